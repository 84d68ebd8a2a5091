/// COLLADA files.
#pragma once

#include <string_view>

#include "core/mesh_io/scene_graph.h"

namespace touchmark::mesh_io {

/// Reads the faces of the scene that a COLLADA 1.4 or 1.5 file shows, with the transforms of its nodes and
/// the file's unit. `up_axis` turns nothing. Every count and index is checked. Skins, morphs, curves, holes
/// and other files are refused by name. Throws MeshError.
SceneGraph read_dae(std::string_view bytes);

}  // namespace touchmark::mesh_io
