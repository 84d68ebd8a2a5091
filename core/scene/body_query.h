/// One body asked about one point: its detector answers in the body's frame to within a bound, and what that
/// leaves open is decided on the images of its stored triangles. docs/exactness.md, E27, E28 and E30.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "core/detector.h"
#include "core/geometry/distance_error.h"
#include "core/scene/nearest_image.h"
#include "core/scene/scene_bodies.h"
#include "core/scene/seen_body.h"
#include "core/scene/shape.h"
#include "core/search/around.h"

namespace touchmark {

/// What a distance that a detector of this accuracy reports may be off by for a point there.
inline double distance_error(const Accuracy& accuracy, const Aabb& bounds, const Vec3& center) noexcept {
  return accuracy.relative * largest_difference(bounds, center) + accuracy.absolute;
}

/// Everything named here outlives it.
template <Detector D>
class BodyQuery {
 public:
  BodyQuery(const Shape<D>& shape, const SeenBody& seen, std::uint32_t body,
            typename D::Session& session) noexcept
      : shape_(shape),
        body_(body),
        session_(session),
        seen_(seen),
        error_(distance_error(shape.detector->accuracy(), shape.mesh->bounds(), seen_.center())) {}

  const SeenBody& seen() const noexcept { return seen_; }

  /// What is known of the distance to the body, or nothing where that surely exceeds the reach.
  std::optional<DistanceInterval> distance(double reach) const noexcept {
    const std::optional<Contact> found =
        shape_.detector->nearest({seen_.center(), 0}, seen_.reach_in_frame(reach, error_), session_);
    if (!found) return std::nullopt;
    const DistanceInterval distance = seen_.in_scene(found->distance, error_);
    return distance.lower > reach ? std::nullopt : std::optional(distance);
  }

  /// Shows all triangles that can be the nearest of the scene, where that is within the limit. It looks
  /// farther by this part of the mesh's diagonal, so that `clearance` has more to say.
  void nearest(NearestImage& nearest, double limit, double ahead, Work& work) const noexcept {
    if constexpr (TellsCloseTriangles<D>) {
      CloseTriangles close;
      const double farther = limit + ahead * shape_.mesh->bounds().diagonal();
      if (shape_.detector->close_triangles(seen_.center(), seen_.reach_in_frame(farther, error_),
                                           slack(farther), session_, close)) {
        if (close.count == 0) return;
        const DistanceInterval least = seen_.in_scene(close.least, close.error);
        if (least.lower > limit) return;
        const SeenCorners corners(seen_);
        if (close.count == 1) {
          // It is the least; whether another one is as near was not asked.
          ImageCandidate only = seen_as(corners, close.triangle[0]);
          only.distance = least;
          nearest.consider(only, work.exact_decisions);
          return;
        }
        for (std::size_t k = 0; k < close.count; ++k)
          nearest.consider_unmeasured(seen_as(corners, close.triangle[k]), work.exact_decisions);
        return;
      }
    }
    const std::optional<DistanceInterval> known = distance(limit);
    if (!known) return;
    for_each_within(std::min(limit, known->upper), [&](const ImageCandidate& candidate) {
      nearest.consider(candidate, work.exact_decisions);
      return false;
    });
  }

  /// Bounds the body's distance from below, by what its detector remembers.
  double clearance() const noexcept {
    if constexpr (TellsClearance<D>)
      return seen_.in_scene(shape_.detector->clearance(seen_.center(), session_), 0).lower;
    return -std::numeric_limits<double>::infinity();
  }

  bool touches(double radius, LimitedWork& work) const noexcept {
    // A detector's own answer costs less than the nearest triangle, and decides all but distances that
    // rounding leaves open.
    if (!shape_.detector->touches({seen_.center(), seen_.reach_in_frame(radius, error_)}, session_))
      return false;
    const double inner = seen_.surely_within(radius, error_);
    if (inner >= 0 && shape_.detector->touches({seen_.center(), inner}, session_)) return true;
    if (work.limit == LimitedWork::unlimited) {  // as `nearest` keeps to none
      const std::optional<DistanceInterval> known = distance(radius);
      if (!known) return false;
      if (known->upper <= radius) return true;
    }
    return for_each_within(radius, [&](const ImageCandidate& candidate) {
      return work.exceeds_limit() || is_within(candidate, seen_.point(), radius, work.exact_decisions);
    });
  }

  /// Calls visit(candidate) for all triangles whose images can be within the reach, and for some more, until
  /// one returns true. Returns whether one did.
  template <class Visit>
  bool for_each_within(double reach, const Visit& visit) const noexcept {
    const SeenCorners corners(seen_);
    std::array<Contact, 32> contacts;
    const std::size_t count = shape_.detector->contacts(
        {seen_.center(), 0}, seen_.reach_in_frame(reach, error_), session_, contacts);
    if (count > contacts.size()) return for_each_of_all(corners, visit);
    for (std::size_t k = 0; k < count; ++k) {
      const Contact& contact = contacts[k];
      const auto [begin, end] = triangles_of(contact.triangle);
      // The triangles of one polygon come together, once.
      if (end - begin > 1 && std::any_of(contacts.begin(), contacts.begin() + static_cast<std::ptrdiff_t>(k),
                                         [&](const Contact& c) { return c.triangle == contact.triangle; }))
        continue;
      for (std::uint32_t i = begin; i < end; ++i) {
        ImageCandidate candidate = this->candidate(corners, i);
        if (end - begin == 1) candidate.distance = seen_.in_scene(contact.distance, error_);
        if (visit(candidate)) return true;
      }
    }
    return false;
  }

  /// No triangle is farther than twice the largest difference of coordinates.
  double slack(double limit) const noexcept {
    return seen_.slack(std::min(limit, 2 * largest_difference(shape_.mesh->bounds(), seen_.center())));
  }

  /// Returns the places in the mesh of the triangles with this id, of which there is one at least.
  std::pair<std::uint32_t, std::uint32_t> triangles_of(TriangleId id) const noexcept {
    const std::span<const TriangleId> ids = shape_.mesh->ids();
    if (ids.empty()) return {id, id + 1};
    const auto [first, last] = std::equal_range(ids.begin(), ids.end(), id);
    return {static_cast<std::uint32_t>(first - ids.begin()), static_cast<std::uint32_t>(last - ids.begin())};
  }
  ImageCandidate candidate(const SeenCorners& corners, std::uint32_t triangle) const noexcept {
    ImageCandidate result = seen_as(corners, triangle);
    result.distance = distance_to(result.seen);
    return result;
  }
  /// Without the distance.
  ImageCandidate seen_as(const SeenCorners& corners, std::uint32_t triangle) const noexcept {
    const TriangleMesh& mesh = *shape_.mesh;
    ImageCandidate result;
    result.body = body_;
    result.triangle = triangle;
    result.id = mesh.id(triangle);
    result.posed = {{mesh.corner(triangle, 0), mesh.corner(triangle, 1), mesh.corner(triangle, 2)},
                    &seen_.pose()};
    result.seen = corners(result.posed.corner);
    return result;
  }

 private:
  template <class Visit>
  bool for_each_of_all(const SeenCorners& corners, const Visit& visit) const noexcept {
    if constexpr (KeepsToLimit<D>)
      if (session_.work.exceeds_limit(shape_.mesh->size())) return false;
    session_.work.triangles += shape_.mesh->size();
    for (std::uint32_t i = 0; i < shape_.mesh->size(); ++i)
      if (visit(candidate(corners, i))) return true;
    return false;
  }

  const Shape<D>& shape_;
  std::uint32_t body_;
  typename D::Session& session_;
  SeenBody seen_;
  double error_;
};

}  // namespace touchmark
