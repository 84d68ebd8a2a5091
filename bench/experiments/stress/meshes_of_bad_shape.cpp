#include <utility>

#include "bench/experiments/stress/corner_cases.h"
#include "bench/experiments/stress/makers.h"
#include "bench/experiments/stress/questions.h"
#include "bench/meshes/generated_meshes.h"

namespace touchmark::bench::experiments::stress {
namespace {

constexpr std::size_t triangles_of_a_soup = 200;

template <class MakeTriangle>
TriangleMesh soup_of(MakeTriangle make_triangle, std::size_t size = triangles_of_a_soup) {
  std::vector<CornerCases::Corners> triangles;
  for (std::size_t i = 0; i < size; ++i) triangles.push_back(make_triangle());
  return mesh_of(triangles);
}

/// A length 1 and something so much smaller that the aspect ratio is above 500 and up to 1e15.
constexpr double thickest = -3, thinnest = -15;

Vec3 unit_vector(CornerCases& cases) {
  for (;;) {
    const Vec3 v = cases.vector();
    if (v.norm() > 0.1) return v.normalized();
  }
}

/// A mesh's triangles with some more.
TriangleMesh with(const TriangleMesh& mesh, std::vector<CornerCases::Corners> more) {
  for (std::size_t i = 0; i < mesh.size(); ++i)
    more.push_back({mesh.corner(i, 0), mesh.corner(i, 1), mesh.corner(i, 2)});
  return mesh_of(more);
}

}  // namespace

std::vector<workload::Workload> needles(std::uint64_t seed, std::size_t probes) {
  CornerCases cases(seed);
  TriangleMesh random = soup_of([&] {
    const Vec3 a = cases.vector(), b = a + unit_vector(cases);
    return cases.shuffled({a, b, b + cases.magnitude(thinnest, thickest) * cases.vector()});
  });
  return corner_case_questions({{"needles", meshes::needles()}, {"random needles", std::move(random)}}, seed,
                               probes);
}

std::vector<workload::Workload> caps(std::uint64_t seed, std::size_t probes) {
  CornerCases cases(seed);
  TriangleMesh random = soup_of([&] {
    const Vec3 a = cases.vector(), direction = unit_vector(cases);
    const Vec3 foot = a + cases.between(0.2, 0.8) * direction;
    return cases.shuffled({a, a + direction, foot + cases.magnitude(thinnest, thickest) * cases.vector()});
  });
  return corner_case_questions({{"caps", meshes::caps()}, {"random caps", std::move(random)}}, seed, probes);
}

std::vector<workload::Workload> degenerate(std::uint64_t seed, std::size_t probes) {
  CornerCases cases(seed);
  TriangleMesh random = soup_of([&] {
    switch (cases.below(4)) {
      case 0:
        return cases.collinear();
      case 1:
        return cases.coincident();
      case 2:
        return cases.nearly_none();
      default:
        return cases.on_lattice();
    }
  });
  return corner_case_questions(
      {{"degenerate", meshes::degenerate()}, {"random degenerate", std::move(random)}}, seed, probes);
}

std::vector<workload::Workload> spanning_triangle(std::uint64_t seed, std::size_t probes) {
  CornerCases cases(seed);
  const Vec3 tilt = 0.25 * cases.vector();
  TriangleMesh across = with(
      meshes::soup(triangles_of_a_soup),
      {{Vec3(-0.5, -0.5, 0.5 + tilt.x()), Vec3(2, -0.5, 0.5 + tilt.y()), Vec3(-0.5, 2, 0.5 + tilt.z())}});
  TriangleMesh around =
      with(meshes::icosphere(1), {{Vec3(-2, -2, -1), Vec3(2, -2, 1), Vec3(0, 3, tilt.x())}});
  return corner_case_questions(
      {{"soup and one across", std::move(across)}, {"sphere and one across", std::move(around)}}, seed,
      probes);
}

std::vector<workload::Workload> one_cell(std::uint64_t seed, std::size_t probes) {
  CornerCases cases(seed);
  std::vector<NamedMesh> meshes;
  for (const double size : {1e-4, 1e-8}) {
    const Vec3 middle = cases.vector();
    const auto corner = [&] { return Vec3(middle + size * cases.vector()); };
    std::vector<CornerCases::Corners> triangles;
    for (std::size_t i = 0; i < triangles_of_a_soup; ++i) {
      const Vec3 a = corner(), b = corner(), c = corner();
      triangles.push_back({a, b, c});
    }
    // Two small ones in opposite corners keep the box, and so the cells, large.
    for (const double side : {-1.0, 1.0}) {
      const Vec3 end = side * Vec3::Ones();
      triangles.push_back({end, end - side * size * Vec3::UnitX(), end - side * size * Vec3::UnitY()});
    }
    meshes.push_back({size > 1e-6 ? "within 1e-4 of the box" : "within 1e-8 of the box", mesh_of(triangles)});
  }
  return corner_case_questions(std::move(meshes), seed, probes);
}

std::vector<workload::Workload> single_triangle(std::uint64_t seed, std::size_t probes) {
  CornerCases cases(seed);
  return corner_case_questions({{"single-triangle", meshes::single_triangle()},
                                {"plain", mesh_of({cases.plain()})},
                                {"needle", mesh_of({cases.needle()})},
                                {"point", mesh_of({cases.coincident()})}},
                               seed, probes);
}

std::vector<workload::Workload> empty_mesh(std::uint64_t, std::size_t) {
  return {workload_on({"empty", TriangleMesh({}, {})}, "any", {asked(Vec3::Zero(), 1)})};
}

}  // namespace touchmark::bench::experiments::stress
