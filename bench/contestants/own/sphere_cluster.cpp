#include "core/sphere_cluster/sphere_cluster.h"

#include "bench/contestants/entry.h"
#include "bench/contestants/own_scene.h"
#include "core/named/published_form.h"
#include "core/sphere_cluster/published/published_sphere_cluster.h"

namespace touchmark::bench::contestants {

namespace {

const Names<bool>& lookups() {
  static const Names<bool> names{{"tree", false}, {"scan", true}};
  return names;
}

const Names<Simd>& widths() {
  static const Names<Simd> names{{"avx2", Simd::avx2}, {"avx512", Simd::avx2}, {"portable", Simd::portable}};
  return names;
}

const Names<SphereCluster::Construction>& constructions() {
  static const Names<SphereCluster::Construction> names{{"whole", SphereCluster::Construction::whole},
                                                        {"lazy", SphereCluster::Construction::lazy}};
  return names;
}

std::vector<OptionInfo> options() {
  return {
      choice("lookup", lookups(), "tree: a hierarchy, nearest first; scan: every sphere, as published"),
      in_code({"clustering",
               OptionKind::length,
               {},
               "0",
               "distance between centroids that share a sphere; 0: a sphere each"},
              "clustering"),
      in_code(choice("precise", yes_or_no, "false: the published fast level alone, spheres for triangles"),
              "precise"),
      certified_option(),
      in_code(choice("build", constructions(),
                     "tree; lazy: parts of it are built, and distances sampled, by the first queries that "
                     "want them"),
              "construction", "SphereCluster::Construction"),
      choice("prepare", no_or_yes,
             "true: list triangles for the next step and ask ahead before each query, clocked apart"),
      in_code(choice("simd", widths(),
                     "tree: no wider instructions than these, nor than the processor's; avx512 is avx2"),
              "widest", "Simd"),
      threads_option(),
      updated_option(),
      side_option()};
}

SphereCluster::Options options_of(const TriangleMesh& mesh, const OptionValues& values) {
  SphereCluster::Options options;
  options.clustering = values.length("clustering", mesh);
  options.certified = chosen(values, "certified", yes_or_no);
  options.widest = chosen(values, "simd", widths());
  options.construction = chosen(values, "build", constructions());
  options.threads = threads_of(values);
  return options;
}

bool is_published(const OptionValues& values) {
  return chosen(values, "lookup", lookups()) || !values.flag("precise");
}

PublishedSphereCluster::Options published_options_of(const TriangleMesh& mesh, const OptionValues& values) {
  named::expect_published(options_of(mesh, values));
  return {values.length("clustering", mesh), values.flag("precise")};
}

}  // namespace

ContestantInfo sphere_cluster_entry() {
  ContestantInfo info;
  info.name = "sphere-cluster";
  info.former_names = {{"auto", {"query", "reach", "speed", "bytes_per_triangle", "trial", "chose"}}};
  info.rank = 40;
  info.summary = "triangles in clustered bounding spheres, after Choi & Sung 2017";
  info.accuracy = "exact; precise=false: conservative";
  info.queries = queries_of<SphereCluster>();
  info.options = options();
  info.build = [](const TriangleMesh& mesh, const OptionValues& values) {
    if (is_published(values))
      return prepared_contestant<PublishedSphereCluster>(mesh, published_options_of(mesh, values), values);
    return prepared_contestant<SphereCluster>(mesh, options_of(mesh, values), values);
  };
  info.build_scene = [](const scenes::PlacedScene& placed, const OptionValues& values) {
    return is_published(values)
               ? build_own_scene<PublishedSphereCluster>(&published_options_of)(placed, values)
               : build_own_scene<SphereCluster>(&options_of)(placed, values);
  };
  info.library = [](const OptionValues& values) -> LibraryClass {
    if (!is_published(values)) return {"sphere_cluster", "SphereCluster"};
    return {"published_sphere_cluster", "PublishedSphereCluster", {"prepare", "simd", "threads"}};
  };
  info.forms = {.compared = {"lookup=scan", "lookup=scan,precise=false", ""},
                .verified = {"clustering=2%", "build=lazy", "threads=2", "prepare=true", "updated=true",
                             "build=lazy,updated=true", "lookup=scan,clustering=2%",
                             "lookup=scan,clustering=2%,precise=false"},
                .frontier = {"", "certified=false", "clustering=2%", "precise=false",
                             "clustering=0.5%,precise=false", "clustering=1%,precise=false",
                             "clustering=2%,precise=false", "clustering=5%,precise=false"},
                .scaled = {""},
                .chosen = {"prepare=true"},
                .updated = {""},
                .suite = {""},
                .scenes = {""},
                .tested = {"simd=portable"}};
  return info;
}

}  // namespace touchmark::bench::contestants
