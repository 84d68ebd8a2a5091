#include "core/sphere_cluster/sphere_cluster.h"

#include "bench/contestants/entry.h"
#include "bench/contestants/own_scene.h"

namespace touchmark::bench::contestants {

namespace {

const Names<SphereCluster::Lookup>& lookups() {
  static const Names<SphereCluster::Lookup> names{{"tree", SphereCluster::Lookup::tree},
                                                  {"scan", SphereCluster::Lookup::scan}};
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
      in_code(
          choice("lookup", lookups(), "tree: a hierarchy, nearest first; scan: every sphere, as published"),
          "lookup", "SphereCluster::Lookup"),
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
  options.lookup = chosen(values, "lookup", lookups());
  options.clustering = values.length("clustering", mesh);
  options.precise = chosen(values, "precise", yes_or_no);
  options.certified = chosen(values, "certified", yes_or_no);
  options.widest = chosen(values, "simd", widths());
  options.construction = chosen(values, "build", constructions());
  options.threads = threads_of(values);
  return options;
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
    const SphereCluster::Options options = options_of(mesh, values);
    return chosen(values, "prepare", no_or_yes)
               ? contestant<SphereCluster, Prefetch::on>(mesh, options, values)
               : contestant<SphereCluster>(mesh, options, values);
  };
  info.build_scene = build_own_scene<SphereCluster>(&options_of);
  info.library = {"sphere_cluster", "SphereCluster"};
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
