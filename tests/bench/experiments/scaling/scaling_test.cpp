#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bench/experiments/scaling/growth.h"
#include "bench/experiments/scaling/mesh_sizes.h"
#include "bench/experiments/scaling/power_law.h"

namespace touchmark::bench::experiments::scaling {
namespace {

using Names = std::vector<std::string>;

TEST(StudentT, IsAsPrintedInTables) {
  // Abramowitz & Stegun, table 26.10, A = 0.95 and 0.99.
  EXPECT_NEAR(student_t(0.95, 1), 12.706, 5e-4);
  EXPECT_NEAR(student_t(0.95, 2), 4.303, 5e-4);
  EXPECT_NEAR(student_t(0.95, 3), 3.182, 5e-4);
  EXPECT_NEAR(student_t(0.95, 4), 2.776, 5e-4);
  EXPECT_NEAR(student_t(0.95, 7), 2.365, 5e-4);
  EXPECT_NEAR(student_t(0.99, 10), 3.169, 5e-4);
  EXPECT_NEAR(student_t(0.95, 120), 1.980, 5e-4);
}

TEST(PowerLaw, FindsTheOneThatAllPointsLieOn) {
  std::vector<SizedQuantity> points;
  for (const double size : {1e3, 1e4, 1e5, 1e7}) points.push_back({size, 3 * std::pow(size, 0.25)});
  const auto law = fit_power_law(points);
  ASSERT_TRUE(law && law->interval);
  EXPECT_EQ(law->points, 4U);
  EXPECT_NEAR(law->exponent, 0.25, 1e-12);
  EXPECT_NEAR(law->factor, 3, 1e-10);
  EXPECT_NEAR(law->interval->low, 0.25, 1e-7);
  EXPECT_NEAR(law->interval->high, 0.25, 1e-7);
}

/// Worked by hand: x = -1, 0, 1 and y = 0, 3, 0 in logarithms give slope 0, residual 6, so the slope's error
/// is sqrt(6 / 1 / 2), and t of one degree of freedom is tan(0.95 pi / 2).
TEST(PowerLaw, SaysHowWellItIsKnown) {
  const auto law =
      fit_power_law(std::vector<SizedQuantity>{{std::exp(-1.0), 1}, {1, std::exp(3.0)}, {std::exp(1.0), 1}});
  ASSERT_TRUE(law && law->interval);
  EXPECT_NEAR(law->exponent, 0, 1e-12);
  EXPECT_NEAR(law->factor, std::exp(1.0), 1e-12);
  EXPECT_NEAR(law->interval->high, 12.7062047 * std::sqrt(3.0), 1e-5);
  EXPECT_NEAR(law->interval->low, -law->interval->high, 1e-9);
}

TEST(PowerLaw, ClaimsNoCertaintyFromTwoPointsAndNothingFromOneSize) {
  const auto law = fit_power_law(std::vector<SizedQuantity>{{10, 1}, {1000, 10}});
  ASSERT_TRUE(law);
  EXPECT_NEAR(law->exponent, 0.5, 1e-12);
  EXPECT_FALSE(law->interval);
  EXPECT_FALSE(fit_power_law({}));
  EXPECT_FALSE(fit_power_law(std::vector<SizedQuantity>{{10, 1}, {10, 2}}));
}

TEST(Sizes, AreReadWithTheirUnitsAndPutInOrder) {
  EXPECT_EQ(parse_sizes("1M,1k,1.5k,200,1000"), (std::vector<std::uint64_t>{200, 1000, 1500, 1'000'000}));
}

TEST(Sizes, ThatMakeNoSenseAreNamed) {
  for (const char* text :
       {"", "1k", "1k,1000", "1k,", "1k,-5", "1k,x", "1k,1.5", "1k,5", "1k,1e300", "1k,k", "1k,9G"}) {
    try {
      parse_sizes(text);
      ADD_FAILURE() << text;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find("--sizes \"" + std::string(text) + '"'), std::string::npos);
    }
  }
}

TEST(Sizes, MakeMeshesOfTheFamiliesThatHaveThem) {
  EXPECT_EQ(meshes_of_sizes({"noisy-sphere", "cube"}, "1k,2k", "5,6"),
            (Names{"noisy-sphere:1000", "noisy-sphere:2000", "cube"}));
  EXPECT_EQ(meshes_of_sizes({"soup"}, "", "10,20"), (Names{"soup:10", "soup:20"}));
  EXPECT_EQ(meshes_of_sizes({"dragon"}, "", "10,20"),
            (Names{"dragon:4", "dragon:3", "dragon:2", "dragon:1"}));
  EXPECT_THROW(meshes_of_sizes({"dragon"}, "10,20", "10,20"), std::invalid_argument);
  EXPECT_THROW(meshes_of_sizes({"cube"}, "", "10,20"), std::invalid_argument);
}

measurement::ResultRow row(const std::string& mesh, std::size_t triangles, double ns) {
  measurement::ResultRow row;
  row.detector = "aabb-tree";
  row.mesh = mesh;
  row.triangles = triangles;
  row.trajectory = "slide";
  row.steps = 2000;
  row.build_ms = static_cast<double>(triangles);
  row.bytes = 100 * triangles;
  row.throughput.emplace().undisturbed.ns = ns;
  row.latency = measurement::LatencySummary{};
  row.latency->p50 = row.latency->p999 = ns;
  return row;
}

TEST(Growth, IsToldForEachContestantFamilyAndQuantity) {
  std::vector<measurement::ResultRow> rows{row("soup:10", 10, 5), row("soup:1000", 1000, 50),
                                           row("torus:3x4", 24, 5), row("torus:6x4", 48, 10)};
  rows.push_back(row("soup:100000", 100000, 1));
  rows.back().status = "timeout";
  rows[2].steps = 999;  // too few for a p99.9
  const std::vector<Growth> growths = growth_of(rows);
  ASSERT_EQ(growths.size(), 9U);  // build, bytes, ns, p50 of both and p99.9 of the first
  EXPECT_EQ(growths[2].quantity, "ns_per_query");
  EXPECT_NEAR(growths[2].law.exponent, 0.5, 1e-12);
  EXPECT_EQ(growths[2].family, "soup");
  EXPECT_EQ(growths[2].max_triangles, 1000U);
  EXPECT_EQ(growths[7].family, "torus");
  EXPECT_EQ(growths[7].quantity, "ns_per_query");
  EXPECT_NEAR(growths[7].law.exponent, 1, 1e-12);
}

TEST(Growth, IsWrittenAsCsv) {
  const std::string csv = scaling_csv(growth_of({row("soup:10", 10, 5), row("soup:1000", 1000, 50)}));
  EXPECT_EQ(csv.substr(0, csv.find('\n')),
            "schema,detector,options,trajectory,quantity,points,exponent,exponent_low,exponent_high,factor,"
            "family,query,least_triangles,most_triangles,shrinks");
  EXPECT_NE(csv.find("\n1,aabb-tree,,slide,ns_per_query,2,0.5,,,1.58114,soup,nearest,10,1000,\n"),
            std::string::npos)
      << csv;
}

TEST(Growth, OfTimeIsThatOfLooksAndOfTheTimeOfALook) {
  std::vector<measurement::ResultRow> rows{row("soup:10", 10, 5), row("soup:100", 100, 17),
                                           row("soup:1000", 1000, 30)};
  const std::vector<std::uint64_t> spheres{4000, 9000, 10000};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    Work work;
    work.spheres = spheres[i];
    work.triangles = 2000 * (i + 1);
    rows[i].work = measurement::summarize_work(std::vector<std::uint64_t>(rows[i].steps, 1), work);
  }
  const std::vector<Growth> growths = growth_of(rows, Shrinks::reach);
  const auto exponent = [&](const std::string& quantity) {
    const auto found = std::ranges::find(growths, quantity, &Growth::quantity);
    return found == growths.end() ? std::numeric_limits<double>::quiet_NaN() : found->law.exponent;
  };
  EXPECT_NEAR(exponent("work_mean") + exponent("ns_per_look"), exponent("ns_per_query"), 1e-12);
  EXPECT_NEAR(exponent("spheres_mean"), std::log10(2.5) / 2, 1e-12);  // the middle one of three does not tilt
  EXPECT_TRUE(std::isnan(exponent("boxes_mean")));                    // none was looked at
  for (const Growth& growth : growths) EXPECT_EQ(name_of(growth.shrinks), "reach");
}

}  // namespace
}  // namespace touchmark::bench::experiments::scaling
