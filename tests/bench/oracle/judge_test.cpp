// A detector that knows the truth and lies in one way at a time: the judge must charge it for that lie, and
// for nothing else.
#include "bench/oracle/judge.h"

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "bench/oracle/float_limits.h"
#include "core/brute_force/brute_force.h"
#include "tests/bench/oracle/corner_case_meshes.h"

namespace touchmark::bench::oracle {

namespace stress = experiments::stress;

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr Accuracy exact = {Guarantee::exact, kernel_relative_error, 0};
constexpr double radius = 0.05;

/// The octasphere(8) has 64 triangles an octant, and octant i lies opposite to octant 7 - i.
TriangleId opposite(TriangleId triangle) { return triangle ^ (7 * 64); }

/// The counts alone, so that a test can say "this one, and only this".
struct Counts {
  std::uint64_t missed = 0, false_contacts = 0, wrong_triangle = 0, beyond_bound = 0, wrong_point = 0,
                wrong_normal = 0, malformed = 0, unresolved = 0;
  bool operator==(const Counts&) const = default;
};

Counts counts(const ErrorCounts& t) {
  return {t.missed,      t.false_contacts, t.wrong_triangle, t.beyond_bound,
          t.wrong_point, t.wrong_normal,   t.malformed,      t.unresolved};
}

std::ostream& operator<<(std::ostream& out, const Counts& c) {
  return out << "missed " << c.missed << " false " << c.false_contacts << " triangle " << c.wrong_triangle
             << " beyond " << c.beyond_bound << " point " << c.wrong_point << " normal " << c.wrong_normal
             << " malformed " << c.malformed << " unresolved " << c.unresolved;
}

/// 300 probes about a ball, two thirds of them within the radius; what they are told is what the oracle
/// knows.
class LyingDetector : public testing::Test {
 protected:
  using Lie = std::function<void(workload::Answer&)>;

  LyingDetector() {
    stress::CornerCases cases(31);
    for (int i = 0; i < 300; ++i) {
      const double distance = i % 3 == 0 ? cases.between(1.2, 4) * radius : cases.between(0.1, 0.6) * radius;
      probes.push_back({(1 + distance) * cases.vector().normalized(), radius});
    }
    truths = oracle.solve(probes);
    for (std::size_t i = 0; i < probes.size(); ++i) answers.push_back(truthful(truths[i], radius));
  }

  static workload::Answer truthful(const GroundTruth& truth, double reach) {
    if (!(truth.high <= reach)) return {};
    return workload::Answer::of({truth.point, truth.direction, truth.high, truth.triangle});
  }

  /// Every answer for which `found` holds is changed by `lie`.
  ErrorCounts errors_of(const Lie& lie, bool found = true, const Accuracy& accuracy = exact) const {
    std::vector<workload::Answer> lies = answers;
    for (workload::Answer& answer : lies)
      if ((answer.found != 0) == found) lie(answer);
    return judge(oracle, truths, workload::Query::nearest, probes, radius, lies, accuracy);
  }

  TriangleMesh mesh = octasphere(8);
  Oracle oracle{mesh};
  std::vector<Probe> probes;
  std::vector<GroundTruth> truths;
  std::vector<workload::Answer> answers;
  static constexpr std::uint64_t touching = 200, free = 100;
};

TEST_F(LyingDetector, IsNotChargedWhileItTellsTheTruth) {
  const ErrorCounts errors = judge(oracle, truths, workload::Query::nearest, probes, radius, answers, exact);
  EXPECT_EQ(counts(errors), Counts{});
  EXPECT_EQ(errors.judged, probes.size());
  EXPECT_LE(errors.max_distance_error_ulp, 0.5);
  EXPECT_LE(errors.max_normal_angle_deg, 1e-12);
  EXPECT_TRUE(meets_guarantee(errors, exact));
}

TEST_F(LyingDetector, IsCaughtMissing) {
  const ErrorCounts errors = errors_of([](workload::Answer& a) { a = {}; });
  EXPECT_EQ(counts(errors), Counts{.missed = touching});
  EXPECT_FALSE(meets_guarantee(errors, exact));
  EXPECT_FALSE(meets_guarantee(errors, {Guarantee::conservative, 0, 0}));
}

TEST_F(LyingDetector, IsCaughtInventing) {
  const ErrorCounts errors = errors_of([](workload::Answer& a) { a.found = 1; }, false);
  EXPECT_EQ(counts(errors), Counts{.false_contacts = free});
  EXPECT_FALSE(meets_guarantee(errors, exact));
  EXPECT_TRUE(meets_guarantee(errors, {Guarantee::conservative, 0, 0}));
}

TEST_F(LyingDetector, IsCaughtNamingAnotherTriangle) {
  const ErrorCounts errors = errors_of([&](workload::Answer& a) { a.triangle = opposite(a.triangle); });
  EXPECT_EQ(counts(errors), Counts{.wrong_triangle = touching});
  EXPECT_FALSE(meets_guarantee(errors, exact));
}

TEST_F(LyingDetector, IsCaughtNamingATriangleThatIsNot) {
  const auto size = static_cast<TriangleId>(mesh.size());
  EXPECT_EQ(counts(errors_of([&](workload::Answer& a) { a.triangle = size; })),
            Counts{.wrong_triangle = touching});
}

TEST_F(LyingDetector, IsCaughtShiftingTheDistance) {
  const double shift = 1e-12;
  for (const double by : {shift, -shift}) {
    const ErrorCounts errors = errors_of([&](workload::Answer& a) { a.distance += by; });
    EXPECT_EQ(counts(errors), Counts{.beyond_bound = touching});
    EXPECT_NEAR(errors.max_distance_error, shift, 1e-16);
    EXPECT_NEAR(errors.max_distance_error_of_diagonal, shift / mesh.diagonal(), 1e-16);
    EXPECT_GT(errors.max_distance_error_ulp, shift / (0.8 * radius * 0x1p-52) * 0.99);
    EXPECT_FALSE(meets_guarantee(errors, exact));
  }
}

TEST_F(LyingDetector, IsCaughtTurningTheNormal) {
  const double degrees = 0.01;
  const ErrorCounts errors = errors_of([&](workload::Answer& a) {
    const Vec3 normal(a.normal[0], a.normal[1], a.normal[2]);
    const Vec3 turned = Eigen::AngleAxisd(degrees * std::numbers::pi / 180, normal.unitOrthogonal()) * normal;
    std::copy(turned.begin(), turned.end(), a.normal);
  });
  EXPECT_EQ(counts(errors), Counts{.wrong_normal = touching});
  EXPECT_NEAR(errors.max_normal_angle_deg, degrees, 1e-9);
  EXPECT_FALSE(meets_guarantee(errors, exact));
}

TEST_F(LyingDetector, IsCaughtTurningTheNormalInward) {
  const ErrorCounts errors = errors_of([](workload::Answer& a) {
    for (double& x : a.normal) x = -x;
  });
  EXPECT_EQ(counts(errors), Counts{.wrong_normal = touching});
  EXPECT_NEAR(errors.max_normal_angle_deg, 180, 1e-6);
}

TEST_F(LyingDetector, IsCaughtStretchingTheNormal) {
  EXPECT_EQ(counts(errors_of([](workload::Answer& a) {
              for (double& x : a.normal) x *= 1.001;
            })),
            Counts{.wrong_normal = touching});
}

TEST_F(LyingDetector, IsCaughtLiftingThePointOffTheMesh) {
  const ErrorCounts errors = errors_of([](workload::Answer& a) {
    for (std::size_t k = 0; k < 3; ++k) a.point[k] += 1e-9 * a.normal[k];
  });
  EXPECT_EQ(counts(errors), Counts{.wrong_point = touching});
  EXPECT_NEAR(errors.max_point_error, 1e-9, 1e-13);
}

TEST_F(LyingDetector, IsCaughtGivingAPointThatIsNotTheNearest) {
  EXPECT_EQ(counts(errors_of([&](workload::Answer& a) {
              const Vec3& corner = mesh.corner(a.triangle, 0);
              std::copy(corner.begin(), corner.end(), a.point);
            })),
            Counts{.wrong_point = touching});
}

TEST_F(LyingDetector, IsCaughtAnsweringWithWhatIsNoNumber) {
  for (const double bad : {nan, infinity, -infinity}) {
    const std::array<Lie, 3> lies = {[&](workload::Answer& a) { a.distance = bad; },
                                     [&](workload::Answer& a) { a.point[1] = bad; },
                                     [&](workload::Answer& a) { a.normal[2] = bad; }};
    for (const Lie& lie : lies) {
      const ErrorCounts errors = errors_of(lie);
      EXPECT_EQ(counts(errors), Counts{.malformed = touching});
      EXPECT_FALSE(meets_guarantee(errors, {Guarantee::approximate, infinity, infinity}));
    }
  }
  EXPECT_EQ(counts(errors_of([](workload::Answer& a) { a.distance = -1e-300; })),
            Counts{.malformed = touching});
}

TEST_F(LyingDetector, MayBeOffByWhatItDeclares) {
  const Accuracy millionth = {Guarantee::approximate, 0, 1e-6};
  const auto shift = [](double by) { return [by](workload::Answer& a) { a.distance += by; }; };
  EXPECT_EQ(counts(errors_of(shift(0.9e-6), true, millionth)), Counts{});
  EXPECT_EQ(counts(errors_of(shift(1.1e-6), true, millionth)), Counts{.beyond_bound = touching});
  const Accuracy relative = {Guarantee::approximate, 1e-5, 0};  // of differences of 0.05 to 0.3 here
  EXPECT_EQ(counts(errors_of(shift(0.4e-6), true, relative)), Counts{});
  EXPECT_EQ(counts(errors_of(shift(4e-6), true, relative)), Counts{.beyond_bound = touching});
}

TEST_F(LyingDetector, GainsNothingByDeclaringNothing) {
  for (const double unknown : {infinity, nan}) {
    const Accuracy accuracy = {Guarantee::approximate, 0, unknown};
    EXPECT_EQ(counts(errors_of([](workload::Answer&) {}, true, accuracy)), Counts{});
    EXPECT_EQ(counts(errors_of([](workload::Answer& a) { a = {}; }, true, accuracy)),
              Counts{.missed = touching});
    const double tolerance = physical_tolerance * mesh.diagonal();
    EXPECT_EQ(counts(errors_of([&](workload::Answer& a) { a.distance += 1.01 * tolerance; }, true, accuracy)),
              Counts{.beyond_bound = touching});
    EXPECT_EQ(
        counts(errors_of([](workload::Answer& a) { a.triangle = opposite(a.triangle); }, true, accuracy)),
        Counts{.wrong_triangle = touching});
  }
}

/// The worst of what rounds in double is no error of whoever declares nothing, and is told apart.
TEST_F(LyingDetector, IsNotChargedForRoundingThatItDeclaresNothingAbout) {
  const Accuracy nothing = {Guarantee::approximate, infinity, 0};
  const double tolerance = physical_tolerance * mesh.diagonal();
  const auto counted = [&](double shift, const Accuracy& accuracy) {
    const ErrorCounts errors = errors_of([&](workload::Answer& a) { a.distance += shift; }, true, accuracy);
    return std::array{errors.beyond_bound, errors.beyond_tolerance, errors.rounding};
  };
  using Expected = std::array<std::uint64_t, 3>;
  EXPECT_EQ(counted(1e-16, nothing), (Expected{0, 0, 0})) << "less than doubles must be off by";
  EXPECT_EQ(counted(1e-12, nothing), (Expected{0, 0, touching}));
  EXPECT_EQ(counted(0.99 * tolerance, nothing), (Expected{0, 0, touching}));
  EXPECT_EQ(counted(1.01 * tolerance, nothing), (Expected{touching, touching, 0}));
  // The same two counts of whoever declares something, and his own bound beside them.
  EXPECT_EQ(counted(1e-12, exact), (Expected{touching, 0, touching}));
  EXPECT_EQ(counted(1.01 * tolerance, {Guarantee::approximate, 0, 1e-3}), (Expected{0, touching, 0}));
  // A neighbour's triangle that is as near but for rounding is no wrong one, and one that is a hand away is.
  EXPECT_EQ(
      errors_of([](workload::Answer& a) { a.triangle = opposite(a.triangle); }, true, nothing).wrong_triangle,
      touching);
}

TEST_F(LyingDetector, HasItsFirstWrongAnswersNamed) {
  for (const std::size_t first : {0U, 17U, 250U}) {
    std::vector<workload::Answer> lies = answers;
    std::vector<std::size_t> expected;
    for (std::size_t i = first; i < lies.size(); ++i) {
      if (lies[i].found == 0) continue;
      lies[i].distance += 1e-9;
      if (expected.size() < 3) expected.push_back(i);
    }
    Charges charges;
    judge(oracle, truths, workload::Query::nearest, probes, radius, lies, exact, {}, &charges);
    std::vector<std::size_t> named;
    for (const Charge& one : charges.kept()) {
      named.push_back(one.step);
      EXPECT_EQ(counts(one.counts), Counts{.beyond_bound = 1});
    }
    EXPECT_EQ(named, expected);
  }
}

TEST_F(LyingDetector, IsNotChargedForATriangleItDoesNotName) {
  EXPECT_EQ(counts(errors_of([](workload::Answer& a) { a.triangle = no_triangle; })), Counts{});
}

TEST_F(LyingDetector, IsNotChargedForFieldsItDoesNotFillIn) {
  std::vector<workload::Answer> bare(answers.size());
  for (std::size_t i = 0; i < bare.size(); ++i) bare[i].found = answers[i].found;
  const ErrorCounts errors = judge(oracle, truths, workload::Query::nearest, probes, radius, bare, exact,
                                   {.triangle = false, .distance = false, .point = false, .normal = false});
  EXPECT_EQ(counts(errors), Counts{});
}

TEST_F(LyingDetector, IsJudgedByItsYesOrNoAloneWhenAskedForTouches) {
  std::vector<workload::Answer> lies(answers.size());
  for (std::size_t i = 0; i < lies.size(); ++i) lies[i] = {answers[i].found, 12345, nan, nan};
  EXPECT_EQ(counts(judge(oracle, truths, workload::Query::touches, probes, 0, lies, exact)), Counts{});
  for (workload::Answer& lie : lies) lie.found = lie.found == 0 ? 1 : 0;
  EXPECT_EQ(counts(judge(oracle, truths, workload::Query::touches, probes, 0, lies, exact)),
            (Counts{.missed = touching, .false_contacts = free}));
}

TEST_F(LyingDetector, IsJudgedAsFarAsItGot) {
  EXPECT_EQ(
      judge(oracle, truths, workload::Query::nearest, probes, radius, {answers.data(), 17}, exact).judged,
      17U);
}

TEST(Judge, MeasuresWhereSquaresUnderflowOrOverflow) {
  for (const int exponent : {-1060, -560, 560, 1000}) {
    const double unit = std::ldexp(1.0, exponent);
    const TriangleMesh mesh({{0, 0, 0}, {2 * unit, 0, 0}, {0, 2 * unit, unit}}, {{0, 1, 2}});
    const Oracle oracle(mesh);
    const BruteForce detector = BruteForce::build(mesh);
    BruteForce::Session session;
    const std::vector<Probe> probes = {{unit * Vec3(0.5, 0.5, 1), 0}, {unit * Vec3(-1, -1, 0.5), 0}};
    std::vector<workload::Answer> answers;
    for (const Probe& probe : probes)
      answers.push_back(workload::Answer::of(detector.nearest(probe, infinity, session).value()));
    const ErrorCounts errors = judge(oracle, oracle.solve(probes), workload::Query::nearest, probes, infinity,
                                     answers, detector.accuracy());
    EXPECT_EQ(counts(errors), Counts()) << "unit 2^" << exponent;
  }
}

TEST_F(LyingDetector, TouchesNothingWithAProbeThatIsNoNumber) {
  const std::vector<Probe> bad = {{Vec3(nan, 0, 0), radius}, {Vec3(0, infinity, 0), radius}};
  const std::vector<GroundTruth> none = oracle.solve(bad);
  const auto errors_of_two = [&](double reach, std::span<const workload::Answer> two) {
    return counts(judge(oracle, none, workload::Query::nearest, bad, reach, two, exact));
  };
  EXPECT_EQ(errors_of_two(infinity, std::vector<workload::Answer>(2)), Counts{});
  EXPECT_EQ(errors_of_two(1e300, {answers.data() + 1, 2}), Counts{.false_contacts = 2});
  // Infinitely far away is within infinite reach, or not: as you like.
  EXPECT_EQ(errors_of_two(infinity, {answers.data() + 1, 2}), Counts{.false_contacts = 1});
}

/// Probes over the plate z = 0 at exactly representable heights.
class Threshold : public testing::Test {
 protected:
  ErrorCounts errors_of(double height, double reach, bool found, const Accuracy& accuracy) const {
    const std::vector<Probe> probes = {{Vec3(1.25, 1.25, height), reach}};
    const workload::Answer contact = workload::Answer::of({Vec3(1.25, 1.25, 0), Vec3(0, 0, 1), height, 8});
    const std::vector<workload::Answer> answers = {found ? contact : workload::Answer{}};
    const ErrorCounts touches =
        judge(oracle, oracle.solve(probes), workload::Query::touches, probes, 0, answers, accuracy);
    const ErrorCounts nearest =
        judge(oracle, oracle.solve(probes), workload::Query::nearest, probes, reach, answers, accuracy);
    EXPECT_EQ(counts(touches), counts(nearest));
    return nearest;
  }

  TriangleMesh mesh = plate(3);
  Oracle oracle{mesh};
};

TEST_F(Threshold, IsDecidedToTheLastBit) {
  const Accuracy unknown = {Guarantee::exact, infinity, 0};
  EXPECT_EQ(counts(errors_of(0.5, 0.5, true, unknown)), Counts{});
  EXPECT_EQ(counts(errors_of(0.5, 0.5, false, unknown)), Counts{.missed = 1});
  EXPECT_EQ(counts(errors_of(0.5, std::nextafter(0.5, 0), false, unknown)), Counts{});
  EXPECT_EQ(counts(errors_of(0.5, std::nextafter(0.5, 0), true, unknown)), Counts{.false_contacts = 1});
}

TEST_F(Threshold, WithinTheDeclaredAccuracyIsUnresolvedAndNeverWrong) {
  const Accuracy thousandth = {Guarantee::exact, 0, 1e-3};
  EXPECT_EQ(counts(errors_of(0.5, 0.5009, false, thousandth)), Counts{.unresolved = 1});
  EXPECT_EQ(counts(errors_of(0.5, 0.4991, true, thousandth)), Counts{.unresolved = 1});
  EXPECT_EQ(counts(errors_of(0.5, 0.5011, false, thousandth)), Counts{.missed = 1});
  EXPECT_EQ(counts(errors_of(0.5, 0.4989, true, thousandth)), Counts{.false_contacts = 1});
  EXPECT_TRUE(meets_guarantee(errors_of(0.5, 0.5009, false, thousandth), thousandth));
}

TEST_F(Threshold, OfTheRoundingKindIsUnresolvedForAKernelInDouble) {
  EXPECT_EQ(counts(errors_of(0.5, std::nextafter(0.5, 0), true, exact)), Counts{.unresolved = 1});
  EXPECT_EQ(counts(errors_of(0.5, 0.5, false, exact)), Counts{.unresolved = 1});
  EXPECT_EQ(counts(errors_of(0.5, 0.5 - 1e-13, true, exact)), Counts{.false_contacts = 1});
}

TEST_F(Threshold, IsNotExcusedForOneThatDecidesExactly) {
  Accuracy certain = {Guarantee::exact, 0, 1e-3, true};
  EXPECT_EQ(counts(errors_of(0.5, std::nextafter(0.5, 0), true, certain)), Counts{.false_contacts = 1});
  EXPECT_EQ(counts(errors_of(0.5, 0.5, false, certain)), Counts{.missed = 1});
  EXPECT_EQ(counts(errors_of(0.5, 0.5, true, certain)), Counts{});
}

TEST_F(Threshold, AtInfinityIsNeverUnresolved) {
  EXPECT_EQ(counts(errors_of(0.5, infinity, false, {Guarantee::exact, 0, 1e3})), Counts{.missed = 1});
}

TEST(Judge, AnIdStandsForEveryTriangleOfItsPolygon) {
  // Two squares of two triangles each, ids 5 and 9.
  const TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}},
                          {{0, 1, 3}, {1, 4, 3}, {1, 2, 4}, {2, 5, 4}}, {5, 5, 9, 9});
  const Oracle oracle(mesh);
  const std::vector<Probe> probes = {{{0.9, 0.9, 0.5}, 1}};
  const auto charged = [&](TriangleId id) {
    const std::vector<workload::Answer> answers = {
        workload::Answer::of({Vec3(0.9, 0.9, 0), Vec3(0, 0, 1), 0.5, id})};
    return judge(oracle, oracle.solve(probes), workload::Query::nearest, probes, 1, answers, exact)
        .wrong_triangle;
  };
  EXPECT_EQ(charged(5), 0U);
  for (const TriangleId wrong : {0U, 1U, 7U, 9U, 10U}) EXPECT_EQ(charged(wrong), 1U) << wrong;
}

TEST(Judge, AnyOfTheTiedTrianglesWillDoAndItsOwnDirectionIsTheRightOne) {
  // Midway between two parallel triangles.
  const TriangleMesh mesh = stress::mesh_of(
      {{Vec3(0, 0, 1), Vec3(4, 0, 1), Vec3(0, 4, 1)}, {Vec3(0, 0, -1), Vec3(4, 0, -1), Vec3(0, 4, -1)}});
  const Oracle oracle(mesh);
  const std::vector<Probe> probes = {{{1, 1, 0}, 1}};
  const auto errors_of = [&](TriangleId id, double side) {
    const std::vector<workload::Answer> answers = {
        workload::Answer::of({Vec3(1, 1, side), Vec3(0, 0, -side), 1, id})};
    return counts(judge(oracle, oracle.solve(probes), workload::Query::nearest, probes, 1, answers, exact));
  };
  EXPECT_EQ(errors_of(0, 1), Counts{});
  EXPECT_EQ(errors_of(1, -1), Counts{});
  EXPECT_EQ(errors_of(no_triangle, 1), Counts{});
  EXPECT_EQ(errors_of(no_triangle, -1), Counts{});
  EXPECT_EQ(errors_of(0, -1), (Counts{.wrong_point = 1, .wrong_normal = 1}));
}

TEST(Judge, OnTheMeshTheNormalIsNotJudgedButForItsLength) {
  const TriangleMesh mesh = plate(2);
  const Oracle oracle(mesh);
  const std::vector<Probe> probes = {{{0.25, 0.25, 0}, 1}};
  const auto errors_of = [&](const Vec3& normal) {
    const std::vector<workload::Answer> answers = {workload::Answer::of({probes[0].center, normal, 0, 0})};
    return counts(judge(oracle, oracle.solve(probes), workload::Query::nearest, probes, 1, answers, exact));
  };
  EXPECT_EQ(errors_of({0, 0, 1}), Counts{});
  EXPECT_EQ(errors_of({0, 0, -1}), Counts{});
  EXPECT_EQ(errors_of({0, 0, 0}), Counts{.wrong_normal = 1});
}

TEST(Judge, FindsNoFaultWithBruteForceOnHardMeshes) {
  stress::CornerCases cases(32);
  for (const auto& [name, mesh] : corner_case_meshes()) {
    if (name == "huge plate") continue;  // its squares overflow in the kernel
    const Oracle oracle(mesh);
    const BruteForce detector = BruteForce::build(mesh);
    BruteForce::Session session;
    std::vector<Probe> probes;
    std::vector<workload::Answer> answers;
    for (const Vec3& point : corner_case_points(mesh, cases, 200)) {
      probes.push_back({point, 0});
      const auto contact = detector.nearest(probes.back(), infinity, session);
      answers.push_back(contact ? workload::Answer::of(*contact) : workload::Answer{});
    }
    const ErrorCounts errors =
        judge(oracle, oracle.solve(probes), workload::Query::nearest, probes, infinity, answers, exact);
    EXPECT_EQ(counts(errors), Counts{}) << name;
  }
}

/// Balls thrown at a ball from all sides; the truth about the fraction is brute force's.
class LyingSweep : public testing::Test {
 protected:
  using Lie = std::function<void(workload::Answer&)>;

  LyingSweep() {
    stress::CornerCases cases(33);
    const BruteForce detector = BruteForce::build(mesh);
    BruteForce::Session session;
    for (int i = 0; i < 120; ++i) {
      const Vec3 from = 2 * cases.vector().normalized();
      const Vec3 aim = (i % 3 == 0 ? 4.0 : 0.5) * cases.vector().normalized();
      Sweep sweep{from, aim, radius};
      if (i % 3 == 0) sweep.to = from + 0.4 * from.unitOrthogonal();  // tangential: no hit
      sweeps.push_back(sweep);
      const auto impact = detector.first_hit(sweep, session);
      answers.push_back(impact ? workload::Answer::of(impact->contact, impact->fraction)
                               : workload::Answer{});
    }
    truths = oracle.solve(sweeps);
  }

  ErrorCounts errors_of(const Lie& lie, bool found = true, const Accuracy& accuracy = exact) const {
    std::vector<workload::Answer> lies = answers;
    for (workload::Answer& answer : lies)
      if ((answer.found != 0) == found) lie(answer);
    return judge(oracle, truths, sweeps, lies, accuracy);
  }

  TriangleMesh mesh = octasphere(8);
  Oracle oracle{mesh};
  std::vector<Sweep> sweeps;
  std::vector<SweepGroundTruth> truths;
  std::vector<workload::Answer> answers;
  static constexpr std::uint64_t hits = 80, misses = 40;
};

TEST_F(LyingSweep, IsNotChargedWhileItTellsTheTruth) {
  EXPECT_EQ(counts(errors_of([](workload::Answer&) {})), Counts{});
}

TEST_F(LyingSweep, IsCaughtMissing) {
  EXPECT_EQ(counts(errors_of([](workload::Answer& a) { a = {}; })), Counts{.missed = hits});
}

TEST_F(LyingSweep, IsCaughtInventing) {
  EXPECT_EQ(counts(errors_of(
                [](workload::Answer& a) {
                  a.found = 1;
                  a.fraction = 0.5;
                },
                false)),
            Counts{.false_contacts = misses});
}

TEST_F(LyingSweep, IsCaughtReportingTooEarly) {
  const ErrorCounts errors = errors_of([](workload::Answer& a) { a.fraction -= 1e-9; });
  EXPECT_EQ(counts(errors), Counts{.false_contacts = hits});
  EXPECT_LT(errors.max_distance_error, 3e-9);  // 1e-9 of a way of at most 2.5
  EXPECT_GT(errors.max_distance_error, 1e-9);
}

TEST_F(LyingSweep, IsCaughtReportingTooLate) {
  EXPECT_EQ(counts(errors_of([](workload::Answer& a) { a.fraction += 1e-9; })), Counts{.missed = hits});
}

TEST_F(LyingSweep, IsCaughtReportingTheSecondContactInsteadOfTheFirst) {
  // Right through the ball, told about the far side; once with a radius and once as a bare point, which comes
  // no nearer to the near side than at the far one.
  const BruteForce detector = BruteForce::build(mesh);
  BruteForce::Session session;
  for (const double size : {0.0, radius}) {
    const std::vector<Sweep> through = {{{2, 0.1, 0.2}, {-2, 0.1, 0.2}, size}};
    const auto from_behind = detector.first_hit({through[0].to, through[0].from, size}, session);
    ASSERT_TRUE(from_behind);
    const std::vector<workload::Answer> late = {
        workload::Answer::of(from_behind->contact, 1 - from_behind->fraction)};
    EXPECT_EQ(counts(judge(oracle, oracle.solve(through), through, late, exact)), Counts{.missed = 1});
  }
}

TEST_F(LyingSweep, OfABarePointIsCaughtMissing) {
  const std::vector<Sweep> through = {{{2, 0.1, 0.2}, {-2, 0.1, 0.2}, 0}};
  const std::vector<workload::Answer> none(1);
  EXPECT_EQ(counts(judge(oracle, oracle.solve(through), through, none, exact)), Counts{.missed = 1});
}

TEST_F(LyingSweep, IsCaughtNamingAnotherTriangle) {
  EXPECT_EQ(counts(errors_of([](workload::Answer& a) { a.triangle = opposite(a.triangle); })),
            Counts{.wrong_triangle = hits});
}

TEST_F(LyingSweep, IsCaughtShiftingTheDistance) {
  EXPECT_EQ(counts(errors_of([](workload::Answer& a) { a.distance += 1e-9; })), Counts{.beyond_bound = hits});
}

TEST_F(LyingSweep, IsCaughtWithAFractionThatIsNone) {
  for (const double bad : {nan, infinity, -1e-300, std::nextafter(1, 2)})
    EXPECT_EQ(counts(errors_of([&](workload::Answer& a) { a.fraction = bad; })), Counts{.malformed = hits});
}

TEST_F(LyingSweep, OfASweepThatStartsTouchingIsCaughtReportingLater) {
  const TriangleMesh flat = plate(3);
  const Oracle truth(flat);
  const std::vector<Sweep> start = {{{1.25, 1.25, 0.25}, {1.25, 1.25, -1}, 0.5}};
  const auto errors_at = [&](double fraction, double distance) {
    const workload::Answer answer =
        workload::Answer::of({Vec3(1.25, 1.25, 0), Vec3(0, 0, 1), distance, 8}, fraction);
    return counts(judge(truth, truth.solve(start), start, std::vector<workload::Answer>{answer}, exact));
  };
  EXPECT_EQ(errors_at(0, 0.25), Counts{});
  EXPECT_EQ(errors_at(0.1, 0.125), Counts{.missed = 1});
}

TEST_F(LyingSweep, WithinTheDeclaredAccuracyIsUnresolved) {
  const TriangleMesh flat = plate(3);
  const Oracle truth(flat);
  const std::vector<Sweep> almost = {{{1.25, 1.25, 1}, {1.25, 1.25, 0.5}, 0.4999}};
  const workload::Answer end = workload::Answer::of({Vec3(1.25, 1.25, 0), Vec3(0, 0, 1), 0.5, 8}, 1);
  const auto errors_with = [&](double absolute) {
    return counts(judge(truth, truth.solve(almost), almost, std::vector<workload::Answer>{end},
                        {Guarantee::approximate, 0, absolute}));
  };
  EXPECT_EQ(errors_with(1e-3), Counts{.unresolved = 1});
  EXPECT_EQ(errors_with(1e-5), Counts{.false_contacts = 1});
  EXPECT_EQ(errors_with(infinity), Counts{.false_contacts = 1});
}

/// Above a plate, by one ulp wherever that matters.
TEST_F(LyingSweep, WhoDecidesExactlyIsExcusedNothing) {
  const TriangleMesh flat = plate(3);
  const Oracle truth(flat);
  const auto told = [&](double from, double to, double size, std::optional<double> fraction) {
    const std::vector<Sweep> sweep = {{{1.25, 1.25, from}, {1.25, 1.25, to}, size}};
    const double height = from + fraction.value_or(0) * (to - from);
    const workload::Answer hit =
        workload::Answer::of({Vec3(1.25, 1.25, 0), Vec3(0, 0, 1), height, 8}, fraction.value_or(0));
    return counts(judge(truth, truth.solve(sweep), sweep,
                        std::vector<workload::Answer>{fraction ? hit : workload::Answer{}},
                        touchmark::certified));
  };
  const double above = std::nextafter(0.5, 1), below = std::nextafter(0.5, 0);
  EXPECT_EQ(told(0.5, 0.25, 0.5, 0), Counts{});
  EXPECT_EQ(told(0.5, 0.25, 0.5, 5e-324), Counts{.missed = 1});
  EXPECT_EQ(told(above, 0.25, 0.5, 5e-324), Counts{});
  EXPECT_EQ(told(above, 0.25, 0.5, 0), Counts{.false_contacts = 1});
  EXPECT_EQ(told(1, 0, 0.5, 0.5), Counts{});
  EXPECT_EQ(told(1, 0, 0.5, above), Counts{.missed = 1});
  EXPECT_EQ(told(1, 0, 0.5, 0.5 - 0x1p-50), Counts{});
  EXPECT_EQ(told(1, 0, 0.5, 0.5 - 0x1p-49), Counts{.false_contacts = 1});
  EXPECT_EQ(told(1, 0.5, 0.5, 1), Counts{});
  EXPECT_EQ(told(1, 0.5, 0.5, std::nullopt), Counts{.missed = 1});
  EXPECT_EQ(told(1, 0.5, below, 1), Counts{.false_contacts = 1});
  EXPECT_EQ(told(1, 0.5, below, std::nullopt), Counts{});
}

TEST(ErrorCounts, AddsCountsAndKeepsTheLargestErrors) {
  ErrorCounts a, b;
  a.missed = 1, a.max_distance_error = 2, a.max_normal_angle_deg = 1;
  b.missed = 2, b.max_distance_error = 1, b.max_normal_angle_deg = 3;
  a += b;
  EXPECT_EQ(a.missed, 3U);
  EXPECT_EQ(a.max_distance_error, 2);
  EXPECT_EQ(a.max_normal_angle_deg, 3);
}

}  // namespace
}  // namespace touchmark::bench::oracle
