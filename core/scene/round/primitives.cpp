#include "core/scene/round/primitives.h"

#include <cstdint>
#include <sstream>
#include <utility>
#include <vector>

#include "core/scene/body.h"

namespace touchmark {
namespace {

using Corners = TriangleMesh::Corners;

void add_quad(std::vector<Corners>& triangles, const std::uint32_t (&corner)[4]) {
  triangles.push_back({corner[0], corner[1], corner[2]});
  triangles.push_back({corner[0], corner[2], corner[3]});
}

}  // namespace

void expect_primitive_size(const char* shape, const char* size, double value) {
  if (is_primitive_size(value)) return;
  std::ostringstream out;
  out << "the " << size << " of a " << shape << " is " << value << "; it must be from " << min_primitive_size
      << " to " << max_primitive_size;
  throw SceneError(out.str());
}

TriangleMesh box_mesh(const Vec3& size) {
  for (const double length : {size.x(), size.y(), size.z()}) expect_primitive_size("box", "size", length);
  const Vec3 half = 0.5 * size;
  std::vector<Vec3> vertices;
  for (std::uint32_t i = 0; i < 8; ++i)
    vertices.emplace_back((i & 1) != 0 ? half.x() : -half.x(), (i & 2) != 0 ? half.y() : -half.y(),
                          (i & 4) != 0 ? half.z() : -half.z());
  constexpr std::uint32_t faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                         {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  std::vector<Corners> triangles;
  for (const auto& face : faces) add_quad(triangles, face);
  return {std::move(vertices), std::move(triangles)};
}

TriangleMesh plane_mesh(double size_x, double size_y) {
  for (const double length : {size_x, size_y}) expect_primitive_size("plane", "size", length);
  const double x = 0.5 * size_x, y = 0.5 * size_y;
  std::vector<Corners> triangles;
  add_quad(triangles, {0, 1, 2, 3});
  return {{{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}}, std::move(triangles)};
}

}  // namespace touchmark
