#include "core/search/distance_field/distance_field.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "core/brute_force/brute_force.h"
#include "core/search/distance_field/distance_field_filling.h"  // IWYU pragma: keep
#include "tests/core/sphere_cluster/test_meshes.h"

namespace touchmark {
namespace {

using test::Random;

TriangleMesh plate(double width, double height, double z = 0) {
  std::vector<Vec3> vertices = {
      {-width, -height, z}, {width, -height, z}, {width, height, z}, {-width, height, z}};
  return {std::move(vertices), {{0, 1, 2}, {0, 2, 3}}};
}

std::vector<TriangleMesh> meshes() {
  return {test::bumpy_sphere(6, 0.1, 1), test::soup(200, 0.1, 2), plate(1, 0.7), plate(1, 1e-3)};
}

double distance_to(const BruteForce& mesh, const Vec3& point) {
  BruteForce::Session session;
  return mesh.nearest({point, 0}, std::numeric_limits<double>::infinity(), session)->distance;
}

/// Each triangle alone, and all of them.
struct Measured {
  explicit Measured(const TriangleMesh& mesh)
      : frame(FilterFrame::around(mesh.bounds())), all(BruteForce::build(mesh, {})) {
    for (std::uint32_t i = 0; i < mesh.size(); ++i) {
      const std::vector<Vec3> corners = {mesh.corner(i, 0), mesh.corner(i, 1), mesh.corner(i, 2)};
      each.push_back(BruteForce::build(TriangleMesh(corners, {{0, 1, 2}}), {}));
    }
  }

  FilterFrame frame;
  BruteForce all;
  std::vector<BruteForce> each;
};

/// Takes samples as a detector does that knows a triangle near each, and gives up after `max_samples`.
class KnowingSampler {
 public:
  KnowingSampler(const Measured& mesh, std::size_t& searches, std::size_t max_samples = 1'000'000)
      : mesh_(mesh), searches_(searches), max_samples_(max_samples) {}

  DistanceField::Interval operator()(const Vec3& place, double most) {
    if (searches_++ >= max_samples_) return {-1, -1};
    const Contact found = nearest(mesh_.all, place);
    near_ = found.triangle;
    const double distance = mesh_.frame.scale() * found.distance;
    EXPECT_LE(distance, most);
    return {0.9 * distance, distance};
  }
  std::uint32_t near() const { return near_; }
  double distance_to(std::uint32_t near, const Vec3& place) {
    return mesh_.frame.scale() * nearest(mesh_.each[near], place).distance;
  }
  const Vec3& to_mesh() const { return to_mesh_; }

 private:
  Contact nearest(const BruteForce& of, const Vec3& place) {
    BruteForce::Session session;
    const Contact found =
        *of.nearest({mesh_.frame.from_frame(place), 0}, std::numeric_limits<double>::infinity(), session);
    to_mesh_ = mesh_.frame.to_frame(found.point) - place;
    return found;
  }

  const Measured& mesh_;
  std::size_t& searches_;
  std::size_t max_samples_;
  std::uint32_t near_ = 0;
  Vec3 to_mesh_ = Vec3::Zero();
};

static_assert(KnowsTriangles<KnowingSampler>);

/// What a detector would make of the mesh, its samples known no better than `least` times the distance, and
/// what one that knows triangles would.
struct Grid {
  explicit Grid(const TriangleMesh& mesh, double least = 1, std::size_t max_samples = 1'000'000)
      : measured(mesh), frame(measured.frame) {
    const Vec3 low = frame.to_frame(mesh.bounds().min), high = frame.to_frame(mesh.bounds().max);
    grid = above = DistanceField(low.cast<float>(), high.cast<float>(), mesh.size());
    const auto distance_at = [&](const Vec3& place, double most) {
      if (samples++ >= max_samples) return DistanceField::Interval{-1, -1};
      const double found = distance(place);
      EXPECT_LE(found, most);
      return DistanceField::Interval{least * found, found};
    };
    grid.fill([&](double) { return distance_at; }, 1);
    std::size_t searches = 0;
    above.fill([&](double) { return KnowingSampler(measured, searches, max_samples); }, 1);
  }
  double distance(const Vec3& in_frame) const {
    return frame.scale() * distance_to(measured.all, frame.origin() + in_frame / frame.scale());
  }
  FilterPoint point(const Vec3& in_frame) const {
    return frame.point(frame.origin() + in_frame / frame.scale());
  }
  double upper_bound(const Vec3& in_frame) const {
    return static_cast<double>(above.upper_bound(point(in_frame)));
  }

  Measured measured;
  const FilterFrame& frame;
  DistanceField grid, above;
  std::size_t samples = 0;
};

TEST(DistanceGrid, BoundsTheDistanceInsideAndFarOutside) {
  Random random(3);
  for (const TriangleMesh& mesh : meshes()) {
    const Grid known(mesh), roughly(mesh, 0.8);
    for (int i = 0; i < 3000; ++i) {
      const Vec3 p = random.point(i % 3 == 0 ? 0.7 : i % 3 == 1 ? 3 : 1e5);
      const double distance = known.distance(p);
      for (const Grid* grid : {&known, &roughly}) {
        EXPECT_LE(static_cast<double>(grid->grid.lower_bound(grid->point(p))), distance) << p.transpose();
        EXPECT_LE(static_cast<double>(grid->grid.tight_lower_bound(grid->point(p))), distance)
            << p.transpose();
        EXPECT_GE(grid->upper_bound(p), distance) << p.transpose();
      }
    }
  }
}

TEST(DistanceGrid, BoundsTheDistanceWhereItFollowsFromSamplesAround) {
  Random random(11);
  for (const TriangleMesh& mesh : meshes()) {
    const Grid plain(mesh);
    const Vec3 low = plain.frame.to_frame(mesh.bounds().min), high = plain.frame.to_frame(mesh.bounds().max);
    DistanceField grid(low.cast<float>(), high.cast<float>(), 4096);
    std::size_t searches = 0;
    grid.fill([&](double) { return KnowingSampler(plain.measured, searches); }, 1);
    for (int i = 0; i < 3000; ++i) {
      const Vec3 p = random.point(i % 2 == 0 ? 0.7 : 3);
      const double distance = plain.distance(p);
      EXPECT_LE(static_cast<double>(grid.lower_bound(plain.point(p))), distance) << p.transpose();
      EXPECT_LE(static_cast<double>(grid.tight_lower_bound(plain.point(p))), distance) << p.transpose();
      EXPECT_GE(static_cast<double>(grid.upper_bound(plain.point(p))), distance) << p.transpose();
    }
    std::size_t all = 0;
    DistanceField searched(low.cast<float>(), high.cast<float>(), 4096);
    KnowingSampler same(plain.measured, all);
    searched.fill([&](double) { return [&](const Vec3& place, double most) { return same(place, most); }; },
                  1);
    EXPECT_LT(searches, all);
  }
}

/// Over the middle of a plate the point of it that a sample found is aside by no more than half the diagonal
/// of a cube.
TEST(DistanceGrid, BoundsTheDistanceFromAboveByAPointOfTheMesh) {
  Random random(19);
  const TriangleMesh mesh = plate(1, 0.7);
  const Measured measured(mesh);
  const FilterFrame& frame = measured.frame;
  const Vec3 low = frame.to_frame(mesh.bounds().min), high = frame.to_frame(mesh.bounds().max);
  DistanceField grid(low.cast<float>(), high.cast<float>(), 4096);
  std::size_t searches = 0;
  grid.fill([&](double) { return KnowingSampler(measured, searches); }, 1);
  const double largest_edge = 1.2 * (high - low).maxCoeff() / std::cbrt(4096 / 8);
  double max_aside = 0;
  for (int i = 0; i < 20'000; ++i) {
    Vec3 p = frame.from_frame(random.point(0.5));
    p.x() *= 0.7;
    p.y() *= 0.4;
    const double distance = frame.scale() * std::abs(p.z());
    const auto upper = static_cast<double>(grid.upper_bound(frame.point(p)));
    EXPECT_GE(upper, distance) << p.transpose();
    EXPECT_LE(upper, std::hypot(distance, std::sqrt(0.5) * largest_edge) + 0x1p-12) << p.transpose();
    max_aside = std::max(max_aside, upper - distance);
  }
  EXPECT_GT(max_aside, 0x1p-12);  // some points were aside
}

TEST(DistanceGrid, ForgetsThePointsOfTheMeshThatMoved) {
  Random random(23);
  const TriangleMesh before = plate(1, 0.7), after = plate(1, 0.7, -0.8);
  Measured measured_before(before), measured_after(after);
  const FilterFrame frame = FilterFrame::around({{-1, -1, -1}, {1, 1, 1}});
  measured_before.frame = measured_after.frame = frame;
  std::size_t searches = 0;
  KnowingSampler of_before(measured_before, searches), of_after(measured_after, searches);
  const Eigen::Vector3f low = frame.to_frame(Vec3(-1, -1, -1)).cast<float>(),
                        high = frame.to_frame(Vec3(1, 1, 1)).cast<float>();
  DistanceField grid(low, high, 4096);
  grid.fill_lazily();
  std::vector<FilterPoint> points;
  for (int i = 0; i < 500; ++i) points.push_back(frame.point(frame.from_frame(random.point(0.5))));
  for (const FilterPoint& p : points)
    while (grid.sample_near(p, of_before)) {
    }
  grid.refill([&](double) { return of_after; },
              std::vector<Aabb>{frame.to_frame(before.bounds()), frame.to_frame(after.bounds())}, 1);
  for (int pass = 0; pass < 2; ++pass) {
    for (const FilterPoint& p : points) {
      const Vec3 in_frame(p.x, p.y, p.z);
      const double distance = frame.scale() * distance_to(measured_after.all, frame.from_frame(in_frame));
      EXPECT_GE(static_cast<double>(grid.upper_bound(p)), distance) << in_frame.transpose();
      EXPECT_LE(static_cast<double>(grid.lower_bound(p)), distance) << in_frame.transpose();
      while (grid.sample_near(p, of_after)) {
      }
      EXPECT_LT(grid.upper_bound(p), 2);
    }
  }
}

TEST(DistanceGrid, KnowsThatAPointIsFar) {
  Random random(4);
  const TriangleMesh mesh = test::bumpy_sphere(20, 0.02, 1);
  const Grid known(mesh);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 p = random.point(4);
    const double distance = known.distance(p);
    if (distance < 0.2) continue;  // two cubes' edges
    EXPECT_GT(static_cast<double>(known.grid.lower_bound(known.point(p))), 0.3 * distance) << p.transpose();
    if (p.lpNorm<Eigen::Infinity>() < 0.5) {
      EXPECT_LT(known.upper_bound(p), 2 * distance + 0.2) << p.transpose();
    }
  }
}

TEST(DistanceGrid, KnowsMoreByEight) {
  Random random(7);
  const TriangleMesh mesh = test::bumpy_sphere(20, 0.02, 1);
  const Grid known(mesh);
  double missing_by_one = 0, missing_by_eight = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 p = random.point(0.6);  // within the samples' box
    const double distance = known.distance(p);
    missing_by_one += distance - static_cast<double>(known.grid.lower_bound(known.point(p)));
    missing_by_eight += distance - static_cast<double>(known.grid.tight_lower_bound(known.point(p)));
  }
  EXPECT_LT(missing_by_eight, 0.6 * missing_by_one);
}

TEST(DistanceGrid, HasNoLowerBoundsInsideAMeshThatFillsItsBox) {
  Random random(13);
  const TriangleMesh mesh = test::soup(4000, 0.1, 2);
  Grid known(mesh);
  const std::size_t bytes = known.grid.bytes();
  EXPECT_LT(bytes, Grid(test::bumpy_sphere(45, 0.02, 1)).grid.bytes() / 4);
  const auto expect_bounds = [&] {
    for (int i = 0; i < 300; ++i) {
      const Vec3 p = random.point(0.6);
      EXPECT_LE(known.grid.lower_bound(known.point(p)), 0);
      EXPECT_FALSE(known.grid.may_be_tighter(known.point(p)));
      EXPECT_GE(known.upper_bound(p), known.distance(p));
    }
  };
  expect_bounds();
  // What moves is sampled anew, and the rest of the mesh still fills the box.
  const auto sampler = [&](double) {
    return [&](const Vec3& place, double) {
      const double distance = known.distance(place);
      return DistanceField::Interval{distance, distance};
    };
  };
  const std::vector<Aabb> all = {known.frame.to_frame(mesh.bounds())};
  known.grid.refill(sampler, all, 1);
  std::size_t searches = 0;
  known.above.refill([&](double) { return KnowingSampler(known.measured, searches); }, all, 1);
  expect_bounds();
  EXPECT_EQ(known.grid.bytes(), bytes);
}

/// Level squares, one above the other, which fill the middle of a box: how far a place is from the nearest.
double distance_to_squares(const Vec3& place, double apart) {
  constexpr double half = 0.35;
  const double level = apart * std::round(std::clamp(place.z(), -half, half) / apart);
  return std::hypot(std::max(std::abs(place.x()) - half, 0.0), std::max(std::abs(place.y()) - half, 0.0),
                    place.z() - level);
}

/// With 10^3 cubes of 0.12 the middle of an eighth is at most 0.42 of its edge from squares that are 0.05
/// apart, and often half an edge from those 0.09 apart.
TEST(DistanceGrid, SamplesInnerEighthsWhereTheyTellMoreThanThatTheMeshIsNear) {
  Random random(29);
  const auto samples_of = [&](double apart) {
    DistanceField grid(Eigen::Vector3f::Constant(-0.5F), Eigen::Vector3f::Constant(0.5F), 4096);
    std::size_t samples = 0;
    const auto distance_at = [&](const Vec3& place, double) {
      ++samples;
      const double distance = distance_to_squares(place, apart);
      return DistanceField::Interval{distance, distance};
    };
    grid.fill([&](double) { return distance_at; }, 1);
    for (int i = 0; i < 3000; ++i) {
      const Vec3 p = random.point(0.6);
      const FilterPoint point{static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()),
                              1e-6F};
      const Vec3 rounded(point.x, point.y, point.z);
      EXPECT_LE(static_cast<double>(grid.lower_bound(point)), distance_to_squares(rounded, apart));
      EXPECT_LE(static_cast<double>(grid.tight_lower_bound(point)), distance_to_squares(rounded, apart));
    }
    return static_cast<double>(samples);
  };
  EXPECT_LT(samples_of(0.05), 0.8 * samples_of(0.09));
}

TEST(DistanceGrid, KeepsItsLowerBoundsWhereAllThatMovesIsNear) {
  Random random(17);
  const TriangleMesh mesh = test::bumpy_sphere(20, 0.02, 1);
  Grid known(mesh);
  const DistanceField before = known.grid;
  const Vec3 moved = known.frame.to_frame(mesh.corner(0, 0));
  const auto sampler = [&](double) {
    return [&](const Vec3& place, double) {
      const double distance = known.distance(place);
      return DistanceField::Interval{distance, distance};
    };
  };
  known.grid.refill(sampler, std::vector<Aabb>{{moved, moved}}, 1);
  for (int i = 0; i < 300; ++i) {
    const Vec3 p = random.point(0.6);
    if ((p - moved).norm() < 3 * known.distance(p)) continue;
    EXPECT_EQ(known.grid.lower_bound(known.point(p)), before.lower_bound(known.point(p))) << p.transpose();
  }
}

TEST(DistanceGrid, WhereSamplingEndsNothingIsClaimed) {
  Random random(5);
  for (const TriangleMesh& mesh : meshes()) {
    const std::size_t all = Grid(mesh).samples;
    for (const std::size_t most : {std::size_t{0}, std::size_t{1}, all / 2}) {
      const Grid cut(mesh, 1, most);
      for (int i = 0; i < 500; ++i) {
        const Vec3 p = random.point(1.5);
        EXPECT_LE(static_cast<double>(cut.grid.lower_bound(cut.point(p))), cut.distance(p));
        EXPECT_LE(static_cast<double>(cut.grid.tight_lower_bound(cut.point(p))), cut.distance(p));
        EXPECT_GE(cut.upper_bound(p), cut.distance(p));
      }
    }
  }
}

TEST(DistanceGrid, ClaimsNothingBeforeItIsFilled) {
  const FilterPoint point{0.1F, 0.2F, 0.3F, 1e-6F};
  EXPECT_LE(DistanceField().lower_bound(point), 0);
  EXPECT_LE(DistanceField().tight_lower_bound(point), 0);
  EXPECT_EQ(DistanceField().upper_bound(point), std::numeric_limits<float>::infinity());
  // Nothing is claimed from above where samples tell no point of the mesh.
  EXPECT_EQ(Grid(plate(1, 0.7)).grid.upper_bound(point), std::numeric_limits<float>::infinity());
}

TEST(DistanceGrid, StaysSmallForAFewTriangles) {
  for (const TriangleMesh& mesh : meshes()) {
    EXPECT_LE(Grid(mesh).grid.bytes(), std::max<std::size_t>(5 * mesh.size(), 128));
    EXPECT_LE(Grid(mesh).above.bytes(), std::max<std::size_t>(5 * mesh.size(), 160));
  }
}

}  // namespace
}  // namespace touchmark
