#include "core/mesh_io/read_with_assimp.h"

#include <cmath>
#include <exception>
#include <map>
#include <utility>
#include <vector>

#include <Eigen/LU>
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

void add_part(const aiMesh& part, const aiMatrix4x4& transform, std::size_t number, MeshBuilder& mesh) {
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
    add_part(*scene.mMeshes[number], transform, number, mesh);
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) add(scene, *node.mChildren[i], transform, mesh);
}

using Matrix4 = Eigen::Matrix4d;

Matrix4 matrix_of(const aiMatrix4x4& m) {
  Matrix4 matrix;
  matrix << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2, m.d3, m.d4;
  return matrix;
}

/// What is wrong with a transform as a pose; empty where it only turns and moves. Files and assimp keep
/// single precision, of which a chain of nodes adds up a few roundings.
std::string why_not_rigid(const Matrix4& transform) {
  constexpr double rounding = 1e-5;
  if (!transform.allFinite()) return "is not finite";
  if ((transform.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).cwiseAbs().maxCoeff() > rounding)
    return "is a projection";
  const Eigen::Matrix3d linear = transform.topLeftCorner<3, 3>();
  const Eigen::Matrix3d gram = linear.transpose() * linear;
  const Vec3 lengths = gram.diagonal().cwiseSqrt();
  if ((lengths - Vec3::Ones()).cwiseAbs().maxCoeff() > rounding) {
    return "scales by " + std::to_string(lengths.x()) + ", " + std::to_string(lengths.y()) + ", " +
           std::to_string(lengths.z());
  }
  if ((gram - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() > 2 * rounding) return "shears";
  return linear.determinant() < 0 ? "mirrors" : "";
}

/// Collects the nodes that have meshes, parents before children, each before what follows it in the file.
class TreeReader {
 public:
  explicit TreeReader(const aiScene& scene) : scene_(scene) {}

  void visit(const aiNode& node, const Matrix4& parent) {
    const Matrix4 transform = parent * matrix_of(node.mTransformation);
    if (node.mNumMeshes > 0) add(node, transform);
    for (unsigned i = 0; i < node.mNumChildren; ++i) visit(*node.mChildren[i], transform);
  }
  NodeTree tree() && { return std::move(tree_); }

 private:
  void add(const aiNode& node, const Matrix4& transform) {
    const std::string name = node.mName.C_Str();
    const std::string fault = why_not_rigid(transform);
    if (!fault.empty()) {
      throw MeshError("node '" + name + "' (with its parents) " + fault +
                      "; the bodies of a scene are turned and moved only");
    }
    tree_.nodes.push_back(
        {name, mesh_of(node), transform.topLeftCorner<3, 3>(), transform.topRightCorner<3, 1>()});
  }

  /// Nodes with the same parts share one mesh.
  std::size_t mesh_of(const aiNode& node) {
    const std::vector<unsigned> parts(node.mMeshes, node.mMeshes + node.mNumMeshes);
    const auto [known, is_new] = meshes_.emplace(parts, tree_.meshes.size());
    if (!is_new) return known->second;
    MeshBuilder mesh;
    for (const unsigned number : parts) {
      if (number >= scene_.mNumMeshes)
        Part{number}.fail("does not exist, the file has " + std::to_string(scene_.mNumMeshes));
      add_part(*scene_.mMeshes[number], aiMatrix4x4(), number, mesh);
    }
    tree_.meshes.push_back(std::move(mesh).build());
    return known->second;
  }

  const aiScene& scene_;
  NodeTree tree_;
  std::map<std::vector<unsigned>, std::size_t> meshes_;
};

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

TriangleMesh read_with_assimp(std::string_view bytes, const std::string& ending) {
  Assimp::Importer importer;
  expect_known_ending(importer, ending);
  const aiScene& scene = imported(importer, [&](Assimp::Importer& reader) {
    return reader.ReadFileFromMemory(bytes.data(), bytes.size(), steps, ending.c_str() + 1);
  });
  MeshBuilder mesh;
  add(scene, *scene.mRootNode, aiMatrix4x4(), mesh);
  return std::move(mesh).build();
}

NodeTree read_tree_with_assimp(const std::filesystem::path& path, const std::string& ending) {
  Assimp::Importer importer;
  expect_known_ending(importer, ending);
  const aiScene& scene =
      imported(importer, [&](Assimp::Importer& reader) { return reader.ReadFile(path.string(), steps); });
  TreeReader reader(scene);
  reader.visit(*scene.mRootNode, Matrix4::Identity());
  NodeTree tree = std::move(reader).tree();
  if (tree.nodes.empty()) throw MeshError("no node has a mesh");
  return tree;
}

}  // namespace touchmark::mesh_io
