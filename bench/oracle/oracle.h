/// What the right answers are: brute force in spirit, exact in every decision, and independent of
/// core/geometry. Intervals in double settle most of it, integers the rest, and a box tree keeps triangles
/// away that cannot matter.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "bench/oracle/reference.h"
#include "bench/oracle/triangle.h"
#include "core/probe.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::oracle {

/// Answers exactly. Constant after construction, and safe to use from many threads. The mesh must outlive it.
class Oracle : public Reference {
 public:
  /// `threads` is how many solve() uses; 0: as many as the machine has.
  explicit Oracle(const TriangleMesh& mesh, unsigned threads = 0);
  ~Oracle() override;
  Oracle(Oracle&&) noexcept;
  Oracle& operator=(Oracle&&) noexcept;

  /// One truth a probe, in order. To be computed once a trajectory and used for every contestant.
  std::vector<GroundTruth> solve(std::span<const Probe> probes) const;
  std::vector<SweepGroundTruth> solve(std::span<const Sweep> sweeps) const;

  GroundTruth solve(const Vec3& center) const override;
  SweepGroundTruth solve(const Sweep& sweep) const;

  /// Returns true if the distance is at most `radius`. `truth` must be of `center`. Exact; false for a radius
  /// below 0 or NaN.
  bool within(const GroundTruth& truth, const Vec3& center, double radius) const override;
  /// Returns true if the distance from `center` to this one triangle is at most `radius`. Exact likewise.
  bool within(std::uint32_t triangle, const Vec3& center, double radius) const override;
  /// Returns true if the segment comes within `radius` of the mesh. Exact likewise; false when a coordinate
  /// is not finite.
  bool segment_within(const Vec3& from, const Vec3& to, double radius) const override {
    return segment_comes(from, to, radius, false);
  }
  /// Returns true if the segment comes nearer than `radius`. Exact likewise.
  bool segment_nearer(const Vec3& from, const Vec3& to, double radius) const override {
    return segment_comes(from, to, radius, true);
  }

  /// Returns true if the sweep touches before that fraction of its path, of the points from + fraction (to -
  /// from) as they are, none rounded. Exact likewise; but a ball that slides at the very radius since less
  /// than the fraction's last digit ago is taken to touch there.
  bool touches_before(const Sweep& sweep, double fraction) const override;
  /// Returns true if the sweep touches at most 2^-50 of its path later, whatever `radius` is. Exact likewise.
  bool touches_soon_after(const Sweep& sweep, double fraction, double radius) const override;

  /// Returns true if the segment passes through a triangle so well that no displacement of either by less
  /// than `margin` could part them: the ends and the triangle's edges keep more than `margin` away. Exact
  /// likewise. (Through the edge between two triangles is not through either.)
  bool surely_crosses(const Vec3& from, const Vec3& to, double margin) const override;

  /// The truth about `center` and this one triangle.
  GroundTruth solve(const Vec3& center, std::uint32_t triangle) const override;
  /// On which side a finite point is; nothing where the mesh is not closed. Looks at every triangle.
  std::optional<Side> side(const Vec3& center) const override;
  /// Every triangle whose distance to `center` is at most `radius`, ascending. Exact.
  std::vector<std::uint32_t> all_within(const Vec3& center, double radius) const override;

  std::pair<std::size_t, std::size_t> named_by(const workload::Answer& answer) const override;
  bool names_first(const GroundTruth& truth, const workload::Answer& answer) const override {
    return answer.triangle == mesh().id(truth.triangle);
  }
  double largest_difference(const Vec3& center, std::uint32_t triangle) const override;
  Interval distance_bounds(const Vec3& point, std::uint32_t triangle) const override;
  Box bounds() const override;

  const TriangleMesh& mesh() const noexcept;
  unsigned threads() const noexcept;

 private:
  struct Structure;
  bool segment_comes(const Vec3& from, const Vec3& to, double radius, bool nearer) const;
  /// Returns true if there is one, of the triangles near to the path up to the fraction, of
  /// which that holds.
  template <class Holds>
  bool any_near(const Sweep& sweep, double fraction, const Holds& holds) const;

  std::unique_ptr<const Structure> structure_;
};

}  // namespace touchmark::bench::oracle
