#include "bench/meshes/mesh_writer.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "bench/support/files/atomic_file.h"
#include "core/geometry/point_triangle.h"

namespace touchmark::bench::meshes {
namespace {

/// Formats into memory and passes it on in large pieces.
class TextFile {
 public:
  explicit TextFile(const std::string& path) : file_(path) {}

  template <typename... Values>
  void print(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(buffer_), format, std::forward<Values>(values)...);
    constexpr std::size_t piece = 1 << 16;
    if (buffer_.size() >= piece) flush();
  }
  void commit() {
    flush();
    file_.commit();
  }

 private:
  void flush() {
    file_.write({buffer_.data(), buffer_.size()});
    buffer_.clear();
  }

  support::AtomicFile file_;
  fmt::memory_buffer buffer_;
};

// fmt's {} of a double is the shortest text that reads back as the same double.

void print_ply(const TriangleMesh& mesh, TextFile& file) {
  file.print("ply\nformat ascii 1.0\nelement vertex {}\n", mesh.vertices().size());
  file.print("property double x\nproperty double y\nproperty double z\n");
  file.print("element face {}\nproperty list uchar uint vertex_indices\nend_header\n", mesh.size());
  for (const Vec3& v : mesh.vertices()) file.print("{} {} {}\n", v.x(), v.y(), v.z());
  for (const auto& [a, b, c] : mesh.triangles()) file.print("3 {} {} {}\n", a, b, c);
}

void print_obj(const TriangleMesh& mesh, TextFile& file) {
  for (const Vec3& v : mesh.vertices()) file.print("v {} {} {}\n", v.x(), v.y(), v.z());
  for (const auto& [a, b, c] : mesh.triangles())
    file.print("f {} {} {}\n", std::size_t{a} + 1, std::size_t{b} + 1, std::size_t{c} + 1);
}

void print_off(const TriangleMesh& mesh, TextFile& file) {
  file.print("OFF\n{} {} 0\n", mesh.vertices().size(), mesh.size());
  for (const Vec3& v : mesh.vertices()) file.print("{} {} {}\n", v.x(), v.y(), v.z());
  for (const auto& [a, b, c] : mesh.triangles()) file.print("3 {} {} {}\n", a, b, c);
}

void print_stl(const TriangleMesh& mesh, TextFile& file) {
  file.print("solid mesh\n");
  for (std::uint32_t t = 0; t < mesh.size(); ++t) {
    const PreparedTriangle triangle = prepare(mesh, t);
    const Vec3& n = triangle.normal;
    file.print("facet normal {} {} {}\nouter loop\n", n.x(), n.y(), n.z());
    for (const Vec3& v : triangle.corner) file.print("vertex {} {} {}\n", v.x(), v.y(), v.z());
    file.print("endloop\nendfacet\n");
  }
  file.print("endsolid mesh\n");
}

}  // namespace

MeshFormat mesh_format_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending == ".ply") return MeshFormat::ply;
  if (ending == ".obj") return MeshFormat::obj;
  if (ending == ".off") return MeshFormat::off;
  if (ending == ".stl") return MeshFormat::stl;
  throw std::invalid_argument(fmt::format("{}: a mesh is written as .ply, .obj, .off or .stl", path));
}

void write_mesh(const TriangleMesh& mesh, const std::string& path) {
  const MeshFormat format = mesh_format_of(path);
  TextFile file(path);
  switch (format) {
    case MeshFormat::ply:
      print_ply(mesh, file);
      break;
    case MeshFormat::obj:
      print_obj(mesh, file);
      break;
    case MeshFormat::off:
      print_off(mesh, file);
      break;
    case MeshFormat::stl:
      print_stl(mesh, file);
      break;
  }
  file.commit();
}

}  // namespace touchmark::bench::meshes
