#include "bench/contestants/entry.h"

#include "baselines/libccd/libccd_detector.h"
#include "bench/contestants/introduced.h"
#include "bench/contestants/rival_options.h"

namespace touchmark::bench::contestants {

ContestantInfo libccd_entry() {
  ContestantInfo info = introduced(
      "libccd+aabb", 70, "libccd between the ball and each candidate triangle of this project's box tree",
      "approximate");
  using baselines::LibccdDetector;
  using Algorithm = LibccdDetector::Algorithm;
  using Frame = LibccdDetector::Frame;
  static const Names<Algorithm> algorithms{{"gjk", Algorithm::gjk}, {"mpr", Algorithm::mpr}};
  static const Names<Frame> frames{{"fitted", Frame::fitted}, {"mesh", Frame::mesh}};
  info.queries = queries_of<LibccdDetector>();
  info.options = {choice("algorithm", algorithms, "gjk: GJK and EPA; mpr: Minkowski portal refinement"),
                  choice("frame", frames, "fitted: the ball as the unit ball; mesh: coordinates as they are"),
                  {"tolerance", OptionKind::number, {}, "1e-4", "of EPA and MPR; in radii when fitted"},
                  {"iterations", OptionKind::count, {}, "500", "of GJK at most"},
                  query_option()};
  info.build = [](const TriangleMesh& mesh, const OptionValues& values) {
    return contestant<LibccdDetector>(
        mesh, {chosen(values, "algorithm", algorithms), chosen(values, "frame", frames),
               values.number("tolerance"), values.count("iterations"), asking(values)});
  };
  info.forms = {
      .compared = {"", "algorithm=mpr"},
      .frontier = {"tolerance=1e-2", "", "tolerance=1e-8", "tolerance=1e-8,iterations=20", "iterations=5",
                   "algorithm=mpr,tolerance=1e-2", "algorithm=mpr", "algorithm=mpr,tolerance=1e-8"},
      .updated = {"algorithm=mpr"}};
  return info;
}

}  // namespace touchmark::bench::contestants
