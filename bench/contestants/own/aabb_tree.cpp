#include "core/aabb_tree/aabb_tree.h"

#include <optional>
#include <stdexcept>

#include "bench/contestants/budgeted.h"
#include "bench/contestants/introduced.h"
#include "bench/contestants/own_options.h"
#include "bench/contestants/own_scene.h"
#include "core/aabb_tree/float_tree.h"

namespace touchmark::bench::contestants {

ContestantInfo aabb_tree_entry() {
  static const Names<bool> precisions{{"double", false}, {"float", true}};
  const auto in_floats = [](const OptionValues& values) { return chosen(values, "precision", precisions); };
  ContestantInfo info = introduced("aabb-tree", 20, "a plain binary tree of boxes: the reference",
                                   "exact; precision=float: approximate; budget!=0: conservative");
  info.queries = queries_of<AabbTree>();
  info.options = options_with<AabbTree::Options>(
      {{"leaf_size", choice("precision", precisions,
                            "float: mesh, boxes, kernel and distances in single precision; touches and "
                            "nearest, no side, nothing certified")},
       {"threads", updated_option()},
       {"threads", budget_option()}});
  info.build = [=](const TriangleMesh& mesh, const OptionValues& values) {
    const auto options = form_of<AabbTree::Options>(mesh, values);
    if (!in_floats(values)) {
      if (auto within_budget = budgeted<AabbTree>(mesh, options, values)) return within_budget;
      return contestant<AabbTree>(mesh, options, values);
    }
    refuse_budget(values);
    if (asks_for_side(values)) throw std::invalid_argument("aabb-tree: precision=float tells no side");
    return contestant<FloatTree>(mesh, {options.leaf_size, options.threads});
  };
  info.build_scene = [=](const scenes::PlacedScene& scene, const OptionValues& values) {
    if (in_floats(values))
      throw std::invalid_argument("precision=float is of one mesh, not of a scene of bodies");
    return build_own_scene<AabbTree>(&form_of<AabbTree::Options>)(scene, values);
  };
  info.storage_rounding = [=](const TriangleMesh& mesh,
                              const OptionValues& values) -> std::optional<StorageRounding> {
    if (!in_floats(values)) return std::nullopt;
    const FloatFrame frame = FloatFrame::around(mesh.bounds());
    return stored_in_single_precision(frame.scale, frame.origin);
  };
  info.library = library_class("aabb_tree", "AabbTree");
  info.forms = {.compared = {""},
                .verified = {"precision=float", "updated=true", "budget=32"},
                .frontier = {"", "certified=false", "precision=float", "budget=8", "budget=32", "budget=128"},
                .scaled = {""},
                .updated = {""},
                .scenes = {""},
                .tested = {"leaf_size=1", "threads=2"}};
  return info;
}

}  // namespace touchmark::bench::contestants
