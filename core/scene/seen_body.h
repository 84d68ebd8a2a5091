/// A body as a point of the scene sees it: where the point is in the body's frame, and by how much distances
/// there differ from those to the body's image. docs/exactness.md, E27.
#pragma once

#include <limits>

#include "core/exact/feature.h"
#include "core/probe.h"
#include "core/scene/pose.h"

namespace touchmark {

/// The true distance is surely in it.
struct DistanceInterval {
  double lower = 0;
  double upper = std::numeric_limits<double>::infinity();
};

class SeenBody {
 public:
  /// `rigid` is rigid_error of the pose's rotation. The pose and the point outlive this.
  SeenBody(const Pose& pose, double rigid, const Vec3& point) noexcept;

  const Vec3& center() const noexcept { return center_; }
  const Pose& pose() const noexcept { return *pose_; }
  const Vec3& point() const noexcept { return *point_; }
  /// Bounds how far the image of `center` is off the point.
  double residue() const noexcept { return residue_; }

  /// What is known of the distance to an image whose distance to `center` is this in the body's frame, but
  /// for an error.
  DistanceInterval in_scene(double distance, double error) const noexcept;
  /// Returns a distance in the body's frame beyond which no image is within the reach.
  double reach_in_frame(double reach, double error) const noexcept;
  /// Two triangles that far at most may have images in either order if their distances in the body's frame
  /// differ by no more than this.
  double slack(double distance) const noexcept;
  /// Returns a distance in the body's frame within which every image is within the reach; less than 0 where
  /// nothing is known.
  double surely_within(double reach, double error) const noexcept;

 private:
  const Pose* pose_;
  const Vec3* point_;
  double rigid_;
  double residue_;
  Vec3 center_;
};

/// A triangle's image as seen from a point, each corner off by at most `error`; infinite where the numbers
/// leave the range in which that is known.
struct SeenTriangle {
  TriangleCorners corner;
  double error = 0;
  double largest = 0;  ///< the longest of the corners
};

/// The images of one body's triangles as seen from the point.
class SeenCorners {
 public:
  explicit SeenCorners(const SeenBody& body) noexcept
      : SeenCorners(body.pose(), body.center(), body.point()) {}
  /// `center` is the point in the body's frame, as in_frame rounds it. The pose outlives this.
  SeenCorners(const Pose& pose, const Vec3& center, const Vec3& point) noexcept;
  SeenTriangle operator()(const TriangleCorners& triangle) const noexcept;
  /// What a corner so far from the point may be off by, also where a triangle's fourth powers underflow.
  double error_at(double longest) const noexcept;

 private:
  const Pose* pose_;
  Vec3 center_;
  Vec3 rest_;          ///< from the point to the image of `center_`
  double rest_error_;  ///< bounds how far it is off
};

/// Are both triangles of one body exactly as far, since the corner or edge that they share is surely nearest
/// for both? Then doubles need not tell their distances apart.
bool surely_tied(const TriangleCorners& a, const SeenTriangle& seen_a, const TriangleCorners& b,
                 const SeenTriangle& seen_b) noexcept;

}  // namespace touchmark
