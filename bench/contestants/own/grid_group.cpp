#include "core/grid_group/grid_group.h"

#include <cstddef>
#include <string>

#include <fmt/format.h>

#include "bench/contestants/entry.h"

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

}  // namespace

ContestantInfo grid_group_entry() {
  static const Names<GridGroup::Lookup> lookups{{"direct", GridGroup::Lookup::direct},
                                                {"scan", GridGroup::Lookup::scan}};
  static const Names<GridGroup::Construction> constructions{{"whole", GridGroup::Construction::whole},
                                                            {"lazy", GridGroup::Construction::lazy}};
  static const Names<GridGroup::Shape> shapes{{"cube", GridGroup::Shape::cube},
                                              {"sphere", GridGroup::Shape::sphere},
                                              {"centered-sphere", GridGroup::Shape::centered_sphere}};
  ContestantInfo info;
  info.name = "grid-group";
  info.rank = 30;
  info.summary = "triangles grouped by uniform cells, after Park & Jang 2018";
  info.accuracy = "exact";
  info.queries = queries_of<GridGroup>();
  info.options = {
      choice("lookup", lookups, "direct: the probe's own cell; scan: every group, as published"),
      choice("shape", shapes,
             "of the groups; scan only; sphere: the smallest; centered-sphere: about the cuboid's centre"),
      {"cell",
       OptionKind::length,
       {},
       "0",
       "edge of a cell, direct: of the smallest; larger where memory is short; 0: choose"},
      {"groups", OptionKind::count, {}, "0", "scan with cell=0: aim at so many groups; 0: choose"},
      {"bytes_per_triangle", OptionKind::number, {}, "400", "direct: what the structure may take"},
      certified_option(),
      choice("build", constructions, "lazy: groups and cells are made by the first queries that want them"),
      updated_option(),
      side_option()};
  info.build = [](const TriangleMesh& mesh, const OptionValues& values) {
    GridGroup::Options options;
    options.lookup = chosen(values, "lookup", lookups);
    options.shape = chosen(values, "shape", shapes);
    options.cell = values.length("cell", mesh);
    options.groups = values.count("groups");
    options.bytes_per_triangle = values.number("bytes_per_triangle");
    options.certified = chosen(values, "certified", yes_or_no);
    options.construction = chosen(values, "build", constructions);
    return contestant<GridGroup>(mesh, options, values, [&](const GridGroup& detector) {
      return remark_on(detector, options, mesh.size());
    });
  };
  info.bytes_per_triangle = [](const OptionValues& values) {
    return values.text("lookup") == "direct" ? values.number("bytes_per_triangle")
                                             : support::min_bytes_per_triangle;
  };
  info.forms = {.compared = {"lookup=scan", "lookup=scan,shape=sphere", ""},
                .verified = {"cell=1%", "lookup=scan,shape=centered-sphere", "build=lazy", "updated=true",
                             "build=lazy,updated=true"},
                .frontier = {"", "certified=false", "cell=0.5%", "cell=4%"},
                .scaled = {""},
                .updated = {""}};
  return info;
}

}  // namespace touchmark::bench::contestants
