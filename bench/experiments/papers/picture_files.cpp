#include "bench/experiments/papers/picture_files.h"

#include <fmt/format.h>

namespace touchmark::bench::experiments::papers {
namespace {

// Six digits are more than any pixel shows.
void append(std::string& text, const Vec3& v, char after) {
  fmt::format_to(std::back_inserter(text), "{:.6g},{:.6g},{:.6g}{}", v.x(), v.y(), v.z(), after);
}

void append_triangle(std::string& text, const TriangleMesh& mesh, std::size_t triangle) {
  append(text, mesh.corner(triangle, 0), ',');
  append(text, mesh.corner(triangle, 1), ',');
  append(text, mesh.corner(triangle, 2), '\n');
}

constexpr const char* triangle_header = "ax,ay,az,bx,by,bz,cx,cy,cz\n";

}  // namespace

std::string triangles_csv(const TriangleMesh& mesh) {
  std::string text = triangle_header;
  for (std::size_t i = 0; i < mesh.size(); ++i) append_triangle(text, mesh, i);
  return text;
}

std::string triangles_csv(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles) {
  std::string text = triangle_header;
  for (const std::uint32_t i : triangles) append_triangle(text, mesh, i);
  return text;
}

std::string spheres_csv(std::span<const Sphere> spheres) {
  std::string text = "x,y,z,radius\n";
  for (const Sphere& sphere : spheres) {
    append(text, sphere.center, ',');
    fmt::format_to(std::back_inserter(text), "{:.6g}\n", sphere.radius);
  }
  return text;
}

std::string boxes_csv(std::span<const Aabb> boxes) {
  std::string text = "min_x,min_y,min_z,max_x,max_y,max_z\n";
  for (const Aabb& box : boxes) {
    append(text, box.min, ',');
    append(text, box.max, '\n');
  }
  return text;
}

}  // namespace touchmark::bench::experiments::papers
