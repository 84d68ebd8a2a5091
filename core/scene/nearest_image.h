/// The exactly nearest of the images of triangles under poses: of several the lowest body's, and of that the
/// lowest triangle. docs/exactness.md, E28.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>

#include "core/probe.h"
#include "core/scene/posed_predicates.h"
#include "core/scene/seen_body.h"

namespace touchmark {

/// One triangle of a body, and what is known of how far its image is.
struct ImageCandidate {
  std::uint32_t body = 0;
  std::uint32_t triangle = 0;  ///< its place in the mesh
  TriangleId id = 0;
  PosedTriangle posed;
  SeenTriangle seen;
  DistanceInterval distance;
};

/// Keeps the nearest of the candidates that it is shown, in any order and more than once. Doubles decide
/// where their bounds let them, then a shared corner or edge, then whole numbers.
class NearestImage {
 public:
  explicit NearestImage(const Vec3& point) noexcept : point_(point) {}
  explicit NearestImage(const Vec3&&) = delete;

  void consider(const ImageCandidate& candidate, std::uint64_t& exact_decisions) noexcept;
  /// Considers a triangle whose distance is not told yet. It is that of the best where both surely share the
  /// nearest corner or edge, so that the triangles around a corner are measured once.
  void consider_unmeasured(ImageCandidate candidate, std::uint64_t& exact_decisions) noexcept;
  const std::optional<ImageCandidate>& best() const noexcept { return best_; }
  /// Nothing farther than this can be the nearest.
  double upper() const noexcept {
    return best_ ? best_->distance.upper : std::numeric_limits<double>::infinity();
  }
  /// Returns the contact of the nearest, or nothing where even that is beyond the reach, exactly.
  std::optional<Contact> contact(double reach, std::uint64_t& exact_decisions) const noexcept;

 private:
  std::weak_ordering compare(const ImageCandidate& a, const ImageCandidate& b,
                             std::uint64_t& exact_decisions) const noexcept;

  bool is_best(const ImageCandidate& candidate) const noexcept {
    return best_ && candidate.body == best_->body && candidate.triangle == best_->triangle;
  }

  const Vec3& point_;
  std::optional<ImageCandidate> best_;
};

/// What the kernel says of the distance to a triangle seen from the point.
DistanceInterval distance_to(const SeenTriangle& seen) noexcept;
/// What it says of the surface, which is so far from the triangle.
DistanceInterval distance_to(const SeenTriangle& seen, double radius) noexcept;

/// Is the surface within the radius? Exact.
bool is_within(const ImageCandidate& candidate, const Vec3& point, double radius,
               std::uint64_t& exact_decisions) noexcept;

/// The contact on the surface, its distance within 32 u M of the true one, M the largest coordinate
/// difference between the point and the image's corners, and a round body's radius on top.
Contact contact_on_image(const ImageCandidate& candidate, const Vec3& point,
                         std::uint64_t& exact_decisions) noexcept;

/// The contact on the surface of a round body of this radius, of that with its axis.
Contact lifted(Contact on_axis, double radius) noexcept;

}  // namespace touchmark
