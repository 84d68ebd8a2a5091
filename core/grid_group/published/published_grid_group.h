/// The grid-group detector as published: J.-S. Park and T.-J. Jang, Journal of Digital Contents Society
/// 19(1), 2018, pages 199-204, in Korean.
///
/// Space is cut into uniform cells, and a triangle belongs to every cell it touches. A group is the smallest
/// cuboid or sphere around the triangles of a cell. A query tests the HIP against every group, then all
/// triangles of the groups that hold it. A probe of radius r enlarges the groups by r, so every answer is
/// exact. A triangle is in many groups, and groups may be many more than triangles: no query ends early
/// because that is more than brute force would look at.
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
#include "core/mesh_update.h"
#include "core/search/linear_scan.h"

namespace touchmark {

/// The grid-group detector as published; satisfies Detector, Updates and every query.
class PublishedGridGroup {
 public:
  /// What a group is. The paper's abstract has the smallest sphere, its text the other kind.
  enum class Shape {
    cube,            ///< the smallest cuboid along the axes that holds its triangles
    sphere,          ///< the smallest sphere that does
    centered_sphere  ///< the sphere about that cuboid's centre that reaches the farthest vertex of its
                     ///< triangles
  };
  /// What `build` may be told.
  struct Options {
    Shape shape = Shape::cube;  ///< shape of the groups
    double cell = 0;            ///< edge of a cell, mesh units; 0: choose by `groups`
    std::size_t groups = 0;     ///< with cell = 0: aim at about so many groups; 0: choose
  };
  /// The work counters; nothing else is remembered.
  struct Session {
    Work work;
  };

  /// Throws std::invalid_argument for a cell below 0 or not finite.
  static PublishedGridGroup build(const TriangleMesh& mesh, const Options& options);
  static PublishedGridGroup build(const TriangleMesh& mesh) { return build(mesh, Options()); }
  /// See the concept Updates. It is built anew.
  void update(const TriangleMesh& mesh);

  bool touches(const Probe& probe, Session& session) const noexcept;
  std::optional<Contact> nearest(const Probe& probe, double reach, Session& session) const noexcept;
  std::optional<Impact> first_hit(const Sweep& sweep, Session& session) const noexcept;
  /// Looks at every triangle once, as the paper's members may be in many groups.
  std::size_t contacts(const Probe& probe, double reach, Session& session,
                       std::span<Contact> into) const noexcept;

  std::size_t bytes() const noexcept;
  Accuracy accuracy() const noexcept { return certified; }

  /// Groups that every query tests: one, without a shape, where the mesh's extent admits no cells.
  std::size_t groups() const noexcept { return is_grouped() ? first_member_.size() - 1 : 1; }
  /// Edge of a cell, in mesh units; 0 where the mesh's extent admits no cells.
  double cell() const noexcept { return cell_; }
  /// True if the cells were made larger than asked, to keep within memory.
  bool coarsened() const noexcept { return coarsened_; }

  /// Returns the mesh's triangles in a group. boxes() or spheres(), whichever was built, hold the shapes
  /// around them; the other is empty.
  std::span<const std::uint32_t> members(std::size_t group) const noexcept {
    return std::span(members_).subspan(first_member_[group], first_member_[group + 1] - first_member_[group]);
  }
  std::span<const Aabb> boxes() const noexcept { return boxes_; }
  std::span<const Sphere> spheres() const noexcept { return spheres_; }

 private:
  /// False where the mesh's extent is zero or its squares leave the range of double: then every triangle is
  /// looked at.
  bool is_grouped() const noexcept { return !first_member_.empty(); }
  void group(const TriangleMesh& mesh);
  void enclose(const TriangleMesh& mesh);
  /// Calls visit(triangle) for the members of every group that holds the point when enlarged by `reach`,
  /// until visit returns true.
  template <class Visit>
  void search(const Vec3& center, double reach, Work& work, const Visit& visit) const noexcept;
  /// Answers without groups, and for numbers whose squares or fourth powers leave the range of double.
  LinearScan fallback() const noexcept { return {triangles_, bounds_, ids_}; }
  template <class Visit>
  bool search_members(std::size_t group, Work& work, const Visit& visit) const noexcept;

  Options options_;
  Connectivity connectivity_;
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

}  // namespace touchmark
