/// Every small scene in every size and place, and probes where detectors disagree first.
#pragma once

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "bench/scenes.h"
#include "core/triangle_mesh.h"
#include "tests/bench/oracle/hard_triangles.h"

namespace touchmark {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

/// The scenes that need no file: as they are, far from zero, tiny and huge; under a sanitizer, which looks at
/// memory and threads and takes many times as long, only as they are.
inline std::vector<std::string> conformance_scenes() {
  std::vector<std::string> names;
  for (const bench::SceneInfo& scene : bench::scenes()) {
    if (scene.example.empty()) continue;
    names.push_back(scene.example);
    if (sanitized) continue;
    for (const char* modifier : {"@offset=1e6", "@scale=1e-6", "@scale=1e6"})
      names.push_back(scene.example + modifier);
  }
  return names;
}

/// On vertices, edges and faces and just off them, on the borders of cells, at the box's corners, at the
/// middle of a ball, and from far to very far. `count` centres at least; the same for the same mesh.
inline std::vector<Vec3> adversarial_centers(const TriangleMesh& mesh, std::size_t count) {
  HardCases hard(50);
  std::vector<Vec3> centers;
  const Aabb& box = mesh.bounds();
  const double size = std::max(mesh.diagonal(), std::numeric_limits<double>::min());
  centers.push_back(box.center());
  Vec3 mean = Vec3::Zero();
  for (const Vec3& v : mesh.vertices()) mean += (v - box.min) / static_cast<double>(mesh.vertices().size());
  centers.push_back(box.min + mean);  // of a generated ball, its middle
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 weight(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    centers.push_back(box.min + weight.cwiseProduct(box.extent()));
  }
  for (const double distance : {1.0, 1e3, 1e6, 1e12})
    centers.push_back(box.center() + distance * size * hard.vector());
  while (centers.size() < count) {
    const std::size_t i = hard.below(mesh.size());
    const Vec3 &a = mesh.corner(i, 0), &b = mesh.corner(i, 1), &c = mesh.corner(i, 2);
    const Vec3 eighths(static_cast<double>(hard.below(9)) / 8, static_cast<double>(hard.below(9)) / 8,
                       static_cast<double>(hard.below(9)) / 8);
    centers.push_back(a);
    centers.push_back(a + 0.5 * (b - a));
    centers.push_back((a + b + c) / 3);
    centers.push_back(box.min + eighths.cwiseProduct(box.extent()));
    centers.push_back(hard.point_about({a, b, c}));
    centers.push_back(a + 0.005 * size * hard.vector());
    centers.push_back(box.center() + 0.6 * size * hard.vector());
  }
  return centers;
}

/// How many centres a test can afford where something looks at every triangle.
inline std::size_t affordable(const TriangleMesh& mesh) {
  return std::clamp<std::size_t>(150000 / mesh.size(), 40, 200);
}

}  // namespace touchmark
