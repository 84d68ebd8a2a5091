#include "core/sphere_cluster/sphere_cluster.h"

#include "bench/contestants/budgeted.h"
#include "bench/contestants/introduced.h"
#include "bench/contestants/own_options.h"
#include "bench/contestants/own_scene.h"
#include "core/sphere_cluster/published/published_sphere_cluster.h"

namespace touchmark::bench::contestants {

namespace {

using named::SphereClusterForm;

bool is_published(const OptionValues& values) {
  return values.text("lookup") == "scan" || !values.flag("precise");
}

}  // namespace

ContestantInfo sphere_cluster_entry() {
  ContestantInfo info =
      introduced("sphere-cluster", 40, "triangles in clustered bounding spheres, after Choi & Sung 2017",
                 "exact; precise=false: conservative; budget!=0: conservative");
  info.former_names = {{"auto", {"query", "reach", "speed", "bytes_per_triangle", "trial", "chose"}}};
  info.queries = queries_of<SphereCluster>();
  info.options = options_with<SphereClusterForm>(
      {{"build",
        prepare_option(
            "true: list triangles for the next step and ask ahead before each query, clocked apart")},
       {"threads", updated_option()},
       {"threads", budget_option()}});
  info.build = [](const TriangleMesh& mesh, const OptionValues& values) {
    const auto form = form_of<SphereClusterForm>(mesh, values);
    if (form.is_published()) {
      refuse_budget(values);
      return prepared_contestant<PublishedSphereCluster>(mesh, form.published_options(), values);
    }
    if (auto within_budget = budgeted<SphereCluster>(mesh, form.fast, values)) return within_budget;
    return prepared_contestant<SphereCluster>(mesh, form.fast, values);
  };
  info.build_scene = [](const scenes::PlacedScene& placed, const OptionValues& values) {
    return is_published(values)
               ? build_own_scene<PublishedSphereCluster>(published_options_of<SphereClusterForm>)(placed,
                                                                                                  values)
               : build_own_scene<SphereCluster>(fast_options_of<SphereClusterForm>)(placed, values);
  };
  info.library = [](const OptionValues& values) -> LibraryClass {
    if (!is_published(values)) return {"sphere_cluster", "SphereCluster"};
    return {"published_sphere_cluster", "PublishedSphereCluster", {"prepare", "simd", "threads"}};
  };
  info.forms = {.compared = {"lookup=scan", "lookup=scan,precise=false", ""},
                .verified = {"clustering=2%", "build=lazy", "threads=2", "prepare=true", "updated=true",
                             "build=lazy,updated=true", "budget=32", "lookup=scan,clustering=2%",
                             "lookup=scan,clustering=2%,precise=false"},
                .frontier = {"", "certified=false", "clustering=2%", "precise=false",
                             "clustering=0.5%,precise=false", "clustering=1%,precise=false",
                             "clustering=2%,precise=false", "clustering=5%,precise=false", "budget=8",
                             "budget=16", "budget=32", "budget=64", "budget=128", "budget=256"},
                .scaled = {""},
                .chosen = {"prepare=true"},
                .updated = {""},
                .suite = {""},
                .scenes = {""},
                .tested = {"simd=portable"}};
  return info;
}

}  // namespace touchmark::bench::contestants
