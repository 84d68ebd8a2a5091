#include "bench/meshes/mesh_import.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <optional>
#include <span>
#include <system_error>
#include <utility>
#include <vector>

#include "bench/meshes/mesh_lists.h"
#include "bench/support/files/raw_lists.h"
#include "bench/support/system/own_process.h"
#include "core/mesh_io_assimp/mesh_io_assimp.h"

namespace touchmark::bench::meshes {
namespace {

namespace fs = std::filesystem;

/// A process that reads a file writes one of these first.
enum Outcome : std::uint64_t { refused, read_whole };

support::ProcessLimits limits_for(const fs::path& path) {
  constexpr std::uint64_t least = 2'000'000'000, bytes_per_byte = 50;
  std::error_code ignored;
  const std::uintmax_t size = fs::is_regular_file(path, ignored) ? fs::file_size(path, ignored) : 0;
  return {std::max<std::uint64_t>(least, bytes_per_byte * size), std::chrono::seconds(60)};
}

void put(std::FILE* to, const MeshFile& file) {
  put_mesh(to, file.mesh);
  support::put_text(to, file.axes);
  support::put_text(to, file.unit);
}

MeshFile take_mesh_file(std::FILE* from) {
  TriangleMesh mesh = take_mesh(from);
  std::string axes = support::take_text(from), unit = support::take_text(from);
  return {std::move(mesh), std::move(axes), std::move(unit)};
}

void put(std::FILE* to, const NodeTree& tree) {
  support::put_number(to, tree.meshes.size());
  for (const TriangleMesh& mesh : tree.meshes) put_mesh(to, mesh);
  support::put_number(to, tree.nodes.size());
  for (const NodeTree::Node& node : tree.nodes) {
    support::put_text(to, node.name);
    support::put_number(to, node.mesh);
    support::put_list(to, std::span<const double>(node.rotation.data(), 9));
    support::put_list(to, std::span<const double>(node.translation.data(), 3));
    support::put_text(to, node.id);
  }
}

NodeTree take_node_tree(std::FILE* from) {
  NodeTree tree;
  for (std::uint64_t i = support::take_number(from); i > 0; --i) tree.meshes.push_back(take_mesh(from));
  for (std::uint64_t i = support::take_number(from); i > 0; --i) {
    NodeTree::Node node;
    node.name = support::take_text(from);
    node.mesh = support::take_number(from);
    node.rotation = Eigen::Matrix3d(support::take_list<double>(from, 9).data());
    node.translation = Vec3(support::take_list<double>(from, 3).data());
    node.id = support::take_text(from);
    tree.nodes.push_back(std::move(node));
  }
  return tree;
}

/// Returns what `load` reads in another process; nothing where there can be none.
template <class Result>
std::optional<Result> read_apart(const fs::path& path, Result (*load)(const fs::path&),
                                 Result (*take)(std::FILE*)) {
  const auto work = [&](std::FILE* to) {
    try {
      const Result result = load(path);
      support::put_number(to, read_whole);
      put(to, result);
    } catch (const MeshError& error) {
      support::put_number(to, refused);
      support::put_text(to, error.what());
    }
  };
  try {
    std::optional<std::string> bytes = support::in_own_process(work, limits_for(path));
    if (!bytes) return std::nullopt;
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> from(fmemopen(bytes->data(), bytes->size(), "r"),
                                                               std::fclose);
    if (support::take_number(from.get()) == refused) throw MeshError(support::take_text(from.get()));
    return take(from.get());
  } catch (const support::ProcessFailure& failure) {
    throw MeshError(path.string() + ": assimp " + failure.what() + "; export it as STL, PLY, OBJ or glTF");
  }
}

}  // namespace

ImportedMesh import_mesh(const fs::path& path) {
  if (is_read_strictly(path)) return {load_mesh_file(path)};
  if (auto file = read_apart(path, load_mesh_file_with_assimp, take_mesh_file)) return {std::move(*file)};
  return {load_mesh_file_with_assimp(path),
          "assimp read it in the program's own process, since the system made no other"};
}

NodeTree import_node_tree(const fs::path& path) {
  if (is_read_strictly(path)) return load_node_tree(path);
  if (auto tree = read_apart(path, load_node_tree_with_assimp, take_node_tree)) return std::move(*tree);
  return load_node_tree_with_assimp(path);
}

}  // namespace touchmark::bench::meshes
