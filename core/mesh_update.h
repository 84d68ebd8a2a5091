/// Detectors whose mesh may move, and what the `update` of each begins with: are these the same triangles,
/// and which of them are elsewhere?
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>

#include "core/detector.h"
#include "core/triangle_mesh.h"

namespace touchmark {

/// Takes the same triangles with some vertices elsewhere. Afterwards every answer is that of a detector built
/// of this mesh with the same options (of an exact one the same bits), from sessions begun before as from new
/// ones. Throws std::invalid_argument when vertices, corners or ids are not those of the mesh it was built
/// of, and is as it was then; after any other exception it may only be destroyed or assigned to. No query may
/// run meanwhile.
template <class D>
concept Updates = Detector<D> && requires(D& detector, const TriangleMesh& mesh) {
  { detector.update(mesh) } -> std::same_as<void>;
};

/// Which vertices make which triangles, wherever they are: what a detector keeps of it, to know its mesh
/// again. Corners and ids are kept as a hash of 64 bits, their numbers as they are.
class Connectivity {
 public:
  Connectivity() = default;
  explicit Connectivity(const TriangleMesh& mesh) noexcept;

  /// Throws std::invalid_argument for a mesh of other triangles.
  void expect(const TriangleMesh& mesh) const;

 private:
  std::size_t vertices_ = 0;
  std::size_t triangles_ = 0;
  std::uint64_t corners_and_ids_ = 0;
};

}  // namespace touchmark
