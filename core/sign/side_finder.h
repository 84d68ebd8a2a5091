/// Inside or outside: which side of a mesh's surface a point is on, or that the mesh does not say.
///
/// Inside is behind the faces, whose corners run counter-clockwise seen from outside. What the mesh is like
/// decides how it is found:
/// - Closed (along every edge as many triangles run one way as the other): by the winding number, which is
/// exact
///   then (winding.h), 0 outside and 1 inside; where solids overlap it is 2 and more, inside too. Where the
///   surface is simple round the nearest point, the pseudonormal there says the same and is found faster.
///   A mesh of negative volume (of the stored doubles, exactly) is inside out: a room, solid all round.
///   There, -1 and less is outside and 0 inside. What is left, positive in a room and negative elsewhere, is
///   a shell turned against the rest: undecided.
/// - Open: the winding number has no jump in an opening. Decided where it is as near to a whole number as
///   `clear_share` and the pseudonormal of the nearest point says the same: so never where an opening is
///   nearest.
/// - Contrary triangles along an edge (a Moebius strip, a patch turned over): undecided everywhere.
/// The orientation of a triangle that is not connected to others cannot be checked and is trusted.
///
/// A point exactly on the surface is on_surface, in closed meshes and open ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/aabb.h"
#include "core/detector.h"
#include "core/sign/pseudonormals.h"
#include "core/sign/winding.h"

namespace touchmark {

/// Finds the side of points from their nearest contacts, for one mesh.
class SideFinder {
 public:
  enum class Method : std::uint8_t {
    pseudonormals,   ///< closed; most points by the pseudonormal, the rest by the exact winding number
    crossings,       ///< closed, but nowhere simple: all points by the exact winding number
    winding_number,  ///< open: by the generalised winding number where that is clear
    none             ///< contrary triangles: undecided
  };

  /// What `build` found.
  struct Surface {
    Method method = Method::none;
    bool closed = false;
    bool inside_out = false;           ///< closed with a negative volume
    std::size_t open_edges = 0;        ///< with one triangle more one way than the other
    std::size_t contrary_edges = 0;    ///< with two or more
    std::size_t simple_triangles = 0;  ///< those whose pseudonormals are used
  };

  /// How far an open mesh's winding number may be from a whole number k: patches that close the openings add
  /// the rest, and k is right for all that cover less than 7/8 of the point's directions, while in the middle
  /// of an opening it is half-way between two.
  static constexpr double clear_share = 0.125;

  static SideFinder build(const TriangleMesh& mesh);

  const Surface& surface() const noexcept { return surface_; }
  /// `nearest` is an answer to `center` by a detector with this accuracy; unless that is exact only its
  /// triangle is used, and only in an open mesh. `counted` goes up when pseudonormals do not decide.
  Side side(const Vec3& center, const Contact& nearest, const Accuracy& accuracy,
            std::uint64_t& counted) const noexcept;

  std::size_t bytes() const noexcept;

 private:
  using Reading = sign::Pseudonormals::Reading;

  void find_simple_faces(const std::vector<bool>& clear);
  bool is_solid_behind(std::uint32_t face) const;
  std::optional<Side> by_pseudonormal(const Vec3& center, const Contact& nearest) const noexcept;
  Side side_of_closed(const Vec3& center) const noexcept;
  Side side_of_open(const Vec3& center, TriangleId nearest) const noexcept;
  std::optional<Reading> reading(TriangleId id, const Vec3& center) const noexcept;
  std::optional<Reading> reading_of_index(std::uint32_t index, const Vec3& center) const noexcept;
  /// Are all faces that meet at the nearest point simple?
  bool is_simple_at(const Reading& reading) const noexcept;

  Surface surface_;
  Aabb bounds_;
  sign::Winding winding_;
  sign::Pseudonormals normals_;
  std::vector<std::uint32_t> face_of_;  ///< by mesh index; no_face where two corners are in one place
  /// By face: nothing else near it, outside in front of it and inside behind it. Empty where no face is so.
  std::vector<bool> simple_face_;
  std::vector<bool> simple_vertex_;  ///< all faces there are simple
  double clearance_ = 0;             ///< what is near a simple face, in mesh units
  std::vector<TriangleId> ids_;      ///< by mesh index; empty when they are the same
};

}  // namespace touchmark
