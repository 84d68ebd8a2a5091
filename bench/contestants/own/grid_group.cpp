#include "core/grid_group/grid_group.h"

#include <string>

#include <fmt/format.h>

#include "bench/contestants/budgeted.h"
#include "bench/contestants/introduced.h"
#include "bench/contestants/own_options.h"
#include "bench/contestants/own_scene.h"
#include "core/grid_group/published/published_grid_group.h"

namespace touchmark::bench::contestants {

namespace {

using named::GridGroupForm;

bool is_published(const OptionValues& values) { return values.text("lookup") == "scan"; }

/// Remarks where cells or groups are fewer than asked for, to keep within memory.
template <class D>
std::unique_ptr<Contestant> build(const TriangleMesh& mesh, const typename D::Options& options,
                                  const OptionValues& values) {
  return prepared_contestant<D>(mesh, options, values, [&](const D& detector) -> std::string {
    if (options.cell > 0 && detector.cell() > 1.01 * options.cell)
      return fmt::format("cells of {} would take more memory than they may; the smallest is {}", options.cell,
                         detector.cell());
    if constexpr (requires { options.bytes_per_triangle; }) {
      if (options.bytes_per_triangle != GridGroup::Options().bytes_per_triangle && detector.coarsened())
        return fmt::format("within {} bytes a triangle {} of {} have a group, the others are searched for",
                           options.bytes_per_triangle, detector.groups(), mesh.size());
    }
    return "";
  });
}

}  // namespace

ContestantInfo grid_group_entry() {
  ContestantInfo info =
      introduced("grid-group", 30, "triangles grouped by uniform cells, after Park & Jang 2018",
                 "exact; budget!=0: conservative");
  info.queries = queries_of<GridGroup>();
  info.options = options_with<GridGroupForm>(
      {{"build",
        prepare_option("true: ask the last question again before each query, clocked apart; direct")},
       {"threads", updated_option()},
       {"threads", budget_option()}});
  info.build = [](const TriangleMesh& mesh, const OptionValues& values) {
    const auto form = form_of<GridGroupForm>(mesh, values);
    if (form.is_published) {
      refuse_budget(values);
      return build<PublishedGridGroup>(mesh, form.published_options(), values);
    }
    if (auto within_budget = budgeted<GridGroup>(mesh, form.fast, values)) return within_budget;
    return build<GridGroup>(mesh, form.fast, values);
  };
  info.build_scene = [](const scenes::PlacedScene& placed, const OptionValues& values) {
    return is_published(values)
               ? build_own_scene<PublishedGridGroup>(published_options_of<GridGroupForm>)(placed, values)
               : build_own_scene<GridGroup>(fast_options_of<GridGroupForm>)(placed, values);
  };
  info.bytes_per_triangle = [](const OptionValues& values) {
    return is_published(values) ? support::min_bytes_per_triangle : values.number("bytes_per_triangle");
  };
  info.library = [](const OptionValues& values) -> LibraryClass {
    if (!is_published(values)) return {"grid_group", "GridGroup", {"shape", "groups"}};
    return {"published_grid_group", "PublishedGridGroup", {"bytes_per_triangle", "prepare", "threads"}};
  };
  info.forms = {
      .compared = {"lookup=scan", "lookup=scan,shape=sphere", ""},
      .verified = {"cell=1%", "lookup=scan,shape=centered-sphere", "build=lazy", "threads=2", "prepare=true",
                   "updated=true", "build=lazy,updated=true", "budget=32"},
      .frontier = {"", "certified=false", "cell=0.5%", "cell=4%", "budget=8", "budget=32", "budget=128"},
      .scaled = {""},
      .chosen = {"bytes_per_triangle=300", "prepare=true"},
      .updated = {""},
      .suite = {""},
      .scenes = {""}};
  return info;
}

}  // namespace touchmark::bench::contestants
