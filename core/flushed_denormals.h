/// Meshes whose coordinates need denormal numbers, in a thread that flushes these to zero.
#pragma once

namespace touchmark {

class TriangleMesh;

/// Throws MeshError where the calling thread flushes denormal numbers (FTZ or DAZ) and a coordinate is below
/// 2^-900 but not 0: it or a difference could become 0 (docs/exactness.md, E9). The constructor of
/// TriangleMesh and every `build` call it.
void check_flushed_denormals(const TriangleMesh& mesh);

}  // namespace touchmark
