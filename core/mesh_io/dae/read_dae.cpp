#include "core/mesh_io/dae/read_dae.h"

#include <algorithm>
#include <array>
#include <span>
#include <unordered_map>
#include <utility>

#include <pugixml.hpp>

#include "core/mesh_io/dae/dae_parts.h"

namespace touchmark::mesh_io {
namespace {

using pugi::xml_node;

constexpr std::size_t max_depth = 1000;
constexpr std::size_t max_visits = std::size_t{1} << 20;  // beyond the elements that the file has
constexpr std::size_t max_placed = std::size_t{1}
                                   << 26;  // vertices and corners beyond those that the file has

// What stands beside transforms and geometries, and in a scene. All but nodes hold no faces.
constexpr std::array<std::string_view, 6> in_node = {"node",  "instance_node",   "asset",
                                                     "extra", "instance_camera", "instance_light"};
constexpr std::array<std::string_view, 4> in_scene = {"node", "asset", "extra", "evaluate_scene"};

class SceneReader {
 public:
  explicit SceneReader(std::string_view bytes)
      : document_(bytes),
        visits_left_(max_visits + document_.element_count()),
        room_left_(max_placed + bytes.size()) {}

  SceneGraph read() && {
    read_asset();
    const xml_node scene = shown_scene();
    Eigen::Matrix4d transform = Eigen::Matrix4d::Identity();
    transform.topLeftCorner<3, 3>() *= graph_.unit;
    for (const xml_node& child : scene.children())
      if (child.type() == pugi::node_element) expect_known(child, in_scene);
    add_children(scene, transform);
    if (!has_faces_) document_.fail(scene, "shows no triangles");
    return std::move(graph_);
  }

 private:
  /// Returns the metres of a unit; 1 where the file states none.
  double metres(const xml_node& unit) const {
    if (!unit.attribute("meter")) return 1;
    const double value = document_.number(unit, "meter");
    if (!(value > 0)) document_.fail(unit, "meter must be larger than 0");
    return value;
  }

  std::string axes(const xml_node& up_axis) const {
    if (!up_axis) return {};
    const DaeDocument::Words words = document_.words(up_axis);
    TextCursor cursor = words.cursor();
    const std::string axes(cursor.word());
    if ((axes != "X_UP" && axes != "Y_UP" && axes != "Z_UP") || !cursor.at_end())
      document_.fail(up_axis, mesh_io::quoted(words.text), " is none of X_UP, Y_UP, Z_UP");
    return axes;
  }

  /// An asset of a part of the file may state a unit and axes of its own, which must be the file's.
  void read_asset() {
    const xml_node asset = document_.only_child(document_.root(), "asset");
    const xml_node unit = document_.only_child(asset, "unit");
    graph_.axes = axes(document_.only_child(asset, "up_axis"));
    graph_.unit = metres(unit);
    graph_.states_unit = !unit.attribute("meter").empty();
    for (const xml_node& other : document_.all_of("asset")) {
      const xml_node other_unit = document_.only_child(other, "unit"),
                     up = document_.only_child(other, "up_axis");
      if (other_unit && metres(other_unit) != graph_.unit)
        document_.fail(other_unit, "is not the unit of the file");
      if (up && axes(up) != graph_.axes) document_.fail(up, "is not the up_axis of the file");
    }
  }

  /// The scene that the file names; else its only one.
  xml_node shown_scene() const {
    const xml_node scene = document_.only_child(document_.root(), "scene");
    const xml_node instance = document_.only_child(scene, "instance_visual_scene");
    if (instance) return document_.target(instance, "url", {"visual_scene"});
    const std::vector<xml_node>& scenes = document_.all_of("visual_scene");
    if (scenes.size() == 1) return scenes.front();
    document_.fail(document_.root(), "has ", scenes.size(),
                   " visual scenes and no <instance_visual_scene> that chooses one");
  }

  void add_node(const xml_node& node, const Eigen::Matrix4d& parent) {
    if (path_.size() == max_depth) document_.fail(node, "is deeper than ", max_depth, " nodes");
    path_.push_back(node);
    Eigen::Matrix4d transform = parent;
    std::vector<std::size_t> parts;
    for (const xml_node& child : node.children()) {
      if (child.type() != pugi::node_element) continue;
      if (visits_left_-- == 0)
        document_.fail(node, "<instance_node>s repeat more than ", max_visits, " elements");
      if (const auto local = dae_transform(document_, child)) {
        transform *= *local;
      } else if (child.name() == std::string_view("instance_geometry")) {
        parts.push_back(placed_part(child));
      } else {
        expect_known(child, in_node);
      }
    }
    const std::string id(document_.attribute(node, "id")), name(document_.attribute(node, "name"));
    if (!parts.empty()) graph_.nodes.push_back({name.empty() ? id : name, transform, std::move(parts), id});
    add_children(node, transform);
    path_.pop_back();
  }

  void add_children(const xml_node& parent, const Eigen::Matrix4d& transform) {
    for (const xml_node& child : parent.children()) {
      const std::string_view name = child.name();
      if (name == "node") add_node(child, transform);
      if (name != "instance_node") continue;
      const xml_node node = document_.target(child, "url", {"node"});
      if (std::find(path_.begin(), path_.end(), node) != path_.end())
        document_.fail(child, "names ", quoted(document_.attribute(child, "url")), ", a node that it is in");
      add_node(node, transform);
    }
  }

  void expect_known(const xml_node& child, std::span<const std::string_view> names) const {
    if (child.name() == std::string_view("instance_controller"))
      document_.fail(child, "skins and morphs are not read; export the mesh in the pose that it has");
    if (std::find(names.begin(), names.end(), child.name()) == names.end()) document_.fail_unknown(child);
  }

  std::size_t placed_part(const xml_node& instance) {
    const xml_node geometry = document_.target(instance, "url", {"geometry"});
    const auto [known, is_new] = parts_.emplace(geometry.hash_value(), graph_.parts.size());
    if (is_new) graph_.parts.push_back(dae_part(document_, geometry));
    const SceneGraph::Part& part = graph_.parts[known->second];
    const std::size_t size = part.vertices.size() + part.corners.size();
    if (size > room_left_)
      document_.fail(instance, "the instances up to here repeat more than ", max_placed,
                     " vertices and corners");
    room_left_ -= size;
    has_faces_ |= !part.ends.empty();
    return known->second;
  }

  DaeDocument document_;
  std::size_t visits_left_, room_left_;
  bool has_faces_ = false;
  SceneGraph graph_;
  std::vector<xml_node> path_;                          // from the scene to the node that is read
  std::unordered_map<std::size_t, std::size_t> parts_;  // of a geometry
};

}  // namespace

SceneGraph read_dae(std::string_view bytes) { return SceneReader(bytes).read(); }

}  // namespace touchmark::mesh_io
