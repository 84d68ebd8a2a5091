/// steps.bin: what happened at each step of a run, for pages that show single steps. Its format is in
/// docs/reference/steps-bin.md.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bench/ground_truth/step_truth.h"
#include "bench/measurement/result_row.h"
#include "bench/workload/workload.h"

namespace touchmark::bench::results {

inline constexpr std::string_view steps_file_name = "steps.bin";
inline constexpr std::string_view steps_magic = "TMSTEPS\n";
inline constexpr std::uint32_t steps_version = 1;
/// Rows of more steps than this are left out.
inline constexpr std::size_t max_steps_in_file = 200'000;
/// The mesh that pages draw has at most so many triangles.
inline constexpr std::size_t max_drawn_triangles = 20'000;

/// The whole file. `rows` without a log are left out; `truths` are one list a trace of the workload.
std::string steps_file(const std::string& run_id, const workload::Workload& workload,
                       const std::vector<measurement::ResultRow>& rows,
                       const std::vector<std::vector<ground_truth::StepTruth>>& truths);

}  // namespace touchmark::bench::results
