/// The only file that knows which baselines were built: TOUCHMARK_WITH_NAME is 0 or 1.
#include "bench/roster.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/brute_force/brute_force.h"

namespace touchmark::bench {
namespace {

template <Detector D>
std::unique_ptr<Contestant> contestant(const TriangleMesh& mesh, const typename D::Options& options) {
  return std::make_unique<ContestantOf<D>>(D::build(mesh, options));
}

ContestantInfo brute_force() {
  ContestantInfo info;
  info.name = "brute-force";
  info.summary = "every triangle, every time: both papers' \"without grouping\"";
  info.accuracy = "exact";
  info.queries = queries_of<BruteForce>();
  info.build = [](const TriangleMesh& mesh, const OptionValues&) { return contestant<BruteForce>(mesh, {}); };
  return info;
}

}  // namespace

const Roster& roster() {
  static const Roster all({brute_force()}, {"brute-force"});
  return all;
}

}  // namespace touchmark::bench
