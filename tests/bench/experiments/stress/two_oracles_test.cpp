/// The program's oracle and another one agree on every family. The other shares nothing with it but the
/// doubles: it looks at every triangle, minimises by solving for the multipliers of each face, edge and
/// corner in rational numbers, and compares squares.
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "bench/experiments/stress/family.h"
#include "bench/oracle/oracle.h"
#include "tests/bench/oracle/rational_hull.h"

namespace touchmark::bench::experiments::stress {
namespace {

constexpr std::size_t probes_a_family = 24;
constexpr std::size_t triangles_at_most = 400;
constexpr std::size_t centers_a_trace = 2;

mpq_class min_squared_distance(const TriangleMesh& mesh, const Vec3& center) {
  std::optional<mpq_class> least;
  for (std::uint32_t i = 0; i < mesh.size(); ++i) {
    const mpq_class squared = oracle::squared_distance_by_multipliers(center, oracle::triangle_of(mesh, i));
    if (!least || squared < *least) least = squared;
  }
  return *least;
}

void expect_agreement(const workload::Workload& workload, std::string_view family, std::size_t& compared) {
  const oracle::Oracle oracle(workload.mesh);
  for (const std::vector<workload::Step>& trace : workload.traces) {
    std::size_t centers = 0;
    std::optional<Vec3> last;
    mpq_class squared;
    for (const workload::Step& step : trace) {
      const Vec3& center = step.probe.center;
      const oracle::GroundTruth truth = oracle.solve(center);
      EXPECT_EQ(truth.defined, center.allFinite());
      if (!truth.defined) continue;
      if (!last || *last != center) {
        if (++centers > centers_a_trace) break;
        squared = min_squared_distance(workload.mesh, center);
        last = center;
        EXPECT_EQ(oracle::squared_distance_by_multipliers(center,
                                                          oracle::triangle_of(workload.mesh, truth.triangle)),
                  squared)
            << family << ": its triangle is not a nearest one";
      }
      const double radius = step.probe.radius;
      const bool within =
          radius >= 0 && (std::isinf(radius) || squared <= mpq_class(radius) * mpq_class(radius));
      EXPECT_EQ(oracle.within(truth, center, radius), within)
          << family << ", " << workload.mesh_name << ": radius " << radius << " at " << truth.high;
      ++compared;
    }
  }
}

TEST(TwoOracles, AgreeOnEveryFamily) {
  std::size_t compared = 0;
  for (const Family& family : families()) {
    if (family.name == "empty-mesh") continue;
    for (const workload::Workload& workload : family.make(11, probes_a_family)) {
      if (workload.mesh.size() <= triangles_at_most) expect_agreement(workload, family.name, compared);
    }
  }
  EXPECT_GT(compared, 150U);
}

}  // namespace
}  // namespace touchmark::bench::experiments::stress
