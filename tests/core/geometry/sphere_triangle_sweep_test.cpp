#include "core/geometry/sphere_triangle_sweep.h"

#include <cmath>
#include <cstdint>
#include <random>

#include <gtest/gtest.h>

#include "bench/oracle/exact/exact_distance.h"
#include "core/detector.h"
#include "core/search/first_touch.h"

namespace touchmark {
namespace {

const PreparedTriangle triangle = prepare({0, 0, 0}, {4, 0, 0}, {0, 4, 0}, 0);

/// A fraction may be early by four units in the last place of 1.
constexpr double max_early = 0x1p-50;

/// Triangles and sweeps in and about the cube [-1, 1]^3, seeded.
class RandomCases {
 public:
  explicit RandomCases(std::uint64_t seed) : random_(seed) {}

  double coordinate() { return static_cast<double>(random_() >> 11) * 0x1p-52 - 1; }
  Vec3 point() { return {coordinate(), coordinate(), coordinate()}; }
  PreparedTriangle triangle() { return prepare(point(), point(), point(), 0); }
  Sweep sweep(bool of_a_bare_point) {
    return {2 * point(), 2 * point(), of_a_bare_point ? 0.0 : 0.3 * std::abs(coordinate())};
  }

 private:
  std::mt19937_64 random_;
};

/// Never later than `fraction` (the doubles below say it exactly), and earlier by less than 2^-50.
void expect_touch_at(double fraction, const PreparedTriangle& t, const Sweep& sweep) {
  const auto hit = sweep_hit(t, sweep, 1);
  ASSERT_TRUE(hit);
  EXPECT_LE(*hit, fraction);
  EXPECT_GE(*hit, fraction - max_early);
}

TEST(SphereTriangleSweep, HitsTheFaceOneRadiusAboveIt) {
  expect_touch_at(0.5, triangle, {{1, 1, 5}, {1, 1, -3}, 1});
}

TEST(SphereTriangleSweep, ABarePointHitsTheFaceItself) {
  expect_touch_at(0.25, triangle, {{1, 1, 1}, {1, 1, -3}, 0});
}

TEST(SphereTriangleSweep, HitsAnEdgeFromTheSide) {
  // Along y towards the edge on the x axis, 0.6 above the plane: touches at y = -0.8.
  expect_touch_at(0.5, triangle, {{2, -4.8, 0.6}, {2, 3.2, 0.6}, 1});
}

TEST(SphereTriangleSweep, HitsACornerHeadOn) { expect_touch_at(0.5, triangle, {{-5, 0, 0}, {3, 0, 0}, 1}); }

TEST(SphereTriangleSweep, TouchingAtTheStartIsFractionZero) {
  EXPECT_EQ(sweep_hit(triangle, {{1, 1, 1}, {1, 1, 9}, 1}, 1), 0.0);
}

TEST(SphereTriangleSweep, TouchingAtTheVeryEndIsAHit) {
  expect_touch_at(1, triangle, {{1, 1, 3}, {1, 1, 1}, 1});
}

TEST(SphereTriangleSweep, StoppingShortIsNoHit) {
  EXPECT_FALSE(sweep_hit(triangle, {{1, 1, 3}, {1, 1, 1.0000001}, 1}, 1));
}

TEST(SphereTriangleSweep, MovingAwayIsNoHit) {
  EXPECT_FALSE(sweep_hit(triangle, {{1, 1, 3}, {1, 1, 9}, 1}, 1));
}

TEST(SphereTriangleSweep, PassingAlongsideIsNoHit) {
  EXPECT_FALSE(sweep_hit(triangle, {{-5, -2, 0}, {9, -2, 0}, 1.9}, 1));
}

TEST(SphereTriangleSweep, StandingStillHitsOnlyWhenTouching) {
  EXPECT_TRUE(sweep_hit(triangle, {{1, 1, 1}, {1, 1, 1}, 1}, 1));
  EXPECT_FALSE(sweep_hit(triangle, {{1, 1, 2}, {1, 1, 2}, 1}, 1));
}

TEST(SphereTriangleSweep, AHitBeyondTheLimitIsNone) {
  EXPECT_FALSE(sweep_hit(triangle, {{1, 1, 5}, {1, 1, -3}, 1}, 0.49));
}

TEST(SphereTriangleSweep, ASliverThinnerThanTheStepIsNotMissed) {
  const PreparedTriangle needle = prepare({0, 0, 0}, {1e-9, 0, 0}, {0, 1, 0}, 0);
  expect_touch_at(0.5, needle, {{-100, 0.5, 0}, {100, 0.5, 0}, 0});
}

/// From so far away that the nearest point may be told anywhere on a third of the triangle, within the
/// rounding of its distance: what direction it is in says little of where the way leads.
TEST(SphereTriangleSweep, AFarBarePointGoesThroughAHugeSliver) {
  const PreparedTriangle sliver =
      prepare({-0x1.0000000000002p+1, -0x1.1c37937d8deep+53, 0x1.06243162a38e4p-10},
              {0x1.1c37937e08p+53, 0x1.000000007a12p+53, -0x1.6a09e6bdd9f86p-1},
              {0x1.12e0ac7ebdca7p-30, 0x1.e848ep+19, -0x1.0000002af31ddp+0}, 0);
  const Sweep sweep{{0x1.6a09e667f3bcdp-1, -0x1.999999999999ap-4, 0x1p+53},
                    {0x1.7af4c4a80aaa1p+51, -0x1.2cfb7a8668681p+48, -0x1.771232cf1a905p+11},
                    0};
  EXPECT_TRUE(sweep_hit(sliver, sweep, 1));
}

/// Along a needle nearly the way's whole length long a small error of the slope is a large one of the way.
TEST(SphereTriangleSweep, AlongANeedleTheTouchIsNotToldTooLate) {
  const PreparedTriangle needle = prepare({1000, 1, 1e6}, {0.75, 0.75, -0x1p+53}, {2, 4, -1}, 0);
  const Sweep sweep{{0x1.d0badef8018p+39, -0x1.65a0bbfe8p+31, -0x1.c72811f9eb6p+52},
                    {-0.1, -0.75, -0x1.0624dd2f1a9fcp-10},
                    0x1.215a116872afbp+13};
  const auto hit = sweep_hit(needle, sweep, 1);
  ASSERT_TRUE(hit);
  const double distance = contact_on(needle, position_at(sweep, *hit), 0).distance;
  const double tolerance = 0x1p-53 * 384 * (0x1p+54 + 0x1p+53) + position_error(sweep);
  EXPECT_GE(distance, sweep.radius - tolerance);
  EXPECT_LE(distance, sweep.radius + tolerance);
}

/// A point over a gear's cap took an exact decision for each of 900 triangles in the cap's plane.
TEST(SphereTriangleSweep, ABarePointThatSlidesOverAPlaneMeetsItsEndAloneAndTakesFewExactDecisions) {
  std::mt19937_64 random(3);
  const auto whole = [&] { return static_cast<double>(random() % 33) / 4 - 2; };  // -2 to 6 by quarters
  std::uint64_t decisions = 0, hits = 0, on_the_border = 0;
  const auto hit_of = [&](const Vec3& start, const Vec3& end) {
    return touch_bounds(triangle, {start, end, 0}, 1, decisions);
  };
  for (int i = 0; i < 20000; ++i) {
    const double height = std::ldexp(random() % 2 == 0 ? 1 : -1, -50 + static_cast<int>(random() % 8));
    const Vec3 from(whole(), whole(), height), on_it(whole(), whole(), 0),
        above(on_it.x(), on_it.y(), height / 3);
    EXPECT_FALSE(hit_of(from, above)) << i;
    EXPECT_FALSE(hit_of(above, from)) << i;
    const bool inside = on_it.x() >= 0 && on_it.y() >= 0 && on_it.x() + on_it.y() <= 4;
    on_the_border += inside && (on_it.x() == 0 || on_it.y() == 0 || on_it.x() + on_it.y() == 4) ? 1 : 0;
    hits += inside ? 1 : 0;
    EXPECT_EQ(hit_of(from, on_it).has_value(), inside) << i;
    const auto leaves = hit_of(on_it, from);
    EXPECT_EQ(leaves.has_value(), inside) << i;
    EXPECT_TRUE(!leaves || leaves->last == 0) << i;
  }
  EXPECT_GT(on_the_border, 100U);
  EXPECT_LE(decisions, 4 * hits);
}

/// Halving took 46 exact decisions a triangle, and counted one.
TEST(SphereTriangleSweep, ABarePointOnASmallGridIsToldWhereItMeetsATriangleByAtMostTwoExactDecisions) {
  std::mt19937_64 random(4);
  const auto place = [&] {
    const auto whole = [&] { return static_cast<double>(random() % 4); };
    const double x = whole(), y = whole();
    return Vec3(x, y, whole());
  };
  int hits = 0;
  for (int i = 0; i < 20000; ++i) {
    const PreparedTriangle t = prepare(place(), place(), place(), 0);
    const Vec3 from = place(), to = place();
    const Sweep sweep{from, to, 0};
    const auto order = [&](double fraction) {
      return bench::oracle::compare_part_distance(from, to, fraction, bench::oracle::Triangle(t.corner), 0);
    };
    std::uint64_t decisions = 0;
    const auto bounds = touch_bounds(t, sweep, 1, decisions);
    ASSERT_EQ(bounds.has_value(), order(1) <= 0) << i;
    if (!bounds) continue;
    const double fraction = touch_fraction(t, sweep, *bounds, decisions);
    ASSERT_LE(decisions, 2U) << i;
    ASSERT_EQ(fraction == 0, order(0) == 0) << i;
    if (fraction == 0) continue;
    ASSERT_TRUE(order(fraction) > 0) << i << " is late";
    ASSERT_TRUE(order(std::min(fraction + max_early, 1.0)) <= 0) << i << " is early";
    ++hits;
  }
  EXPECT_GT(hits, 500);
}

/// Halving took 54 decisions where rounding hides that a ball along an edge comes near enough to touch.
TEST(SphereTriangleSweep, ABallAlongAnEdgeIsToldWhereItTouchesByFewExactDecisions) {
  RandomCases random(5);
  int hits = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const PreparedTriangle t = random.triangle();
    const Vec3 edge = t.corner[1] - t.corner[0], third = (t.corner[0] + t.corner[1] + t.corner[2]) / 3;
    const Vec3 from = trial % 2 == 0 ? Vec3(t.corner[0] - 0.5 * edge) : Vec3(third + random.point());
    const double distance = contact_on(t, from, 0).distance;
    const double radius =
        trial % 3 == 0 ? std::ldexp(0.5, -(trial % 40)) : distance * (1 + random.coordinate() * 0x1p-48);
    const Sweep sweep{from, trial % 5 == 0 ? t.corner[1] : Vec3(from + 2 * edge), radius};
    std::uint64_t decisions = 0;
    const auto bounds = touch_bounds(t, sweep, 1, decisions);
    if (!bounds) continue;
    touch_fraction(t, sweep, *bounds, decisions);
    ASSERT_LE(decisions, 9U) << trial;
    ++hits;
  }
  EXPECT_GT(hits, 5000);

  // Found by fuzzing: 248 decisions on numbers of 2,000 bits kept a detector busy for a second.
  const PreparedTriangle t = prepare({0, 1e-24, 0}, {1e-12, -2e-9, 1e-9}, {1e-14, 4e-9, 1}, 0);
  const Vec3 two_thirds = (t.corner[0] + t.corner[1] + t.corner[1]) / 3;
  std::uint64_t decisions = 0;
  EXPECT_TRUE(touch_bounds(t, {two_thirds, t.corner[1], 5e-324}, 1, decisions));
  EXPECT_LE(decisions, 9U);
}

TEST(SphereTriangleSweep, NotANumberHitsNothing) {
  const double nan = std::nan("");
  EXPECT_FALSE(sweep_hit(triangle, {{nan, 0, 0}, {1, 1, 1}, 1}, 1));
  EXPECT_FALSE(sweep_hit(triangle, {{5, 5, 5}, {1, nan, 1}, 1}, 1));
}

/// Random sweeps against dense sampling of the distance, which is convex along the way.
TEST(SphereTriangleSweep, StopsAtTheRadiusAndNeverTouchesBefore) {
  RandomCases random(7);
  int hits = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const PreparedTriangle t = random.triangle();
    const Sweep sweep = random.sweep(trial % 3 == 0);
    const auto distance_at = [&](double fraction) {
      return std::sqrt(squared_distance(t, position_at(sweep, fraction)));
    };
    constexpr double tolerance = 4 * 40 * kernel_relative_error;
    const auto hit = sweep_hit(t, sweep, 1);
    const double last = hit.value_or(1);
    if (hit) {
      ++hits;
      if (*hit > 0) {
        EXPECT_NEAR(distance_at(*hit), sweep.radius, tolerance) << trial;
      }
    }
    double lo = 0, hi = last;  // ternary search for the least distance before the hit
    for (int i = 0; i < 100; ++i) {
      const double a = lo + (hi - lo) / 3, b = hi - (hi - lo) / 3;
      (distance_at(a) < distance_at(b) ? hi : lo) = distance_at(a) < distance_at(b) ? b : a;
    }
    if (!hit || *hit > 0) {
      EXPECT_GE(distance_at(lo), sweep.radius - tolerance) << trial;
    }
  }
  EXPECT_GT(hits, 1000);
}

TEST(SphereTriangleSweep, ALongWayThatPiercesTheFaceOrEndsOnACornerIsNotMissed) {
  RandomCases random(11);
  for (int trial = 0; trial < 20000; ++trial) {
    const PreparedTriangle t = random.triangle();
    const Vec3 middle = (t.corner[0] + t.corner[1] + t.corner[2]) / 3;
    const double far = std::pow(10.0, 1 + trial % 9);
    const Vec3 from = far * random.point();
    const Vec3 way = (middle - from).normalized();
    // In triangles seen nearly edge on, rounding decides whether the way goes through the inside.
    if (std::abs(way.dot(t.normal)) < 0.1) continue;
    const double behind = std::max(far * 1e-14, std::pow(10.0, -1 - trial % 13));
    const Sweep through{from, middle + behind * way, 0};
    EXPECT_TRUE(sweep_hit(t, through, 1)) << trial;
    EXPECT_TRUE(sweep_hit(t, {from, t.corner[trial % 3], 0}, 1)) << trial;
  }
}

/// Returns where a ball that goes about this way touches the feature (1: a corner, 2: an edge, 3: the face),
/// and comes near to it at this rate.
Sweep grazing(RandomCases& random, const PreparedTriangle& t, int feature, double radius, double rate,
              double length) {
  Vec3 along = random.point(), outward = t.normal, foot = t.corner[0];
  if (feature == 3) foot = (t.corner[0] + t.corner[1] + t.corner[2]) / 3;
  if (feature == 2) {
    const Vec3 edge = t.corner[1] - t.corner[0];
    foot += 0.25 * (1 + random.coordinate()) * edge;
    outward += (edge.cross(t.normal)).normalized();
  }
  if (feature == 1)
    outward = (2 * t.corner[0] - t.corner[1] - t.corner[2]).normalized() + 0.1 * random.point();
  outward.normalize();
  along = (along - along.dot(outward) * outward).normalized() - rate * outward;
  const Vec3 touch = foot + radius * outward;
  const double before = 0.5 * (1 + random.coordinate());
  return {touch - before * length * along, touch + (1 - before) * length * along, radius};
}

TEST(SphereTriangleSweep, TheFractionIsNeverLateAndEarlyByLessThanFourUnitsInTheLastPlaceOfOne) {
  RandomCases random(13);
  int hits = 0, grazes = 0;
  for (int trial = 0; trial < 12000; ++trial) {
    const double scale = std::ldexp(1, trial % 11 == 0 ? 400 : trial % 9 * 40 - 120),
                 offset = trial % 5 * trial % 5 * 1e4;
    const Vec3 far = offset * random.point();
    const auto placed = [&](const Vec3& point) -> Vec3 { return scale * (point + far); };
    const PreparedTriangle unit = random.triangle();
    const double radius = trial % 4 == 0 ? 0 : std::exp2(12 * random.coordinate() - 6);
    const double rate = std::exp2(-30 * std::abs(random.coordinate())),
                 length = std::exp2(10 * random.coordinate() - 4);
    const Sweep about = grazing(random, unit, 1 + trial % 3, radius, rate, length);
    const PreparedTriangle t =
        prepare(placed(unit.corner[0]), placed(unit.corner[1]), placed(unit.corner[2]), 0);
    const Sweep sweep{placed(about.from), placed(about.to), scale * radius};
    const auto order = [&](double fraction) {
      return bench::oracle::compare_part_distance(sweep.from, sweep.to, fraction,
                                                  bench::oracle::Triangle(t.corner), sweep.radius);
    };
    std::uint64_t decisions = 0;
    const auto bounds = touch_bounds(t, sweep, 1, decisions);
    ASSERT_EQ(bounds.has_value(), order(1) <= 0) << trial;
    if (!bounds || bounds->last == 0) continue;
    const double fraction = touch_fraction(t, sweep, *bounds, decisions);
    ASSERT_LE(decisions, 5U) << trial;
    ++hits;
    if (rate < 1e-6) ++grazes;
    ASSERT_FALSE(order(fraction) < 0) << trial << " is late";
    ASSERT_TRUE(order(std::min(fraction + max_early, 1.0)) <= 0) << trial << " is early";
  }
  EXPECT_GT(hits, 4000);
  EXPECT_GT(grazes, 500);
}

/// A ball grazes the tip of one triangle, and meets the other head on within what doubles know of that touch.
TEST(SphereTriangleSweep, OfTwoTouchesWithinRoundingTheFirstCountsInEitherOrder) {
  const Sweep sweep{{-0.5, 0, 0}, {0.5, 0, 0}, 1};
  std::uint64_t decisions = 0;
  int told_apart = 0;
  for (int depth = 30; depth < 53; ++depth) {
    const PreparedTriangle grazed = prepare({0, 1 - std::ldexp(1, -depth), 0}, {-1, 3, 0}, {1, 3, 0}, 0);
    const auto bounds = touch_bounds(grazed, sweep, 1, decisions);
    ASSERT_TRUE(bounds) << depth;
    const double at = touch_fraction(grazed, sweep, *bounds, decisions);
    for (const double wall_at : {0.5 * (bounds->first + at), 0.5 * (at + bounds->last)}) {
      if (std::abs(wall_at - at) < 0x1p-40) continue;
      ++told_apart;
      const double x = wall_at + 0.5;
      const PreparedTriangle wall = prepare({x, -5, -5}, {x, 5, -5}, {x, 0, 5}, 1);
      for (const bool wall_is_last : {false, true}) {
        FirstTouch first(sweep);
        first.consider(wall_is_last ? grazed : wall, decisions);
        first.consider(wall_is_last ? wall : grazed, decisions);
        EXPECT_EQ(first.triangle().index, wall_at < at ? 1U : 0U) << depth;
        EXPECT_NEAR(first.fraction(), std::min(wall_at, at), 2 * max_early) << depth;
      }
    }
  }
  EXPECT_GT(told_apart, 5);
}

TEST(SphereTriangleSweep, TheLimitDoesNotChangeWhereItHits) {
  RandomCases random(12);
  int hits = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const PreparedTriangle t = random.triangle();
    const Sweep sweep = random.sweep(trial % 3 == 0);
    const auto hit = sweep_hit(t, sweep, 1);
    if (!hit) continue;
    ++hits;
    EXPECT_EQ(sweep_hit(t, sweep, *hit), hit) << trial;
    if (*hit > 0) {
      EXPECT_EQ(sweep_hit(t, sweep, std::nextafter(*hit, 0)), std::nullopt) << trial;
    }
  }
  EXPECT_GT(hits, 1000);
}

}  // namespace
}  // namespace touchmark
