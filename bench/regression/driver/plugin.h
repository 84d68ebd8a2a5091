/// What the regression gate knows of one build of the core: a C interface, so that two builds can be loaded
/// into one process. The plug-in's source is always the one under judgement; the core behind it is either
/// revision's, seen through its public headers alone.
#pragma once

#include <cstddef>
#include <cstdint>

#pragma GCC visibility push(default)
extern "C" {

/// Lengths are in mesh units; three doubles a vertex, three vertices a triangle.
struct TouchmarkGateMesh {
  const double* vertices;
  std::size_t vertex_count;
  const std::uint32_t* triangles;
  std::size_t triangle_count;
};

enum TouchmarkGateQuery { touchmark_gate_touches, touchmark_gate_nearest, touchmark_gate_sweep };

/// One pass along a trajectory with a fresh session. A sweep goes from the centre before to this one; the
/// first stands still.
struct TouchmarkGatePass {
  TouchmarkGateQuery query;
  const double* centers;  ///< three a step
  std::size_t count;
  double radius;
  double reach;  ///< for `nearest`
};

/// What a pass gives; equal on every machine for equal meshes and passes.
struct TouchmarkGateResult {
  std::uint64_t cells, spheres, boxes, triangles;  ///< the session's work counters
  std::uint64_t answers;  ///< a checksum: whether found, triangle, distance and fraction, in order
  std::uint64_t details;  ///< a checksum over points and normals; `answer` only
};

struct TouchmarkGateDetector;

/// Null where the detector is unknown to this core or refuses the mesh; then `error` holds one line, cut to
/// its size.
TouchmarkGateDetector* touchmark_gate_build(const char* name, const TouchmarkGateMesh* mesh, char* error,
                                            std::size_t error_size);
/// Every answer in full.
void touchmark_gate_answer(const TouchmarkGateDetector* detector, const TouchmarkGatePass* pass,
                           TouchmarkGateResult* result);
/// The pass that is timed and whose instructions are counted.
void touchmark_gate_replay(const TouchmarkGateDetector* detector, const TouchmarkGatePass* pass,
                           TouchmarkGateResult* result);
void touchmark_gate_destroy(TouchmarkGateDetector* detector);
}
#pragma GCC visibility pop
