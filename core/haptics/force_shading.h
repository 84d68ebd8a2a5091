/// Force shading: a coarse mesh that feels smooth, since the force turns from face to face as the normals of
/// its vertices do (H. B. Morgenbesser and M. A. Srinivasan, "Force shading for haptic shape perception",
/// ASME Dynamic Systems and Control 1996). The force alone is turned: where the proxy goes is none of its
/// doing.
#pragma once

#include <cstddef>
#include <vector>

#include "core/probe.h"
#include "core/triangle_mesh.h"

namespace touchmark {

struct ProxyState;

/// The normals of a mesh's vertices, each the mean of its faces' by their areas.
class ForceShading {
 public:
  /// Takes memory. The mesh must outlive it; after an update of the mesh another one is to be made.
  explicit ForceShading(const TriangleMesh& mesh);

  /// Returns the state's force, its part along the contact's normal turned by `share`, 0 to 1, towards the
  /// normal that is interpolated between the vertices of the contact's triangle. It keeps its length. Where
  /// the proxy has no contact, more than one, or one of no known triangle, it is the force as it is.
  Vec3 shaded(const ProxyState& state, double share) const noexcept;

 private:
  std::size_t triangle_at(TriangleId id, const Vec3& point) const noexcept;

  const TriangleMesh* mesh_;
  std::vector<Vec3> normals_;
};

}  // namespace touchmark
