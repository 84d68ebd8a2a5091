/// The exactly nearest of triangles that are as near as rounding lets doubles tell, or which of them are
/// within a radius.
///
/// Each is compared with the nearest so far by the cheapest comparison that is sure: a shared corner or edge,
/// sure features in 106 bits, nearest points in 106 bits, whole numbers (docs/exactness.md, E6). Before the
/// last two, the places and triangles that they last found not to be nearer are known again. So many
/// triangles about one corner or edge, or in one place, cost about as much again as their kernel distances; N
/// different places as far but for rounding 3 to 35 times that; and whole numbers for each, 20 to 100 times,
/// are needed only by N different edges or faces whose distances agree to 2^-97.
#pragma once

#include <array>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/exact/exact_square.h"
#include "core/exact/precise_closest_point.h"
#include "core/geometry/point_triangle.h"
#include "core/probe.h"
#include "core/search/sure_feature.h"

namespace touchmark {

/// A triangle that doubles do not tell from others as near, and what has been found out about it so far.
class Rival {
 public:
  Rival(const PreparedTriangle& triangle, const Vec3& center) noexcept;

  const PreparedTriangle& triangle() const noexcept { return *triangle_; }
  /// The feature that is nearest, where doubles are sure of it.
  const std::optional<Feature>& feature() const noexcept { return feature_; }
  const SquaredDistance& squared(const Vec3& center) noexcept;
  /// Nothing where 106 bits do not tell.
  const std::optional<CloseFoot>& foot(const Vec3& center) noexcept;
  void add_to(exact::Grid& grid) const noexcept;
  exact::Square square(const exact::Grid& grid, const Vec3& center) const noexcept;

 private:
  const PreparedTriangle* triangle_;
  std::optional<Feature> feature_;
  std::optional<SquaredDistance> squared_;
  std::optional<CloseFoot> foot_;
  bool foot_is_sought_ = false;
};

/// The last triangles found not to be nearer, or not within a radius, and whether they were as far: another
/// with the same corners is known.
class KnownTriangles {
 public:
  void add(const PreparedTriangle& triangle, bool as_far) noexcept {
    known_[count_++ % known_.size()] = {&triangle, as_far};
  }
  void clear() noexcept { count_ = 0; }
  /// Nothing where it is not known.
  std::optional<bool> is_as_far(const PreparedTriangle& triangle) const noexcept;

 private:
  struct Known {
    const PreparedTriangle* triangle;
    bool as_far;
  };
  std::array<Known, 8> known_;
  std::size_t count_ = 0;
};

class NearestOfTies {
 public:
  explicit NearestOfTies(const Vec3& center) noexcept : center_(center) {}
  explicit NearestOfTies(const Vec3&&) = delete;

  /// Of several as far it keeps the first of the mesh.
  void consider(const PreparedTriangle& triangle) noexcept;
  /// The nearest of those considered; null where there were none.
  const PreparedTriangle* nearest() const noexcept { return first_; }
  /// Its contact; nothing when even that is beyond the reach. The kernel's, where that is certain by the
  /// error. `ids` by the mesh's order, empty where they are the same.
  std::optional<Contact> contact(double reach, double error, std::span<const TriangleId> ids) noexcept;

  /// How often whole numbers decided.
  std::uint64_t exact_decisions() const noexcept { return exact_decisions_; }

 private:
  /// How the rival compares with the nearest so far.
  std::partial_ordering compare(Rival& rival) noexcept;
  std::partial_ordering compare_closely(Rival& rival) noexcept;
  std::partial_ordering compare_feet(Rival& rival) noexcept;
  std::strong_ordering compare_exactly(const Rival& rival) noexcept;
  bool is_within(const Foot& foot, double reach) noexcept;

  /// Places that whole numbers found to be no nearer than the nearest so far.
  struct Known {
    Feature place;
    bool as_far;
  };
  static constexpr std::size_t most_known = 8;

  const Vec3& center_;
  const PreparedTriangle* first_ = nullptr;  ///< of those as far as the nearest
  std::optional<Rival> nearest_;             ///< one of them
  std::optional<SharedPlace> place_;         ///< its place
  std::optional<exact::Grid> grid_;          ///< of its square, where that is known
  exact::Square square_;
  std::array<Known, most_known> known_;
  std::size_t known_count_ = 0;
  KnownTriangles known_triangles_;
  std::uint64_t exact_decisions_ = 0;
};

/// Which triangles are within a radius, exactly. What doubles leave open is decided by the steps above, and
/// remembered of the last place that is not within it.
class WithinRadius {
 public:
  WithinRadius(const Vec3& center, double radius, double error) noexcept
      : center_(center), radius_(radius), error_(error) {}

  /// Is this triangle, at this computed distance? Counts where whole numbers decide.
  bool operator()(const PreparedTriangle& triangle, double distance,
                  std::uint64_t& exact_decisions) noexcept {
    if (std::abs(distance - radius_) > error_) return distance < radius_;
    return decide(triangle, exact_decisions);
  }

 private:
  [[gnu::cold, gnu::noinline]] bool decide(const PreparedTriangle& triangle,
                                           std::uint64_t& exact_decisions) noexcept;

  const Vec3& center_;
  double radius_;
  double error_;  ///< of a computed distance
  std::optional<SharedPlace> outside_;
  KnownTriangles known_outside_;
};

}  // namespace touchmark
