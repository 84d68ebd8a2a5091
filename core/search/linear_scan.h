/// What brute force does, for whoever falls back on it: a look at every triangle.
///
/// A hierarchy costs most where it is of no use: where everything is equally near, or equal. So each query of
/// our forms that has looked at as much as there are triangles, and a little, ends with these. It so costs at
/// most twice what brute force does, and a little, whatever the scene; and answers the same bits. The
/// published scans end with these only for numbers that their own arithmetic cannot hold.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "core/aabb.h"
#include "core/detector.h"
#include "core/geometry/point_triangle.h"
#include "core/mesh_motion.h"
#include "core/probe.h"
#include "core/search/first_touch.h"
#include "core/triangle_ids.h"

namespace touchmark {

/// What a query may look at before it ends with a look at every triangle. The little is a few nodes of eight
/// and their blocks, so that small meshes are searched like any other.
inline std::uint64_t work_budget(std::size_t triangles) noexcept {
  constexpr std::uint64_t little = 64;
  return triangles + little;
}

inline constexpr std::uint64_t any_work = std::numeric_limits<std::uint64_t>::max();

/// What is left of it after `spent`.
inline std::uint64_t remaining(std::uint64_t budget, std::uint64_t spent) noexcept {
  return budget > spent ? budget - spent : 0;
}

/// The triangles in any order, `bounds` theirs. For any finite numbers, and nothing for others, in a unit of
/// its own where their fourth powers would leave the range of double; they are counted once, and in such a
/// unit twice.
struct LinearScan {
  std::span<const PreparedTriangle> triangles;
  const Aabb& bounds;
  const TriangleIds& ids;
  bool is_certified = true;  ///< false: contact as doubles have it

  bool touches(const Probe& probe, Work& work) const noexcept;
  std::optional<Contact> nearest(const Vec3& center, double reach, Work& work) const noexcept;
  std::optional<Impact> first_hit(const Sweep& sweep, Work& work) const noexcept;
  std::optional<Impact> first_hit_moving(const Sweep& sweep, const MeshMotion& motion,
                                         Work& work) const noexcept;
  std::size_t contacts(const Vec3& center, double reach, std::span<Contact> into, Work& work) const noexcept;
  /// Looks at all for the first touch.
  FirstTouch first_touch(const Sweep& sweep, Work& work) const noexcept;

 private:
  std::optional<Contact> nearest_as_computed(const Vec3& center, double reach, Work& work) const noexcept;
};

}  // namespace touchmark
