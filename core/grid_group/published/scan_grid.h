/// Park & Jang's detector as published: groups in no order, every one tested by every query, and the members
/// of each that holds the probe. A triangle is in many groups, and groups may be many more than triangles: no
/// query ends early because that is more than brute force would look at.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/aabb.h"
#include "core/detector.h"
#include "core/geometry/point_triangle.h"
#include "core/geometry/smallest_sphere.h"
#include "core/grid_group/published/uniform_cells.h"
#include "core/search/linear_scan.h"

namespace touchmark::grid {

/// What a group is. The paper's abstract has the smallest sphere, its text the other kind.
enum class Shape {
  cube,            ///< the smallest cuboid along the axes that holds its triangles
  sphere,          ///< the smallest sphere that does
  centered_sphere  ///< the sphere about that cuboid's centre that reaches the farthest vertex of its
                   ///< triangles
};

struct ScanOptions {
  Shape shape = Shape::cube;
  double cell = 0;         ///< edge, mesh units; 0: choose by `groups`
  std::size_t groups = 0;  ///< about so many; 0: choose
};

class ScanGrid {
 public:
  /// The mesh's box must fit the filter's frame (FilterFrame::fits).
  static ScanGrid build(const TriangleMesh& mesh, const ScanOptions& options);

  // A radius or reach must be at least 0.
  bool touches(const Probe& probe, Work& work) const noexcept;
  std::optional<Contact> nearest(const Vec3& center, double reach, Work& work) const noexcept;
  std::optional<Impact> first_hit(const Sweep& sweep, Work& work) const noexcept;

  /// Looks at every triangle once, as the paper's members may be in many groups.
  std::size_t contacts(const Vec3& center, double reach, std::span<Contact> into, Work& work) const noexcept {
    return fallback().contacts(center, reach, into, work);
  }

  std::size_t bytes() const noexcept;
  std::size_t groups() const noexcept { return first_member_.size() - 1; }
  double cell() const noexcept { return cell_; }
  bool coarsened() const noexcept { return coarsened_; }

  /// Returns the mesh's triangles in a group. boxes() or spheres(), whichever was built, hold the shapes
  /// around them; the other is empty.
  std::span<const std::uint32_t> members(std::size_t group) const noexcept {
    return std::span(members_).subspan(first_member_[group], first_member_[group + 1] - first_member_[group]);
  }
  std::span<const Aabb> boxes() const noexcept { return boxes_; }
  std::span<const Sphere> spheres() const noexcept { return spheres_; }

 private:
  void enclose(const TriangleMesh& mesh, Shape shape);
  /// Calls visit(triangle) for the members of every group that holds the point when enlarged by `reach`,
  /// until visit returns true.
  template <class Visit>
  void search(const Vec3& center, double reach, Work& work, const Visit& visit) const noexcept;
  /// Answers for numbers whose squares or fourth powers leave the range of double.
  LinearScan fallback() const noexcept { return {triangles_, bounds_, ids_}; }
  template <class Visit>
  bool search_members(std::size_t group, Work& work, const Visit& visit) const noexcept;

  std::vector<Aabb> boxes_;
  std::vector<Sphere> spheres_;
  std::vector<std::size_t> first_member_;  ///< one more than groups
  std::vector<std::uint32_t> members_;
  std::vector<PreparedTriangle> triangles_;  ///< in the mesh's order
  TriangleIds ids_;
  Aabb bounds_;
  double cell_ = 0;
  bool coarsened_ = false;
};

}  // namespace touchmark::grid
