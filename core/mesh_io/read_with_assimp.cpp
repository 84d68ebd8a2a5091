#include "core/mesh_io/read_with_assimp.h"

#include <exception>
#include <vector>

#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include "core/mesh_io/mesh_file.h"

namespace touchmark::mesh_io {
namespace {

/// The part that the reader is in, for errors: assimp tells no lines.
struct Part {
  std::size_t number;
  [[noreturn]] void fail(const std::string& message) const {
    throw MeshError("part " + std::to_string(number) + ": " + message);
  }
};

void add(const aiMesh& part, const aiMatrix4x4& transform, std::size_t number, MeshBuilder& mesh) {
  const auto first = static_cast<std::int64_t>(mesh.vertex_count());
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const aiVector3D position = transform * part.mVertices[i];
    mesh.add_vertex({position.x, position.y, position.z});
  }
  std::vector<std::uint32_t> corners;
  for (unsigned i = 0; i < part.mNumFaces; ++i) {
    const aiFace& face = part.mFaces[i];
    if (face.mNumIndices < 3) continue;  // a point or a line
    corners.clear();
    for (unsigned k = 0; k < face.mNumIndices; ++k) {
      if (face.mIndices[k] >= part.mNumVertices) {
        Part{number}.fail("face " + std::to_string(i) + " names vertex " + std::to_string(face.mIndices[k]) +
                          " of " + std::to_string(part.mNumVertices));
      }
      corners.push_back(mesh.checked_corner(first + face.mIndices[k], Part{number}));
    }
    mesh.add_face(corners, Part{number});
  }
}

void add(const aiScene& scene, const aiNode& node, const aiMatrix4x4& parent, MeshBuilder& mesh) {
  const aiMatrix4x4 transform = parent * node.mTransformation;
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    const unsigned number = node.mMeshes[i];
    if (number >= scene.mNumMeshes)
      Part{number}.fail("does not exist, the file has " + std::to_string(scene.mNumMeshes));
    add(*scene.mMeshes[number], transform, number, mesh);
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) add(scene, *node.mChildren[i], transform, mesh);
}

}  // namespace

TriangleMesh read_with_assimp(std::string_view bytes, const std::string& ending) {
  Assimp::Importer importer;
  if (ending.empty() || !importer.IsExtensionSupported(ending)) {
    throw MeshError("the ending '" + ending + "' is of no known mesh format");
  }
  const aiScene* scene = nullptr;
  try {
    // No step that drops, merges or reorders faces.
    scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), aiProcess_ValidateDataStructure,
                                        ending.c_str() + 1);
  } catch (const std::exception& error) {
    throw MeshError(std::string("assimp failed: ") + error.what());
  }
  if (scene == nullptr || scene->mRootNode == nullptr) {
    std::string message = importer.GetErrorString();
    for (char& c : message) c = c == '\n' || c == '\r' ? ' ' : c;
    throw MeshError("assimp cannot read it: " + message);
  }
  if ((scene->mFlags & AI_SCENE_FLAGS_INCOMPLETE) != 0) throw MeshError("assimp calls it incomplete");
  MeshBuilder mesh;
  add(*scene, *scene->mRootNode, aiMatrix4x4(), mesh);
  return std::move(mesh).build();
}

}  // namespace touchmark::mesh_io
