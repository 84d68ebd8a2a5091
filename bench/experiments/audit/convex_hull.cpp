#include "bench/experiments/audit/convex_hull.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <utility>

#include <Eigen/Geometry>

#include "bench/support/random.h"

namespace touchmark::bench::experiments::audit {
namespace {

using Index = std::uint32_t;

struct Face {
  std::array<Index, 3> corners;
  Vec3 normal;
  std::vector<Index> outside = {};  ///< points in front of this face, and of no face before it
};

class Growth {
 public:
  Growth(std::span<const Vec3> points, double error)
      : points_(points.begin(), points.end()), least_height_(error) {
    // In general position no face is a sliver whose normal is noise, and no four points lie in a plane.
    support::Random random(1);
    for (Vec3& point : points_) point += random.point(shake / 2 * error);
    start();
    const auto open = [&] {
      return std::ranges::find_if(faces_, [](const Face& face) { return !face.outside.empty(); });
    };
    for (auto face = open(); face != faces_.end(); face = open())
      take(farthest(face->outside, [&](Index p) { return height(*face, p); }));
  }

  const std::vector<Face>& faces() const noexcept { return faces_; }
  const Vec3& point(Index i) const noexcept { return points_[i]; }

 private:
  static constexpr double shake = 1.0 / 64;  ///< a share of the error

  double height(const Face& face, Index p) const {
    return face.normal.dot(points_[p] - points_[face.corners[0]]);
  }
  template <class Measure>
  static Index farthest(const std::vector<Index>& among, const Measure& measure) {
    return *std::ranges::max_element(among, {}, measure);
  }

  /// Adds a face, to which those of the points belong that are in front of it.
  void add(Index a, Index b, Index c, std::vector<Index>& left) {
    Face& face = faces_.emplace_back(
        Face{{a, b, c}, (points_[b] - points_[a]).cross(points_[c] - points_[a]).stableNormalized()});
    const auto behind =
        std::ranges::partition(left, [&](Index p) { return !(height(face, p) > least_height_); });
    face.outside.assign(behind.begin(), behind.end());
    left.erase(behind.begin(), behind.end());
  }

  void start() {
    std::vector<Index> all(points_.size());
    for (Index i = 0; i < all.size(); ++i) all[i] = i;
    const auto away = [&](Index p, Index from) { return Vec3(points_[p] - points_[from]); };
    const Index a = farthest(all, [&](Index p) { return points_[p].x(); });
    const Index b = farthest(all, [&](Index p) { return away(p, a).norm(); });
    const Index c = farthest(all, [&](Index p) { return away(p, a).cross(away(b, a)).norm(); });
    const Vec3 normal = away(b, a).cross(away(c, a)).stableNormalized();
    const Index d = farthest(all, [&](Index p) { return std::abs(normal.dot(away(p, a))); });
    const double top = normal.dot(away(d, a));
    if (!(std::abs(top) > least_height_)) return;
    const Index low = top > 0 ? c : b, high = top > 0 ? b : c;  // d is behind a, low, high
    add(a, low, high, all);
    add(a, high, d, all);
    add(high, low, d, all);
    add(low, a, d, all);
  }

  /// Makes the point a corner: in place of the faces that it is in front of come those between it and the
  /// edges round them.
  void take(Index p) {
    const auto seen =
        std::ranges::stable_partition(faces_, [&](const Face& face) { return !(height(face, p) > 0); });
    std::set<std::pair<Index, Index>> rim;
    std::vector<Index> left;
    for (const Face& face : seen) {
      left.insert(left.end(), face.outside.begin(), face.outside.end());
      for (std::size_t k = 0; k < 3; ++k) {
        const std::pair edge{face.corners[k], face.corners[(k + 1) % 3]};
        if (rim.erase({edge.second, edge.first}) == 0) rim.insert(edge);
      }
    }
    faces_.erase(seen.begin(), seen.end());
    for (const auto& [from, to] : rim) add(from, to, p, left);
  }

  std::vector<Vec3> points_;
  double least_height_;
  std::vector<Face> faces_;
};

}  // namespace

ConvexHull::ConvexHull(std::span<const Vec3> points, double error) {
  const Growth growth(points, error / 2);
  for (const Face& face : growth.faces()) planes_.push_back({face.normal, growth.point(face.corners[0])});
}

double ConvexHull::depth(const Vec3& point) const noexcept {
  double depth =
      planes_.empty() ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
  for (const Plane& plane : planes_) depth = std::min(depth, plane.normal.dot(plane.on_it - point));
  return depth;
}

}  // namespace touchmark::bench::experiments::audit
