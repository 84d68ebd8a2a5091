#include "bench/experiments/stress/shared_features.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

#include "bench/experiments/stress/corner_cases.h"
#include "bench/experiments/stress/makers.h"
#include "bench/experiments/stress/questions.h"
#include "bench/oracle/oracle.h"

namespace touchmark::bench::experiments::stress {
namespace {

using Corners = CornerCases::Corners;

double turn(std::size_t i, std::size_t count) {
  return 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
}

/// About a tip, whose nearest surroundings are the same for all.
SharedFeature fan(std::string name, std::size_t count, const Vec3& tip, double drop) {
  std::vector<Corners> triangles;
  const auto rim = [&](std::size_t i) {
    return Vec3(tip + Vec3(std::cos(turn(i, count)), std::sin(turn(i, count)), -drop));
  };
  for (std::size_t i = 0; i < count; ++i) triangles.push_back({tip, rim(i), rim(i + 1)});
  return {std::move(name), mesh_of(triangles), {tip + Vec3(0, 0, 0.5), tip, tip + Vec3(0.01, 0.02, 0.3)}};
}

/// Pages about a spine.
SharedFeature book(std::string name, std::size_t count, const Vec3& from, const Vec3& to) {
  const Vec3 along = (to - from).normalized(), across = along.unitOrthogonal(), up = along.cross(across);
  std::vector<Corners> pages;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = turn(i, 2 * count);
    pages.push_back({from, to, from + 0.6 * (to - from) + std::cos(angle) * across + std::sin(angle) * up});
  }
  const Vec3 middle = 0.5 * (from + to);
  return {std::move(name),
          mesh_of(pages),
          {Vec3(middle - 0.25 * up), from, Vec3(from - 0.1 * along - 0.1 * up), Vec3(middle - 0x1p-30 * up)}};
}

/// Repeats one pair of triangles in a plane that x and y span.
SharedFeature sheet(std::string name, std::size_t count, const Vec3& x, const Vec3& y) {
  const Vec3 origin(0.5, 0.25, 0.125), up = x.cross(y);
  const auto at = [&](double u, double v) { return Vec3(origin + u * x + v * y); };
  std::vector<Corners> triangles;
  while (triangles.size() < count) {
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) {
        triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
        triangles.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
  }
  return {std::move(name),
          mesh_of(triangles),
          {at(0.25, 0.25) + 0.5 * up, at(0.25, 0.25), at(1, 1) + 0.5 * up, at(1, 1), at(1.5, 1) + 0.5 * up}};
}

/// Whole points of a sphere about the origin, in no order.
std::vector<Vec3> whole_points(std::size_t count, CornerCases& cases) {
  // 5 * 13 * 17 * 29 squared is the sum of three squares in very many ways.
  constexpr int radius = 32045, coarse = 17;
  std::vector<Vec3> points;
  for (int x = 0; x <= radius && points.size() < count; x += coarse) {
    for (int y = 0; y * y <= radius * radius - x * x && points.size() < count; ++y) {
      const double rest =
          static_cast<double>(radius) * radius - static_cast<double>(x) * x - static_cast<double>(y) * y;
      const double z = std::round(std::sqrt(rest));
      if (z * z != rest) continue;
      for (const double sign : {1.0, -1.0}) points.emplace_back(sign * x, y, -sign * z);
    }
  }
  for (std::size_t i = points.size(); i > 1; --i) std::swap(points[i - 1], points[cases.below(i)]);
  return points;
}

/// Spikes outwards of points about the origin.
SharedFeature spikes(std::string name, const std::vector<Vec3>& tips, CornerCases& cases) {
  std::vector<Corners> triangles;
  for (const Vec3& tip : tips) {
    const Vec3 a = 2 * tip + 0.1 * tip.norm() * cases.vector();
    triangles.push_back({tip, a, 2 * tip + 0.1 * tip.norm() * cases.vector()});
  }
  return {std::move(name), mesh_of(triangles), {Vec3::Zero()}};
}

/// Edges, or faces, that touch a sphere about the origin in these points.
SharedFeature tangents(std::string name, const std::vector<Vec3>& points, bool faces) {
  std::vector<Corners> triangles;
  for (const Vec3& p : points) {
    const Vec3 a = p.unitOrthogonal() * p.norm(), b = p.cross(a) / p.norm();
    if (faces)
      triangles.push_back({p - 2 * a - b, p + 2 * a - b, p + 2 * b});
    else
      triangles.push_back({p - a, p + 1.5 * a, 2 * p + b});
  }
  return {std::move(name), mesh_of(triangles), {Vec3::Zero()}};
}

std::vector<Vec3> directions(std::size_t count, CornerCases& cases) {
  std::vector<Vec3> all;
  while (all.size() < count) all.push_back(cases.vector().normalized());
  return all;
}

/// These centres first, then others about them, from a diagonal away to hardly beside them.
std::vector<Vec3> centers_near(const std::vector<Vec3>& given, double diagonal, std::size_t count,
                               CornerCases& cases) {
  std::vector<Vec3> centers(given.begin(),
                            given.begin() + static_cast<std::ptrdiff_t>(std::min(count, given.size())));
  while (centers.size() < count) {
    const double distance = std::ldexp(diagonal, -static_cast<int>(cases.below(60)));
    centers.push_back(given[cases.below(given.size())] + distance * cases.vector());
  }
  return centers;
}

}  // namespace

std::vector<SharedFeature> shared_feature_meshes(std::size_t triangles) {
  CornerCases cases(17);
  std::vector<SharedFeature> all;
  all.push_back(fan("cone", triangles, {0.125, 0.25, 0.5}, 1));
  all.push_back(fan("disc", triangles, Vec3::Zero(), 0));
  all.push_back(book("book", triangles, {0.1, 0.2, 0.3}, {0.4, 1.1, 0.2}));
  all.push_back(book("upright book", triangles, Vec3::Zero(), {0, 0, 2}));
  all.push_back(sheet("level sheets", triangles, Vec3::UnitX(), Vec3::UnitY()));
  all.push_back(sheet("oblique sheets", triangles, {0.6, 0.1, 0.7}, {-0.3, 0.9, 0.2}));
  all.push_back(spikes("spikes of whole points", whole_points(triangles, cases), cases));
  all.push_back(spikes("spikes", directions(triangles, cases), cases));
  all.push_back(tangents("tangent edges", directions(triangles, cases), false));
  all.push_back(tangents("tangent faces", directions(triangles, cases), true));
  return all;
}

std::vector<workload::Workload> shared_features(std::uint64_t seed, std::size_t probes) {
  std::vector<SharedFeature> all = shared_feature_meshes(200);
  CornerCases cases(seed);
  std::vector<workload::Workload> workloads;
  const std::size_t centers_each = share_of(probes, 4 * all.size());
  for (SharedFeature& shared : all) {
    shared.centers = centers_near(shared.centers, shared.mesh.diagonal(), centers_each, cases);
    std::vector<workload::Step> trace = at_the_exact_distance(shared.mesh, shared.centers);
    const oracle::Oracle oracle(shared.mesh);
    for (const Vec3& center : shared.centers) trace.push_back(asked(center, 2 * oracle.solve(center).high));
    workloads.push_back(workload_on({std::move(shared.name), std::move(shared.mesh)},
                                    "as near to all by a shared place", std::move(trace)));
  }
  return workloads;
}

}  // namespace touchmark::bench::experiments::stress
