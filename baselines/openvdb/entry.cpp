#include "bench/contestants/entry.h"

#include <string>

#include "baselines/openvdb/openvdb_detector.h"
#include "bench/contestants/introduced.h"
#include "bench/contestants/rival_module.h"
#include "bench/contestants/rival_options.h"

namespace touchmark::bench::contestants {

ContestantInfo openvdb_entry() {
  using baselines::OpenVdbDetector;
  using Distances = OpenVdbDetector::Distances;
  using Found = OpenVdbDetector::Found;
  static const Names<Distances> distances{{"signed", Distances::with_sign}, {"unsigned", Distances::without}};
  static const Names<Found> contacts{{"gradient", Found::gradient}, {"polygon", Found::polygon}};
  static const std::string module = "openvdb";
  ContestantInfo info = introduced(
      module, 110, "OpenVDB: distances sampled on a sparse lattice, read by trilinear interpolation",
      "approximate");
  info.queries = queries_of<OpenVdbDetector>();
  info.options = {{"voxel", OptionKind::length, {}, "1%", "edge of a voxel"},
                  {"band", OptionKind::length, {}, "1%", "nothing is found farther away; at least 3 voxels"},
                  choice("distances", distances,
                         "signed: a level set, negative inside of a closed mesh; unsigned: distances alone"),
                  choice("contact", contacts,
                         "gradient: along the interpolated distance's, and no triangle is named; polygon: on "
                         "the one that the nearest voxel keeps"),
                  query_option()};
  info.build = [](const TriangleMesh& mesh, const OptionValues& values) {
    const OpenVdbDetector::Options options{values.length("voxel", mesh), values.length("band", mesh),
                                           chosen(values, "distances", distances),
                                           chosen(values, "contact", contacts), asking(values)};
    return contestant_of_module(module, mesh, options);
  };
  comes_from_module(info, module);
  info.forms = {.verified = {"", "contact=polygon"},
                .frontier = {"voxel=2%", "", "voxel=0.5%", "voxel=0.25%", "voxel=0.125%", "contact=polygon",
                             "voxel=0.25%,contact=polygon"},
                .tested = {"distances=unsigned", "query=plain"}};
  return info;
}

}  // namespace touchmark::bench::contestants
