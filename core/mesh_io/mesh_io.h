/// Meshes from files.
#pragma once

#include <filesystem>

#include "core/triangle_mesh.h"

namespace touchmark {

/// Reads a mesh; the id of a triangle is the number of its face in the file, from 0, and the triangles cut
/// from a polygon share it. PLY, OBJ, OFF and STL (by the file's ending, of any case) keep every double of
/// the file; every other format goes through assimp, which keeps single precision, and whose parts follow one
/// another in the order of its scene graph. Throws MeshError("PATH: what is wrong", with the line or the
/// byte) for everything else than a mesh that can be used.
TriangleMesh load_mesh(const std::filesystem::path& path);

}  // namespace touchmark
