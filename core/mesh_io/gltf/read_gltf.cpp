#include "core/mesh_io/gltf/read_gltf.h"

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "core/mesh_io/gltf/gltf_accessor.h"
#include "core/mesh_io/gltf/gltf_document.h"
#include "core/mesh_io/gltf/gltf_primitive.h"

namespace touchmark::mesh_io {
namespace {

using Eigen::Matrix4d;

/// Three decimals of each of four numbers, and one of eight bits.
constexpr double max_written_rounding = 4 * 0.0005 / 2, max_packed_rounding = 1.0 / 127;

/// Translation, rotation (x, y, z, w) and scale.
struct Placement {
  std::array<double, 3> translation{0, 0, 0};
  std::array<double, 4> rotation{0, 0, 0, 1};
  std::array<double, 3> scale{1, 1, 1};

  /// `place` can fail(message), for a rotation that is none beyond the rounding of its length.
  template <class Place>
  Matrix4d matrix(const Place& place, double rounding) const {
    const auto [x, y, z, w] = rotation;
    const double length = std::sqrt(x * x + y * y + z * z + w * w);
    if (!(std::abs(length - 1) <= rounding))
      place.fail("its rotation is a quaternion of length " + std::to_string(length) + " instead of 1");
    Matrix4d result = Matrix4d::Identity();
    result.topLeftCorner<3, 3>() =
        Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix() * Vec3::Map(scale.data()).asDiagonal();
    result.topRightCorner<3, 1>() = Vec3::Map(translation.data());
    return result;
  }
};

Matrix4d transform_of(const JsonValue& node) {
  const auto translation = node.find("translation"), rotation = node.find("rotation"),
             scale = node.find("scale");
  if (const std::optional<JsonValue> matrix = node.find("matrix")) {
    if (translation || rotation || scale) node.fail("has a matrix and a translation, rotation or scale");
    return Matrix4d::Map(matrix->numbers<16>().data());  // by columns, as Eigen has them
  }
  Placement placement;
  if (translation) placement.translation = translation->numbers<3>();
  if (rotation) placement.rotation = rotation->numbers<4>();
  if (scale) placement.scale = scale->numbers<3>();
  return placement.matrix(node, max_written_rounding);
}

/// Returns the places that EXT_mesh_gpu_instancing gives a node's mesh, in the node's frame.
std::vector<Matrix4d> instances_of(const GltfDocument& document, const JsonValue& attributes) {
  const auto accessor = [&](const char* name, const char* type) {
    std::optional<GltfAccessor> found;
    if (const auto index = attributes.find(name))
      found.emplace(document, *index, type, GltfAccessor::Use::attribute);
    return found;
  };
  const auto translation = accessor("TRANSLATION", "VEC3"), rotation = accessor("ROTATION", "VEC4"),
             scale = accessor("SCALE", "VEC3");
  std::optional<std::size_t> count;
  for (const auto* one : {&translation, &rotation, &scale}) {
    if (!*one) continue;
    if (count && *count != (*one)->count()) attributes.fail("its accessors differ in their count");
    count = (*one)->count();
  }
  if (!count) attributes.fail("has neither TRANSLATION nor ROTATION nor SCALE");
  std::vector<Matrix4d> instances;
  const auto read = [](const auto& from, std::size_t i, auto& to) {
    for (std::size_t k = 0; from && k < to.size(); ++k) to[k] = from->number(i, k);
  };
  for (std::size_t i = 0; i < *count; ++i) {
    Placement placement;
    read(translation, i, placement.translation);
    read(rotation, i, placement.rotation);
    read(scale, i, placement.scale);
    instances.push_back(placement.matrix(attributes, max_packed_rounding));
  }
  return instances;
}

/// Parents and children, checked to be trees.
class Nodes {
 public:
  explicit Nodes(const GltfDocument& document) : list_(document.root().find("nodes")) {
    const std::size_t size = list_ ? list_->size() : 0;
    parents_.resize(size, none);
    children_.resize(size);
    for (std::size_t i = 0; i < size; ++i) {
      const std::optional<JsonValue> children = (*list_)[i].find("children");
      for (std::size_t k = 0; children && k < children->size(); ++k) add_child(document, i, (*children)[k]);
    }
    refuse_cycles();
  }

  std::size_t size() const noexcept { return parents_.size(); }
  bool has_parent(std::size_t node) const { return parents_[node] != none; }
  const std::vector<std::size_t>& children(std::size_t node) const { return children_[node]; }
  JsonValue operator[](std::size_t node) const { return (*list_)[node]; }

 private:
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  void add_child(const GltfDocument& document, std::size_t parent, const JsonValue& index) {
    document.named_by(index, "nodes");
    const std::size_t child = index.whole();
    if (has_parent(child))
      index.fail("nodes[" + std::to_string(child) + "] is also a child of nodes[" +
                 std::to_string(parents_[child]) + "]");
    parents_[child] = parent;
    children_[parent].push_back(child);
  }

  /// With one parent each, what no root reaches is on a cycle or below one.
  void refuse_cycles() const {
    std::vector<bool> reached(size());
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < size(); ++i)
      if (!has_parent(i)) open.push_back(i);
    while (!open.empty()) {
      const std::size_t node = open.back();
      open.pop_back();
      reached[node] = true;
      open.insert(open.end(), children_[node].begin(), children_[node].end());
    }
    for (std::size_t i = 0; i < size(); ++i) {
      if (reached[i]) continue;
      std::size_t on_cycle = i;
      for (std::size_t step = 0; step < size(); ++step) on_cycle = parents_[on_cycle];
      (*this)[on_cycle].fail("is a child of itself, directly or through its children");
    }
  }

  std::optional<JsonValue> list_;
  std::vector<std::size_t> parents_;
  std::vector<std::vector<std::size_t>> children_;
};

class GltfReader {
 public:
  GltfReader(std::string_view bytes, const std::filesystem::path& folder)
      : document_(bytes, folder), nodes_(document_), primitives_(document_) {}

  SceneGraph graph() && {
    struct Open {
      std::size_t node;
      Matrix4d parent;
    };
    std::vector<Open> open;  // a stack: the next node is the last
    const auto push = [&](const std::vector<std::size_t>& nodes, const Matrix4d& parent) {
      for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) open.push_back({*node, parent});
    };
    push(roots(), Matrix4d::Identity());
    while (!open.empty()) {
      const Open next = open.back();
      open.pop_back();
      const JsonValue node = nodes_[next.node];
      const Matrix4d transform = next.parent * transform_of(node);
      if (const std::optional<JsonValue> mesh = node.find("mesh")) add(node, *mesh, transform);
      push(nodes_.children(next.node), transform);
    }
    return std::move(graph_);
  }

 private:
  /// Those of the default scene, else of the first; in a file without scenes every node that has no parent.
  std::vector<std::size_t> roots() const {
    std::vector<std::size_t> roots;
    const std::optional<JsonValue> stated = document_.root().find("scene"),
                                   scenes = document_.root().find("scenes");
    if (!stated && (!scenes || scenes->size() == 0)) {
      for (std::size_t i = 0; i < nodes_.size(); ++i)
        if (!nodes_.has_parent(i)) roots.push_back(i);
      return roots;
    }
    const JsonValue scene = stated ? document_.named_by(*stated, "scenes") : (*scenes)[0];
    const std::optional<JsonValue> list = scene.find("nodes");
    std::set<std::size_t> seen;
    for (std::size_t i = 0; list && i < list->size(); ++i) {
      document_.named_by((*list)[i], "nodes");
      roots.push_back((*list)[i].whole());
      if (nodes_.has_parent(roots.back())) (*list)[i].fail("names a node that has a parent");
      if (!seen.insert(roots.back()).second) (*list)[i].fail("names a node a second time");
    }
    return roots;
  }

  void add(const JsonValue& node, const JsonValue& mesh, const Matrix4d& transform) {
    const std::optional<JsonValue> name = node.find("name");
    SceneGraph::Node added{name ? name->text() : "", transform, parts_of(mesh)};
    const std::optional<JsonValue> extensions = node.find("extensions");
    const auto instancing = extensions ? extensions->find("EXT_mesh_gpu_instancing") : std::nullopt;
    if (!instancing) {
      graph_.nodes.push_back(std::move(added));
      return;
    }
    for (const Matrix4d& instance : instances_of(document_, instancing->at("attributes"))) {
      added.transform = transform * instance;
      graph_.nodes.push_back(added);
    }
  }

  const std::vector<std::size_t>& parts_of(const JsonValue& index) {
    const JsonValue mesh = document_.named_by(index, "meshes");
    const auto [known, is_new] = parts_.try_emplace(index.whole());
    if (is_new) {
      const JsonValue primitives = mesh.at("primitives");
      for (std::size_t i = 0; i < primitives.size(); ++i) {
        known->second.push_back(graph_.parts.size());
        graph_.parts.push_back(primitives_.part(primitives[i]));
      }
    }
    return known->second;
  }

  GltfDocument document_;
  Nodes nodes_;
  GltfPrimitives primitives_;
  SceneGraph graph_;
  std::map<std::size_t, std::vector<std::size_t>> parts_;  // of the meshes so far
};

}  // namespace

SceneGraph read_gltf(std::string_view bytes, const std::filesystem::path& folder) {
  return GltfReader(bytes, folder).graph();
}

}  // namespace touchmark::mesh_io
