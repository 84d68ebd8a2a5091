#include "bench/scenes/scene_source.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "bench/meshes/mesh_import.h"
#include "bench/scenes/poses_csv.h"
#include "bench/scenes/scene_json.h"
#include "bench/scenes/urdf.h"
#include "bench/support/did_you_mean.h"

namespace touchmark::bench::scenes {
namespace {

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
