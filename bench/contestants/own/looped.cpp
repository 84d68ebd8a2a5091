#include <stdexcept>

#include "bench/contestants/plain_scenes.h"
#include "core/aabb_tree/aabb_tree.h"
#include "core/grid_group/grid_group.h"
#include "core/sphere_cluster/sphere_cluster.h"

namespace touchmark::bench::contestants {
namespace {

template <Detector D>
std::unique_ptr<Contestant> built_of(const bodies::PlacedScene& placed) {
  return scene_contestant(placed, [](const bodies::PlacedScene& one) { return LoopedScene<D>(one); });
}

}  // namespace

ContestantInfo looped_entry() {
  ContestantInfo info;
  info.name = "looped";
  info.rank = 44;
  info.summary = "every body of a scene asked in turn: a plain loop over one of our detectors";
  info.accuracy = "exact";
  info.queries = queries_of<SphereCluster>();
  info.options = {of_option()};
  info.build = [](const TriangleMesh&, const OptionValues&) -> std::unique_ptr<Contestant> {
    throw std::invalid_argument("it is of scenes of bodies: --scene");
  };
  info.build_scene = [](const bodies::PlacedScene& placed, const OptionValues& values) {
    const std::string& of = values.text("of");
    return of == "grid-group"  ? built_of<GridGroup>(placed)
           : of == "aabb-tree" ? built_of<AabbTree>(placed)
                               : built_of<SphereCluster>(placed);
  };
  info.forms = {.scenes = {""}};
  return info;
}

}  // namespace touchmark::bench::contestants
