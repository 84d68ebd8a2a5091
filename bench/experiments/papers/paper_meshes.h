/// The meshes of the papers, or the nearest thing that is there.
#pragma once

#include <string>
#include <vector>

#include "core/triangle_mesh.h"

namespace touchmark::bench::experiments::papers {

struct PaperMesh {
  std::string name;  ///< without folders
  TriangleMesh mesh;
  std::string origin;  ///< a sentence for the report: the paper's own mesh, or what stands in for it
};

/// Choi & Sung's level 0: the bunny of the CHAI3D distribution, 902 triangles. `requested` is a mesh or
/// file; empty: bunny-902.ply or bunny.obj in the models' folder, if it is that mesh, else the bunny (or what
/// stands in for it) decimated to about 900. Throws as load_mesh and decimate do.
PaperMesh choi_sung_mesh(const std::string& requested);

/// Park & Jang's bunny, whose resolution is not printed: those of the Stanford laboratory (948, 3,851, 16,301
/// triangles, from the models' folder, or decimated) and the whole bunny, which is decimated where it is
/// used. `requested` replaces them.
std::vector<PaperMesh> park_jang_meshes(const std::vector<std::string>& requested, bool quick);

/// Returns true if it is the mesh that Choi & Sung used, so that their counts must come out.
bool is_choi_sungs_bunny(const TriangleMesh& mesh);

}  // namespace touchmark::bench::experiments::papers
