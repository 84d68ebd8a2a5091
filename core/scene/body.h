/// How a scene's bodies and shapes are called, and answers that name the body.
#pragma once

#include <compare>
#include <cstdint>
#include <stdexcept>

#include "core/probe.h"
#include "core/visible.h"

namespace touchmark {

/// Thrown when a scene is given a body or a shape that it does not have; the message names it.
class TOUCHMARK_VISIBLE SceneError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A body of a scene. The index is the lowest one free when the body was added, so the first body of a scene
/// is 0; the generation tells bodies that had one index after another apart.
struct BodyId {
  std::uint32_t index = 0;
  std::uint32_t generation = 0;

  friend bool operator==(const BodyId&, const BodyId&) = default;
};

/// A shape of a scene, which any number of bodies may have.
struct ShapeId {
  std::uint32_t index = 0;

  friend bool operator==(const ShapeId&, const ShapeId&) = default;
};

/// A contact in the scene's frame, and whose it is. The triangle's id is the one within the body's mesh.
struct BodyContact {
  BodyId body;
  Contact contact;
};

/// A first touch along a sweep, and on which body.
struct BodyImpact {
  BodyId body;
  Impact impact;
};

}  // namespace touchmark
