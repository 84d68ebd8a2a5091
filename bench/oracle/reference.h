/// What the judge must know to judge an answer: about one mesh, or about a scene of bodies as it stands.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "bench/oracle/exact/interval_distance.h"
#include "bench/oracle/triangle_tree.h"
#include "bench/workload/answer.h"
#include "core/probe.h"

namespace touchmark::bench::oracle {

/// The truth about one position. It does not depend on radius or reach, so one serves every query there.
struct GroundTruth {
  bool defined = false;           ///< false when a coordinate of the centre is not finite: it touches nothing
  std::uint32_t triangle = 0;     ///< number of a nearest triangle; of exact ties the lowest
  double high = 0;                ///< the distance rounded to nearest; infinite if beyond all doubles
  double low = 0;                 ///< high + low is the distance to 2^-100 of it
  Vec3 point = Vec3::Zero();      ///< the nearest point of `triangle`, rounded
  Vec3 direction = Vec3::Zero();  ///< unit, from `point` to the centre; zero where the distance is exactly 0
  double largest_difference = 0;  ///< between coordinates of the centre and of the corners of `triangle`
};

/// The truth about one sweep.
struct SweepGroundTruth {
  bool defined = false;            ///< false when a coordinate is not finite: it hits nothing
  bool hit = false;                ///< the path comes within the radius of the mesh, exactly
  bool touching_at_start = false;  ///< it already is there at the start, exactly
};

/// Triangles are numbered from 0: as in the mesh, or over all bodies of a scene, one body after the other.
/// All answers are exact, and false for a radius below 0 or NaN and for coordinates that are not finite.
class Reference {
 public:
  Reference() = default;
  Reference(const Reference&) = default;
  Reference& operator=(const Reference&) = default;
  virtual ~Reference() = default;

  virtual GroundTruth solve(const Vec3& center) const = 0;
  /// The truth about `center` and this one triangle.
  virtual GroundTruth solve(const Vec3& center, std::uint32_t triangle) const = 0;
  /// Returns true if the distance is at most `radius`. `truth` must be of `center`.
  virtual bool within(const GroundTruth& truth, const Vec3& center, double radius) const = 0;
  /// Returns true if the distance from `center` to this one triangle is at most `radius`.
  virtual bool within(std::uint32_t triangle, const Vec3& center, double radius) const = 0;
  /// Every triangle whose distance to `center` is at most `radius`, ascending.
  virtual std::vector<std::uint32_t> all_within(const Vec3& center, double radius) const = 0;

  /// Returns true if the segment comes within `radius`.
  virtual bool segment_within(const Vec3& from, const Vec3& to, double radius) const = 0;
  /// Returns true if the segment comes nearer than `radius`.
  virtual bool segment_nearer(const Vec3& from, const Vec3& to, double radius) const = 0;
  /// Returns true if the sweep touches before that fraction of its path, of the points from + fraction (to -
  /// from) as they are, none rounded; but a ball that slides at the very radius since less than the
  /// fraction's last digit ago is taken to touch there.
  virtual bool touches_before(const Sweep& sweep, double fraction) const = 0;
  /// Returns true if the sweep touches so soon after that fraction as E16 promises of a mesh; in a scene,
  /// whose images double rounds, if the point there is within `radius`.
  virtual bool touches_soon_after(const Sweep& sweep, double fraction, double radius) const = 0;
  /// Returns true if the segment passes through a triangle so well that no displacement of either by less
  /// than `margin` could part them: the ends and the triangle's edges keep more than `margin` away. (Through
  /// the edge between two triangles is not through either.)
  virtual bool surely_crosses(const Vec3& from, const Vec3& to, double margin) const = 0;
  /// On which side a finite point is; nothing where that is not known. Looks at every triangle.
  virtual std::optional<Side> side(const Vec3& center) const = 0;

  /// Returns where the triangles that the answer names begin and end.
  virtual std::pair<std::size_t, std::size_t> named_by(const workload::Answer& answer) const = 0;
  /// Returns true if the answer names the truth's triangle.
  virtual bool names_first(const GroundTruth& truth, const workload::Answer& answer) const = 0;
  /// Returns the largest difference between coordinates of `center` and of the triangle's corners.
  virtual double largest_difference(const Vec3& center, std::uint32_t triangle) const = 0;
  virtual Interval distance_bounds(const Vec3& point, std::uint32_t triangle) const = 0;
  /// Returns the box of all corners.
  virtual Box bounds() const = 0;
};

/// Whether a truth's distance is at most `radius`, as its digits tell; nothing where they do not.
std::optional<bool> within_by_digits(const GroundTruth& truth, double radius) noexcept;

SweepGroundTruth truth_of_sweep(const Reference& reference, const Sweep& sweep);

/// Returns where the triangles that carry the id begin and end.
std::pair<std::size_t, std::size_t> positions_of(const TriangleMesh& mesh, TriangleId id);

}  // namespace touchmark::bench::oracle
