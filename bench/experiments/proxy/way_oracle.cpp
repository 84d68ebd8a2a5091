#include "bench/experiments/proxy/way_oracle.h"

#include <algorithm>
#include <vector>

#include "bench/oracle/exact_distance.h"
#include "bench/oracle/interval_distance.h"

namespace touchmark::bench::experiments::proxy {

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

std::optional<Vec3> first_free(const WayOracle& oracle, std::span<const Vec3> positions, double radius) {
  const auto free = std::find_if(positions.begin(), positions.end(),
                                 [&](const Vec3& at) { return !oracle.is_within(at, at, radius); });
  return free == positions.end() ? std::nullopt : std::optional(*free);
}

}  // namespace touchmark::bench::experiments::proxy
