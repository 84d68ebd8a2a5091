/// The judge of proxies, on ways that are known to leak or not: it must count every leak and nothing else.
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "bench/meshes/surface_builder.h"
#include "bench/oracle/exact/moving_meeting.h"
#include "bench/proxies/tally.h"
#include "core/float_limits.h"

namespace touchmark::bench::proxies {
namespace {

/// The square |x|, |y| <= 1 at z = 0.
TriangleMesh sheet() {
  meshes::Surface surface;
  meshes::add_patch(surface, 2, 2, [](double u, double v) { return Vec3(2 * u - 1, 2 * v - 1, 0); });
  return std::move(surface).mesh();
}

TriangleMesh box() {
  meshes::Surface surface;
  meshes::add_box(surface, Vec3(-1, -1, -1), Vec3(1, 1, 1));
  return std::move(surface).mesh();
}

/// Judges given ways: the proxy goes through each list of positions in one tick, its last one the goal unless
/// goals are given.
struct Trial {
  Course course;
  Coupling coupling{};
  std::vector<std::vector<Vec3>> ways;

  Tally judged() {
    course.goals.clear();
    for (const std::vector<Vec3>& way : ways) course.goals.push_back(way.back());
    return judged_with_goals();
  }
  Tally judged_with_goals() {
    Tally tally;
    const WayOracle oracle(course.mesh);
    const std::vector<Vec3> optima = optima_of(course);
    Judge judge(course, optima, coupling, tally);
    judge.see(oracle);
    Vec3 at = course.start;
    for (std::size_t tick = 0; tick < ways.size(); ++tick) {
      Step step;
      step.begin(at);
      for (const Vec3& to : ways[tick]) step.go(to);
      judge.tick(tick, step);
      at = step.position();
    }
    return tally;
  }
};

Trial over(TriangleMesh mesh, double radius, const Vec3& start, std::vector<std::vector<Vec3>> ways) {
  Trial trial{{"trial", std::move(mesh), radius, 0, start, {}}, {}, std::move(ways)};
  trial.coupling.radius = radius;
  return trial;
}

TEST(ProxyJudge, CountsAWayThroughASheetAsACrossingAndAPop) {
  const Tally tally = over(sheet(), 0, Vec3(0.3, 0.2, 1), {{Vec3(0.3, 0.2, -1)}}).judged();
  EXPECT_EQ(tally.crossings, 1U);
  EXPECT_EQ(tally.pops, 1U);
}

TEST(ProxyJudge, CountsAWayThroughASharedEdgeOrCornerAsACrossing) {
  EXPECT_EQ(over(sheet(), 0, Vec3(0, 0, 1), {{Vec3(0, 0, -1)}}).judged().crossings, 1U);
  EXPECT_EQ(over(sheet(), 0, Vec3(0.5, 0.5, 1), {{Vec3(0.5, 0.5, -1)}}).judged().crossings, 1U);
}

TEST(ProxyJudge, CountsAWayThatStopsOnTheSheetAsACrossingButNoPop) {
  const Tally tally =
      over(sheet(), 0, Vec3(0.3, 0.2, 1), {{Vec3(0.3, 0.2, 0)}, {Vec3(0.3, 0.2, 1)}}).judged();
  EXPECT_EQ(tally.crossings, 2U) << "there and back";
  EXPECT_EQ(tally.pops, 0U);
}

TEST(ProxyJudge, DoesNotCountAWayOneUlpBesideTheSheetOrRoundItsBorder) {
  const double smallest = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(over(sheet(), 0, Vec3(0, 0, 1), {{Vec3(0.3, 0.2, smallest)}, {Vec3(0.9, 0.2, smallest)}})
                .judged()
                .crossings,
            0U);
  const Vec3 beside(std::nextafter(1.0, 2.0), 0, 1), below(std::nextafter(1.0, 2.0), 0, -1);
  EXPECT_EQ(over(sheet(), 0, beside, {{below}}).judged().crossings, 0U);
  EXPECT_EQ(over(sheet(), 0, Vec3(1, 0, 1), {{Vec3(1, 0, -1)}}).judged().crossings, 1U)
      << "the border is closed";
}

TEST(ProxyJudge, CountsEachPieceOfATicksWayButEachTickOnce) {
  const Tally tally =
      over(sheet(), 0, Vec3(0.3, 0.2, 1), {{Vec3(0.3, 0.2, -1), Vec3(0.3, 0.2, 1), Vec3(0.4, 0.2, 1)}})
          .judged();
  EXPECT_EQ(tally.pieces, 3U);
  EXPECT_EQ(tally.crossings, 1U);
}

TEST(ProxyJudge, SeesALeakInTwoStepsThroughAClosedSurface) {
  // Onto the face to the last bit, and on from there: neither piece alone is clear of the face at both ends.
  const Tally tally =
      over(box(), 0, Vec3(0.3, 0.2, 2), {{Vec3(0.3, 0.2, 1)}, {Vec3(0.3, 0.2, 0.5)}}).judged();
  EXPECT_EQ(tally.crossings, 2U);
  EXPECT_EQ(tally.pops, 1U);
}

TEST(ProxyJudge, TellsTheRadiusFromOneUlpLess) {
  const double radius = 0.1, nearer = std::nextafter(radius, 0);
  const Tally at_it =
      over(sheet(), radius, Vec3(0.3, 0.2, 1), {{Vec3(0.3, 0.2, radius)}, {Vec3(0.7, 0.2, radius)}}).judged();
  EXPECT_EQ(at_it.violations, 0U);
  const Tally inside = over(sheet(), radius, Vec3(0.3, 0.2, 1), {{Vec3(0.3, 0.2, nearer)}}).judged();
  EXPECT_EQ(inside.violations, 1U);
  EXPECT_EQ(inside.crossings, 0U);
  EXPECT_EQ(inside.max_shortfall, radius - nearer);
}

TEST(ProxyJudge, SeesABallThatCutsACornerBetweenTwoFreePositions) {
  // Both ends are a radius off the box's edge at (1, y, 1); the middle of the way is nearer.
  const Tally tally =
      over(box(), 0.25, Vec3(1.25, 0, 0.5), {{Vec3(1.25, 0, 1)}, {Vec3(1, 0, 1.25)}}).judged();
  EXPECT_EQ(tally.violations, 1U);
  EXPECT_EQ(tally.max_shortfall, 0) << "at the tick's end it is as far as it should be";
}

TEST(ProxyJudge, CountsAGoalThatWasFreeAndNotReached) {
  Trial trial = over(sheet(), 0, Vec3(0, 0, 1), {{Vec3(0.3, 0, 1)}, {Vec3(0.3, 0, 0.5)}});
  trial.course.goals = {Vec3(0.4, 0, 1), Vec3(0.3, 0, -0.5)};
  EXPECT_EQ(trial.judged_with_goals().missed_goals, 1U) << "the second goal is below the sheet";
}

TEST(ProxyJudge, CountsBitsThatChangeAfterTenTicksOfRest) {
  const Vec3 rest(0.3, 0.2, 0.5), beside(std::nextafter(0.3, 1.0), 0.2, 0.5);
  Trial trial = over(sheet(), 0, Vec3(0, 0, 1), std::vector<std::vector<Vec3>>(15, {rest}));
  trial.course.goals.assign(15, Vec3(0.3, 0.2, -0.5));
  EXPECT_EQ(trial.judged_with_goals().rest_ticks, 4U);
  EXPECT_EQ(trial.judged_with_goals().jitters, 0U);
  trial.ways[13] = {beside};
  EXPECT_EQ(trial.judged_with_goals().jitters, 2U) << "there and back";
}

TEST(ProxyJudge, MeasuresTheDistanceFromTheOptimum) {
  Trial trial = over(sheet(), 0.25, Vec3(0, 0, 1), {{Vec3(0.25, 0, 0.25)}, {Vec3(0.25, 0, 0.5)}});
  trial.course.bounds = {0};
  trial.course.goals.assign(2, Vec3(0.25, 0, -1));
  const Tally tally = trial.judged_with_goals();
  EXPECT_EQ(tally.optimum_ticks, 2U);
  EXPECT_EQ(tally.max_optimum_error, 0.25);
}

TEST(ProxyJudge, CountsAnAnswerThatIsNoNumber) {
  const Tally tally =
      over(sheet(), 0, Vec3(0, 0, 1), {{Vec3(0, 0, std::nan(""))}, {Vec3(infinity, 0, 0)}}).judged();
  EXPECT_EQ(tally.unanswered, 2U);
}

TEST(ProxyJudge, DoesNotHoldTheSurfacesOwnMotionAgainstTheProxy) {
  Trial trial = over(sheet(), 0.25, Vec3(0, 0, 0.5), {});
  Tally tally;
  const WayOracle before(trial.course.mesh);
  const WayOracle after(trial.course.mesh.transformed(1, Vec3(0, 0, 0.375)));
  const std::vector<Vec3> none;
  trial.course.goals.assign(3, Vec3(0, 0, 1));
  Judge judge(trial.course, none, trial.coupling, tally);
  judge.see(before);
  judge.see(after);
  Vec3 at = trial.course.start;
  for (std::size_t tick = 0; tick < 3; ++tick) {
    Step step;
    step.begin(at);
    step.go(at + Vec3(0, 0, tick == 2 ? -0.25 : 0.125));
    judge.tick(tick, step);
    at = step.position();
  }
  EXPECT_EQ(tally.violations, 1U) << "once it is off again, it is its own doing";
}

TEST(ProxyJudge, CountsABallThatGoesThroughTheSurfaceThatWasMovedOntoIt) {
  Trial trial = over(sheet(), 0.25, Vec3(0, 0, 0.5), {});
  Tally tally;
  const WayOracle before(trial.course.mesh);
  const WayOracle after(trial.course.mesh.transformed(1, Vec3(0, 0, 0.375)));
  const std::vector<Vec3> none;
  trial.course.goals.assign(1, Vec3(0, 0, -1));
  Judge judge(trial.course, none, trial.coupling, tally);
  judge.see(before);
  judge.see(after);
  Step step;
  step.begin(trial.course.start);
  step.go(Vec3(0, 0, 0.25));
  judge.tick(0, step);
  EXPECT_EQ(tally.crossings, 1U);
  EXPECT_EQ(tally.violations, 0U);
}

TEST(ProxyJudge, CountsAPointThatASheetPassesUnlessItIsTakenAlongOrSqueezed) {
  const TriangleMesh low = sheet(), raised = low.transformed(1, Vec3(0, 0, 1));
  const WayOracle before(low), after(raised);
  const std::vector<Vec3> none;
  const Vec3 at(0.3, 0.2, 0.5), ahead(0.3, 0.2, 1.5), late(0.3, 0.2, 1);
  const auto crossings = [&](const Vec3& to, bool squeezed) {
    Trial trial = over(low, 0, at, {});
    trial.course.goals.assign(1, to);
    Tally tally;
    Judge judge(trial.course, none, trial.coupling, tally);
    judge.see(before);
    judge.see(
        after, [] {},
        [&](const Vec3& from, const Vec3& end) { return oracle::any_meets(low, raised, from, end); });
    Step step;
    step.begin(to);
    step.squeezed = squeezed;
    judge.tick(0, step);
    return tally.crossings;
  };
  EXPECT_EQ(crossings(at, false), 1U);
  EXPECT_EQ(crossings(late, false), 1U) << "it is met at the very end";
  EXPECT_EQ(crossings(ahead, false), 0U);
  EXPECT_EQ(crossings(at, true), 0U) << "the method has said so";
}

TEST(ProxyJudge, SumsTheEnergyOfAClosedTurn) {
  Trial trial = over(sheet(), 0, Vec3(0, 0, 1), {});
  trial.course.loop = 2;
  trial.course.goals = {Vec3(0, 0, 0.5), Vec3(0, 0, 1)};
  Tally tally;
  const WayOracle oracle(trial.course.mesh);
  const std::vector<Vec3> none;
  Judge judge(trial.course, none, trial.coupling, tally);
  judge.see(oracle);
  Step step;
  step.begin(trial.course.start);
  step.force = Vec3(0, 0, 2);
  judge.tick(0, step);  // half a metre against 1 N in the mean
  judge.tick(1, step);  // and back with 2 N
  EXPECT_EQ(tally.max_energy, 0.5);
}

}  // namespace
}  // namespace touchmark::bench::proxies
