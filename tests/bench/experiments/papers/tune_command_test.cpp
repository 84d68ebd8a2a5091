#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bench/experiments/papers/tuning.h"
#include "bench/meshes/meshes.h"
#include "core/subdivision/subdivision.h"
#include "tests/bench/cli/run_touchmark.h"

namespace touchmark::bench::experiments::papers {
namespace {

FrontierPoint point(const char* form, double error, std::optional<double> ns) {
  FrontierPoint p;
  p.method = "ls3";
  p.form = form;
  p.error.mean = error;
  p.ns = p.ns_p99 = ns;
  return p;
}

TEST(Tune, TakesTheLeastErrorThatHoldsTheRate) {
  FrontierResult result;
  result.points = {point("scan", 1, 1e6), point("scan", 3, 1e3), point("fast level", 2, 1e4),
                   point("tree", 1, 500)};
  EXPECT_EQ(tune(result, 1000).published->error.mean, 1);
  EXPECT_EQ(tune(result, 1001).published->error.mean, 2);
  EXPECT_EQ(tune(result, 1e6).published->error.mean, 3);
  EXPECT_FALSE(tune(result, 1e6 + 1).published);
  EXPECT_EQ(tune(result, 1e6 + 1).fast->error.mean, 1);
  EXPECT_FALSE(tune(result, 1e10).fast);
}

TEST(Tune, OfEqualErrorsTakesTheFaster) {
  FrontierResult result;
  result.points = {point("scan", 1, 200), point("scan", 1, 100), point("scan", 1, 300)};
  EXPECT_EQ(tune(result, 10).published->ns, 100);
}

TEST(Tune, CountsNothingThatWasNotTimed) {
  FrontierResult result;
  result.points = {point("scan", 1, std::nullopt)};
  EXPECT_FALSE(tune(result, 10).published);
}

TEST(Tune, TakesWhatTookLessThanAnyClockTells) {
  FrontierResult result;
  result.points = {point("tree", 0.93, 100), point("tree", 0.22, 0)};
  EXPECT_EQ(tune(result, 1000).fast->error.mean, 0.22);
}

TEST(Tune, PrefersTheSimplerMeshWithinATenthOfTheError) {
  const auto of_size = [](std::size_t triangles, double error) {
    FrontierPoint p = point("tree", error, 100);
    p.triangles = triangles;
    return p;
  };
  FrontierResult result;
  result.points = {of_size(40'000, 1), of_size(10'000, 1.09), of_size(900, 1.2)};
  EXPECT_EQ(tune(result, 1000).fast->triangles, 10'000u);
}

TEST(TuneNote, SaysWhenAFinerLevelIsFartherOff) {
  FrontierResult result;
  result.points = {point("scan", 2, 1), point("scan", 1, 1), point("scan", 1.5, 1)};
  for (int level = 0; level < 3; ++level) result.points[static_cast<std::size_t>(level)].level = level;
  EXPECT_TRUE(rising_error_note(result).starts_with("The error rises from level 1 to level 2 of ls3"));
  result.points.pop_back();
  EXPECT_EQ(rising_error_note(result), "");
}

TEST(MarkBest, MarksWhatNoOtherBeats) {
  std::vector<FrontierPoint> points = {point("scan", 5, 10), point("scan", 6, 20), point("scan", 1, 30),
                                       point("tree", 1, 20), point("scan", 0.5, std::nullopt)};
  mark_best(points, [](const FrontierPoint&) { return true; });
  const std::vector<bool> expected{true, false, false, true, false};
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(points[i].best, expected[i]) << i;
  mark_best(points, [](const FrontierPoint& p) { return p.form == "scan"; });
  EXPECT_TRUE(points[2].best);
  EXPECT_FALSE(points[3].best);
}

TEST(Detector, IsWrittenAsTheCommandLineTakesIt) {
  FrontierPoint p = point("fast level", 1, 1);
  p.clustering = 0.25;
  EXPECT_EQ(detector_of(p), "sphere-cluster:lookup=scan,clustering=0.25,precise=false");
  EXPECT_EQ(detector_of(point("scan", 1, 1)), "sphere-cluster:lookup=scan");
  EXPECT_EQ(detector_of(point("grid", 1, 1)), "grid-group");
}

TEST(TuneCommand, FindsAFinerSurfaceAtARateThatEveryoneHolds) {
  // A sphere's facets are wrong where its subdivision is right: the finest level has the least error.
  const TemporaryFolder folder;
  const cli::Outcome outcome = cli::run_touchmark({"tune", "--rate", "0.001", "--mesh", "icosphere:1",
                                                   "--quick", "--levels", "2", "--out", folder.file("")});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("as published: ls3 level 2, sphere-cluster:lookup=scan"), std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.out.find("--method ls3 --levels 2"), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.out.find("inf"), std::string::npos) << outcome.out;
  EXPECT_NE(cli::content_of(folder.file("tune.csv")).find("method,level,form"), std::string::npos);
}

TEST(SharpEdges, AreThoseOfACubeHoweverFinelyItsFacesAreCut) {
  const TriangleMesh cube = meshes::load_mesh("cube");
  EXPECT_EQ(sharp_edges(cube).count, 12u);
  EXPECT_EQ(sharp_edges(cube).share, 1);
  const TriangleMesh fine = subdivide(cube, {.method = SubdivisionMethod::mid_point, .levels = 3});
  EXPECT_EQ(sharp_edges(fine).count, 12u * 8);
  EXPECT_EQ(sharp_edges(fine).share, 1);
  EXPECT_EQ(sharp_edges(meshes::load_mesh("icosphere:2")).count, 0u);
}

TEST(TuneCommand, AnswersFirstAndKeepsTheCornersOfACube) {
  const cli::Outcome outcome = cli::run_touchmark({"tune", "--rate", "0.001", "--mesh", "cube", "--quick"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(outcome.out.starts_with("as published: original level 0")) << outcome.out;
  EXPECT_NE(outcome.out.find("mean error 0.0000 %"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("error: against the mesh as it is, since 12 edges"), std::string::npos)
      << outcome.out;
}

TEST(TuneCommand, GoesOnWhileTheRateHoldsAndSaysWhyItStops) {
  const cli::Outcome outcome =
      cli::run_touchmark({"tune", "--rate", "0.001", "--mesh", "icosphere:1", "--quick"});
  EXPECT_NE(outcome.out.find("ls3 2 "), std::string::npos) << outcome.out;  // a row beyond quick's one level
  EXPECT_NE(outcome.out.find("finer levels: none tried, level 4 would be the reference itself"),
            std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.out.find("against LS3's own limit surface"), std::string::npos) << outcome.out;
}

TEST(TuneCommand, MeasuresAgainstTheReferenceThatIsNamed) {
  const cli::Outcome outcome =
      cli::run_touchmark({"tune", "--rate", "0.001", "--mesh", "icosphere:1", "--quick", "--reference",
                          "icosphere:1", "--method", "loop"});
  EXPECT_TRUE(outcome.out.starts_with("as published: original level 0")) << outcome.out;
  EXPECT_NE(outcome.out.find("error: against icosphere:1 (80 triangles)"), std::string::npos) << outcome.out;
  cli::expect_bad_input({"tune", "--rate", "1", "--mesh", "icosphere:1", "--reference", "no-such-mesh"},
                        {"no-such-mesh"});
}

TEST(TuneCommand, SaysThatNothingHoldsAnImpossibleRate) {
  const cli::Outcome outcome =
      cli::run_touchmark({"tune", "--rate", "1e12", "--mesh", "icosphere:0", "--quick"});
  EXPECT_EQ(outcome.status, 1) << outcome.err;
  EXPECT_NE(outcome.out.find("as published: none holds 1e12 Hz"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("fast and exact: none holds 1e12 Hz"), std::string::npos) << outcome.out;
}

TEST(TuneCommand, RefusesBadInputInOneLine) {
  cli::expect_bad_input({"tune", "--mesh", "icosphere:1"}, {"--rate"});
  cli::expect_bad_input({"tune", "--rate", "1000"}, {"mesh"});
  const auto with = [](const std::string& option, const std::string& value) {
    std::vector<std::string> words{"tune", "--mesh", "icosphere:1"};
    if (option != "--rate") words.insert(words.end(), {"--rate", "1000"});
    words.insert(words.end(), {option, value});
    cli::expect_bad_input(words, {option, value});
  };
  for (const char* rate : {"0", "-1", "inf", "nan", "fast"}) with("--rate", rate);
  for (const char* levels : {"-1", "9", "x"}) with("--levels", levels);
  for (const char* length : {"-1", "inf", "x"}) {
    with("--threshold", length);
    with("--clustering", length);
    with("--radius", length);
  }
  with("--method", "doo-sabin");
  with("--steps", "0");
  with("--seed", "x");
}

}  // namespace
}  // namespace touchmark::bench::experiments::papers
