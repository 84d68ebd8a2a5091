/// One function a family; families.cpp says what each is for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bench/workload/workload.h"

namespace touchmark::bench::experiments::stress {

// meshes_of_bad_shape.cpp
std::vector<workload::Workload> needles(std::uint64_t seed, std::size_t probes);
std::vector<workload::Workload> caps(std::uint64_t seed, std::size_t probes);
std::vector<workload::Workload> degenerate(std::uint64_t seed, std::size_t probes);
std::vector<workload::Workload> spanning_triangle(std::uint64_t seed, std::size_t probes);
std::vector<workload::Workload> one_cell(std::uint64_t seed, std::size_t probes);
std::vector<workload::Workload> single_triangle(std::uint64_t seed, std::size_t probes);
std::vector<workload::Workload> empty_mesh(std::uint64_t seed, std::size_t probes);

// scaled_and_offset_meshes.cpp
std::vector<workload::Workload> thresholds(std::uint64_t seed, std::size_t probes);
std::vector<workload::Workload> scales(std::uint64_t seed, std::size_t probes);
std::vector<workload::Workload> offsets(std::uint64_t seed, std::size_t probes);
std::vector<workload::Workload> ball_centre(std::uint64_t seed, std::size_t probes);

// probes_on_a_lattice.cpp
std::vector<workload::Workload> radius_zero(std::uint64_t seed, std::size_t probes);
std::vector<workload::Workload> ties(std::uint64_t seed, std::size_t probes);
std::vector<workload::Workload> cell_borders(std::uint64_t seed, std::size_t probes);
std::vector<workload::Workload> tangent(std::uint64_t seed, std::size_t probes);

// non_finite_probes.cpp
std::vector<workload::Workload> huge(std::uint64_t seed, std::size_t probes);
std::vector<workload::Workload> denormal(std::uint64_t seed, std::size_t probes);
std::vector<workload::Workload> not_a_number(std::uint64_t seed, std::size_t probes);

// sweeps.cpp
std::vector<workload::Workload> sweeps(std::uint64_t seed, std::size_t probes);
std::vector<workload::Workload> far_sweeps(std::uint64_t seed, std::size_t probes);

// motions.cpp
std::vector<workload::Workload> motions(std::uint64_t seed, std::size_t probes);

// near_ties.cpp
std::vector<workload::Workload> near_ties(std::uint64_t seed, std::size_t probes);

// shared_features.cpp
std::vector<workload::Workload> shared_features(std::uint64_t seed, std::size_t probes);

// control_family.cpp
std::vector<workload::Workload> control_family(std::uint64_t seed, std::size_t probes);

}  // namespace touchmark::bench::experiments::stress
