/// What the gate found, as people and as programs read it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/regression/gate/baseline.h"
#include "bench/regression/gate/judge.h"
#include "bench/results/junit.h"
#include "bench/support/table.h"

namespace touchmark::bench::regression::gate {

struct GateLine {
  GateKey key;
  std::optional<RatioInterval> baseline;  ///< nothing while one is written
  Judgement judgement;
  std::string answers = "-";  ///< "same", "-" where the baseline does not say, or what differs
  std::string verdict;
  bool failed = false;  ///< by which the command's exit status is 1
  double seconds = 0;   ///< that it took
};

support::Table gate_table(const std::vector<GateLine>& lines);
/// Returns a case a line. An inconclusive one is skipped.
std::vector<results::TestCase> cases_of(const std::vector<GateLine>& lines);
std::string gate_csv(const std::vector<GateLine>& lines, double tolerance);

}  // namespace touchmark::bench::regression::gate
