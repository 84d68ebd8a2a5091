/// servo.csv, servo_histogram.csv and servo_worst.csv, schema 1. Columns are only ever appended.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/experiments/servo/servo_row.h"
#include "bench/results/column.h"
#include "bench/workload/workload.h"

namespace touchmark::bench::experiments::servo {

inline constexpr int servo_schema = 1;

/// What column `query` has where a tick is a proxy's whole step, and column `proxy` then.
inline constexpr std::string_view proxy_step = "proxy", own_proxy = "certified";

/// A row of the table with what all rows have.
struct ServoLine {
  const ServoSettings& settings;
  const ServoRow& row;
};

/// What a tick asks: the query's name, or that it is a proxy's step.
std::string question_of(const ServoSettings& settings, workload::Query query);

/// The columns of servo.csv.
std::span<const results::Column<ServoLine>> servo_columns();

/// One row a contestant.
std::string servo_csv(const std::string& run_id, const ServoSettings& settings,
                      const std::vector<ServoRow>& rows);

/// One row a bucket that is not empty, of each contestant's latency and query and of its idle loop's latency.
std::string histogram_csv(const std::vector<ServoRow>& rows);

/// One row for each of the worst ticks.
std::string worst_csv(const workload::Workload& workload, const std::vector<ServoRow>& rows);

/// Fewer ticks have no such percentile.
inline constexpr std::uint64_t ticks_for_p999 = 1000, ticks_for_p9999 = 10'000;

}  // namespace touchmark::bench::experiments::servo
