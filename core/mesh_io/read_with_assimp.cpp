#include "core/mesh_io/read_with_assimp.h"

#include <exception>

#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include "core/triangle_mesh.h"

namespace touchmark::mesh_io {
namespace {

SceneGraph::Part part_of(const aiMesh& mesh, std::size_t number) {
  SceneGraph::Part part;
  for (unsigned i = 0; i < mesh.mNumVertices; ++i)
    part.vertices.emplace_back(mesh.mVertices[i].x, mesh.mVertices[i].y, mesh.mVertices[i].z);
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    if (face.mNumIndices < 3) continue;  // a point or a line
    for (unsigned k = 0; k < face.mNumIndices; ++k) {
      if (face.mIndices[k] >= mesh.mNumVertices) {
        throw MeshError("part " + std::to_string(number) + ": face " + std::to_string(i) + " names vertex " +
                        std::to_string(face.mIndices[k]) + " of " + std::to_string(mesh.mNumVertices));
      }
      part.corners.push_back(face.mIndices[k]);
    }
    part.ends.push_back(static_cast<std::uint32_t>(part.corners.size()));
  }
  return part;
}

Eigen::Matrix4d matrix_of(const aiMatrix4x4& m) {
  Eigen::Matrix4d matrix;
  matrix << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2, m.d3, m.d4;
  return matrix;
}

bool is_one_of(std::string_view endings, const std::string& ending) {
  return endings.find(" " + ending + " ") != std::string_view::npos;
}

/// Returns what brings the scene back into the axes of the file, which some importers turn so that y is up,
/// or mirror so that they are right-handed; those turn all faces, too.
Eigen::Matrix4d into_axes_of_file(const aiScene& scene, const std::string& ending) {
  Eigen::Matrix4d turn = Eigen::Matrix4d::Identity();
  turn.block<2, 2>(1, 1) << 0, 1, -1, 0;
  if (is_one_of(" .3ds .ase .ask .dxf .hmp .md3 .md5mesh .mdc .mdl .prj ", ending) &&
      matrix_of(scene.mRootNode->mTransformation) == turn)
    return turn.transpose();
  const double z = is_one_of(" .3d .b3d .lwo .lws .lxo .pmx .uc .x ", ending) ? -1 : 1;
  return Eigen::Vector4d(1, 1, z, 1).asDiagonal().toDenseMatrix();
}

/// Adds the nodes below, parents before children, each before what follows it in the file.
void add(const aiScene& scene, const aiNode& node, const Eigen::Matrix4d& parent, SceneGraph& graph) {
  const Eigen::Matrix4d transform = parent * matrix_of(node.mTransformation);
  if (node.mNumMeshes > 0) {
    graph.nodes.push_back({node.mName.C_Str(), transform, {node.mMeshes, node.mMeshes + node.mNumMeshes}});
    for (const std::size_t part : graph.nodes.back().parts) {
      if (part >= scene.mNumMeshes) {
        throw MeshError("part " + std::to_string(part) + " does not exist, the file has " +
                        std::to_string(scene.mNumMeshes));
      }
    }
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) add(scene, *node.mChildren[i], transform, graph);
}

constexpr unsigned steps = aiProcess_ValidateDataStructure;  // none that drops, merges or reorders faces

void expect_known_ending(const Assimp::Importer& importer, const std::string& ending) {
  if (ending.empty() || !importer.IsExtensionSupported(ending))
    throw MeshError("the ending '" + ending + "' is of no known mesh format");
}

/// What `read(importer)` makes of a file, checked.
template <class Read>
const aiScene& imported(Assimp::Importer& importer, const Read& read) {
  const aiScene* scene = nullptr;
  try {
    scene = read(importer);
  } catch (const std::exception& error) {
    throw MeshError(std::string("assimp failed: ") + error.what());
  }
  if (scene == nullptr || scene->mRootNode == nullptr) {
    std::string message = importer.GetErrorString();
    for (char& c : message) c = c == '\n' || c == '\r' ? ' ' : c;
    throw MeshError("assimp cannot read it: " + message);
  }
  if ((scene->mFlags & AI_SCENE_FLAGS_INCOMPLETE) != 0) throw MeshError("assimp calls it incomplete");
  return *scene;
}

}  // namespace

SceneGraph read_with_assimp(const std::filesystem::path& path, std::string_view bytes,
                            const std::string& ending) {
  Assimp::Importer importer;
  expect_known_ending(importer, ending);
  const aiScene& scene = imported(importer, [&](Assimp::Importer& reader) {
    return std::filesystem::is_regular_file(path)
               ? reader.ReadFile(path.string(), steps)
               : reader.ReadFileFromMemory(bytes.data(), bytes.size(), steps, ending.c_str() + 1);
  });
  SceneGraph graph;
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) graph.parts.push_back(part_of(*scene.mMeshes[i], i));
  add(scene, *scene.mRootNode, into_axes_of_file(scene, ending), graph);
  return graph;
}

}  // namespace touchmark::mesh_io
