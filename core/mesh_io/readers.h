/// Strict readers of the formats that carry meshes between haptics programs. They keep every double of the
/// file and find truncation, wrong counts and wrong indices, naming the line or the byte. The id of a
/// triangle is the number of its face in the file, from 0; points and lines are no faces.
#pragma once

#include <string_view>

#include "core/triangle_mesh.h"

namespace touchmark::mesh_io {

/// PLY 1.0, ascii and binary of either byte order. Elements other than `vertex` and `face` are skipped.
TriangleMesh read_ply(std::string_view bytes);
/// Wavefront OBJ: v and f; everything else that is known is skipped, unknown statements are refused.
TriangleMesh read_obj(std::string_view bytes);
/// OFF and its forms with colours, normals or texture coordinates (COFF, NOFF, STOFF...), ascii.
TriangleMesh read_off(std::string_view bytes);
/// STL, ascii and binary. Corners with the same coordinates become one vertex; triangles keep their numbers.
TriangleMesh read_stl(std::string_view bytes);

}  // namespace touchmark::mesh_io
