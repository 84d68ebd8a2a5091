#include "bench/contestants/entry.h"

#include <stdexcept>

#include "baselines/fcl/fcl_ccd.h"
#include "baselines/fcl/fcl_detector.h"
#include "baselines/fcl/fcl_scene.h"
#include "bench/contestants/introduced.h"
#include "bench/contestants/rival_options.h"
#include "bench/contestants/rival_scene.h"

namespace touchmark::bench::contestants {

ContestantInfo fcl_entry() {
  ContestantInfo info = introduced("fcl", 50, "Flexible Collision Library: bounding volume hierarchies",
                                   "approximate; bv=aabb with narrow=exact: exact");
  using baselines::FclDetector;
  using Volume = FclDetector::Volume;
  using Method = FclDetector::Method;
  using Narrow = FclDetector::Narrow;
  static const Names<Volume> volumes{{"kios", Volume::kios},
                                     {"obbrss", Volume::obbrss},
                                     {"obb", Volume::obb},
                                     {"rss", Volume::rss},
                                     {"aabb", Volume::aabb}};
  static const Names<Method> methods{
      {"collide", Method::collide}, {"traverse", Method::traverse}, {"distance", Method::distance}};
  static const Names<Narrow> narrows{{"fcl", Narrow::fcl}, {"exact", Narrow::exact}};
  const auto options_of = [](const OptionValues& values) -> FclDetector::Options {
    return {chosen(values, "bv", volumes), chosen(values, "method", methods),
            chosen(values, "narrow", narrows), asking(values)};
  };
  info.queries = queries_of<FclDetector>();
  info.options = {
      choice("bv", volumes, "the hierarchy's bounding volume"),
      choice("method", methods, "collide: as most programs use it; distance: best first, bounded"),
      choice("narrow", narrows, "exact: this project's kernel on the triangles FCL reaches"),
      query_option(),
      {"ccd",
       OptionKind::count,
       {},
       "0",
       "sweeps alone, for touchmark proxy: FCL's continuous collision with so many poses; its default is "
       "10"}};
  info.build = [options_of](const TriangleMesh& mesh, const OptionValues& values) {
    if (values.count("ccd") > 0) return contestant<baselines::FclCcd>(mesh, {values.count("ccd")});
    return contestant<FclDetector>(mesh, options_of(values));
  };
  info.build_scene = build_rival_scene<baselines::FclScene>([options_of](const OptionValues& values) {
    if (values.count("ccd") > 0) throw std::invalid_argument("ccd is of one mesh, not of a scene of bodies");
    return options_of(values);
  });
  info.forms = {.compared = {"", "bv=obbrss", "bv=aabb,method=distance,narrow=exact"},
                .verified = {"bv=obb", "bv=rss,method=distance", "bv=kios,method=traverse,narrow=exact"},
                .frontier = {"", "bv=kios,method=traverse,narrow=exact", "bv=rss,method=distance",
                             "bv=aabb,method=distance,narrow=exact"},
                .scaled = {"", "bv=aabb,method=distance,narrow=exact"},
                .updated = {"", "bv=aabb,method=distance,narrow=exact"},
                .suite = {"bv=aabb,method=distance,narrow=exact"},
                .scenes = {"bv=aabb,method=distance,narrow=exact"}};
  return info;
}

}  // namespace touchmark::bench::contestants
