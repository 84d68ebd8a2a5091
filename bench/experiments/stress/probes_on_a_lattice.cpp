// Whole numbers and halves of them: what doubles hold exactly, so that "on", "as far as" and "tangent" mean
// it.
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "bench/experiments/stress/corner_case_centers.h"
#include "bench/experiments/stress/corner_cases.h"
#include "bench/experiments/stress/makers.h"
#include "bench/experiments/stress/questions.h"
#include "bench/meshes/generated_meshes.h"
#include "core/float_limits.h"

namespace touchmark::bench::experiments::stress {
namespace {

TriangleMesh lattice_triangles(CornerCases& cases, std::size_t count) {
  std::vector<CornerCases::Corners> triangles;
  for (std::size_t i = 0; i < count; ++i) triangles.push_back(cases.on_lattice());
  return mesh_of(triangles);
}

/// One coordinate goes to a neighbouring double.
Vec3 beside(Vec3 point, CornerCases& cases) {
  double& coordinate = point[static_cast<Eigen::Index>(cases.below(3))];
  coordinate = std::nextafter(coordinate, cases.below(2) == 0 ? infinity : -infinity);
  return point;
}

/// On a vertex, an edge or the face: eighths of small whole numbers, so there is no rounding.
Vec3 point_on(const TriangleMesh& mesh, CornerCases& cases) {
  const std::size_t triangle = cases.below(mesh.size());
  const std::size_t i = cases.below(9), j = cases.below(9 - i);
  Vec3 weights(static_cast<double>(i), static_cast<double>(j), static_cast<double>(8 - i - j));
  if (cases.below(3) == 0) weights = Vec3(8, 0, 0);
  return (weights[0] * mesh.corner(triangle, 0) + weights[1] * mesh.corner(triangle, 1) +
          weights[2] * mesh.corner(triangle, 2)) /
         8;
}

/// Triangles and their images in the plane z = 0.
TriangleMesh mirrored(const TriangleMesh& mesh) {
  std::vector<CornerCases::Corners> triangles;
  for (const double side : {1.0, -1.0}) {
    for (std::size_t i = 0; i < mesh.size(); ++i) {
      CornerCases::Corners corners;
      for (int k = 0; k < 3; ++k)
        corners[static_cast<std::size_t>(k)] = mesh.corner(i, k).cwiseProduct(Vec3(1, 1, side));
      triangles.push_back(corners);
    }
  }
  return mesh_of(triangles);
}

/// Ways of whole numbers whose length is a whole number, in a plane and in space.
const std::array directions_in_a_plane{Vec3(3, 0, 4), Vec3(5, 0, 12), Vec3(8, 0, 15), Vec3(7, 0, 24)};
const std::array directions_in_space{Vec3(1, 2, 2), Vec3(2, 3, 6), Vec3(1, 4, 8),
                                     Vec3(4, 4, 7), Vec3(2, 6, 9), Vec3(6, 6, 7)};

/// [0, 8] x [0, 8] at z = 0 in squares, each of two triangles.
TriangleMesh floor_of_squares() {
  std::vector<CornerCases::Corners> triangles;
  for (int x = 0; x < 8; ++x) {
    for (int y = 0; y < 8; ++y) {
      const Vec3 a(x, y, 0), b(x + 1, y, 0), c(x + 1, y + 1, 0), d(x, y + 1, 0);
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
  }
  return mesh_of(triangles);
}

/// A centre whose distance to that floor is a double: over the face, beside an edge, or beyond a corner.
Vec3 center_at_a_double(CornerCases& cases) {
  const double size = std::ldexp(1, static_cast<int>(cases.below(12)) - 8);
  const double along = static_cast<double>(cases.below(65)) / 8;
  switch (cases.below(3)) {
    case 0:
      return {along, static_cast<double>(cases.below(65)) / 8,
              size * static_cast<double>(1 + cases.below(1000))};
    case 1:
      return Vec3(8, along, 0) + size * directions_in_a_plane[cases.below(directions_in_a_plane.size())];
    default:
      return Vec3(8, 8, 0) + size * directions_in_space[cases.below(directions_in_space.size())];
  }
}

}  // namespace

std::vector<workload::Workload> radius_zero(std::uint64_t seed, std::size_t probes) {
  CornerCases cases(seed);
  std::vector<workload::Workload> workloads;
  std::vector<NamedMesh> meshes;
  meshes.push_back({"lattice triangles", lattice_triangles(cases, 60)});
  meshes.push_back({"cube", meshes::cube()});
  for (NamedMesh& mesh : meshes) {
    std::vector<workload::Step> trace;
    while (trace.size() < share_of(probes, meshes.size())) {
      const Vec3 on = point_on(mesh.mesh, cases);
      trace.push_back(asked(on, 0));
      trace.push_back(asked(beside(on, cases), 0));
    }
    workloads.push_back(workload_on(std::move(mesh), "on the surface and one ulp off", std::move(trace)));
  }
  return workloads;
}

std::vector<workload::Workload> ties(std::uint64_t seed, std::size_t probes) {
  CornerCases cases(seed);
  const std::size_t centers_each = share_of(probes, 9);
  const auto half = [&] { return (static_cast<double>(cases.below(65)) - 32) / 64; };
  std::vector<Vec3> in_cube{Vec3::Zero()}, in_plane, on_doubled;
  while (in_cube.size() < centers_each) {
    const double t = half(), u = half();
    in_cube.push_back(cases.below(2) == 0 ? Vec3(t, t, u) : Vec3(t, -t, t));
  }
  while (in_plane.size() < centers_each) in_plane.emplace_back(6 * half(), 6 * half(), 0);
  on_doubled = corner_case_centers(meshes::doubled(), centers_each, seed);
  on_doubled.resize(centers_each);

  TriangleMesh mirror = mirrored(lattice_triangles(cases, 60));
  std::vector<workload::Step> of_cube = at_the_exact_distance(meshes::cube(), in_cube);
  std::vector<workload::Step> of_mirror = at_the_exact_distance(mirror, in_plane);
  std::vector<workload::Step> of_doubled = at_the_exact_distance(meshes::doubled(), on_doubled);
  return {workload_on({"cube", meshes::cube()}, "centre and diagonal planes", std::move(of_cube)),
          workload_on({"mirror images", std::move(mirror)}, "in the mirror's plane", std::move(of_mirror)),
          workload_on({"doubled", meshes::doubled()}, "hard centres", std::move(of_doubled))};
}

std::vector<workload::Workload> cell_borders(std::uint64_t seed, std::size_t probes) {
  CornerCases cases(seed);
  // The box is exactly the unit cube, so that k / n of it is where a grid of n cells has its borders.
  std::vector<CornerCases::Corners> triangles{{Vec3(0, 0, 0), Vec3(0.125, 0, 0), Vec3(0, 0.125, 0)},
                                              {Vec3(1, 1, 1), Vec3(0.875, 1, 1), Vec3(1, 0.875, 1)}};
  const auto border = [&](std::size_t cells) {
    return static_cast<double>(cases.below(cells + 1)) / static_cast<double>(cells);
  };
  for (int i = 0; i < 150; ++i) {
    const auto corner = [&] {
      const double x = border(16), y = border(16), z = border(16);
      return Vec3(x, y, z);
    };
    const Vec3 a = corner(), b = corner(), c = corner();
    const Vec3 middle = (a + b + c) / 4;
    triangles.push_back({a, 0.5 * (a + middle), 0.5 * (b + middle)});
  }
  TriangleMesh mesh = mesh_of(triangles);
  std::vector<Vec3> centers;
  while (centers.size() < share_of(probes, 3)) {
    constexpr std::array<std::size_t, 8> counts{2, 3, 4, 8, 10, 16, 32, 64};
    const std::size_t cells = counts[cases.below(counts.size())];
    const double x = border(cells), y = border(cells), z = border(cells);
    // `cell=1%` is of the diagonal, from the box's lower corner.
    const Vec3 on = cases.below(4) > 0 ? Vec3(x, y, z)
                                       : Vec3(0.01 * mesh.diagonal() * (100 * Vec3(x, y, z)).array().floor());
    centers.push_back(cases.below(2) == 0 ? on : beside(on, cases));
  }
  std::vector<workload::Step> trace = at_the_exact_distance(mesh, centers);
  return {workload_on({"unit cube of triangles", std::move(mesh)}, "on borders and one ulp off",
                      std::move(trace))};
}

std::vector<workload::Workload> tangent(std::uint64_t seed, std::size_t probes) {
  CornerCases cases(seed);
  TriangleMesh mesh = floor_of_squares();
  std::vector<Vec3> centers;
  while (centers.size() < share_of(probes, 3)) centers.push_back(center_at_a_double(cases));
  std::vector<workload::Step> trace = at_the_exact_distance(mesh, centers);
  return {workload_on({"floor of squares", std::move(mesh)}, "tangent to face, edge and corner",
                      std::move(trace))};
}

}  // namespace touchmark::bench::experiments::stress
