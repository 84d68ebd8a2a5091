/// choose.csv, schema 1: a row a candidate, in the order in which they were measured. Columns are only ever
/// appended.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "bench/experiments/choose/candidate.h"
#include "bench/experiments/choose/decision.h"
#include "bench/results/column.h"
#include "bench/results/validation/fault.h"
#include "bench/results/validation/results_check.h"
#include "bench/workload/workload.h"

namespace touchmark::bench::experiments::choose {

inline constexpr int choose_schema = 1;

/// What all candidates were asked.
struct Asked {
  const workload::Workload& workload;
  workload::Query query = workload::Query::nearest;
  Limits limits;
};

/// A row of the table with what all rows have.
struct ChooseLine {
  const Asked& asked;
  const Candidate& candidate;
  std::size_t rank = 0;  ///< from 1, the recommended one; 0: it does not hold
};

std::span<const results::Column<ChooseLine>> choose_columns();

std::string choose_csv(const std::string& run_id, const Asked& asked,
                       const std::vector<Candidate>& candidates);

/// Checks that a file is a choose.csv of schema 1, and agrees with itself and with its run.json. `run` is the
/// run.json beside the file, if there is one.
void check_choose(const results::validation::CsvTable& table, const nlohmann::json* run,
                  results::validation::Faults& faults);

}  // namespace touchmark::bench::experiments::choose
