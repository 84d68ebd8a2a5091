/// The only file that knows which baselines were built: TOUCHMARK_WITH_NAME is 0 or 1.
#include "bench/roster.h"

#include <initializer_list>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/brute_force/brute_force.h"
#include "core/grid_group/grid_group.h"
#include "core/sphere_cluster/sphere_cluster.h"

#if TOUCHMARK_WITH_FCL
#include "baselines/fcl/fcl_detector.h"
#endif

namespace touchmark::bench {
namespace {

template <Detector D>
std::unique_ptr<Contestant> contestant(const TriangleMesh& mesh, const typename D::Options& options) {
  return std::make_unique<ContestantOf<D>>(D::build(mesh, options));
}

/// A choice's names with what they stand for. The first one is the default.
template <class Value>
using Names = std::vector<std::pair<std::string, Value>>;

template <class Value>
OptionInfo choice(std::string key, const Names<Value>& names, std::string summary) {
  OptionInfo option{std::move(key), OptionKind::choice, {}, names.front().first, std::move(summary)};
  for (const auto& [name, value] : names) option.choices.push_back(name);
  return option;
}

template <class Value>
Value chosen(const OptionValues& values, const std::string& key, const Names<Value>& names) {
  for (const auto& [name, value] : names) {
    if (name == values.text(key)) return value;
  }
  return names.front().second;  // the roster has checked it
}

ContestantInfo brute_force() {
  ContestantInfo info;
  info.name = "brute-force";
  info.summary = "every triangle, every time: both papers' \"without grouping\"";
  info.accuracy = "exact";
  info.queries = queries_of<BruteForce>();
  info.build = [](const TriangleMesh& mesh, const OptionValues&) { return contestant<BruteForce>(mesh, {}); };
  return info;
}

ContestantInfo grid_group() {
  static const Names<GridGroup::Lookup> lookups{{"direct", GridGroup::Lookup::direct},
                                                {"scan", GridGroup::Lookup::scan}};
  static const Names<GridGroup::Shape> shapes{{"cube", GridGroup::Shape::cube},
                                              {"sphere", GridGroup::Shape::sphere}};
  ContestantInfo info;
  info.name = "grid-group";
  info.summary = "triangles grouped by uniform cells, after Park & Jang 2018";
  info.accuracy = "exact";
  info.queries = queries_of<GridGroup>();
  info.options = {
      choice("lookup", lookups, "direct: the probe's own cell; scan: every group, as published"),
      choice("shape", shapes, "of the groups; scan only"),
      {"cell", OptionKind::length, {}, "0", "edge of a cell, direct: of the smallest; 0: choose"},
      {"groups", OptionKind::count, {}, "0", "scan with cell=0: aim at so many groups; 0: choose"},
      {"bytes_per_triangle", OptionKind::number, {}, "400", "direct: what the structure may take"}};
  info.build = [](const TriangleMesh& mesh, const OptionValues& values) {
    GridGroup::Options options;
    options.lookup = chosen(values, "lookup", lookups);
    options.shape = chosen(values, "shape", shapes);
    options.cell = values.length("cell", mesh);
    options.groups = values.count("groups");
    options.bytes_per_triangle = values.number("bytes_per_triangle");
    return contestant<GridGroup>(mesh, options);
  };
  return info;
}

ContestantInfo sphere_cluster() {
  static const Names<SphereCluster::Lookup> lookups{{"tree", SphereCluster::Lookup::tree},
                                                    {"scan", SphereCluster::Lookup::scan}};
  static const Names<bool> yes_or_no{{"true", true}, {"false", false}};
  ContestantInfo info;
  info.name = "sphere-cluster";
  info.summary = "triangles in clustered bounding spheres, after Choi & Sung 2017";
  info.accuracy = "exact; precise=false: conservative";
  info.queries = queries_of<SphereCluster>();
  info.options = {
      choice("lookup", lookups, "tree: a hierarchy, nearest first; scan: every sphere, as published"),
      {"clustering",
       OptionKind::length,
       {},
       "0",
       "distance between centroids that share a sphere; 0: a sphere each"},
      choice("precise", yes_or_no, "false: the published fast level alone, spheres for triangles")};
  info.build = [](const TriangleMesh& mesh, const OptionValues& values) {
    SphereCluster::Options options;
    options.lookup = chosen(values, "lookup", lookups);
    options.clustering = values.length("clustering", mesh);
    options.precise = chosen(values, "precise", yes_or_no);
    return contestant<SphereCluster>(mesh, options);
  };
  return info;
}

ContestantInfo fcl() {
  ContestantInfo info;
  info.name = "fcl";
  info.summary = "Flexible Collision Library: bounding volume hierarchies";
#if TOUCHMARK_WITH_FCL
  using baselines::FclDetector;
  using Volume = FclDetector::Volume;
  using Method = FclDetector::Method;
  using Narrow = FclDetector::Narrow;
  static const Names<Volume> volumes{{"kios", Volume::kios},
                                     {"obbrss", Volume::obbrss},
                                     {"obb", Volume::obb},
                                     {"rss", Volume::rss},
                                     {"aabb", Volume::aabb}};
  static const Names<Method> methods{
      {"collide", Method::collide}, {"traverse", Method::traverse}, {"distance", Method::distance}};
  static const Names<Narrow> narrows{{"fcl", Narrow::fcl}, {"exact", Narrow::exact}};
  info.accuracy = "approximate; bv=aabb with narrow=exact: exact";
  info.queries = queries_of<FclDetector>();
  info.options = {
      choice("bv", volumes, "the hierarchy's bounding volume"),
      choice("method", methods, "collide: as most programs use it; distance: best first, bounded"),
      choice("narrow", narrows, "exact: this project's kernel on the triangles FCL reaches")};
  info.build = [](const TriangleMesh& mesh, const OptionValues& values) {
    return contestant<FclDetector>(mesh, {chosen(values, "bv", volumes), chosen(values, "method", methods),
                                          chosen(values, "narrow", narrows)});
  };
#endif
  return info;
}

}  // namespace

const Roster& roster() {
  static const Roster all(
      {brute_force(), grid_group(), sphere_cluster(), fcl()},
      {"brute-force", "grid-group:lookup=scan", "grid-group:lookup=scan,shape=sphere", "grid-group",
       "sphere-cluster:lookup=scan", "sphere-cluster:lookup=scan,precise=false", "sphere-cluster", "fcl",
       "fcl:bv=aabb,method=distance,narrow=exact"});
  return all;
}

}  // namespace touchmark::bench
