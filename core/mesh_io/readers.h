/// Strict readers of the formats that carry meshes between haptics programs. They keep every double of the
/// file and find truncation, wrong counts and wrong indices, naming the line or the byte. The id of a
/// triangle is the number of its face in the file, from 0; points and lines are no faces.
#pragma once

#include <string_view>

#include "core/triangle_mesh.h"

namespace touchmark::mesh_io {

/// PLY 1.0, ascii and binary of either byte order: faces and triangle strips, of which each triangle with
/// three different vertices is a face. Elements that hold no surface are skipped.
TriangleMesh read_ply(std::string_view bytes);
/// Wavefront OBJ: v and f; attributes, points, lines and curves are skipped, free-form surfaces, included
/// files and unknown statements are refused.
TriangleMesh read_obj(std::string_view bytes);
/// OFF, ascii, also without its header, and its forms with colours, normals or texture coordinates (COFF,
/// NOFF, STOFF...), with a fourth coordinate that divides the others (4OFF) and with a dimension of 3 (nOFF).
TriangleMesh read_off(std::string_view bytes);
/// STL, ascii, also with polygons, and binary. Corners with the same coordinates become one vertex; triangles
/// keep their numbers.
TriangleMesh read_stl(std::string_view bytes);

}  // namespace touchmark::mesh_io
