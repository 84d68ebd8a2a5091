/// What read_dae makes of a COLLADA node's transforms and of a geometry.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "core/mesh_io/dae/dae_document.h"
#include "core/mesh_io/scene_graph.h"

namespace touchmark::mesh_io {

/// Returns the matrix of <matrix>, <translate>, <rotate>, <scale>, <skew> or <lookat>; nothing for other
/// elements. Throws MeshError.
std::optional<Eigen::Matrix4d> dae_transform(const DaeDocument& document, const pugi::xml_node& element);

/// Returns the faces of a <geometry>, whose primitives share its vertices. Throws MeshError.
SceneGraph::Part dae_part(const DaeDocument& document, const pugi::xml_node& geometry);

}  // namespace touchmark::mesh_io
