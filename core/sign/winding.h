/// How often a mesh winds round a point: exactly where it is closed (docs/exactness.md, E20), within a known
/// error where it is not (E22).
///
/// A ray goes down from the point. Through a closed surface it passes as often outwards as the surface winds
/// round the point, less the times it passes inwards. What is open is closed first by curtains that hang
/// upwards from its open edges to infinity, which the ray never meets; the winding number of the mesh alone
/// is the count less what the curtains cover (van Oosterom & Strackee, "The solid angle of a plane triangle",
/// 1983). That is one ray and a term for each open edge instead of a term for each triangle (Jacobson, Kavan
/// & Sorkine-Hornung, "Robust inside-outside segmentation using generalized winding numbers", 2013).
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "core/sign/triangle_tree.h"

namespace touchmark::sign {

class Winding {
 public:
  /// A number with what it may be off by.
  struct Share {
    double value = 0;
    double error = 0;
  };

  Winding() = default;
  /// The open edges in the direction in which their triangles run.
  Winding(const TriangleMesh& mesh, std::vector<std::array<Vec3, 2>> open_edges);

  /// The winding number of the mesh and its curtains; nothing on the surface itself. Exact, for finite
  /// points.
  std::optional<int> count(const Vec3& point) const noexcept;
  /// What the curtains contribute to that.
  Share of_curtains(const Vec3& point) const noexcept;

  const TriangleTree& tree() const noexcept { return tree_; }
  std::size_t bytes() const noexcept {
    return tree_.bytes() + open_edges_.capacity() * sizeof(open_edges_[0]);
  }

 private:
  TriangleTree tree_;
  std::vector<std::array<Vec3, 2>> open_edges_;
};

}  // namespace touchmark::sign
