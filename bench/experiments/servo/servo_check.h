/// Checks that a file is a servo.csv of schema 1, and agrees with itself, its histogram and its run.json.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "bench/results/validation/fault.h"
#include "bench/results/validation/results_check.h"

namespace touchmark::bench::experiments::servo {

/// `run` is the run.json beside the file and `histogram` the servo_histogram.csv, if there are such.
void check_servo(const results::validation::CsvTable& table, const results::validation::CsvTable* histogram,
                 const nlohmann::json* run, results::validation::Faults& faults);

}  // namespace touchmark::bench::experiments::servo
