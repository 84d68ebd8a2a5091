#include "core/grid_group/grid_group.h"

#include <cstddef>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bench/contestants/entry.h"
#include "bench/contestants/own_scene.h"
#include "core/grid_group/published/published_grid_group.h"
#include "core/named/published_form.h"

namespace touchmark::bench::contestants {

namespace {

const Names<bool>& lookups() {
  static const Names<bool> names{{"direct", false}, {"scan", true}};
  return names;
}
const Names<GridGroup::Construction>& constructions() {
  static const Names<GridGroup::Construction> names{{"whole", GridGroup::Construction::whole},
                                                    {"lazy", GridGroup::Construction::lazy}};
  return names;
}
const Names<PublishedGridGroup::Shape>& shapes() {
  using Shape = PublishedGridGroup::Shape;
  static const Names<Shape> names{
      {"cube", Shape::cube}, {"sphere", Shape::sphere}, {"centered-sphere", Shape::centered_sphere}};
  return names;
}

std::vector<OptionInfo> options() {
  return {
      choice("lookup", lookups(), "direct: the probe's own cell; scan: every group, as published"),
      in_code(choice("shape", shapes(),
                     "of the groups; scan only; sphere: the smallest; centered-sphere: about the cuboid's "
                     "centre"),
              "shape", "PublishedGridGroup::Shape"),
      in_code({"cell",
               OptionKind::length,
               {},
               "0",
               "edge of a cell, direct: of the smallest; larger where memory is short; 0: choose"},
              "cell"),
      in_code({"groups", OptionKind::count, {}, "0", "scan with cell=0: aim at so many groups; 0: choose"},
              "groups"),
      in_code({"bytes_per_triangle", OptionKind::number, {}, "400", "direct: what the structure may take"},
              "bytes_per_triangle"),
      certified_option(),
      in_code(choice("build", constructions(),
                     "lazy: groups and cells are made by the first queries that want them"),
              "construction", "GridGroup::Construction"),
      choice("prepare", no_or_yes,
             "true: ask the last question again before each query, clocked apart; direct"),
      threads_option(),
      updated_option(),
      side_option()};
}

GridGroup::Options options_of(const TriangleMesh& mesh, const OptionValues& values) {
  GridGroup::Options options;
  options.cell = values.length("cell", mesh);
  options.bytes_per_triangle = values.number("bytes_per_triangle");
  options.certified = chosen(values, "certified", yes_or_no);
  options.construction = chosen(values, "build", constructions());
  options.threads = threads_of(values);
  return options;
}

bool is_published(const OptionValues& values) { return chosen(values, "lookup", lookups()); }

PublishedGridGroup::Options published_options_of(const TriangleMesh& mesh, const OptionValues& values) {
  named::expect_published(options_of(mesh, values));
  return {chosen(values, "shape", shapes()), values.length("cell", mesh), values.count("groups")};
}

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
  ContestantInfo info;
  info.name = "grid-group";
  info.rank = 30;
  info.summary = "triangles grouped by uniform cells, after Park & Jang 2018";
  info.accuracy = "exact";
  info.queries = queries_of<GridGroup>();
  info.options = options();
  info.build = [](const TriangleMesh& mesh, const OptionValues& values) {
    return is_published(values) ? build<PublishedGridGroup>(mesh, published_options_of(mesh, values), values)
                                : build<GridGroup>(mesh, options_of(mesh, values), values);
  };
  info.build_scene = [](const scenes::PlacedScene& placed, const OptionValues& values) {
    return is_published(values) ? build_own_scene<PublishedGridGroup>(&published_options_of)(placed, values)
                                : build_own_scene<GridGroup>(&options_of)(placed, values);
  };
  info.bytes_per_triangle = [](const OptionValues& values) {
    return is_published(values) ? support::min_bytes_per_triangle : values.number("bytes_per_triangle");
  };
  info.library = [](const OptionValues& values) -> LibraryClass {
    if (!is_published(values)) return {"grid_group", "GridGroup", {"shape", "groups"}};
    return {"published_grid_group", "PublishedGridGroup", {"bytes_per_triangle", "prepare", "threads"}};
  };
  info.forms = {.compared = {"lookup=scan", "lookup=scan,shape=sphere", ""},
                .verified = {"cell=1%", "lookup=scan,shape=centered-sphere", "build=lazy", "threads=2",
                             "prepare=true", "updated=true", "build=lazy,updated=true"},
                .frontier = {"", "certified=false", "cell=0.5%", "cell=4%"},
                .scaled = {""},
                .chosen = {"bytes_per_triangle=300", "prepare=true"},
                .updated = {""},
                .suite = {""},
                .scenes = {""}};
  return info;
}

}  // namespace touchmark::bench::contestants
