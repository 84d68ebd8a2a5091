#include "core/brute_force/brute_force.h"

#include "bench/contestants/introduced.h"
#include "bench/contestants/own_options.h"
#include "bench/contestants/own_scene.h"

namespace touchmark::bench::contestants {

ContestantInfo brute_force_entry() {
  ContestantInfo info =
      introduced("brute-force", 10, "every triangle, every time: both papers' \"without grouping\"", "exact");
  info.queries = queries_of<BruteForce>();
  info.options = options_with<BruteForce::Options>({});
  info.build = [](const TriangleMesh& mesh, const OptionValues& values) {
    return contestant<BruteForce>(mesh, {}, values);
  };
  info.build_scene = build_own_scene<BruteForce>(
      [](const TriangleMesh&, const OptionValues&) { return BruteForce::Options(); });
  info.library = library_class("brute_force", "BruteForce");
  info.forms = {.compared = {""}, .chosen = {""}, .updated = {""}};
  return info;
}

}  // namespace touchmark::bench::contestants
