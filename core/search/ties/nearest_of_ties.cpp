#include "core/search/ties/nearest_of_ties.h"

#include <algorithm>
#include <cmath>

#include "core/float_limits.h"
#include "core/search/ties/certified_nearest.h"
#include "core/search/ties/shared_nearest.h"

namespace touchmark {
namespace {

double largest_difference(const PreparedTriangle& triangle, const Vec3& center) noexcept {
  double largest = 0;
  for (const Vec3& corner : triangle.corner)
    largest = std::max(largest, (corner - center).cwiseAbs().maxCoeff());
  return largest;
}

std::optional<Feature> feature_of(const PreparedTriangle& triangle, const Vec3& center) noexcept {
  if (!features_fit(largest_difference(triangle, center))) return std::nullopt;
  return sure_feature(triangle, center);
}

/// No point of the triangle is nearer than its plane.
SquaredDistance squared_off_plane(const PreparedTriangle& triangle, const Vec3& center) noexcept {
  if (!features_fit(largest_difference(triangle, center))) return {{}, infinity};
  return squared_distance(Feature{triangle.corner, 3}, center);
}

/// With d off by e, its square is off by 2 d e + e^2; and by 2^-100 of it for the product, or by underflow.
SquaredDistance square_of(const ClosestPoint& closest) noexcept {
  const double d = closest.distance.high, e = closest.error;
  return {closest.distance * closest.distance, 3 * d * e + 2 * e * e + 0x1p-99 * d * d + 0x1p-900};
}

}  // namespace

TiedTriangle::TiedTriangle(const PreparedTriangle& triangle, const Vec3& center) noexcept
    : triangle_(&triangle), feature_(feature_of(triangle, center)) {}

const SquaredDistance& TiedTriangle::squared(const Vec3& center) noexcept {
  if (!squared_) squared_ = feature_ ? squared_distance(*feature_, center) : SquaredDistance{{}, infinity};
  return *squared_;
}

const std::optional<PreciseClosestPoint>& TiedTriangle::closest(const Vec3& center) noexcept {
  if (!closest_is_known_) closest_ = precise_closest_point(triangle_->corner, center);
  closest_is_known_ = true;
  return closest_;
}

void TiedTriangle::add_to(exact::Lattice& lattice) const noexcept {
  lattice.add(feature_ ? feature_->corner : triangle_->corner);
}

exact::Square TiedTriangle::square(const exact::Lattice& lattice, const Vec3& center) const noexcept {
  return feature_ ? exact::square(lattice, *feature_, center)
                  : exact::square(lattice, triangle_->corner, center);
}

std::optional<bool> KnownTriangles::is_as_far(const PreparedTriangle& triangle) const noexcept {
  for (std::size_t i = 0; i < std::min(count_, known_.size()); ++i)
    if (have_same_corners(known_[i].triangle->corner, triangle.corner)) return known_[i].as_far;
  return std::nullopt;
}

void NearestOfTies::consider(const PreparedTriangle& triangle) noexcept {
  if (nearest_) {
    if (&triangle == first_ || &triangle == &nearest_->triangle()) return;
    const bool shares = location_ && location_->is_nearest_of(triangle);
    std::partial_ordering order = std::partial_ordering::equivalent;
    if (!shares) {
      if (!corner_) corner_.emplace(nearest_->triangle().corner, center_);
      order = corner_->compare(triangle.corner);
    }
    std::optional<TiedTriangle> tied;
    if (order == std::partial_ordering::unordered) order = compare(tied.emplace(triangle, center_));
    if (order == 0 && triangle.index < first_->index) first_ = &triangle;
    if (order >= 0) return;
    nearest_ = tied ? *tied : TiedTriangle(triangle, center_);
  } else {
    nearest_.emplace(triangle, center_);
  }
  first_ = &triangle;
  location_.reset();
  corner_.reset();
  squared_.reset();
  if (nearest_->feature()) location_.emplace(*nearest_->feature(), center_);
  lattice_.reset();
  known_count_ = 0;
  known_triangles_.clear();
}

std::partial_ordering NearestOfTies::compare(TiedTriangle& tied) noexcept {
  const auto &own = tied.feature(), &least = nearest_->feature();
  if (own && least) {
    if (is_same_location(*own, *least)) return std::partial_ordering::equivalent;
    const std::partial_ordering order = touchmark::compare(tied.squared(center_), nearest_->squared(center_));
    if (order != std::partial_ordering::unordered) return order;
    if (own->corners == 3 && least->corners == 3) {
      const std::partial_ordering inside =
          compare_inside(tied.triangle().corner, nearest_->triangle().corner, center_);
      if (inside != std::partial_ordering::unordered) return inside;
    }
    return compare_exactly(tied);
  }
  if (const std::optional<bool> as_far = known_triangles_.is_as_far(tied.triangle()))
    return *as_far ? std::partial_ordering::equivalent : std::partial_ordering::greater;
  if (touchmark::compare(squared_off_plane(tied.triangle(), center_), squared_of_nearest()) > 0)
    return std::partial_ordering::greater;
  const std::partial_ordering order = compare_closely(tied);
  if (order >= 0) known_triangles_.add(tied.triangle(), order == 0);
  return order;
}

const SquaredDistance& NearestOfTies::squared_of_nearest() noexcept {
  if (!squared_) {
    const std::optional<PreciseClosestPoint>* close =
        nearest_->feature() ? nullptr : &nearest_->closest(center_);
    squared_ = close == nullptr ? nearest_->squared(center_)
               : *close         ? square_of((*close)->closest)
                                : SquaredDistance{{}, infinity};
  }
  return *squared_;
}

std::partial_ordering NearestOfTies::compare_closely(TiedTriangle& tied) noexcept {
  const std::partial_ordering order = compare_closest_points(tied);
  return order != std::partial_ordering::unordered ? order : compare_exactly(tied);
}

std::partial_ordering NearestOfTies::compare_closest_points(TiedTriangle& tied) noexcept {
  const TriangleCorners &a = tied.triangle().corner, &b = nearest_->triangle().corner;
  if (have_same_corners(a, b)) return std::partial_ordering::equivalent;
  const std::optional<PreciseClosestPoint>&own = tied.closest(center_), &least = nearest_->closest(center_);
  if (!own || !least) return std::partial_ordering::unordered;
  const std::partial_ordering order = touchmark::compare(own->closest, least->closest);
  if (order != std::partial_ordering::unordered) return order;
  if (on_same_feature(*own, *least)) return std::partial_ordering::equivalent;
  if (is_nearer_inside(*least, b, *own)) return std::partial_ordering::greater;
  if (is_nearer_inside(*own, a, *least)) return std::partial_ordering::less;
  if (own->inside && least->inside) return compare_inside(a, b, center_);
  return std::partial_ordering::unordered;
}

std::strong_ordering NearestOfTies::compare_exactly(const TiedTriangle& tied) noexcept {
  const auto known_end = known_.begin() + static_cast<std::ptrdiff_t>(std::min(known_count_, max_known));
  if (tied.feature()) {
    const auto known = std::find_if(known_.begin(), known_end, [&](const Known& other) {
      return is_same_location(*tied.feature(), other.location);
    });
    if (known != known_end)
      return known->as_far ? std::strong_ordering::equal : std::strong_ordering::greater;
  }
  ++exact_decisions_;
  exact::Lattice lattice = lattice_.value_or(exact::Lattice());
  if (!lattice_) {
    lattice.add(center_);
    nearest_->add_to(lattice);
  }
  tied.add_to(lattice);
  if (!lattice_ || lattice.exponent() != lattice_->exponent()) {
    lattice_ = lattice;
    square_ = nearest_->square(lattice, center_);
  }
  const std::strong_ordering order = exact::compare(tied.square(lattice, center_), square_);
  if (order >= 0 && tied.feature()) known_[known_count_++ % max_known] = {*tied.feature(), order == 0};
  return order;
}

bool NearestOfTies::is_within(const ClosestPoint& closest, double reach) noexcept {
  if (std::isinf(reach)) return true;
  const std::partial_ordering order = touchmark::compare(closest, {.distance = {reach, 0}});
  if (order != std::partial_ordering::unordered) return order <= 0;
  ++exact_decisions_;
  return within_exactly(first_->corner, center_, reach);
}

std::optional<Contact> NearestOfTies::contact(double reach, double error, const TriangleIds& ids) noexcept {
  if (first_ == nullptr) return std::nullopt;
  const PreparedTriangle& triangle = *first_;
  const TriangleId id = ids[triangle.index];
  // These are the bits that a search gives that was certain of this triangle at once.
  const double computed = std::sqrt(touchmark::squared_distance(triangle, center_));
  if (is_certain_on(triangle, computed, center_, reach, error)) {
    if (computed > reach) return std::nullopt;
    return contact_on(triangle, center_, id);
  }
  const std::optional<PreciseClosestPoint> close = precise_closest_point(triangle.corner, center_);
  if (!close) ++exact_decisions_;
  const ClosestPoint closest = close ? close->closest : closest_point_exactly(triangle.corner, center_);
  if (!is_within(closest, reach)) return std::nullopt;
  const bool coincident = closest.direction.isZero(0);
  return Contact{center_ - closest.offset, coincident ? face_normal(triangle) : closest.direction,
                 std::min(closest.distance.rounded(), reach), id};
}

bool WithinRadius::decide(const PreparedTriangle& triangle, std::uint64_t& exact_decisions) noexcept {
  if (outside_ && outside_->is_nearest_of(triangle)) return false;
  TiedTriangle tied(triangle, center_);
  if (!tied.feature() && known_outside_.is_as_far(triangle)) return false;
  if (!tied.feature() && touchmark::compare(squared_off_plane(triangle, center_), squared(radius_)) > 0)
    return false;
  std::partial_ordering order = touchmark::compare(tied.squared(center_), squared(radius_));
  if (order == std::partial_ordering::unordered) {
    if (const std::optional<PreciseClosestPoint>& close = tied.closest(center_))
      order = touchmark::compare(close->closest, {.distance = {radius_, 0}});
  }
  bool within = order <= 0;
  if (order == std::partial_ordering::unordered) {
    ++exact_decisions;
    within = within_exactly(triangle.corner, center_, radius_);
  }
  if (within) return true;
  if (tied.feature()) {
    outside_.emplace(*tied.feature(), center_);
  } else {
    known_outside_.add(triangle, false);
  }
  return false;
}

}  // namespace touchmark
