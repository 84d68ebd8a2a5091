#include "bench/proxies/way_oracle.h"

#include <algorithm>
#include <vector>

#include <Eigen/Geometry>

#include "bench/oracle/exact/exact_distance.h"
#include "bench/oracle/exact/interval_distance.h"

namespace touchmark::bench::proxies {

WayOracle::WayOracle(const TriangleMesh& mesh) : mesh_(mesh), oracle_(mesh_, 1), tree_(mesh_) {}

bool WayOracle::is_nearer(const Vec3& from, const Vec3& to, double radius) const {
  if (!from.allFinite() || !to.allFinite() || !(radius > 0)) return false;
  bool surely = false;
  double limit = radius;
  std::vector<oracle::Triangle> doubtful;
  tree_.visit([&](const oracle::Box& box) { return oracle::distance_below(box, from, to); }, limit,
              [&](std::uint32_t index) {
                if (surely) return;
                const oracle::Triangle triangle = oracle::triangle_of(mesh_, index);
                // This costs far less than the interval.
                if (oracle::distance_of_boxes_below(oracle::box_of(triangle), from, to) > radius) return;
                const oracle::Interval distance = oracle::segment_distance_interval(from, to, triangle);
                if (distance.hi < radius) {
                  surely = true;
                  limit = -1;  // nothing more to visit
                } else if (distance.lo < radius) {
                  doubtful.push_back(triangle);
                }
              });
  return surely || std::any_of(doubtful.begin(), doubtful.end(), [&](const oracle::Triangle& triangle) {
           return oracle::compare_segment_distance(from, to, triangle, radius) < 0;
         });
}

double WayOracle::shortfall(const Vec3& at, double radius) const {
  if (!is_nearer(at, at, radius)) return 0;
  const oracle::GroundTruth truth = oracle_.solve(at);
  return (radius - truth.high) - truth.low;
}

WayOracle::WayOut WayOracle::way_out(const Vec3& at) const {
  const oracle::GroundTruth truth = oracle_.solve(at);
  Vec3 direction = truth.direction;
  if (direction.isZero()) {
    const Vec3 corner = mesh_.corner(truth.triangle, 0);
    direction = (mesh_.corner(truth.triangle, 1) - corner)
                    .cross(mesh_.corner(truth.triangle, 2) - corner)
                    .stableNormalized();
    // A triangle without an area: any way out of the box will do.
    if (direction.isZero()) direction = Vec3::UnitZ();
  } else if (side(at) == Side::inside) {
    direction = -direction;
  }
  return {truth.point, direction};
}

Vec3 free_start(const WayOracle& oracle, std::span<const Vec3> goals, double radius) {
  const auto is_free = [&](const Vec3& at) { return !oracle.is_within(at, at, radius); };
  const auto first = std::find_if(goals.begin(), goals.end(), is_free);
  if (first != goals.end()) return *first;
  constexpr double min_share = 0x1p-20;
  const WayOracle::WayOut out = oracle.way_out(goals.front());
  // Nothing of the mesh is near beyond its box, so that this ends.
  for (double beyond = min_share * (oracle.diagonal() + radius);; beyond *= 2) {
    const Vec3 start = out.from + (radius + beyond) * out.direction;
    if (is_free(start)) return start;
  }
}

}  // namespace touchmark::bench::proxies
