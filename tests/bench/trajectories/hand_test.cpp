#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "bench/trajectories/trajectories.h"
#include "core/float_limits.h"
#include "tests/bench/trajectories/distances.h"
#include "tests/bench/trajectories/hand_measures.h"
#include "tests/bench/trajectories/simple_meshes.h"

namespace touchmark::bench::trajectories {
namespace {

using hands::Way;

std::vector<Vec3> made(const std::string& name, const TriangleMesh& mesh, std::size_t steps,
                       double radius_of_diagonal = 0.005, std::uint64_t seed = 1,
                       std::optional<support::LengthUnit> unit = std::nullopt) {
  return make_trajectory(name, mesh, {steps, seed, radius_of_diagonal * mesh.diagonal(), {}, unit}).positions;
}

/// A hand on a plate of a hundred metres, whose borders it never sees. Millimetres.
Way on_a_plate(const std::string& words, std::size_t steps, std::uint64_t seed = 1) {
  const TriangleMesh mesh = plate();
  Way way = made("hand:size=100m" + words, mesh, steps, 0.005, seed);
  for (Vec3& position : way) position *= 1e5 / mesh.diagonal();
  return way;
}

/// A recording of ../shared/motions, turned so that z is along the paper's normal. Millimetres.
Way recorded(const std::filesystem::path& file) {
  Way way = make_trajectory(file.string(), plate()).positions;
  Vec3 mean = Vec3::Zero();
  for (const Vec3& position : way) mean += position / static_cast<double>(way.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Vec3& position : way) covariance += (position - mean) * (position - mean).transpose();
  const Eigen::Matrix3d axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors();
  for (Vec3& position : way) position = 1e3 * (axes.transpose() * (position - mean)).reverse();
  return way;
}

struct Range {
  double low, high;
};

void expect_within(const Range& range, double value, double rounding = 0) {
  EXPECT_GE(value, range.low - rounding);
  EXPECT_LE(value, range.high + rounding);
}

// What three recordings of a hand that guides a pen over paper say, 29,641 ticks in all: millimetres a tick,
// parts of the velocity's power, degrees in 20 ms, micrometres.
const std::vector<std::pair<double, double>> recorded_speeds = {
    {0.05, 0.0017}, {0.25, 0.0039}, {0.5, 0.0083}, {0.75, 0.025}, {0.9, 0.079}, {0.95, 0.125}, {0.99, 0.224}};
constexpr Range recorded_pauses{0.31, 0.40}, recorded_longest_pause{20, 44};
constexpr Range power_of_strokes{0.34, 0.61}, power_from_2_to_8_hz{0.01, 0.10},
    power_of_the_sensor{0.11, 0.28};
constexpr double max_power_of_tremor = 0.13;
constexpr Range turning_at_50{2, 3}, turning_at_90{5, 10}, turning_at_99{9, 24};
constexpr Range recorded_trembling{6, 13};

TEST(Hand, MovesAtTheSpeedsThatWereRecorded) {
  const std::vector<double> speeds = hands::speeds(on_a_plate("", 200'000));
  for (const auto& [share, speed] : recorded_speeds)
    EXPECT_NEAR(hands::quantile(speeds, share), speed, 0.1 * speed) << share;
}

TEST(Hand, HasNearlyThoseSpeedsInEachRunOfTwentySeconds) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const std::vector<double> speeds = hands::speeds(on_a_plate("", 20'000, seed));
    for (const auto& [share, speed] : recorded_speeds)
      EXPECT_NEAR(hands::quantile(speeds, share), speed, 0.35 * speed) << share << ", " << seed;
  }
}

TEST(Hand, PausesInRunsAndInSingleTicks) {
  const Way way = on_a_plate("", 200'000);
  const std::vector<double> speeds = hands::speeds(way);
  const auto paused = std::count_if(speeds.begin(), speeds.end(), [](double speed) { return speed < 0.005; });
  expect_within(recorded_pauses, static_cast<double>(paused) / static_cast<double>(speeds.size()));
  // A recording has about 10,000 ticks.
  std::vector<double> longest, single;
  for (auto piece = way.begin(); piece != way.end(); piece += 10'000) {
    const std::vector<std::size_t> runs = hands::pauses({piece, piece + 10'000});
    longest.push_back(static_cast<double>(*std::max_element(runs.begin(), runs.end())));
    single.push_back(static_cast<double>(std::count(runs.begin(), runs.end(), 1u)) /
                     static_cast<double>(runs.size()));
  }
  expect_within(recorded_longest_pause, hands::quantile(longest, 0.5));
  expect_within({0.2, 0.5}, hands::quantile(single, 0.5));
}

TEST(Hand, HasThePowerThatWasRecordedInEachBand) {
  const Way way = on_a_plate("", 40'000);
  const hands::Spectrum along(way, {0, 1}), across(way, {2});
  expect_within(power_of_strokes, along.share(0.5, 2));
  expect_within(power_from_2_to_8_hz, along.share(2, 8));
  expect_within(power_of_the_sensor, along.share(200, 501));
  expect_within({0.02, max_power_of_tremor}, across.share(8, 20));
  expect_within(recorded_trembling, 1e3 * hands::trembling(way));
}

TEST(Hand, TurnsAsRecorded) {
  const std::vector<double> turning = hands::turning(on_a_plate("", 200'000));
  expect_within(turning_at_50, hands::quantile(turning, 0.5));
  expect_within(turning_at_90, hands::quantile(turning, 0.9));
  expect_within(turning_at_99, hands::quantile(turning, 0.99));
}

// The measures say of the recordings themselves what the tests above demand of the generated motion.
TEST(Hand, IsMeasuredAsTheRecordingsAre) {
  std::vector<std::filesystem::path> files;
  for (const char* number : {"1", "2", "5"})
    files.push_back(std::filesystem::path(TOUCHMARK_SHARED_MOTIONS) /
                    (std::string("panda-symbol17-rec") + number + ".csv"));
  for (const std::filesystem::path& file : files)
    if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  std::vector<double> speeds;
  for (const std::filesystem::path& file : files) {
    const Way way = recorded(file);
    const std::vector<double> own = hands::speeds(way);
    speeds.insert(speeds.end(), own.begin(), own.end());
    const auto paused = std::count_if(own.begin(), own.end(), [](double speed) { return speed < 0.005; });
    expect_within(recorded_pauses, static_cast<double>(paused) / static_cast<double>(own.size()), 0.005);
    const std::vector<std::size_t> runs = hands::pauses(way);
    expect_within(recorded_longest_pause, static_cast<double>(*std::max_element(runs.begin(), runs.end())));
    const hands::Spectrum along(way, {0, 1}), across(way, {2});
    expect_within(power_of_strokes, along.share(0.5, 2), 0.01);
    expect_within(power_from_2_to_8_hz, along.share(2, 8), 0.005);
    expect_within(power_of_the_sensor, along.share(200, 501), 0.005);
    expect_within({0.02, max_power_of_tremor}, across.share(8, 20), 0.03);
    expect_within(recorded_trembling, 1e3 * hands::trembling(way), 0.5);
    const std::vector<double> turning = hands::turning(way);
    expect_within(turning_at_50, hands::quantile(turning, 0.5), 0.5);
    expect_within(turning_at_90, hands::quantile(turning, 0.9), 0.5);
    expect_within(turning_at_99, hands::quantile(turning, 0.99), 0.5);
  }
  for (const auto& [share, speed] : recorded_speeds)
    EXPECT_NEAR(hands::quantile(speeds, share), speed, 0.02 * speed) << share;
}

TEST(Hand, StaysInContactWhateverTheRadius) {
  for (const TriangleMesh& mesh : {plate(), cube()}) {
    for (const double radius : {0.0, 1e-6, 1e-4, 0.001, 0.005, 0.05}) {
      for (const char* name :
           {"hand", "hand:contact,speed=5", "hand:encoder=50um", "hand:tremor=20,noise=20"})
        EXPECT_LE(most(distances(made(name, mesh, 5000, radius), mesh)), radius * mesh.diagonal() + 1e-14)
            << name << ' ' << radius;
    }
  }
}

TEST(Hand, ScalesTremorAndNoiseToARadiusBelowFourTimesTheirSize) {
  // 8 um on 20 cm, where tremor and noise are 15 um.
  const TriangleMesh mesh = plate();
  const double radius = 4e-5;
  std::vector<double> heights = distances(made("hand", mesh, 20'000, radius), mesh);
  double mean = 0, squares = 0;
  for (const double height : heights) mean += height / static_cast<double>(heights.size());
  for (const double height : heights) squares += std::pow(height - mean, 2);
  const double spread = std::sqrt(squares / static_cast<double>(heights.size())) / (radius * mesh.diagonal());
  EXPECT_GT(spread, 0.2);
  EXPECT_LT(spread, 0.3);
}

TEST(Hand, InFreeAirIsNearAndFarAndDoesNotTouch) {
  const TriangleMesh mesh = cube();
  const std::vector<double> heights = distances(made("hand:free", mesh, 40'000), mesh);
  EXPECT_GT(least(heights), 0.005 * mesh.diagonal());
  EXPECT_LT(least(heights), 0.02 * mesh.diagonal());
  EXPECT_GT(most(heights), 0.08 * mesh.diagonal());
  EXPECT_LT(most(heights), 0.2 * mesh.diagonal());
}

TEST(Hand, TapsAgainAndAgain) {
  for (const TriangleMesh& mesh : {plate(), cube()}) {
    const double radius = 0.005 * mesh.diagonal();
    int taps = 0;
    bool touching = false;
    for (const double height : distances(made("hand:tap", mesh, 40'000), mesh)) {
      if (height <= radius && !touching) ++taps;
      touching = height <= radius;
    }
    EXPECT_GE(taps, 8);  // two strokes and their rests take about two seconds
  }
}

TEST(Hand, LosesTheContactBetweenTapsOfAnyRadius) {
  const TriangleMesh mesh = plate();
  const double radius = 0.05;  // of the diagonal: 1 cm, farther than most strokes go
  std::size_t lifted = 0;
  const std::vector<double> heights = distances(made("hand:tap,speed=0.05", mesh, 400'000, radius), mesh);
  for (std::size_t i = 1; i < heights.size(); ++i)
    lifted += heights[i - 1] <= radius * mesh.diagonal() && heights[i] > radius * mesh.diagonal() ? 1 : 0;
  EXPECT_GE(lifted, 15u);
}

TEST(Hand, TakesItsStrokesInAnyOrder) {
  double slowest = infinity, fastest = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const double first = most(hands::speeds(on_a_plate(",noise=0,tremor=0", 500, seed)));
    slowest = std::min(slowest, first);
    fastest = std::max(fastest, first);
  }
  EXPECT_GT(fastest, 4 * slowest);
}

TEST(Hand, LeavesOutWhatAFactorOfZeroSays) {
  const std::vector<double> clean = hands::speeds(on_a_plate(",tremor=0,noise=0", 40'000));
  for (std::size_t i = 1; i < clean.size(); ++i)  // minimum jerk: no step differs much from the one before
    ASSERT_NEAR(clean[i], clean[i - 1], 0.004);
  EXPECT_GT(std::count_if(clean.begin(), clean.end(), [](double speed) { return speed < 1e-9; }), 8000);
  EXPECT_LT(most(hands::speeds(on_a_plate(",speed=0", 40'000))), 0.02);
}

TEST(Hand, IsFasterTremblesMoreAndIsNoisierByItsFactors) {
  const auto fast = [](const Way& way) { return hands::quantile(hands::speeds(way), 0.95); };
  EXPECT_NEAR(fast(on_a_plate(",speed=3", 40'000)), 3 * fast(on_a_plate("", 40'000)), 0.02);
  EXPECT_NEAR(hands::trembling(on_a_plate(",noise=0,tremor=3", 40'000)),
              3 * hands::trembling(on_a_plate(",noise=0", 40'000)), 0.001);
  const auto slow = [](const Way& way) { return hands::quantile(hands::speeds(way), 0.05); };
  EXPECT_NEAR(slow(on_a_plate(",speed=0,tremor=0,noise=3", 40'000)),
              3 * slow(on_a_plate(",speed=0,tremor=0", 40'000)), 1e-4);
}

TEST(Hand, IsReadByAnEncoder) {
  // The ground's frame is not the mesh's, so lengths of steps tell.
  std::size_t still = 0;
  for (const double speed : hands::speeds(on_a_plate(",encoder=4.5um", 20'000))) {
    const double steps = std::pow(speed / 0.0045, 2);
    EXPECT_NEAR(steps, std::round(steps), 1e-3 * std::max(1., steps));
    still += steps < 0.5 ? 1 : 0;
  }
  EXPECT_GT(still, 1000u);
}

TEST(Hand, TakesItsSizeFromTheUnitOrFromItsOwnWord) {
  const TriangleMesh mesh = plate();
  const auto pace = [&](const std::string& name, std::optional<support::LengthUnit> unit) {
    return hands::quantile(hands::speeds(made(name, mesh, 20'000, 0.005, 1, unit)), 0.95);
  };
  const double usual = pace("hand", std::nullopt);
  EXPECT_NEAR(usual, 125e-6 / 0.2 * mesh.diagonal(), 0.3 * usual);
  EXPECT_NEAR(pace("hand:size=10cm", std::nullopt), 2 * usual, 0.1 * usual);
  EXPECT_NEAR(pace("hand", support::LengthUnit{"", 0.1 / mesh.diagonal()}), 2 * usual, 0.1 * usual);
  EXPECT_NEAR(pace("hand:size=200mm", support::LengthUnit{"mm", 0.001}), usual, 0.1 * usual);
}

TEST(Hand, BeginsAlikeHoweverLongItIs) {
  const std::vector<Vec3> whole = made("hand", cube(), 3000), part = made("hand", cube(), 1000);
  EXPECT_TRUE(std::equal(part.begin(), part.end(), whole.begin()));
}

TEST(Hand, RefusesUnknownWordsInOneLine) {
  const auto complaint = [](const std::string& name) -> std::string {
    try {
      made(name, plate(), 10);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(complaint("hand:flat"),
            "trajectory 'hand:flat': \"flat\" is unknown, out of range or one too many; write "
            "hand[:contact|free|tap][,speed=F,tremor=F,noise=F,encoder=LENGTH,size=LENGTH], F from 0 to 100, "
            "LENGTH as 4.5um or 20cm");
  for (const char* name :
       {"hand:", "hand:contact,", "hand:speed", "hand:speed=", "hand:speed=-1", "hand:speed=101",
        "hand:noise=inf", "hand:tremor=1%", "hand:size=0m", "hand:encoder=-1um", "hand:encoder=infm",
        "hand:speed=1,speed=1", "hand:free,tap", "hand:size=20", "hand:speed=fast", "hand:pace=1"})
    EXPECT_NE(complaint(name), "") << name;
  for (const char* name :
       {"hand:contact", "hand:encoder=0um", "hand:free,speed=100,size=1in", "hand:speed=0"})
    EXPECT_EQ(complaint(name), "") << name;
}

}  // namespace
}  // namespace touchmark::bench::trajectories
