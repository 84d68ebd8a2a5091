/// The meshes and axes of bodies that need no mesh file. Each lies about the origin of its frame, and lengths
/// are those of the scene. docs/library-scenes.md lists them.
#pragma once

#include "core/probe.h"
#include "core/triangle_mesh.h"

namespace touchmark {

/// What a size of a primitive may be, so that nothing that is worked out of one leaves the range of double.
inline constexpr double min_primitive_size = 1e-30, max_primitive_size = 1e30;

/// Returns true if a size is in that range.
constexpr bool is_primitive_size(double size) noexcept {
  return size >= min_primitive_size && size <= max_primitive_size;
}

/// Throws SceneError for a size that is out of range, naming the shape, the size and its value.
void expect_primitive_size(const char* shape, const char* size, double value);

/// Returns a box of 12 triangles, seen from outside counter-clockwise, whose corners are at half the size to
/// either side. Throws SceneError for a size that is out of range.
TriangleMesh box_mesh(const Vec3& size);

/// Returns a rectangle of two triangles in the plane z = 0, seen from +z counter-clockwise, whose corners are
/// at half the size to either side. Throws SceneError for a size that is out of range.
TriangleMesh plane_mesh(double size_x, double size_y);

}  // namespace touchmark
