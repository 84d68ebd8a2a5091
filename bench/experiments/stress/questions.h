/// What families make their questions with.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "bench/workload/workload.h"

namespace touchmark::bench::experiments::stress {

struct NamedMesh {
  std::string name;
  TriangleMesh mesh;
};

/// A probe that looks as far as its radius.
inline workload::Step asked(const Vec3& center, double radius) { return {{center, radius}, radius}; }

/// For each centre its distance to the mesh as the oracle knows it, rounded, between the double below and the
/// double above: where the distance is a double, contact begins at the second of the three, where it is not,
/// at the second or the third. No radius is below zero. Centres whose distance is beyond all doubles are left
/// out.
std::vector<workload::Step> at_the_exact_distance(const TriangleMesh& mesh, const std::vector<Vec3>& centers);

/// One trace about one mesh.
workload::Workload workload_on(NamedMesh mesh, std::string trace_name, std::vector<workload::Step> trace);

/// Returns the first so many of a mesh's corner case centers, each at its exact distance. A third of `probes`
/// in centres, spread evenly over the meshes.
std::vector<workload::Workload> corner_case_questions(std::vector<NamedMesh> meshes, std::uint64_t seed,
                                                      std::size_t probes);

/// How many of `probes` each of `parts` gets: at least one.
std::size_t share_of(std::size_t probes, std::size_t parts);

}  // namespace touchmark::bench::experiments::stress
