/// The parts of the papers' experiments, each against what is known.
#include <array>
#include <cmath>
#include <csignal>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "bench/contestants/entry.h"
#include "bench/experiments/papers/choi_sung/choi_sung.h"
#include "bench/experiments/papers/choi_sung/choi_sung_models.h"
#include "bench/experiments/papers/choi_sung/choi_sung_report.h"
#include "bench/experiments/papers/choi_sung/choi_sung_scores.h"
#include "bench/experiments/papers/choi_sung/geometric_error.h"
#include "bench/experiments/papers/choi_sung/sphere_partitions.h"
#include "bench/experiments/papers/choi_sung/surface_measures.h"
#include "bench/experiments/papers/claims.h"
#include "bench/experiments/papers/decimation.h"
#include "bench/experiments/papers/interleaved_timing.h"
#include "bench/experiments/papers/line_fit.h"
#include "bench/experiments/papers/paper_trace.h"
#include "bench/experiments/papers/park_jang/park_jang.h"
#include "bench/meshes/meshes.h"
#include "bench/support/median.h"
#include "bench/support/system/interrupt.h"
#include "bench/support/table.h"
#include "core/brute_force/brute_force.h"
#include "core/geometry/point_triangle.h"
#include "core/sphere_cluster/published/published_sphere_cluster.h"
#include "core/subdivision/mesh_measures.h"
#include "core/subdivision/subdivision.h"

namespace touchmark::bench::experiments::papers {
namespace {

TEST(Median, IsTheMiddleOrTheMeanOfTheTwoThere) {
  EXPECT_EQ(support::median({}), 0);
  EXPECT_EQ(support::median({3, 1, 2}), 2);
  EXPECT_EQ(support::median({4, 1, 2, 3}), 2.5);
}

TEST(PaperTable, QuotesInCsvAndKeepsEmptyCells) {
  support::Table table({"a", "b"});
  table.add({"", "x,y"});
  EXPECT_EQ(table.csv(), "a,b\n,\"x,y\"\n");
  EXPECT_EQ(table.markdown(), "| a | b |\n| --- | --- |\n|  | x,y |\n");
  EXPECT_THROW(table.add({"alone"}), std::invalid_argument);
}

TEST(NumberClaim, AgreesWhenThePrintedDigitsDo) {
  EXPECT_EQ(number_claim("", "", 2.014, 2.0144, 3, 0.1, "why").agreement, Agreement::yes);
  EXPECT_EQ(number_claim("", "", 100, 109, 0, 0.1, "why").agreement, Agreement::nearly);
  const Claim no = number_claim("", "", 100, 111, 0, 0.1, "why");
  EXPECT_EQ(no.agreement, Agreement::no);
  EXPECT_EQ(no.why, "why");
  EXPECT_EQ(number_claim("", "", 100, 100, 0, 0.1, "why").why, "");
}

TEST(Scores, RunFromNoughtForTheWorstToFiveForTheBest) {
  EXPECT_EQ(scores_of({4, 2, 3}), (std::vector<double>{0, 5, 2.5}));
  EXPECT_EQ(scores_of({7, 7}), (std::vector<double>{5, 5}));
}

TEST(ConcaveBending, IsNoneOfAConvexSurfaceAndKeptByWhatDoesNotMoveIt) {
  EXPECT_EQ(concave_bending(meshes::load_mesh("cube")), 0);
  const TriangleMesh torus = meshes::load_mesh("torus:16x8");
  const double bending = concave_bending(torus);
  EXPECT_GT(bending, 0);
  const TriangleMesh finer = subdivide(torus, {.method = SubdivisionMethod::mid_point, .levels = 1});
  EXPECT_NEAR(concave_bending(finer), bending, 1e-9 * bending);
}

TEST(SpherePartitions, HalveIntoAsManyPartsAsWantedWithEveryTriangleOnce) {
  const TriangleMesh mesh = meshes::load_mesh("icosphere:2");
  for (const std::size_t wanted : {1u, 7u, 320u, 1000u}) {
    const auto parts = halved_into(mesh, wanted);
    EXPECT_EQ(parts.size(), std::min<std::size_t>(wanted, mesh.size()));
    std::vector<int> count(mesh.size());
    for (const auto& part : parts)
      for (const std::uint32_t triangle : part) ++count[triangle];
    EXPECT_EQ(count, std::vector<int>(mesh.size(), 1));
  }
}

TEST(SpherePartitions, AgreeWhereEveryTriangleHasItsOwnSphere) {
  const TriangleMesh mesh = meshes::load_mesh("icosphere:2");
  const PartitionTightness tightness = partition_tightness(mesh, cluster_spheres(mesh, 0));
  EXPECT_NEAR(tightness.bottom_up, tightness.top_down, 1e-12);
}

/// A number that counts what is done with it: the operations and comparisons of a textbook's test.
struct Counted {
  double value = 0;
  static inline int operations = 0;

  friend Counted operator+(Counted a, Counted b) { return {(++operations, a.value + b.value)}; }
  friend Counted operator-(Counted a, Counted b) { return {(++operations, a.value - b.value)}; }
  friend Counted operator*(Counted a, Counted b) { return {(++operations, a.value * b.value)}; }
  friend Counted operator/(Counted a, Counted b) { return {(++operations, a.value / b.value)}; }
  friend bool operator<=(Counted a, Counted b) { return ++operations, a.value <= b.value; }
  friend bool operator>=(Counted a, Counted b) { return ++operations, a.value >= b.value; }
};
using Point = std::array<Counted, 3>;

Point counted(const Vec3& p) { return {Counted{p.x()}, Counted{p.y()}, Counted{p.z()}}; }
Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point along(const Point& a, Counted t, const Point& d) {
  return {a[0] + t * d[0], a[1] + t * d[1], a[2] + t * d[2]};
}
Counted dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// The square of the distance by the regions of a triangle, as Ericson's book has it: first the corners, then
/// the edges, and what is left is the face.
Counted by_regions(const Point& p, const Point& a, const Point& b, const Point& c) {
  const Counted zero{0};
  const auto to = [&p](const Point& q) {
    const Point d = minus(p, q);
    return dot(d, d);
  };
  const Point ab = minus(b, a), ac = minus(c, a), ap = minus(p, a);
  const Counted d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= zero && d2 <= zero) return to(a);
  const Point bp = minus(p, b);
  const Counted d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= zero && d4 <= d3) return to(b);
  const Counted vc = d1 * d4 - d3 * d2;
  if (vc <= zero && d1 >= zero && d3 <= zero) return to(along(a, d1 / (d1 - d3), ab));
  const Point cp = minus(p, c);
  const Counted d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= zero && d5 <= d6) return to(c);
  const Counted vb = d5 * d2 - d1 * d6;
  if (vb <= zero && d2 >= zero && d6 <= zero) return to(along(a, d2 / (d2 - d6), ac));
  const Counted va = d3 * d6 - d5 * d4, b_to_c = d4 - d3, c_to_b = d5 - d6;
  if (va <= zero && b_to_c >= zero && c_to_b >= zero)
    return to(along(b, b_to_c / (b_to_c + c_to_b), minus(c, b)));
  const Counted whole = va + vb + vc;
  return to(along(along(a, vb / whole, ab), vc / whole, ac));
}

TEST(Operations, OfACuboidAreSixComparisonsAndOfASphereNine) {
  const Point p = counted({0.5, 0.5, 0.5}), low = counted({0, 0, 0}), high = counted({1, 1, 1});
  Counted::operations = 0;
  bool inside = true;
  for (std::size_t k = 0; k < 3; ++k) inside = inside && p[k] >= low[k] && p[k] <= high[k];
  EXPECT_TRUE(inside);
  EXPECT_EQ(Counted::operations, cuboid_operations);
  Counted::operations = 0;
  const Point d = minus(p, low);
  EXPECT_TRUE(dot(d, d) <= Counted{1});  // the square of the radius is stored
  EXPECT_EQ(Counted::operations, sphere_operations);
}

TEST(Operations, OfATriangleAreThoseOfAQueryWithoutGroups) {
  const TriangleMesh mesh = meshes::load_mesh("icosphere:3");
  const std::vector<workload::Step> trace = paper_trace("slide", mesh, 20, 1, 0.01);
  Counted::operations = 0;
  int least = 1000, most = 0;
  for (const workload::Step& step : trace) {
    const Point p = counted(step.probe.center);
    for (std::uint32_t i = 0; i < mesh.size(); ++i) {
      const int before = Counted::operations;
      const double squared =
          by_regions(p, counted(mesh.corner(i, 0)), counted(mesh.corner(i, 1)), counted(mesh.corner(i, 2)))
              .value;
      least = std::min(least, Counted::operations - before);
      most = std::max(most, Counted::operations - before);
      EXPECT_NEAR(squared, squared_distance(prepare(mesh, i), step.probe.center), 1e-12);
    }
  }
  const double mean = Counted::operations / static_cast<double>(trace.size() * mesh.size());
  EXPECT_NEAR(mean, triangle_operations, 5);
  EXPECT_EQ(least, 29);
  EXPECT_EQ(most, 86);
}

TEST(Decimation, LeavesAboutAsManyTrianglesAsWantedAndTheShape) {
  if (!can_decimate()) GTEST_SKIP() << "built without OpenMesh";
  const TriangleMesh sphere = meshes::load_mesh("icosphere:4");
  const TriangleMesh coarse = decimate(sphere, 900);
  EXPECT_NEAR(static_cast<double>(coarse.size()), 900, 2);
  EXPECT_TRUE(edge_statistics(coarse).closed());
  EXPECT_NEAR(signed_volume(coarse) / signed_volume(sphere), 1, 0.02);
  EXPECT_EQ(decimate(coarse, 5000).size(), coarse.size());
}

TEST(Claims, NameAnotherMeshWithOrWithoutAFurtherReason) {
  ChoiSungResult result;
  for (const double clustering : {0.0, 0.1}) {
    ChoiSungRow row;
    row.surface.method = "original";
    row.clustering = clustering;
    row.spheres = 7;
    result.rows.push_back(row);
  }
  const std::vector<Claim> claims = choi_sung_claims(result, false);
  ASSERT_EQ(claims.size(), 3u);  // spheres without and with clustering, and their reduction
  EXPECT_EQ(claims[0].why, "another mesh than the paper's was measured");
  EXPECT_TRUE(claims[1].why.starts_with("another mesh than the paper's was measured; the paper states"));
  EXPECT_EQ(claims_markdown(claims).find("; ."), std::string::npos);
  EXPECT_EQ(choi_sung_claims(result, true)[0].why, "");
}

TEST(InterleavedTiming, TimesEachDetectorAndSeesThatTheyAnswerAlike) {
  const TriangleMesh mesh = meshes::load_mesh("icosphere:2");
  const std::vector<workload::Step> trace = paper_trace("slide", mesh, 50, 1, 0.01);
  InterleavedTiming timing(trace, workload::Query::nearest, 1);
  timing.add(contestants::contestant<BruteForce>(mesh, {}));
  timing.add(contestants::contestant<SphereCluster>(mesh, {}));
  EXPECT_EQ(timing.timed(0).ns, 0);
  EXPECT_FALSE(timing.timed(0).ns_p99);
  timing.run({3, 1e4}, [](std::size_t, std::size_t) {});
  EXPECT_EQ(timing.timed(0).answers, timing.timed(1).answers);
  EXPECT_EQ(timing.timed(0).contacts, 50u);
  EXPECT_EQ(timing.timed(0).work, 320);
  EXPECT_GT(timing.timed(1).ns, 0);
  ASSERT_TRUE(timing.timed(0).ns_p99 && timing.timed(1).ns_p99);
  EXPECT_GE(*timing.timed(0).ns_p99, *timing.timed(1).ns_p99 / 100);
}

/// Answers in less than the clock's own cost.
struct Instant {
  struct Options {};
  struct Session {
    Work work;
  };
  static Instant build(const TriangleMesh&, const Options& = {}) { return {}; }
  std::optional<Contact> nearest(const Probe&, double, Session&) const noexcept { return std::nullopt; }
  std::size_t bytes() const noexcept { return 0; }
  Accuracy accuracy() const noexcept { return {}; }
};

TEST(InterleavedTiming, GivesNoTimeShorterThanTheClockCanTell) {
  const std::vector<workload::Step> trace =
      paper_trace("slide", meshes::load_mesh("icosphere:1"), 50, 1, 0.01);
  InterleavedTiming timing(trace, workload::Query::nearest, 1);
  timing.add(std::make_unique<contestants::ContestantOf<Instant>>(Instant()));
  timing.run({3, 1e4}, [](std::size_t, std::size_t) {});
  ASSERT_TRUE(timing.timed(0).ns_p99);
  EXPECT_GT(*timing.timed(0).ns_p99, 0);
}

TEST(GeometricError, IsNoughtOfTheReferenceAndTheGapOfASmallerSphere) {
  const TriangleMesh mesh = meshes::load_mesh("icosphere:4");
  const ReferenceSurface reference(mesh, 0.3, 200, 1);
  EXPECT_EQ(reference.error_of(SphereCluster::build(mesh)).max, 0);
  const GeometricError error = reference.error_of(SphereCluster::build(mesh.transformed(0.9, Vec3::Zero())));
  EXPECT_NEAR(error.mean, 0.1, 0.002);
  EXPECT_NEAR(error.rms, 0.1, 0.002);
  EXPECT_NEAR(error.max, 0.1, 0.005);
}

TEST(GeometricError, OfTheFastLevelLiesWithinItsBound) {
  const TriangleMesh mesh = meshes::load_mesh("icosphere:3");
  const ReferenceSurface reference(mesh, 0.3, 200, 1);
  const auto fast = PublishedSphereCluster::build(mesh, {.clustering = 0.1, .precise = false});
  const GeometricError error = reference.error_of(fast);
  EXPECT_GT(error.mean, 0.01);
  EXPECT_LE(error.max, fast.accuracy().absolute * (1 + 1e-12));
}

ChoiSungSettings small_settings() {
  ChoiSungSettings settings;
  settings.levels = 2;
  settings.steps = 20;
  settings.radius = 0.01;
  settings.clustering = 0.2;
  settings.effort = {1, 1e3};
  return settings;
}

void ignore(const SurfaceMeasures&, const TriangleMesh&, const SphereClusters&, const SphereClusters&) {}

TEST(ChoiSung, MeasuresTheSameTwice) {
  const TriangleMesh mesh = meshes::load_mesh("icosphere:1");
  const ChoiSungResult a = run_choi_sung(mesh, small_settings(), ignore, [](const std::string&) {});
  const ChoiSungResult b = run_choi_sung(mesh, small_settings(), ignore, [](const std::string&) {});
  ASSERT_EQ(a.rows.size(), b.rows.size());
  for (std::size_t i = 0; i < a.rows.size(); ++i) {
    EXPECT_EQ(a.rows[i].spheres, b.rows[i].spheres);
    EXPECT_EQ(a.rows[i].tightness, b.rows[i].tightness);
    EXPECT_EQ(a.rows[i].scan->work, b.rows[i].scan->work);
    EXPECT_EQ(a.rows[i].scan->answers, b.rows[i].scan->answers);
  }
  EXPECT_TRUE(a.answers_agree);
}

TEST(ChoiSung, CreasesGoAwayWhereTheSurfaceGetsSmooth) {
  const ChoiSungResult result =
      run_choi_sung(meshes::load_mesh("icosphere:1"), small_settings(), ignore, [](const std::string&) {});
  const auto crease = [&](SubdivisionMethod method, int level) {
    return find_row(result, method, level, false)->surface.crease_deg;
  };
  EXPECT_NEAR(crease(SubdivisionMethod::ls3, 2) / crease(SubdivisionMethod::ls3, 1), 0.5, 0.05);
  // Half of the edges are flat after each level, the others as creased as ever.
  EXPECT_NEAR(crease(SubdivisionMethod::mid_point, 2) / crease(SubdivisionMethod::mid_point, 1),
              std::sqrt(0.5), 0.02);
}

TEST(ChoiSung, KeepsFinishedRowsWhenInterrupted) {
  support::watch_for_interrupts();
  const ChoiSungResult result =
      run_choi_sung(meshes::load_mesh("icosphere:1"), small_settings(), ignore, [](const std::string& what) {
        if (what.starts_with("catmull-clark-linear level 1")) std::raise(SIGINT);
      });
  support::watch_for_interrupts();
  EXPECT_FALSE(result.finished);
  EXPECT_EQ(result.rows.size(), 2u * 3);  // the original and two levels of butterfly
  EXPECT_EQ(choi_sung_table1(result).size(), 6u);
  EXPECT_TRUE(choi_sung_scores(result).empty());
  EXPECT_FALSE(choi_sung_claims(result, false).empty() && result.finished);
}

TEST(ParkJang, KeepsFinishedRowsWhenInterrupted) {
  const std::vector<PaperMesh> meshes{{"a", meshes::load_mesh("icosphere:2"), ""},
                                      {"b", meshes::load_mesh("icosphere:3"), ""}};
  ParkJangSettings settings{.groups = {1, 10}, .steps = 20, .radius = {0.1, true}, .effort = {1, 1e3}};
  support::watch_for_interrupts();
  const ParkJangResult result = run_park_jang(meshes, settings, [](const std::string& what) {
    if (what.starts_with("b:")) std::raise(SIGINT);
  });
  support::watch_for_interrupts();
  EXPECT_FALSE(result.finished);
  ASSERT_EQ(result.rows.size(), 1u + 2 + 2 + 2 + 1 + 1);  // of b the ungrouped form, not timed
  EXPECT_GT(result.rows[0].timed->ns, 0);
  EXPECT_EQ(result.rows.back().timed->ns, 0);
}

/// A row whose queries looked at every group and at so many triangles.
ParkJangRow counted_row(const char* mesh, std::size_t triangles, const char* form, std::size_t groups,
                        double triangles_tested) {
  ParkJangRow row{mesh, triangles, form, 0, groups, TimedTurns{.ns = 1}};
  row.counted.mean = static_cast<double>(groups) + triangles_tested;
  row.groups_per_triangle = groups > 0 ? 2 : 0;
  return row;
}

/// Operations 50,000 ungrouped; 50,006, 5,490, 3,700 and 54,000 with 1, 40, 200 and 9,000 cuboids.
ParkJangResult one_curve() {
  ParkJangResult result;
  result.finished = true;
  result.rows = {counted_row("m", 1000, "ungrouped", 0, 1000), counted_row("m", 1000, "cube", 1, 1000),
                 counted_row("m", 1000, "cube", 40, 105), counted_row("m", 1000, "cube", 200, 50),
                 counted_row("m", 1000, "cube", 9000, 0)};
  return result;
}

TEST(ParkJang, FindsWhereACurveReachesATenthIsLowestAndRises) {
  const std::vector<ParkJangCurve> curves = park_jang_curves(one_curve());
  ASSERT_EQ(curves.size(), 1u);
  EXPECT_EQ(curves[0].best, 200u);
  EXPECT_NEAR(curves[0].factor, 50000 / 3700.0, 1e-9);
  // Straight lines in logarithms: 5,000 operations between 40 and 200 groups, 4,070 between 200 and 9,000.
  ASSERT_TRUE(curves[0].tenth_from && curves[0].rises_from);
  EXPECT_NEAR(*curves[0].tenth_from, 40 * std::pow(5.0, std::log(5490 / 5000.0) / std::log(5490 / 3700.0)),
              1e-6);
  EXPECT_NEAR(*curves[0].rises_from, 200 * std::pow(45.0, std::log(1.1) / std::log(54000 / 3700.0)), 1e-6);
}

TEST(ParkJang, GivesOneVerdictAStatementForSomeMeshOfThoseTried) {
  ParkJangResult result = one_curve();
  const ParkJangResult other = one_curve();
  for (ParkJangRow row : other.rows) {  // another mesh, whose best count is far off
    row.mesh = "n";
    if (row.groups == 200) row.counted.mean += 800;
    result.rows.push_back(row);
  }
  std::size_t best_count = 0;
  for (const Claim& claim : park_jang_claims(result)) {
    if (claim.what != "cuboids that suit the bunny best") continue;
    ++best_count;
    EXPECT_EQ(claim.agreement, Agreement::yes) << claim.reproduced;  // 200 is within a quarter of 214
    EXPECT_EQ(claim.printed, "about 214");
    EXPECT_EQ(claim.reproduced, "200 (1000 triangles), 40 (1000 triangles)");
  }
  EXPECT_EQ(best_count, 1u);
}

TEST(ParkJang, PassesNoVerdictOnTheTimesOfAnotherMachine) {
  const std::vector<Claim> claims = park_jang_claims(one_curve());
  ASSERT_FALSE(claims.empty());
  EXPECT_EQ(claims[0].what, "ungrouped time, ms");
  EXPECT_EQ(claims[0].agreement, Agreement::not_comparable);
  EXPECT_NE(claims_table({claims[0]}).csv().find("not comparable (their machine)"), std::string::npos);
  EXPECT_EQ(
      summary({claims[0]}),
      "Of 1 printed numbers and statements 0 agree, 0 nearly, 0 do not; 1 of their machine, not comparable.");
}

TEST(LineFit, FindsTheLine) {
  const std::array<std::pair<double, double>, 3> points{{{1, 5}, {2, 7}, {4, 11}}};
  EXPECT_NEAR(line_through(points).offset, 3, 1e-12);
  EXPECT_NEAR(line_through(points).slope, 2, 1e-12);
}

TEST(SurfaceRuler, TellsWhatASmallerSphereLost) {
  const TriangleMesh sphere = meshes::load_mesh("icosphere:3");
  const SurfaceRuler ruler(sphere);
  const SurfaceMeasures same = ruler.measure("original", 0, sphere);
  EXPECT_TRUE(same.keeps_vertices);
  EXPECT_EQ(same.vertices, 642u);
  EXPECT_NEAR(same.mean_offset, 0, 1e-12);
  const SurfaceMeasures smaller = ruler.measure("loop", 1, sphere.transformed(0.9, Vec3::Zero()));
  EXPECT_FALSE(smaller.keeps_vertices);
  EXPECT_NEAR(smaller.relative_volume, 0.729, 1e-9);
  EXPECT_NEAR(smaller.vertex_offset, 0.1, 1e-3);
  EXPECT_NEAR(smaller.shrinkage_at_creases, 1, 0.02);  // as far off everywhere
}

TEST(SurfaceMeasures, OfATriangleWithARightAngle) {
  const TriangleMesh mesh({{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}, {{0, 1, 2}});
  EXPECT_NEAR(mean_edge_ratio(mesh), 5.0 / 3, 1e-12);
  const SurfaceMeasures measures = SurfaceRuler(mesh).measure("original", 0, mesh);
  EXPECT_NEAR(measures.circumradius, 2.5, 1e-12);                         // half the hypotenuse
  EXPECT_NEAR(measures.centroid_radius, std::sqrt(1 + 64.0 / 9), 1e-12);  // from (1, 4/3) to (0, 4)
}

TEST(ChoiSungModels, AreClosedAndTheStatementsAreAskedOfThem) {
  for (const Model& model : choi_sung_models()) {
    EXPECT_TRUE(edge_statistics(model.mesh).closed()) << model.name;
    EXPECT_GT(signed_volume(model.mesh), 0) << model.name;
  }
  ChoiSungSettings settings = small_settings();
  settings.levels = 3;
  ChoiSungResult result;
  const std::vector<Model> ball{{"ball", meshes::load_mesh("icosphere:0")}};
  add_models(ball, settings, 2, result, [](const std::string&) {});
  EXPECT_GT(result.models.size(), 10u);
  EXPECT_EQ(result.models[0].model, "ball");
  EXPECT_EQ(result.distances.size(), 6u);
}

TEST(ParkJang, FindsTheBestCountAndThoseNearIt) {
  ParkJangResult result;
  const auto add = [&](const char* form, std::size_t groups, double ns) {
    result.rows.push_back({"m", 100, form, 0, groups, TimedTurns{.ns = ns}});
  };
  add("ungrouped", 0, 1000);
  add("cube", 1, 1010);
  add("cube", 10, 104);
  add("cube", 20, 100);
  add("cube", 40, 109);
  add("cube", 80, 300);
  const std::vector<ParkJangBest> best = park_jang_best(result);
  ASSERT_EQ(best.size(), 1u);
  EXPECT_EQ(best[0].groups, 20u);
  EXPECT_EQ(best[0].from, 10u);
  EXPECT_EQ(best[0].to, 40u);
  EXPECT_EQ(best[0].factor(), 10);
  EXPECT_EQ(best[0].last_ns, 300);
}

}  // namespace
}  // namespace touchmark::bench::experiments::papers
