#include "bench/trajectories/drape.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "bench/meshes/generated_meshes.h"
#include "bench/trajectories/trajectories.h"
#include "core/aabb_tree/aabb_tree.h"
#include "core/float_limits.h"
#include "tests/bench/trajectories/hand_measures.h"
#include "tests/bench/trajectories/simple_meshes.h"

namespace touchmark::bench::trajectories {
namespace {

using hands::Way;

constexpr double radius_of_diagonal = 0.005;

/// A path over paper, in metres: two unequal sweeps, with a hand's height that is slow where it is low.
Way scribble(std::size_t rows) {
  Way way;
  for (std::size_t i = 0; i < rows; ++i) {
    const double t = static_cast<double>(i) / 1000;
    const double lift = std::sin(2 * t) > 0 ? 3 * std::sin(2 * t) : std::sin(2 * t);
    way.emplace_back(0.02 * std::sin(1.1 * t) + 0.008 * std::cos(2.2 * t + lift / 5),
                     0.01 * std::sin(1.7 * t) + 0.003 * std::sin(3.4 * t + 1), 1e-4 * lift);
  }
  return way;
}

Eigen::Matrix3d some_rotation() {
  return Eigen::Quaterniond(0.3, -0.5, 0.4, 0.7).normalized().toRotationMatrix();
}

class DrapeTest : public testing::Test {
 protected:
  std::string written(const Way& way, const std::string& columns = "", double radius = 0) {
    const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / (name() + ".csv");
    std::ofstream file(path);
    file << "x,y,z" << columns << '\n';
    for (const Vec3& p : way)
      file << fmt::format("{},{},{}", p.x(), p.y(), p.z()) << (radius > 0 ? fmt::format(",{}", radius) : "")
           << '\n';
    return path.string();
  }
  static std::string name() {
    return std::string("drape_") + testing::UnitTest::GetInstance()->current_test_info()->name();
  }
  static std::vector<Vec3> draped(const std::string& file, const TriangleMesh& mesh,
                                  Drape how = Drape::contact, std::uint64_t seed = 1,
                                  MotionOptions motion = {},
                                  std::optional<support::LengthUnit> unit = std::nullopt) {
    motion.drape = how;
    return make_trajectory(file, mesh, {0, seed, radius_of_diagonal * mesh.diagonal(), motion, unit})
        .positions;
  }
  void TearDown() override {
    std::filesystem::remove(std::filesystem::path(testing::TempDir()) / (name() + ".csv"));
  }
};

std::vector<Contact> contacts(const std::vector<Vec3>& way, const TriangleMesh& mesh) {
  const AabbTree detector = AabbTree::build(mesh);
  AabbTree::Session session;
  std::vector<Contact> all;
  for (const Vec3& p : way) all.push_back(*detector.nearest({p, 0}, infinity, session));
  return all;
}

double flat_step(const Way& way, std::size_t i) { return (way[i] - way[i - 1]).head<2>().norm(); }

TEST_F(DrapeTest, KeepsTheStepsOnAPlane) {
  const TriangleMesh mesh = plate();
  const Way way = scribble(20'000);
  const double metre = mesh.diagonal() / 0.2;
  const std::vector<Vec3> laid = draped(written(way), mesh);
  ASSERT_EQ(laid.size(), way.size());
  std::size_t over_the_border = 0;
  for (std::size_t i = 1; i < way.size(); ++i) {
    const bool inside = (laid[i].array().head<2>() > 0.01).all() && (laid[i].array().head<2>() < 0.99).all();
    over_the_border += inside ? 0 : 1;
    // The axes of the recording are not those of the paper to the last bit.
    const double wanted = inside ? metre * flat_step(way, i) : (laid[i] - laid[i - 1]).head<2>().norm();
    ASSERT_NEAR((laid[i] - laid[i - 1]).head<2>().norm(), wanted, 1e-6) << i;
  }
  EXPECT_LT(over_the_border, way.size() / 2);
}

// A step of the centre at height h is one of the point below it times R / (R + h). Here h is at most the
// radius, 0.87 % of R, and the faces of the sphere lie 0.1 % inside it.
TEST_F(DrapeTest, KeepsTheStepsOnASphereWithinOnePercent) {
  const TriangleMesh mesh = meshes::icosphere(5);
  const Way way = scribble(20'000);
  const double metre = mesh.diagonal() / 0.2;
  const std::vector<Vec3> laid = draped(written(way), mesh);
  double length = 0, wanted = 0;
  std::size_t far_off = 0;
  for (std::size_t i = 1; i < way.size(); ++i) {
    const double step = (laid[i].normalized() - laid[i - 1].normalized()).norm();
    length += step;
    wanted += metre * flat_step(way, i);
    far_off += std::abs(step - metre * flat_step(way, i)) > 0.02 * metre * flat_step(way, i) + 1e-5 ? 1 : 0;
  }
  EXPECT_NEAR(length, wanted, 0.01 * wanted);
  EXPECT_LT(far_off, way.size() / 50);
}

TEST_F(DrapeTest, IsTheSameForARecordingTurnedAndMoved) {
  for (const TriangleMesh& mesh : {plate(), meshes::icosphere(4)}) {
    for (const Drape how : {Drape::contact, Drape::free}) {
      const std::vector<Vec3> laid = draped(written(scribble(5000)), mesh, how);
      Way turned = scribble(5000);
      for (Vec3& position : turned) position = some_rotation() * position + Vec3(0.4, -2, 0.1);
      const std::vector<Vec3> same = draped(written(turned), mesh, how);
      for (std::size_t i = 0; i < laid.size(); ++i) ASSERT_LT((laid[i] - same[i]).norm(), 1e-7) << i;
    }
  }
}

TEST_F(DrapeTest, ClampsHeightsBetweenHalfTheRadiusInsideAndTheRadius) {
  const TriangleMesh mesh = meshes::icosphere(5);
  const double radius = radius_of_diagonal * mesh.diagonal();
  Way way = scribble(20'000);
  for (Vec3& position : way) position.z() *= 30;  // 9 mm up and 3 mm down, where the radius is 1 mm
  double inside = 0, outside = 0;
  std::size_t deep = 0, high = 0;
  const std::vector<Vec3> laid = draped(written(way), mesh);
  const std::vector<Contact> found = contacts(laid, mesh);
  for (std::size_t i = 0; i < laid.size(); ++i) {
    const double side = (laid[i] - found[i].point).dot(laid[i]) > 0 ? 1 : -1;
    inside = std::max(inside, -side * found[i].distance);
    outside = std::max(outside, side * found[i].distance);
    deep += side * found[i].distance < -0.49 * radius ? 1 : 0;
    high += side * found[i].distance > 0.99 * radius ? 1 : 0;
  }
  EXPECT_LE(outside, radius);
  EXPECT_LE(inside, 0.5 * radius * 1.0001);
  EXPECT_GT(deep, 3000u);
  EXPECT_GT(high, 3000u);
}

// Whether it is the side of few and high points, by which the third central moment would go, or the other.
TEST_F(DrapeTest, TurnsTheSlowerSideInward) {
  const TriangleMesh mesh = meshes::icosphere(5);
  for (const bool few_are_slow : {true, false}) {
    Way way;
    Vec3 at = Vec3::Zero();
    for (int i = 0; i < 8000; ++i) {
      const bool is_few = i / 500 % 4 == 3;
      at += (is_few == few_are_slow ? 1e-5 : 5e-5) * Vec3(std::cos(i / 700.), 0.4 * std::sin(i / 400.), 0);
      way.emplace_back(at.x(), at.y(), (is_few ? 6e-4 : -2e-4) + 1e-6 * std::sin(i / 9.));
    }
    for (const double sign : {1., -1.}) {
      for (Vec3& position : way) position.z() *= sign;
      const std::vector<Vec3> laid = draped(written(way), mesh);
      const std::vector<Contact> found = contacts(laid, mesh);
      for (const std::size_t few : {1750u, 3750u, 5750u}) {
        EXPECT_EQ((laid[few] - found[few].point).dot(laid[few]) < 0, few_are_slow) << few << ' ' << sign;
        EXPECT_LT(found[few - 1000].distance, 0.002);  // the median has height 0
      }
    }
  }
}

TEST_F(DrapeTest, FreeKeepsHeightsFromTheLowestUp) {
  const TriangleMesh mesh = plate();
  Way way = scribble(10'000);
  for (Vec3& position : way) position.z() *= 30;
  const std::vector<Vec3> laid = draped(written(way), mesh, Drape::free);
  double lowest = infinity, highest = 0;
  for (const Contact& contact : contacts(laid, mesh)) {
    lowest = std::min(lowest, contact.distance);
    highest = std::max(highest, contact.distance);
  }
  const double metre = mesh.diagonal() / 0.2;
  EXPECT_NEAR(lowest, 0, 1e-9);
  EXPECT_NEAR(highest, 0.012 * metre, 0.002 * metre);  // from 3 mm below to 9 mm above
}

TEST_F(DrapeTest, StartsElsewhereForAnotherSeed) {
  const TriangleMesh mesh = meshes::icosphere(3);
  const std::string file = written(scribble(100));
  EXPECT_EQ(draped(file, mesh), draped(file, mesh));
  EXPECT_GT(
      (draped(file, mesh, Drape::contact, 1).front() - draped(file, mesh, Drape::contact, 2).front()).norm(),
      0.1);
}

TEST_F(DrapeTest, TakesTheMeshForTwentyCentimetresUnlessToldOtherwise) {
  const TriangleMesh mesh = meshes::icosphere(4);
  const std::string file = written(scribble(3000));
  const auto length = [&](const MotionOptions& motion, std::optional<support::LengthUnit> unit) {
    double sum = 0;
    for (const double step : hands::speeds(draped(file, mesh, Drape::contact, 1, motion, unit))) sum += step;
    return sum;
  };
  double metres = 0;
  for (const double step : hands::speeds(scribble(3000))) metres += step;
  const double usual = metres * mesh.diagonal() / 0.2;
  EXPECT_NEAR(length({}, std::nullopt), usual, 0.02 * usual);
  EXPECT_NEAR(length({}, support::LengthUnit{"dm", 0.1}), 10 * metres, 0.2 * metres);
  MotionOptions scaled;
  scaled.scale = 7;
  EXPECT_NEAR(length(scaled, std::nullopt), 7 * metres, 0.14 * metres);
  EXPECT_NEAR(length(scaled, support::LengthUnit{"dm", 0.1}), 7 * metres,
              0.14 * metres);  // to mesh units, as ever
}

TEST_F(DrapeTest, ClampsByTheFilesOwnRadii) {
  const TriangleMesh mesh = plate();
  Way way = scribble(5000);
  for (Vec3& position : way) position.z() *= 30;
  const std::vector<Vec3> laid = draped(written(way, ",radius", 0.002), mesh);  // 2 mm of 20 cm: 1 %
  double most = 0;
  for (const Contact& contact : contacts(laid, mesh)) most = std::max(most, contact.distance);
  EXPECT_NEAR(most, 0.01 * mesh.diagonal(), 1e-6);
}

TEST_F(DrapeTest, TakesARecordingThatStandsAndOneOfASingleRow) {
  const TriangleMesh mesh = meshes::icosphere(2);
  for (const std::size_t rows : {1u, 5u}) {
    const std::vector<Vec3> laid = draped(written(Way(rows, Vec3(1, 2, 3))), mesh);
    ASSERT_EQ(laid.size(), rows);
    for (const Contact& contact : contacts(laid, mesh)) EXPECT_NEAR(contact.distance, 0, 1e-12);
  }
}

TEST_F(DrapeTest, RefusesCoordinatesWhoseVarianceOverflows) {
  const std::string file = written({{0, 0, 0}, {1e200, 0, 0}});
  try {
    draped(file, plate());
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(error.what(), file + ": the coordinates are too large for --drape");
  }
}

TEST_F(DrapeTest, RefusesAnotherWord) {
  EXPECT_EQ(parse_motion_options("", "", "", "").drape, std::nullopt);
  EXPECT_EQ(parse_motion_options("", "", "", "contact").drape, Drape::contact);
  EXPECT_EQ(parse_motion_options("", "", "", "free").drape, Drape::free);
  try {
    parse_motion_options("", "", "", "loose");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "--drape \"loose\" is neither contact nor free");
  }
}

// A recording on a generated mesh is as fast as over the paper, and in contact.
TEST_F(DrapeTest, KeepsTheSpeedsOfTheRecordings) {
  const TriangleMesh mesh = meshes::icosphere(5);
  const double metre = mesh.diagonal() / 0.2;
  for (const char* number : {"1", "2", "5"}) {
    const std::filesystem::path file = std::filesystem::path(TOUCHMARK_SHARED_MOTIONS) /
                                       (std::string("panda-symbol17-rec") + number + ".csv");
    if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
    const std::vector<double> before = hands::speeds(make_trajectory(file.string(), mesh).positions);
    const std::vector<Vec3> laid = draped(file.string(), mesh);
    const std::vector<double> after = hands::speeds(laid);
    for (const double share : {0.05, 0.25, 0.5, 0.75, 0.9, 0.95, 0.99}) {
      const double wanted = metre * hands::quantile(before, share);
      EXPECT_NEAR(hands::quantile(after, share), wanted, 0.05 * wanted) << file << ' ' << share;
    }
    for (const Contact& contact : contacts(laid, mesh))
      ASSERT_LE(contact.distance, radius_of_diagonal * mesh.diagonal());
  }
}

/// Steps of the same length in one direction.
Way straight(std::size_t rows, double step, double height) {
  Way way;
  for (std::size_t i = 0; i < rows; ++i) way.emplace_back(step * static_cast<double>(i), 0, height);
  return way;
}

std::vector<Vec3> laid(const TriangleMesh& mesh, const Way& way, std::uint64_t seed) {
  Motion motion{mesh, way.size(), support::Random(seed), mesh.diagonal(), 0};
  return laid_on_surface(way, motion);
}

// Unfolded, the way over the crease between a floor and a wall is as straight as on the floor.
TEST(LaidOnSurface, GoesStraightOnIntoAConcaveCrease) {
  const TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 1}, {1, 1, 1}},
                          {{0, 1, 2}, {1, 3, 2}, {1, 5, 3}, {1, 4, 5}});
  constexpr double step = 0.01, height = 0.001;
  int crossed = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const std::vector<Vec3> way = laid(mesh, straight(40, step, height), seed);
    const auto inside = [](const Vec3& p) {
      return p.x() > 0.05 && p.z() < 0.95 && p.y() > 0.05 && p.y() < 0.95;
    };
    const bool begins_inside = way.front().x() < 1 && way.front().z() > 0;
    if (!begins_inside || !std::all_of(way.begin(), way.end(), inside)) continue;
    for (const Vec3& p : way) {
      ASSERT_LE(p.x(), 1) << seed;
      ASSERT_GE(p.z(), 0) << seed;
    }
    const auto unfolded = [](const Vec3& p) {
      return p.z() < 1 - p.x() ? Eigen::Vector2d(p.x(), p.y()) : Eigen::Vector2d(1 + p.z(), p.y());
    };
    const Eigen::Vector2d first = unfolded(way.front()), last = unfolded(way.back());
    if ((first.x() < 1) == (last.x() < 1)) continue;
    ++crossed;
    EXPECT_NEAR((last - first).norm(), 39 * step, 3 * height) << seed;
  }
  EXPECT_GT(crossed, 5);
}

TEST(LaidOnSurface, IsNotThrownBetweenWallsThatAreTooClose) {
  const TriangleMesh mesh({{0, 0, 0},
                           {1, 0, 0},
                           {0, 1, 0},
                           {1, 1, 0},  // faces up
                           {0, 0, 0.01},
                           {1, 0, 0.01},
                           {0, 1, 0.01},
                           {1, 1, 0.01}},  // faces down
                          {{0, 1, 2}, {1, 3, 2}, {4, 6, 5}, {5, 6, 7}});
  constexpr double step = 0.001;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const std::vector<Vec3> way = laid(mesh, straight(200, step, 0.008), seed);
    for (std::size_t i = 2; i < way.size(); ++i) {
      ASSERT_LT((way[i] - way[i - 1]).norm(), 1.2 * step) << seed << ' ' << i;
    }
  }
}

}  // namespace
}  // namespace touchmark::bench::trajectories
