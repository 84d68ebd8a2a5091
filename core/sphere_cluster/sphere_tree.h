/// A hierarchy of spheres over a mesh, searched nearest first.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/detector.h"
#include "core/geometry/point_triangle.h"
#include "core/sphere_cluster/clustering.h"

namespace touchmark {

class SphereTree {
 public:
  /// What a haptic point remembers between ticks.
  struct Memory {
    std::uint32_t last = 0;  ///< where the last nearest triangle is kept
  };

  SphereTree() = default;
  SphereTree(const TriangleMesh& mesh, const SphereClusters& clusters);

  bool touches(const Probe& probe, Memory& memory, Work& work) const noexcept;
  std::optional<Contact> nearest(const Vec3& center, double reach, Memory& memory, Work& work) const noexcept;
  std::optional<Impact> first_hit(const Sweep& sweep, Memory& memory, Work& work) const noexcept;
  std::size_t bytes() const noexcept;

 private:
  struct Node {
    Sphere sphere;
    std::uint32_t first = 0;  // leaf: its first triangle. Else: its first child; the other one follows.
    std::uint32_t count = 0;  // triangles; 0: not a leaf
  };
  struct Best {
    Candidate candidate;
    std::uint32_t kept_at = 0;
  };

  void build(std::uint32_t node, std::uint32_t begin, std::uint32_t end);
  TriangleId id(std::uint32_t index) const noexcept { return ids_.empty() ? index : ids_[index]; }
  void consider(std::uint32_t triangle, const Vec3& center, Best& best, Work& work) const noexcept;

  std::vector<Node> nodes_;
  std::vector<PreparedTriangle> triangles_;  // in the order of the leaves
  std::vector<TriangleId> ids_;              // by mesh index; empty when they are the same
};

}  // namespace touchmark
