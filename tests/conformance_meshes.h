/// Every small mesh in every size and place, and probes where detectors disagree first.
#pragma once

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "bench/experiments/stress/corner_case_centers.h"
#include "bench/meshes/meshes.h"
#include "core/triangle_mesh.h"

namespace touchmark {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

/// The meshes that need no file.
inline std::vector<std::string> conformance_meshes() {
  std::vector<std::string> names;
  for (const bench::meshes::NamedMesh& named : bench::meshes::named_meshes())
    if (!named.example.empty()) names.push_back(named.example);
  return names;
}

/// These far from zero, tiny and huge. None under a sanitizer, which looks at memory and threads and takes
/// many times as long.
inline std::vector<std::string> resized_meshes() {
  std::vector<std::string> names;
  for (const std::string& name : conformance_meshes())
    for (const char* modifier : {"@offset=1e6", "@scale=1e-6", "@scale=1e6"})
      if (!sanitized) names.push_back(name + modifier);
  return names;
}

/// `count` centres at least; the same for the same mesh.
inline std::vector<Vec3> adversarial_centers(const TriangleMesh& mesh, std::size_t count) {
  return bench::experiments::stress::corner_case_centers(mesh, count, 50);
}

/// How many centres a test can afford where something looks at every triangle.
inline std::size_t affordable(const TriangleMesh& mesh) {
  return std::clamp<std::size_t>(150000 / mesh.size(), 40, 200);
}

}  // namespace touchmark
