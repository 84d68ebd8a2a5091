#include "bench/scenes/scene_source.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "bench/meshes/mesh_import.h"
#include "bench/scenes/body_scene.h"
#include "bench/scenes/scene_json.h"
#include "bench/scenes/urdf.h"
#include "bench/support/did_you_mean.h"
#include "bench/support/files/csv_reader.h"
#include "bench/support/system/available_memory.h"
#include "bench/trajectories/motion_field.h"

namespace touchmark::bench::scenes {
namespace {

// Recorded motions of bodies.

constexpr std::array<std::string_view, 9> columns{"time_s", "body", "x", "y", "z", "qw", "qx", "qy", "qz"};
constexpr std::size_t time_column = 0, body_column = 1, first_position = 2, first_orientation = 5;

struct Row {
  double time_s = 0;
  Placement placement;
};

/// The rows of one body, times ascending.
using Track = std::vector<Row>;
using Tracks = std::map<std::uint32_t, Track>;

Placement placement_at(const Track& track, double time_s) {
  const auto after = std::ranges::upper_bound(track, time_s, {}, &Row::time_s);
  if (after == track.begin()) return track.front().placement;
  const Row& before = *(after - 1);
  if (after == track.end() || before.time_s == time_s) return before.placement;
  // Halves cannot overflow.
  const double part = (time_s / 2 - before.time_s / 2) / (after->time_s / 2 - before.time_s / 2);
  return between(before.placement, after->placement, part);
}

class PoseReader {
 public:
  PoseReader(const std::string& path, const BodyScene& scene) : file_(path), numbers_(file_), scene_(scene) {
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
      bodies_.emplace(scene.bodies[i].name, static_cast<std::uint32_t>(i));
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
      if (!scene.bodies[i].id.empty()) bodies_.emplace(scene.bodies[i].id, static_cast<std::uint32_t>(i));
  }

  Tracks read() {
    read_header();
    while (file_.next(fields_)) add_row();
    if (tracks_.empty()) throw file_.error("no row follows the header");
    return std::move(tracks_);
  }

 private:
  void read_header() {
    if (!file_.next(fields_)) throw file_.error("is empty");
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const auto found = std::ranges::find(fields_, columns[i]);
      if (found == fields_.end()) throw file_.error(fmt::format("the header has no column {}", columns[i]));
      places_[i] = static_cast<std::size_t>(found - fields_.begin());
    }
    for (const std::string& field : fields_)
      if (std::ranges::find(columns, field) == columns.end())
        throw file_.error("unknown column " + trajectories::shown(field));
    if (fields_.size() != columns.size()) throw file_.error("the header has a column twice");
  }

  double number(std::size_t column) {
    return numbers_.read(fields_[places_[column]], std::string(columns[column]));
  }

  std::uint32_t body() const {
    const std::string& name = fields_[places_[body_column]];
    const auto found = bodies_.find(name);
    if (found != bodies_.end()) return found->second;
    std::vector<std::string> names;
    for (const Body& one : scene_.bodies) names.push_back(one.name);
    throw file_.error(fmt::format("the scene has no body {}; did you mean {}?", trajectories::shown(name),
                                  support::near_names(name, names)));
  }

  void add_row() {
    if (fields_.size() != columns.size())
      throw file_.error(fmt::format("the row has {} fields, the header {}", fields_.size(), columns.size()));
    Row row;
    row.time_s = number(time_column);
    for (std::size_t i = 0; i < 3; ++i)
      row.placement.position[static_cast<Eigen::Index>(i)] = number(first_position + i);
    Quaternion orientation{};
    for (std::size_t i = 0; i < 4; ++i) orientation[i] = number(first_orientation + i);
    if (orientation == Quaternion{}) throw file_.error("qw,qx,qy,qz is the quaternion of zeros");
    row.placement.orientation = orientation;
    Track& track = tracks_[body()];
    if (!track.empty() && !(row.time_s > track.back().time_s))
      throw file_.error(fmt::format("column time_s: {} is not after the row of this body before, {}",
                                    row.time_s, track.back().time_s));
    track.push_back(row);
  }

  support::CsvReader file_;
  trajectories::NumberReader numbers_;
  const BodyScene& scene_;
  std::unordered_map<std::string, std::uint32_t> bodies_;
  std::vector<std::string> fields_;
  std::array<std::size_t, columns.size()> places_{};
  Tracks tracks_;
};

/// Reads CSV with the header time_s,body,x,y,z,qw,qx,qy,qz, its columns in any order. The times of one body's
/// rows ascend; rows of several bodies may stand in any order. Between two rows the position is linear and
/// the orientation a slerp (`between`); before a body's first row and after its last it stays there. Bodies
/// without rows keep the scene's place. Throws std::invalid_argument, naming file and line, for a header or a
/// row of another form, an unknown body, anything that is not a finite number, a quaternion of zeros, times
/// that do not ascend, and no row at all.
BodyMotion read_poses(const std::string& path, const BodyScene& scene) {
  const auto tracks = std::make_shared<const Tracks>(PoseReader(path, scene).read());
  BodyMotion motion;
  for (const auto& [body, track] : *tracks) motion.moving.push_back(body);
  motion.at = [tracks](std::uint32_t body, double time_s) { return placement_at(tracks->at(body), time_s); };
  return motion;
}

/// A name that no node before has.
std::string unused(const std::string& name, std::set<std::string>& names) {
  const std::string base = name.empty() ? "node" : name;
  std::string unique = base;
  for (int i = 2; !names.insert(unique).second; ++i) unique = fmt::format("{}#{}", base, i);
  return unique;
}

BodyScene read_node_tree(const std::string& path) {
  NodeTree tree = meshes::import_node_tree(path);
  BodyScene scene;
  for (TriangleMesh& mesh : tree.meshes)
    scene.shapes.push_back(std::make_shared<const TriangleMesh>(std::move(mesh)));
  std::set<std::string> names;
  for (const NodeTree::Node& node : tree.nodes) {
    // The file's matrix is in single precision: a quaternion's is orthonormal to the last digits.
    const Eigen::Quaterniond turn(node.rotation);
    scene.bodies.push_back({unused(node.name, names),
                            node.mesh,
                            {node.translation, {turn.w(), turn.x(), turn.y(), turn.z()}},
                            node.id});
  }
  return scene;
}

BodyScene read_robot(const std::string& path, const std::vector<std::string>& packages) {
  BodyScene scene = read_urdf(path, RosPackages(packages));
  std::set<std::string> names;
  for (Body& body : scene.bodies) body.name = unused(body.name, names);
  return scene;
}

std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

void expect_a_file(const std::string& what) {
  std::error_code ignored;
  const bool looks_like_a_path = what.find_first_of("/.") != std::string::npos;
  if (looks_like_a_path || std::filesystem::exists(what, ignored)) return;
  std::vector<std::string> known;
  for (const BodySceneInfo& scene : body_scenes()) known.push_back(scene.name);
  throw std::invalid_argument(
      fmt::format("scene \"{}\": no generated scene and no file has this name; did you mean {}?", what,
                  support::near_names(what.substr(0, what.find(':')), known)));
}

GeneratedScene load_unmoved(const std::string& what, const std::vector<std::string>& packages) {
  if (std::optional<GeneratedScene> generated = generated_scene(what)) return *std::move(generated);
  expect_a_file(what);
  const std::filesystem::path path(what);
  const std::string ending = lower_case(path.extension().string());
  GeneratedScene loaded;
  loaded.scene = ending == ".json"   ? read_scene_json(what)
                 : ending == ".urdf" ? read_robot(what, packages)
                                     : read_node_tree(what);
  loaded.scene.name = path.filename().string();
  return loaded;
}

}  // namespace

GeneratedScene load_body_scene(const std::string& what, const std::string& poses,
                               const std::vector<std::string>& packages) {
  GeneratedScene loaded = load_unmoved(what, packages);
  if (!poses.empty()) loaded.motion = read_poses(poses, loaded.scene);
  return loaded;
}

}  // namespace touchmark::bench::scenes
