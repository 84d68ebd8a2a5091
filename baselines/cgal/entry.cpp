#include "bench/contestants/entry.h"

#include "baselines/cgal/cgal_detector.h"
#include "bench/contestants/introduced.h"
#include "bench/contestants/rival_options.h"

namespace touchmark::bench::contestants {

ContestantInfo cgal_entry() {
  ContestantInfo info =
      introduced("cgal", 90, "CGAL: closest point over its AABB tree", "approximate; kernel=epeck: exact");
  using baselines::CgalDetector;
  using Kernel = CgalDetector::Kernel;
  using Hint = CgalDetector::Hint;
  static const Names<Kernel> kernels{
      {"epick", Kernel::epick}, {"simple", Kernel::simple}, {"epeck", Kernel::epeck}};
  static const Names<Hint> hints{{"bounded", Hint::bounded}, {"none", Hint::none}, {"last", Hint::last}};
  info.queries = queries_of<CgalDetector>();
  info.options = {choice("kernel", kernels,
                         "simple: doubles throughout; epick: exact predicates; epeck: exact points, too"),
                  choice("hint", hints,
                         "where a search starts: none: CGAL's own; last: at the last triangle; bounded: that "
                         "within the reach"),
                  query_option()};
  info.build = [](const TriangleMesh& mesh, const OptionValues& values) {
    return contestant<CgalDetector>(
        mesh, {chosen(values, "kernel", kernels), chosen(values, "hint", hints), asking(values)});
  };
  info.forms = {.compared = {"kernel=simple,hint=bounded"},
                .verified = {"", "hint=none,query=plain", "kernel=epeck,hint=bounded"},
                .frontier = {"kernel=simple,hint=bounded", "kernel=epeck,hint=bounded"},
                .scaled = {"kernel=simple,hint=bounded"},
                .updated = {"kernel=simple,hint=bounded"},
                .suite = {"kernel=simple,hint=bounded"}};
  return info;
}

}  // namespace touchmark::bench::contestants
