/// glTF files.
#pragma once

#include <filesystem>
#include <string_view>

#include "core/mesh_io/scene_graph.h"

namespace touchmark::mesh_io {

/// Reads the triangles of a glTF 2.0 file's default scene, text or binary, and of its side files in `folder`:
/// lists, strips and fans, also of KHR_draco_mesh_compression, KHR_mesh_quantization and
/// EXT_mesh_gpu_instancing. Skins and morph targets change nothing. Every index is checked. Throws MeshError.
SceneGraph read_gltf(std::string_view bytes, const std::filesystem::path& folder);

}  // namespace touchmark::mesh_io
