/// A scene of bodies as it stands at the start: shapes, which several bodies may share, and where the bodies
/// are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bench/scenes/placement.h"
#include "core/aabb.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::scenes {

struct Body {
  std::string name;
  std::size_t shape = 0;  ///< which of the scene's shapes
  Placement start;
  std::string id = {};  ///< another name that a file of poses may use where no body has it as its name
};

/// A sphere about the origin of its frame, or a capsule along z: all points so far from a segment.
struct RoundShape {
  double half_length = 0;  ///< half the segment; 0: a sphere
  double radius = 0;
};

/// The first body is the lowest: of several at the same distance it is the one that is named.
struct BodyScene {
  std::string name;  ///< the file's without its folders, or what was generated
  std::vector<std::shared_ptr<const TriangleMesh>> shapes;
  std::vector<Body> bodies;  ///< at least one
  /// The shapes that are round, whose mesh is facets that trajectories are made over: no answer is about it.
  std::map<std::size_t, RoundShape> round = {};

  /// Triangles of all bodies: those of a shape count for each body that has it, a round one's axis as one.
  std::size_t triangles() const noexcept {
    std::size_t sum = 0;
    for (const Body& body : bodies) sum += round.contains(body.shape) ? 1 : shapes[body.shape]->size();
    return sum;
  }
};

/// How bodies move: those that do, ascending, and where each is at a time.
struct BodyMotion {
  std::vector<std::uint32_t> moving;
  std::function<Placement(std::uint32_t body, double time_s)> at;
};

/// Returns the box of all bodies' vertices at the start, each rounded once it is placed.
Aabb bounds_of(const BodyScene& scene);

/// Returns one mesh of all bodies' triangles at the start, in the bodies' order, each vertex rounded once it
/// is placed. Those of the first bodies alone where all have more than `most` triangles, of one at least.
TriangleMesh merged(const BodyScene& scene, std::size_t most);

}  // namespace touchmark::bench::scenes
