/// Every exact form of every detector of core, behind one face.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bench/contestants/contestant.h"
#include "bench/scenes/displaced.h"
#include "core/aabb_tree/aabb_tree.h"
#include "core/brute_force/brute_force.h"
#include "core/grid_group/grid_group.h"
#include "core/sphere_cluster/sphere_cluster.h"

namespace touchmark {

struct ExactForm {
  std::string name;
  std::unique_ptr<bench::contestants::Contestant> detector;
};

/// Brute force comes first: the others must give its bits.
inline std::vector<ExactForm> exact_forms(const TriangleMesh& mesh) {
  std::vector<ExactForm> forms;
  const auto add = [&]<class D>(std::string name, D detector) {
    forms.push_back(
        {std::move(name), std::make_unique<bench::contestants::ContestantOf<D>>(std::move(detector))});
  };
  add("brute-force", BruteForce::build(mesh));
  add("aabb-tree", AabbTree::build(mesh));
  add("aabb-tree, a triangle a leaf", AabbTree::build(mesh, {1}));
  const double some = 0.05 * mesh.diagonal() < 1e300 ? 0.05 * mesh.diagonal() : 0;
  using Grid = GridGroup;
  add("grid-group, scan, cubes", Grid::build(mesh, {.lookup = Grid::Lookup::scan}));
  add("grid-group, scan, spheres",
      Grid::build(mesh, {.shape = Grid::Shape::sphere, .lookup = Grid::Lookup::scan}));
  add("grid-group, direct", Grid::build(mesh));
  add("grid-group, direct, small cells", Grid::build(mesh, {.cell = 0.2 * some}));
  // Some groups are made when the mesh is still elsewhere.
  const auto updated = [&]<class D>(D detector) {
    typename D::Session session;
    for (const Vec3& v : mesh.vertices()) detector.nearest({v, 0}, some, session);
    detector.update(mesh);
    return detector;
  };
  const TriangleMesh before = bench::scenes::displaced(mesh, 1);
  add("grid-group, direct, updated", updated(Grid::build(before)));
  add("grid-group, direct, lazy", Grid::build(mesh, {.construction = Grid::Construction::lazy}));
  add("grid-group, direct, lazy, updated",
      updated(Grid::build(before, {.construction = Grid::Construction::lazy})));
  using Cluster = SphereCluster;
  add("sphere-cluster, scan", Cluster::build(mesh, {.lookup = Cluster::Lookup::scan}));
  add("sphere-cluster, scan, clustered",
      Cluster::build(mesh, {.clustering = some, .lookup = Cluster::Lookup::scan}));
  add("sphere-cluster, tree", Cluster::build(mesh));
  add("sphere-cluster, tree, portable", Cluster::build(mesh, {.widest = Simd::portable}));
  add("sphere-cluster, tree, avx2", Cluster::build(mesh, {.widest = Simd::avx2}));
  add("sphere-cluster, tree, clustered", Cluster::build(mesh, {.clustering = some}));
  add("sphere-cluster, tree, updated", updated(Cluster::build(before)));
  add("sphere-cluster, tree, lazy", Cluster::build(mesh, {.construction = Cluster::Construction::lazy}));
  add("sphere-cluster, tree, lazy, updated",
      updated(Cluster::build(before, {.construction = Cluster::Construction::lazy})));
  return forms;
}

}  // namespace touchmark
