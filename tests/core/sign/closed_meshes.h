/// Closed, oriented meshes on which inside and outside are hard to tell, and points where they are hardest.
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "bench/meshes/generated_meshes.h"
#include "bench/support/random.h"
#include "core/triangle_mesh.h"

namespace touchmark {

struct Named {
  std::string name;
  TriangleMesh mesh;
};

inline TriangleMesh turned_over(const TriangleMesh& mesh) {
  std::vector<TriangleMesh::Corners> triangles;
  for (const auto& [a, b, c] : mesh.triangles()) triangles.push_back({a, c, b});
  return {{mesh.vertices().begin(), mesh.vertices().end()}, std::move(triangles)};
}

inline TriangleMesh together(const std::vector<TriangleMesh>& parts) {
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Corners> triangles;
  for (const TriangleMesh& part : parts) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    vertices.insert(vertices.end(), part.vertices().begin(), part.vertices().end());
    for (const auto& [a, b, c] : part.triangles()) triangles.push_back({first + a, first + b, first + c});
  }
  return {std::move(vertices), std::move(triangles)};
}

inline TriangleMesh moved(const TriangleMesh& mesh, double scale, const Vec3& shift) {
  return mesh.transformed(scale, shift / scale);
}

/// A cone with its tip at the origin, over a polygon of `sides`, `width` wide and 1 high, downwards.
inline TriangleMesh spike(std::uint32_t sides, double width) {
  std::vector<Vec3> vertices{{0, 0, 0}, {0, 0, -1}};
  std::vector<TriangleMesh::Corners> triangles;
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double angle = 6.283185307179586 * i / sides;
    vertices.emplace_back(width * std::cos(angle), width * std::sin(angle), -1);
  }
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t here = 2 + i, next = 2 + (i + 1) % sides;
    triangles.push_back({0, here, next});
    triangles.push_back({1, next, here});
  }
  return {std::move(vertices), std::move(triangles)};
}

/// A box whose top is pushed in to a point: at its rim sharp vertices, in its middle a hollow one.
inline TriangleMesh crater() {
  return {{{-1, -1, -1},
           {1, -1, -1},
           {1, 1, -1},
           {-1, 1, -1},
           {-1, -1, 0},
           {1, -1, 0},
           {1, 1, 0},
           {-1, 1, 0},
           {0, 0, -0.9}},
          {{0, 2, 1},
           {0, 3, 2},
           {0, 1, 5},
           {0, 5, 4},
           {1, 2, 6},
           {1, 6, 5},
           {2, 3, 7},
           {2, 7, 6},
           {3, 0, 4},
           {3, 4, 7},
           {4, 5, 8},
           {5, 6, 8},
           {6, 7, 8},
           {7, 4, 8}}};
}

inline TriangleMesh slab(double thickness) {
  const TriangleMesh cube = bench::meshes::cube();
  std::vector<Vec3> vertices;
  for (const Vec3& v : cube.vertices()) vertices.emplace_back(v.x(), v.y(), thickness * v.z());
  return {std::move(vertices), {cube.triangles().begin(), cube.triangles().end()}};
}

/// One face of a tetrahedron split along its edge by a triangle without area: closed by its connections, but
/// not a surface as the books have it.
inline TriangleMesh with_flat_triangle() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5, 0, 0}},
          {{0, 2, 1}, {0, 1, 4}, {0, 4, 3}, {4, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

/// Boundaries of solids: 1 wound round inside, 0 outside.
inline std::vector<Named> solids() {
  using namespace bench::meshes;
  const TriangleMesh ball = icosphere(1);
  std::vector<Named> all;
  all.push_back({"icosphere", icosphere(2)});
  all.push_back({"torus", torus(12, 8)});
  all.push_back({"noisy sphere", noisy_sphere(500)});
  all.push_back({"cube", cube()});
  all.push_back({"wedge", wedge()});
  all.push_back({"slab", slab(1e-3)});
  all.push_back({"sheet", slab(1e-15)});
  all.push_back({"hollow ball", together({ball, turned_over(moved(ball, 0.5, {0.1, 0, 0}))})});
  all.push_back({"ball in a hollow ball",
                 together({ball, turned_over(moved(ball, 0.75, {0, 0, 0})), moved(ball, 0.5, {0, 0, 0})})});
  all.push_back({"two balls", together({ball, moved(ball, 0.25, {1.5, 0.3, 0.2})})});
  all.push_back({"spike", spike(7, 0.01)});
  all.push_back({"needle", spike(3, 1e-7)});
  all.push_back({"hair", spike(5, 1e-15)});
  all.push_back({"crater", crater()});
  all.push_back({"flat triangle", with_flat_triangle()});
  return all;
}

/// As many triangles each way on every edge, but no boundary of a solid: overlapping, doubled, touching.
inline std::vector<Named> tangles() {
  using namespace bench::meshes;
  const TriangleMesh ball = icosphere(1);
  std::vector<Named> all;
  all.push_back({"overlapping balls", together({ball, moved(ball, 1, {0.8, 0.1, 0.2})})});
  all.push_back({"ball in a ball", together({ball, moved(ball, 0.5, {0, 0, 0})})});
  all.push_back({"crossing cubes", together({cube(), moved(cube(), 1, {0.25, 0.5, 0.125})})});
  all.push_back({"cubes face to face", together({cube(), moved(cube(), 1, {1, 0, 0})})});
  all.push_back({"cubes at a corner", together({cube(), moved(cube(), 1, {1, 1, 1})})});
  all.push_back({"the same twice", together({ball, ball})});
  all.push_back({"doubled", doubled()});
  all.push_back({"spindle", together({spike(6, 0.5), turned_over(moved(spike(6, 0.5), -1, {0, 0, 0}))})});
  return all;
}

/// Near and on vertices, edges and faces, from one rounding to a tenth of the size away; anywhere; far away.
inline std::vector<Vec3> telling_points(const TriangleMesh& mesh, bench::support::Random& random, int count) {
  const Aabb box = mesh.bounds();
  const double size = mesh.diagonal();
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    const std::size_t t = random.below(mesh.size());
    const auto k = static_cast<int>(random.below(3));
    const Vec3 &a = mesh.corner(t, k), &b = mesh.corner(t, (k + 1) % 3), &c = mesh.corner(t, (k + 2) % 3);
    const double share = random.unit(), rest = (1 - share) * random.unit();
    const Vec3 on_face = a + share * (b - a) + rest * (c - a), on_edge = a + share * (b - a);
    const double away = size * std::ldexp(1.0, -static_cast<int>(random.below(52)) - 3);
    for (const Vec3& near : {a, on_edge, on_face, Vec3(0.5 * (a + b))}) {
      points.push_back(near);
      points.push_back(near + away * random.direction());
    }
    const Vec3 normal = (b - a).cross(c - a).stableNormalized();
    points.push_back(on_face + away * normal);
    points.push_back(on_face - away * normal);
    points.push_back(box.center() + 0.6 * random.between(-1, 1) * box.extent());
    points.push_back(
        box.min +
        (Vec3(random.unit(), random.unit(), random.unit()).array() * box.extent().array()).matrix());
    points.push_back(box.center() + 100 * size * random.direction());
  }
  return points;
}

}  // namespace touchmark
