#include "core/search/distance_field.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "core/brute_force/brute_force.h"
#include "core/search/distance_field_filling.h"
#include "tests/core/sphere_cluster/test_meshes.h"

namespace touchmark {
namespace {

using test::Random;

TriangleMesh plate(double width, double height) {
  std::vector<Vec3> vertices = {
      {-width, -height, 0}, {width, -height, 0}, {width, height, 0}, {-width, height, 0}};
  return {std::move(vertices), {{0, 1, 2}, {0, 2, 3}}};
}

std::vector<TriangleMesh> meshes() {
  return {test::bumpy_sphere(6, 0.1, 1), test::soup(200, 0.1, 2), plate(1, 0.7), plate(1, 1e-3)};
}

double distance_to(const BruteForce& mesh, const Vec3& point) {
  BruteForce::Session session;
  return mesh.nearest({point, 0}, std::numeric_limits<double>::infinity(), session)->distance;
}

/// What a detector would make of the mesh, its samples known no better than `least` times the distance.
struct Grid {
  explicit Grid(const TriangleMesh& mesh, double least = 1, std::size_t most_samples = 1'000'000)
      : brute(BruteForce::build(mesh, {})), frame(FilterFrame::around(mesh.bounds())) {
    const Vec3 low = frame.to_frame(mesh.bounds().min), high = frame.to_frame(mesh.bounds().max);
    grid = DistanceField(low.cast<float>(), high.cast<float>(), mesh.size());
    const auto distance_at = [&](const Vec3& place, double most) {
      if (samples++ >= most_samples) return DistanceField::Interval{-1, -1};
      const double distance = frame.scale() * distance_to(brute, frame.origin() + place / frame.scale());
      EXPECT_LE(distance, most);
      return DistanceField::Interval{least * distance, distance};
    };
    grid.fill([&](double) { return distance_at; }, 1);
  }
  double distance(const Vec3& in_frame) const {
    return frame.scale() * distance_to(brute, frame.origin() + in_frame / frame.scale());
  }
  FilterPoint point(const Vec3& in_frame) const {
    return frame.point(frame.origin() + in_frame / frame.scale());
  }

  BruteForce brute;
  FilterFrame frame;
  DistanceField grid;
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
        EXPECT_GE(static_cast<double>(grid->grid.upper_bound(grid->point(p))), distance) << p.transpose();
      }
    }
  }
}

/// Takes samples as a detector does that knows a triangle near each.
class KnowingSampler {
 public:
  KnowingSampler(const TriangleMesh& mesh, const FilterFrame& frame, std::size_t& searches)
      : frame_(frame), searches_(searches), all_(BruteForce::build(mesh, {})) {
    for (std::uint32_t i = 0; i < mesh.size(); ++i) {
      const std::vector<Vec3> corners = {mesh.corner(i, 0), mesh.corner(i, 1), mesh.corner(i, 2)};
      each_.push_back(BruteForce::build(TriangleMesh(corners, {{0, 1, 2}}), {}));
    }
  }

  DistanceField::Interval operator()(const Vec3& place, double most) {
    ++searches_;
    BruteForce::Session session;
    const Contact found =
        *all_.nearest({frame_.from_frame(place), 0}, std::numeric_limits<double>::infinity(), session);
    near_ = found.triangle;
    const double distance = frame_.scale() * found.distance;
    EXPECT_LE(distance, most);
    return {0.9 * distance, distance};
  }
  std::uint32_t near() const { return near_; }
  double distance_to(std::uint32_t near, const Vec3& place) const {
    return frame_.scale() * ::touchmark::distance_to(each_[near], frame_.from_frame(place));
  }

 private:
  const FilterFrame& frame_;
  std::size_t& searches_;
  BruteForce all_;
  std::vector<BruteForce> each_;
  std::uint32_t near_ = 0;
};

static_assert(KnowsTriangles<KnowingSampler>);

TEST(DistanceGrid, BoundsTheDistanceWhereItFollowsFromSamplesAround) {
  Random random(11);
  for (const TriangleMesh& mesh : meshes()) {
    const Grid plain(mesh);
    const Vec3 low = plain.frame.to_frame(mesh.bounds().min), high = plain.frame.to_frame(mesh.bounds().max);
    DistanceField grid(low.cast<float>(), high.cast<float>(), 4096);
    std::size_t searches = 0;
    const KnowingSampler sampler(mesh, plain.frame, searches);
    grid.fill([&](double) { return sampler; }, 1);
    for (int i = 0; i < 3000; ++i) {
      const Vec3 p = random.point(i % 2 == 0 ? 0.7 : 3);
      const double distance = plain.distance(p);
      EXPECT_LE(static_cast<double>(grid.lower_bound(plain.point(p))), distance) << p.transpose();
      EXPECT_LE(static_cast<double>(grid.tight_lower_bound(plain.point(p))), distance) << p.transpose();
      EXPECT_GE(static_cast<double>(grid.upper_bound(plain.point(p))), distance) << p.transpose();
    }
    std::size_t all = 0;
    DistanceField searched(low.cast<float>(), high.cast<float>(), 4096);
    KnowingSampler same(mesh, plain.frame, all);
    searched.fill([&](double) { return [&](const Vec3& place, double most) { return same(place, most); }; },
                  1);
    EXPECT_LT(searches, all);
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
      EXPECT_LT(static_cast<double>(known.grid.upper_bound(known.point(p))), 2 * distance + 0.2)
          << p.transpose();
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
      EXPECT_GE(static_cast<double>(known.grid.upper_bound(known.point(p))), known.distance(p));
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
  known.grid.refill(sampler, std::vector<Aabb>{known.frame.to_frame(mesh.bounds())}, 1);
  expect_bounds();
  EXPECT_EQ(known.grid.bytes(), bytes);
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
        EXPECT_GE(static_cast<double>(cut.grid.upper_bound(cut.point(p))), cut.distance(p));
      }
    }
  }
}

TEST(DistanceGrid, ClaimsNothingBeforeItIsFilled) {
  const FilterPoint point{0.1F, 0.2F, 0.3F, 1e-6F};
  EXPECT_LE(DistanceField().lower_bound(point), 0);
  EXPECT_LE(DistanceField().tight_lower_bound(point), 0);
  EXPECT_EQ(DistanceField().upper_bound(point), std::numeric_limits<float>::infinity());
}

TEST(DistanceGrid, StaysSmallForAFewTriangles) {
  for (const TriangleMesh& mesh : meshes())
    EXPECT_LE(Grid(mesh).grid.bytes(), std::max<std::size_t>(5 * mesh.size(), 128));
}

}  // namespace
}  // namespace touchmark
