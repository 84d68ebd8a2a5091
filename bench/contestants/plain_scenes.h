/// Scenes as programs have them without core/scene: every body asked in turn, or all triangles as one mesh.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "baselines/posed.h"
#include "bench/contestants/introduced.h"
#include "bench/contestants/rival_scene.h"
#include "bench/contestants/scene_player.h"
#include "core/aabb_tree/aabb_tree.h"
#include "core/grid_group/grid_group.h"
#include "core/sphere_cluster/sphere_cluster.h"

namespace touchmark::bench::contestants {

/// Asks every body, with a session for each.
template <Detector D>
class LoopedScene {
 public:
  using Session = typename baselines::PosedShapes<D>::Session;

  explicit LoopedScene(const scenes::PlacedScene& placed) : bodies_(posed(placed), {}) {}

  void place(std::uint32_t body, const Pose& pose) { bodies_.place(body, pose); }

  std::optional<BodyContact> nearest_body(const Probe& probe, double reach, Session& session) const {
    std::optional<BodyContact> best;
    for (std::uint32_t i = 0; i < bodies_.size(); ++i) bodies_.consider(i, probe, reach, session, best);
    return best;
  }
  std::optional<BodyImpact> first_hit_body(const Sweep& sweep, Session& session) const {
    std::optional<BodyImpact> first;
    for (std::uint32_t i = 0; i < bodies_.size(); ++i) bodies_.consider(i, sweep, session, first);
    return first;
  }

  std::size_t bytes() const noexcept { return bodies_.bytes(); }
  Accuracy accuracy() const noexcept { return bodies_.accuracy(); }

 private:
  baselines::PosedShapes<D> bodies_;
};

/// One detector over the triangles of all bodies, which stand.
template <Detector D>
class MergedScene {
 public:
  using Session = typename D::Session;

  explicit MergedScene(const scenes::PlacedScene& placed) : MergedScene(placed, merged(placed)) {}

  /// Bodies stand, so this is only told what it knows.
  void place(std::uint32_t, const Pose&) {}
  std::optional<BodyContact> nearest_body(const Probe& probe, double reach, Session& session) const noexcept {
    const std::optional<Contact> found = detector_.nearest(probe, reach, session);
    return found ? std::optional(owned(*found)) : std::nullopt;
  }
  std::optional<BodyImpact> first_hit_body(const Sweep& sweep, Session& session) const noexcept {
    const std::optional<Impact> found = detector_.first_hit(sweep, session);
    if (!found) return std::nullopt;
    const BodyContact contact = owned(found->contact);
    return BodyImpact{contact.body, {found->fraction, contact.contact}};
  }
  std::size_t bytes() const noexcept {
    return detector_.bytes() + first_.capacity() * sizeof(std::uint32_t) +
           ids_.capacity() * sizeof(TriangleId);
  }
  Accuracy accuracy() const noexcept { return baselines::with_poses(detector_.accuracy(), largest_); }

 private:
  MergedScene(const scenes::PlacedScene& placed, const TriangleMesh& mesh)
      : detector_(D::build(mesh, {})), largest_(baselines::largest_coordinate(mesh.bounds())) {
    std::uint32_t sum = 0;
    for (const scenes::PlacedScene::PlacedBody& body : placed.bodies) {
      const TriangleMesh& shape = *placed.shapes[body.shape];
      first_.push_back(sum);
      sum += static_cast<std::uint32_t>(shape.size());
      for (std::size_t i = 0; i < shape.size(); ++i) ids_.push_back(shape.id(i));
    }
  }

  static TriangleMesh merged(const scenes::PlacedScene& placed) {
    expect_triangles(placed);
    if (placed.moves) throw std::invalid_argument("its triangles are one mesh, and the bodies move");
    std::vector<Vec3> vertices;
    std::vector<TriangleMesh::Corners> triangles;
    for (const scenes::PlacedScene::PlacedBody& body : placed.bodies) {
      const TriangleMesh& shape = *placed.shapes[body.shape];
      const auto first = static_cast<std::uint32_t>(vertices.size());
      for (const Vec3& vertex : shape.vertices()) vertices.push_back(image(body.start, vertex));
      for (const TriangleMesh::Corners& corners : shape.triangles())
        triangles.push_back({first + corners[0], first + corners[1], first + corners[2]});
    }
    return {std::move(vertices), std::move(triangles)};
  }

  BodyContact owned(Contact contact) const noexcept {
    const auto after = std::ranges::upper_bound(first_, contact.triangle);
    const auto body = static_cast<std::uint32_t>(after - first_.begin() - 1);
    contact.triangle = ids_[contact.triangle];
    return {{body, 0}, contact};
  }

  D detector_;
  double largest_;
  std::vector<std::uint32_t> first_;  ///< triangle of each body
  std::vector<TriangleId> ids_;       ///< in its body, of each triangle
};

/// Returns the entry of such a scene over one of our detectors, which its option `of` names.
template <template <class> class SceneOf>
ContestantInfo plain_scene_entry(std::string name, int rank, std::string summary) {
  ContestantInfo info = introduced(std::move(name), rank, std::move(summary), "exact");
  info.queries = queries_of<SphereCluster>();
  info.options = {{"of",
                   OptionKind::choice,
                   {"sphere-cluster", "grid-group", "aabb-tree"},
                   "sphere-cluster",
                   "the detector, in its default form"}};
  info.scenes_only = true;
  info.build = [](const TriangleMesh&, const OptionValues&) -> std::unique_ptr<Contestant> {
    throw std::invalid_argument("it is of scenes of bodies: --scene");
  };
  info.build_scene = [](const scenes::PlacedScene& placed, const OptionValues& values) {
    const auto over = [&]<Detector D>(std::type_identity<D>) {
      return scene_contestant(placed, [](const scenes::PlacedScene& one) { return SceneOf<D>(one); });
    };
    const std::string& of = values.text("of");
    return of == "grid-group"  ? over(std::type_identity<GridGroup>())
           : of == "aabb-tree" ? over(std::type_identity<AabbTree>())
                               : over(std::type_identity<SphereCluster>());
  };
  info.forms = {.scenes = {""}};
  return info;
}

}  // namespace touchmark::bench::contestants
