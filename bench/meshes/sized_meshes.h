/// Kinds of meshes that come in any size, "NAME:TRIANGLES": what the suite measures on. Each is the same bits
/// on every machine, as generated_meshes.h says, and lies about the unit cube.
#pragma once

#include <cstdint>
#include <span>

#include "core/triangle_mesh.h"

namespace touchmark::bench::meshes {

struct SizedMesh {
  const char* form;         ///< as written on the command line: "hair:TRIANGLES"
  const char* description;  ///< one line
  std::uint64_t min_triangles;
  const char* example;  ///< a small instance that tests can run, or empty
  /// Returns at most so many triangles, and from 1,000 on at least half as many.
  TriangleMesh (*make)(std::uint64_t triangles);
};

/// Returns all of them.
std::span<const SizedMesh> sized_meshes();

// Many parts.
TriangleMesh large_soup(std::uint64_t triangles);
TriangleMesh dust(std::uint64_t triangles);
TriangleMesh clusters(std::uint64_t triangles);
TriangleMesh pebbles(std::uint64_t triangles);
TriangleMesh giant_quad(std::uint64_t triangles);
TriangleMesh boxes(std::uint64_t triangles);
TriangleMesh crates(std::uint64_t triangles);
TriangleMesh voxels(std::uint64_t triangles);
TriangleMesh truss(std::uint64_t triangles);
TriangleMesh fins(std::uint64_t triangles);

// Long and thin.
TriangleMesh hair(std::uint64_t triangles);
TriangleMesh wires(std::uint64_t triangles);
TriangleMesh cable(std::uint64_t triangles);
TriangleMesh cylinder(std::uint64_t triangles);
TriangleMesh bolts(std::uint64_t triangles);
TriangleMesh gear(std::uint64_t triangles);
TriangleMesh spring(std::uint64_t triangles);
TriangleMesh knot(std::uint64_t triangles);
TriangleMesh spikes(std::uint64_t triangles);

// Sheets and shells.
TriangleMesh sheets(std::uint64_t triangles);
TriangleMesh shells(std::uint64_t triangles);
TriangleMesh foam(std::uint64_t triangles);
TriangleMesh terrain(std::uint64_t triangles);
TriangleMesh blades(std::uint64_t triangles);
TriangleMesh graded(std::uint64_t triangles);

}  // namespace touchmark::bench::meshes
