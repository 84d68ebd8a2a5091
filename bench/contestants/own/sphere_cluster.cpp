#include "core/sphere_cluster/sphere_cluster.h"

#include "bench/contestants/entry.h"

namespace touchmark::bench::contestants {

ContestantInfo sphere_cluster_entry() {
  static const Names<SphereCluster::Lookup> lookups{{"tree", SphereCluster::Lookup::tree},
                                                    {"scan", SphereCluster::Lookup::scan}};
  static const Names<Simd> widths{
      {"avx512", Simd::avx512}, {"avx2", Simd::avx2}, {"portable", Simd::portable}};
  static const Names<SphereCluster::Construction> constructions{{"whole", SphereCluster::Construction::whole},
                                                                {"lazy", SphereCluster::Construction::lazy}};
  ContestantInfo info;
  info.name = "sphere-cluster";
  info.rank = 40;
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
      choice("precise", yes_or_no, "false: the published fast level alone, spheres for triangles"),
      certified_option(),
      choice("build", constructions,
             "tree; lazy: distances all around are sampled by the first queries that want them"),
      choice("prepare", no_or_yes,
             "true: list triangles for the next step in the idle rest of a tick, clocked apart"),
      choice("simd", widths, "tree: no wider instructions than these, nor than the processor's"),
      updated_option(),
      side_option()};
  info.build = [](const TriangleMesh& mesh, const OptionValues& values) {
    SphereCluster::Options options;
    options.lookup = chosen(values, "lookup", lookups);
    options.clustering = values.length("clustering", mesh);
    options.precise = chosen(values, "precise", yes_or_no);
    options.certified = chosen(values, "certified", yes_or_no);
    options.widest = chosen(values, "simd", widths);
    options.construction = chosen(values, "build", constructions);
    return chosen(values, "prepare", no_or_yes)
               ? contestant<SphereCluster, Prefetch::on>(mesh, options, values)
               : contestant<SphereCluster>(mesh, options, values);
  };
  info.forms = {
      .compared = {"lookup=scan", "lookup=scan,precise=false", ""},
      .verified = {"clustering=2%", "build=lazy", "prepare=true", "updated=true", "build=lazy,updated=true",
                   "lookup=scan,clustering=2%", "lookup=scan,clustering=2%,precise=false"},
      .frontier = {"", "certified=false", "clustering=2%", "precise=false", "clustering=0.5%,precise=false",
                   "clustering=1%,precise=false", "clustering=2%,precise=false",
                   "clustering=5%,precise=false"},
      .scaled = {""},
      .updated = {""},
      .tested = {"simd=portable", "simd=avx2"}};
  return info;
}

}  // namespace touchmark::bench::contestants
