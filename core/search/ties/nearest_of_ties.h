/// The exactly nearest of triangles that are as near as rounding lets doubles tell, or which of them are
/// within a radius. Each is compared with the nearest so far by the first of these that is sure
/// (docs/exactness.md, E6):
///   1. closest_candidates.h: a search keeps those whose computed distances are as near but for rounding.
///   2. shared_corner.h, shared_nearest.h: a corner or an edge that both have is nearest, by doubles alone.
///   3. same_location.h: the nearest corner, edge or face of each, and its distance in 106 bits.
///   4. corner_advance.h: how much nearer than a corner that both have each comes.
///   5. core/exact/precise_closest_point.h: nearest points in 106 bits.
///   6. core/exact/exact_square.h: whole numbers.
/// certified_nearest.h is what a search calls. Before steps 5 and 6, the places and triangles that they last
/// found not to be nearer are known again. So many triangles about one corner or edge, or in one place, cost
/// about as much again as their kernel distances; N different places as far but for rounding 4 to 14 times
/// that; and whole numbers for each, 20 to 100 times, are needed only by N different edges or faces whose
/// distances agree to 2^-97.
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
#include "core/search/ties/corner_advance.h"
#include "core/search/ties/same_location.h"
#include "core/triangle_ids.h"

namespace touchmark {

/// A triangle that doubles do not tell from others as near, and what has been found out about it so far.
class TiedTriangle {
 public:
  TiedTriangle(const PreparedTriangle& triangle, const Vec3& center) noexcept;

  const PreparedTriangle& triangle() const noexcept { return *triangle_; }
  /// The feature that is nearest, where doubles are sure of it.
  const std::optional<Feature>& feature() const noexcept { return feature_; }
  const SquaredDistance& squared(const Vec3& center) noexcept;
  /// Returns the closest point, or nothing where 106 bits do not tell.
  const std::optional<PreciseClosestPoint>& closest(const Vec3& center) noexcept;
  void add_to(exact::Lattice& lattice) const noexcept;
  exact::Square square(const exact::Lattice& lattice, const Vec3& center) const noexcept;

 private:
  const PreparedTriangle* triangle_;
  std::optional<Feature> feature_;
  std::optional<SquaredDistance> squared_;
  std::optional<PreciseClosestPoint> closest_;
  bool closest_is_known_ = false;
};

/// The last triangles found not to be nearer, or not within a radius, and whether they were as far: another
/// with the same corners is known.
class KnownTriangles {
 public:
  void add(const PreparedTriangle& triangle, bool as_far) noexcept {
    known_[count_++ % known_.size()] = {&triangle, as_far};
  }
  void clear() noexcept { count_ = 0; }
  /// Returns whether a triangle of the same corners was as far, or nothing where none is known.
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

  /// Keeps the nearest, and of several as far the first of the mesh.
  void consider(const PreparedTriangle& triangle) noexcept;
  /// The nearest of those considered; null where there were none.
  const PreparedTriangle* nearest() const noexcept { return first_; }
  /// Returns the contact of the nearest, or nothing when even that is beyond the reach. It is the kernel's
  /// where that is certain by the error.
  std::optional<Contact> contact(double reach, double error, const TriangleIds& ids) noexcept;

  /// How often whole numbers decided.
  std::uint64_t exact_decisions() const noexcept { return exact_decisions_; }

 private:
  /// How the other compares with the nearest so far.
  std::partial_ordering compare(TiedTriangle& tied) noexcept;
  const SquaredDistance& squared_of_nearest() noexcept;
  std::partial_ordering compare_closely(TiedTriangle& tied) noexcept;
  std::partial_ordering compare_closest_points(TiedTriangle& tied) noexcept;
  std::strong_ordering compare_exactly(const TiedTriangle& tied) noexcept;
  bool is_within(const ClosestPoint& closest, double reach) noexcept;

  /// Places that whole numbers found to be no nearer than the nearest so far.
  struct Known {
    Feature location;
    bool as_far;
  };
  static constexpr std::size_t max_known = 8;

  const Vec3& center_;
  const PreparedTriangle* first_ = nullptr;  ///< first of those as far as the nearest
  std::optional<TiedTriangle> nearest_;      ///< one of them
  std::optional<SharedFeature> location_;    ///< its feature
  std::optional<BesideCorner> corner_;       ///< its corner
  std::optional<SquaredDistance> squared_;   ///< its squared distance, where that was asked for
  std::optional<exact::Lattice> lattice_;    ///< lattice of its square, where that is known
  exact::Square square_;
  std::array<Known, max_known> known_;
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
  double error_;  ///< bounds the error of a computed distance
  std::optional<SharedFeature> outside_;
  KnownTriangles known_outside_;
};

}  // namespace touchmark
