#include "core/grid_group/grid_group.h"

#include <cstddef>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bench/contestants/entry.h"
#include "bench/contestants/own_scene.h"

namespace touchmark::bench::contestants {

namespace {

/// Whether cells or groups are fewer than asked for, to keep within memory.
std::string remark_on(const GridGroup& detector, const GridGroup::Options& options, std::size_t triangles) {
  if (options.cell > 0 && detector.cell() > 1.01 * options.cell) {
    return fmt::format("cells of {} would take more memory than they may; the smallest is {}", options.cell,
                       detector.cell());
  }
  if (options.bytes_per_triangle != GridGroup::Options().bytes_per_triangle && detector.coarsened() &&
      options.lookup == GridGroup::Lookup::direct) {
    return fmt::format("within {} bytes a triangle {} of {} have a group, the others are searched for",
                       options.bytes_per_triangle, detector.groups(), triangles);
  }
  return "";
}

const Names<GridGroup::Lookup>& lookups() {
  static const Names<GridGroup::Lookup> names{{"direct", GridGroup::Lookup::direct},
                                              {"scan", GridGroup::Lookup::scan}};
  return names;
}
const Names<GridGroup::Construction>& constructions() {
  static const Names<GridGroup::Construction> names{{"whole", GridGroup::Construction::whole},
                                                    {"lazy", GridGroup::Construction::lazy}};
  return names;
}
const Names<GridGroup::Shape>& shapes() {
  static const Names<GridGroup::Shape> names{{"cube", GridGroup::Shape::cube},
                                             {"sphere", GridGroup::Shape::sphere},
                                             {"centered-sphere", GridGroup::Shape::centered_sphere}};
  return names;
}

std::vector<OptionInfo> options() {
  return {
      in_code(choice("lookup", lookups(), "direct: the probe's own cell; scan: every group, as published"),
              "lookup", "GridGroup::Lookup"),
      in_code(choice("shape", shapes(),
                     "of the groups; scan only; sphere: the smallest; centered-sphere: about the cuboid's "
                     "centre"),
              "shape", "GridGroup::Shape"),
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
  options.lookup = chosen(values, "lookup", lookups());
  options.shape = chosen(values, "shape", shapes());
  options.cell = values.length("cell", mesh);
  options.groups = values.count("groups");
  options.bytes_per_triangle = values.number("bytes_per_triangle");
  options.certified = chosen(values, "certified", yes_or_no);
  options.construction = chosen(values, "build", constructions());
  options.threads = threads_of(values);
  return options;
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
    const GridGroup::Options options = options_of(mesh, values);
    const auto remark = [&](const GridGroup& detector) { return remark_on(detector, options, mesh.size()); };
    return chosen(values, "prepare", no_or_yes)
               ? contestant<GridGroup, Prefetch::on>(mesh, options, values, remark)
               : contestant<GridGroup>(mesh, options, values, remark);
  };
  info.build_scene = build_own_scene<GridGroup>(&options_of);
  info.bytes_per_triangle = [](const OptionValues& values) {
    return values.text("lookup") == "direct" ? values.number("bytes_per_triangle")
                                             : support::min_bytes_per_triangle;
  };
  info.library = {"grid_group", "GridGroup"};
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
