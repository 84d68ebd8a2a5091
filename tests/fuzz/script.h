/// A small mesh and probes out of any bytes: whatever the fuzzer changes is again a mesh and probes, and most
/// bytes stand for a number that detectors find hard.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "core/triangle_mesh.h"

namespace touchmark::fuzz {

/// Reads the bytes from the front; zeros when there are none left.
class Script {
 public:
  explicit Script(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  bool ended() const { return at_ >= bytes_.size(); }
  std::size_t below(std::size_t count) { return byte() % count; }
  bool flag() { return (byte() & 1) != 0; }

  /// Exact halves and thirds of nothing, neighbours of one, what vanishes beside it, and offsets that make it
  /// vanish.
  double number() {
    // clang-format off
    constexpr std::array<double, 32> palette = {
        0, 1, 2, 3, 4, 7, 0.5, 0.25,
        0.75, 1.5, 0.1, 0.3, 1.0 / 3, 0.7071067811865476, 0.1 + 0x1p-56, 12345.678,
        1e-3, 1e-5, 1e-8, 1e-9, 1e-15, 1e-17, 0x1p-30, 0x1p-52, 0x1p-53,
        1 + 0x1p-52, 1 - 0x1p-53, 1e3, 1e6, 1e9, 1e16, 0x1p53};
    // clang-format on
    const std::uint8_t chosen = byte();
    const double value = palette[chosen & 31];
    return (chosen & 32) != 0 ? -value : value;
  }
  /// Where detectors search; one of sixteen is beyond single precision, where whole numbers take their time
  /// and all of them do the same.
  double magnitude() {
    constexpr std::array<double, 8> usual = {1, 1, 1, 1, 0x1p-30, 0x1p30, 1e-9, 1e9};
    constexpr std::array<double, 8> rare = {0x1p-149, 0x1p-260,  0x1p260,  0x1p500,
                                            0x1p-500, 0x1p-1000, 0x1p1000, 1e-40};
    const std::uint8_t chosen = byte();
    return (chosen < 240 ? usual : rare)[chosen & 7];
  }
  Vec3 vector() {
    const double x = number(), y = number(), z = number();
    return {x, y, z};
  }

 private:
  std::uint8_t byte() { return at_ < bytes_.size() ? bytes_[at_++] : 0; }

  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

/// No way at all, one of the mesh's own size or so, or as far as doubles tell its corners apart and farther.
inline Vec3 read_shift(Script& script) {
  switch (script.below(4)) {
    case 1:
      return script.vector();
    case 2:
      return std::ldexp(1.0, 20 + static_cast<int>(script.below(36))) * script.vector();
    case 3:
      return Vec3::Constant(std::ldexp(1.0, 20 + static_cast<int>(script.below(36))));
    default:
      return Vec3::Zero();
  }
}

/// 1 to 16 triangles of 3 to 10 vertices, and in one of four meshes up to seven copies of them, each moved on
/// from the last, for hierarchies of some depth: those take the most time. Throws MeshError where the scale
/// leaves the range of double.
inline TriangleMesh read_mesh(Script& script) {
  const double scale = script.magnitude();
  const Vec3 shift = read_shift(script);
  const std::size_t given = 3 + script.below(8), copies = script.below(4) == 0 ? 1 + script.below(8) : 1;
  const Vec3 step = copies > 1 ? script.vector() : Vec3(Vec3::Zero());
  std::vector<Vec3> vertices(given);
  for (Vec3& vertex : vertices) vertex = script.vector() + shift;
  std::vector<TriangleMesh::Corners> triangles(1 + script.below(16));
  for (TriangleMesh::Corners& corners : triangles)
    for (std::uint32_t& corner : corners) corner = static_cast<std::uint32_t>(script.below(given));
  const std::size_t drawn = triangles.size();
  for (std::size_t copy = 1; copy < copies; ++copy) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    for (std::size_t i = 0; i < given; ++i)
      vertices.push_back(vertices[i] + static_cast<double>(copy) * step);
    for (std::size_t i = 0; i < drawn; ++i)
      triangles.push_back({triangles[i][0] + first, triangles[i][1] + first, triangles[i][2] + first});
  }
  for (Vec3& vertex : vertices) vertex *= scale;
  return {std::move(vertices), std::move(triangles)};
}

/// On a corner, an edge, a face, or off them by something small or large; or anywhere.
inline Vec3 read_center(Script& script, const TriangleMesh& mesh) {
  const std::size_t triangle = script.below(mesh.size());
  const Vec3 &a = mesh.corner(triangle, 0), &b = mesh.corner(triangle, 1), &c = mesh.corner(triangle, 2);
  const double size = mesh.bounds().extent().maxCoeff();
  const Vec3 e = b - a, f = c - a;
  const Vec3 across(e.y() * f.z() - e.z() * f.y(), e.z() * f.x() - e.x() * f.z(),
                    e.x() * f.y() - e.y() * f.x());
  switch (script.below(8)) {
    case 0:
      return a;
    case 1:
      return 0.5 * (a + b);
    case 2:
      return (a + b + c) / 3;
    case 3:
      return a + script.number() * e + script.number() * f;
    case 4:
      return a + 0.25 * e + 0.25 * f + script.number() * across;
    case 5:
      return a + size * script.vector();
    case 6:
      return mesh.bounds().center() + size * script.vector();
    default:
      return script.magnitude() * script.vector();
  }
}

}  // namespace touchmark::fuzz
