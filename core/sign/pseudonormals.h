/// The normals by which a nearest point tells outside from inside: a face's own, on an edge the sum of its
/// two faces', on a vertex the sum of its faces' weighted by their angles there. Baerentzen & Aanaes, "Signed
/// distance computation using the angle weighted pseudonormal" (2005). Only where the surface goes on all
/// round the feature: on a border and where fans or sheets meet there is none.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "core/subdivision/indexed_faces.h"
#include "core/subdivision/oriented_surface.h"

namespace touchmark::sign {

class Pseudonormals {
 public:
  enum class Feature : std::uint8_t { face, edge, vertex };

  /// What the nearest point of a face says.
  struct Reading {
    std::uint32_t face = 0;
    Feature feature = Feature::face;
    std::uint32_t side = 0;      ///< edge: the face's side on it; vertex: the side that starts there
    Vec3 offset = Vec3::Zero();  ///< from that point to the probe's centre
    double distance = 0;         ///< its length
    /// From that point to the features of the face that it does not lie on, before their angles count; on a
    /// vertex the shortest edge there.
    double gap = 0;
    /// The pseudonormal's share of the offset's direction: above 0 outside. The normal is scaled such that
    /// minus this is twice the integral of the offset's direction over the solid's directions as that point
    /// sees them: 2 pi in front of a plane, and never more.
    double in_front = 0;
  };

  Pseudonormals() = default;
  /// Takes what it needs of the welded mesh and its surface.
  Pseudonormals(const IndexedTriangles& welded, const TriangleSurface& surface);

  std::size_t faces() const noexcept { return faces_.size(); }
  std::size_t vertices() const noexcept { return positions_.size(); }
  const std::array<std::uint32_t, 3>& corners(std::uint32_t face) const noexcept { return faces_[face]; }
  const Vec3& position(std::uint32_t vertex) const noexcept { return positions_[vertex]; }
  const Vec3& normal(std::uint32_t face) const noexcept { return normals_[face]; }
  /// Returns the face on the other side of side s; no_face on borders and seams.
  std::uint32_t across(std::uint32_t face, std::size_t s) const noexcept { return across_[3 * face + s]; }
  static constexpr std::uint32_t no_face = std::numeric_limits<std::uint32_t>::max();
  /// Does the vertex have a pseudonormal?
  bool regular(std::uint32_t vertex) const noexcept { return shortest_edge_[vertex] > 0; }

  /// Nothing where that feature has no pseudonormal.
  std::optional<Reading> at_nearest(std::uint32_t face, const Vec3& center) const noexcept;

  std::size_t bytes() const noexcept;

 private:
  void sum_up_vertices(const TriangleSurface& surface);
  std::optional<Reading> on_face(std::uint32_t face, const Vec3& center, const Vec3& offset,
                                 double gap) const noexcept;
  std::optional<Reading> on_edge(std::uint32_t face, std::uint32_t s, const Vec3& offset,
                                 double gap) const noexcept;
  std::optional<Reading> on_vertex(std::uint32_t face, std::uint32_t s, const Vec3& offset) const noexcept;

  std::vector<Vec3> positions_;
  std::vector<std::array<std::uint32_t, 3>> faces_;
  std::vector<std::uint32_t> across_;
  std::vector<Vec3> normals_;          ///< by face, unit; zero without area
  std::vector<Vec3> vertex_normals_;   ///< sum of angle * normal
  std::vector<double> shortest_edge_;  ///< at a vertex; 0 where it has no pseudonormal
};

}  // namespace touchmark::sign
