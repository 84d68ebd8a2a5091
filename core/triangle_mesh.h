/// A triangle mesh in double precision that can be used as it stands: every index and every coordinate was
/// checked.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "core/aabb.h"
#include "core/probe.h"
#include "core/triangle_ids.h"
#include "core/visible.h"

namespace touchmark {

/// Thrown when a mesh cannot be used; the message names the offender and both numbers.
class TOUCHMARK_VISIBLE MeshError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Degenerate triangles are kept: to a probe they are segments or points. Ids are the file's own.
class TriangleMesh {
 public:
  using Corners = std::array<std::uint32_t, 3>;  ///< indices into vertices()

  /// `ids[i]` is the id of triangle i, non-decreasing in i; empty means that triangle i has id i.
  /// Throws MeshError for no triangle, a vertex index out of range, a coordinate that is not finite, more
  /// than 2^32 - 1 triangles or vertices, a wrong number of ids, or ids that decrease.
  TriangleMesh(std::vector<Vec3> vertices, std::vector<Corners> triangles, std::vector<TriangleId> ids = {});

  std::span<const Vec3> vertices() const noexcept { return vertices_; }
  std::span<const Corners> triangles() const noexcept { return triangles_; }
  std::size_t size() const noexcept { return triangles_.size(); }
  TriangleId id(std::size_t triangle) const noexcept { return ids_[triangle]; }
  /// Empty when triangle i has id i.
  std::span<const TriangleId> ids() const noexcept { return ids_.stored(); }
  const TriangleIds& triangle_ids() const noexcept { return ids_; }
  const Vec3& corner(std::size_t triangle, int which) const noexcept {
    return vertices_[triangles_[triangle][static_cast<std::size_t>(which)]];
  }
  /// Returns the box of the vertices that triangles use.
  const Aabb& bounds() const noexcept { return bounds_; }
  double diagonal() const noexcept { return bounds_.diagonal(); }

  /// Every vertex v becomes scale * (v + shift). Throws MeshError when a coordinate overflows.
  TriangleMesh transformed(double scale, const Vec3& shift) const;
  /// Box diagonal 1, box centre at the origin. Throws MeshError when all vertices coincide, or lie so far
  /// apart that the diagonal overflows.
  TriangleMesh normalized() const;

 private:
  std::vector<Vec3> vertices_;
  std::vector<Corners> triangles_;
  TriangleIds ids_;
  Aabb bounds_;
};

}  // namespace touchmark
