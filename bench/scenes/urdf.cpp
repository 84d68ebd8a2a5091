#include "bench/scenes/urdf.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <console_bridge/console.h>
#include <fmt/format.h>
#include <urdf_parser/urdf_parser.h>

#include "bench/meshes/mesh_import.h"
#include "bench/meshes/surface_builder.h"
#include "bench/scenes/primitives.h"
#include "bench/support/files/text_file.h"
#include "core/scene/round/primitives.h"

namespace touchmark::bench::scenes {
namespace {

/// Keeps the library's first complaint, which it would print.
class FirstComplaint final : public console_bridge::OutputHandler {
 public:
  FirstComplaint() { console_bridge::useOutputHandler(this); }
  FirstComplaint(const FirstComplaint&) = delete;
  FirstComplaint& operator=(const FirstComplaint&) = delete;
  ~FirstComplaint() override { console_bridge::restorePreviousOutputHandler(); }

  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR && text_.empty())
      text_ = text.substr(0, text.find('\n'));
  }
  const std::string& text() const noexcept { return text_; }

 private:
  std::string text_;
};

Vec3 vector_of(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

/// Returns where something stands that has this place in the frame of what stands there.
Placement within(const Placement& outer, const urdf::Pose& inner) {
  const urdf::Rotation& r = inner.rotation;
  const Quaternion turn{r.w, r.x, r.y, r.z};
  return {image(pose_of(outer), vector_of(inner.position)), normalized(product(outer.orientation, turn))};
}

void expect_sizes(std::string_view shape, std::initializer_list<double> sizes) {
  for (const double size : sizes) {
    if (is_primitive_size(size)) continue;
    throw std::invalid_argument(fmt::format("{}: {} is no size, which is from {} to {}", shape, size,
                                            min_primitive_size, max_primitive_size));
  }
}

TriangleMesh cylinder(double length, double radius) {
  expect_sizes("cylinder", {length, radius});
  meshes::Surface surface;
  meshes::add_tube(surface, {{0, 0, -0.5 * length}, {0, 0, 0.5 * length}}, radius, cylinder_sides);
  return std::move(surface).mesh();
}

/// Returns the mesh with each coordinate times its own factor. A mirrored one is turned over, so that its
/// inside and its normals stay on their sides.
TriangleMesh stretched(const TriangleMesh& mesh, const Vec3& factors) {
  if (!factors.allFinite() || (factors.array() == 0).any())
    throw std::invalid_argument("a mesh's scale is 0 or not finite");
  std::vector<Vec3> vertices;
  for (const Vec3& v : mesh.vertices()) vertices.emplace_back(v.cwiseProduct(factors));
  std::vector<TriangleMesh::Corners> triangles(mesh.triangles().begin(), mesh.triangles().end());
  if ((factors.array() < 0).count() % 2 == 1)
    for (TriangleMesh::Corners& corners : triangles) std::swap(corners[1], corners[2]);
  return {std::move(vertices), std::move(triangles), {mesh.ids().begin(), mesh.ids().end()}};
}

class UrdfReader {
 public:
  UrdfReader(const std::string& path, const RosPackages& packages)
      : folder_(std::filesystem::path(path).parent_path()), packages_(packages) {}

  void add(const urdf::Link& link, const Placement& place) {
    link_ = link.name;
    std::vector<std::pair<urdf::Pose, urdf::GeometrySharedPtr>> parts;
    for (const auto& part : link.collision_array) parts.emplace_back(part->origin, part->geometry);
    if (parts.empty())
      for (const auto& part : link.visual_array) parts.emplace_back(part->origin, part->geometry);
    for (const auto& [origin, geometry] : parts) {
      if (!geometry) throw std::invalid_argument("has an element without geometry");
      const Placement stands = within(place, origin);
      if (!stands.position.allFinite() || !std::isfinite(dot(stands.orientation, stands.orientation)))
        throw std::invalid_argument("does not stand at numbers that are finite");
      scene_.bodies.push_back({link.name, shape_of(*geometry), stands});
    }
    for (const auto& joint : link.child_joints) {
      const auto child = std::ranges::find(link.child_links, joint->child_link_name,
                                           [](const urdf::LinkSharedPtr& one) { return one->name; });
      if (child != link.child_links.end())
        add(**child, within(place, joint->parent_to_joint_origin_transform));
    }
  }
  /// Returns how messages begin.
  std::string where() const { return link_.empty() ? "" : fmt::format("link \"{}\": ", link_); }
  BodyScene scene() && { return std::move(scene_); }

 private:
  std::size_t added(std::optional<RoundShape> round, TriangleMesh mesh) {
    const std::size_t index = scene_.shapes.size();
    if (round) scene_.round.emplace(index, *round);
    scene_.shapes.push_back(std::make_shared<const TriangleMesh>(std::move(mesh)));
    return index;
  }

  std::size_t shape_of(const urdf::Geometry& geometry) {
    switch (geometry.type) {
      case urdf::Geometry::BOX: {
        const Vec3 size = vector_of(dynamic_cast<const urdf::Box&>(geometry).dim);
        expect_sizes("box", {size.x(), size.y(), size.z()});
        return added(std::nullopt, box_mesh(size));
      }
      case urdf::Geometry::SPHERE: {
        const RoundShape sphere{0, dynamic_cast<const urdf::Sphere&>(geometry).radius};
        expect_sizes("sphere", {sphere.radius});
        return added(sphere, facets_of(sphere));
      }
      case urdf::Geometry::CYLINDER: {
        const auto& one = dynamic_cast<const urdf::Cylinder&>(geometry);
        return added(std::nullopt, cylinder(one.length, one.radius));
      }
      case urdf::Geometry::MESH:
        return mesh_of(dynamic_cast<const urdf::Mesh&>(geometry));
    }
    throw std::invalid_argument("has geometry of a kind that is not known");
  }

  std::size_t mesh_of(const urdf::Mesh& mesh) {
    const Vec3 scale = vector_of(mesh.scale);
    const auto key = std::tuple(mesh.filename, scale.x(), scale.y(), scale.z());
    if (const auto known = meshes_.find(key); known != meshes_.end()) return known->second;
    return meshes_[key] =
               added(std::nullopt, stretched(meshes::import_mesh(file_of(mesh.filename)).mesh, scale));
  }

  std::filesystem::path file_of(const std::string& address) const {
    constexpr std::string_view file = "file://", package = "package://";
    if (address.starts_with(file)) return address.substr(file.size());
    if (!address.starts_with(package)) {
      if (address.find("://") == std::string::npos) return folder_ / address;
      throw std::invalid_argument(fmt::format(
          "mesh \"{}\": only package://, file:// and paths from the URDF's folder are read", address));
    }
    const std::string path = address.substr(package.size());
    const std::size_t slash = path.find('/');
    if (slash == 0 || slash == std::string::npos)
      throw std::invalid_argument(fmt::format("mesh \"{}\": names no file of a package", address));
    const std::string name = path.substr(0, slash);
    if (const auto folder = packages_.folder_of(name)) return *folder / path.substr(slash + 1);
    throw std::invalid_argument(
        fmt::format("mesh \"{}\": package \"{}\" is in neither ROS_PACKAGE_PATH nor AMENT_PREFIX_PATH: say "
                    "where it is, --package {}=DIR",
                    address, name, name));
  }

  std::filesystem::path folder_;
  const RosPackages& packages_;
  BodyScene scene_;
  std::string link_;
  std::map<std::tuple<std::string, double, double, double>, std::size_t> meshes_;
};

}  // namespace

BodyScene read_urdf(const std::string& path, const RosPackages& packages) {
  const std::string text = support::read_text_file(path);
  const FirstComplaint complaint;
  const urdf::ModelInterfaceSharedPtr robot = urdf::parseURDF(text);
  if (!robot || !robot->getRoot())
    throw std::invalid_argument(fmt::format("{}: is no URDF: {}", path, complaint.text()));
  UrdfReader reader(path, packages);
  try {
    reader.add(*robot->getRoot(), {});
  } catch (const MeshError& error) {
    throw MeshError(fmt::format("{}: {}{}", path, reader.where(), error.what()));
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("{}: {}{}", path, reader.where(), error.what()));
  }
  BodyScene scene = std::move(reader).scene();
  if (scene.bodies.empty())
    throw std::invalid_argument(path + ": no link of the robot has collision or visual geometry");
  return scene;
}

}  // namespace touchmark::bench::scenes
