#include "bench/contestants/entry.h"

#include "baselines/ode/ode_detector.h"
#include "bench/contestants/introduced.h"
#include "bench/contestants/rival_options.h"

namespace touchmark::bench::contestants {

ContestantInfo ode_entry() {
  using baselines::OdeDetector;
  using Sides = OdeDetector::Sides;
  static const Names<Sides> sides{{"front", Sides::front}, {"both", Sides::both}};
  ContestantInfo info =
      introduced("ode", 100, "Open Dynamics Engine: OPCODE's hierarchy of boxes", "approximate");
  info.queries = queries_of<OdeDetector>();
  info.options = {
      choice("sides", sides, "front: as the mesh is, collided with from outside; both: its inside, too"),
      query_option()};
  info.build = [](const TriangleMesh& mesh, const OptionValues& values) {
    return contestant<OdeDetector>(mesh, {chosen(values, "sides", sides), asking(values)});
  };
  info.forms = {.verified = {"", "sides=both"}, .frontier = {"", "sides=both"}};
  return info;
}

}  // namespace touchmark::bench::contestants
