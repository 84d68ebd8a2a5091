/// The planes that hold a proxy, and the point nearest to its goal that is behind none of them.
///
/// Everything here is rounded as it comes: it says where a proxy tries to go, and never whether it may.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/probe.h"

namespace touchmark {

/// A contact's plane: no point of the surface near `anchor` is meant to come nearer to the proxy than a
/// distance along the normal.
struct ContactPlane {
  Vec3 normal = Vec3::Zero();  ///< unit, out of the surface
  Vec3 anchor = Vec3::Zero();  ///< on the surface
  double lift = 0;             ///< farther off it than usual, since rounding did not let it be
  TriangleId triangle = 0;     ///< the contact's

  double height(const Vec3& x) const noexcept { return normal.dot(x - anchor); }
};

/// A fixed number of planes; takes no memory.
class ContactPlanes {
 public:
  static constexpr std::size_t max_planes = 8, max_active = 3;

  std::size_t size() const noexcept { return count_; }
  bool empty() const noexcept { return count_ == 0; }
  bool full() const noexcept { return count_ == max_planes; }
  void clear() noexcept { count_ = active_count_ = 0; }
  std::span<const ContactPlane> all() const noexcept { return {planes_.data(), count_}; }
  /// Planes of the last solution that hold it.
  std::span<const std::uint8_t> active() const noexcept { return {active_.data(), active_count_}; }

  /// True if the point is above all planes: what a contact there tells is no news where it is not.
  bool protrudes(const Vec3& point, double by) const noexcept;
  void add(const ContactPlane& plane) noexcept {
    if (!full()) planes_[count_++] = plane;
  }
  /// Adds a plane that has just been met, or lifts the one of the same direction that should have kept the
  /// proxy off.
  void meet(const ContactPlane& plane, double lift) noexcept;

  /// The point nearest to the goal that is at least `distance` off all planes; where there is none, that is
  /// no less off each than `at` is. By the conditions of Karush, Kuhn and Tucker: the first set of at most
  /// three planes whose solution pushes on all of them and is behind none, within the slack. `at` where there
  /// is none.
  Vec3 nearest_to(const Vec3& goal, const Vec3& at, double distance, double slack) noexcept;

 private:
  bool solve(std::span<const double> lack, double slack, Vec3& offset) noexcept;
  bool try_set(std::span<const std::uint8_t> chosen, std::span<const double> lack, double slack,
               Vec3& offset) const noexcept;

  std::array<ContactPlane, max_planes> planes_;
  std::size_t count_ = 0;
  std::array<std::uint8_t, max_active> active_{};
  std::size_t active_count_ = 0;
};

}  // namespace touchmark
