/// What the program and a worker say to each other: one JSON object a line, a request and its reply in turn.
/// Bulk data (mesh, traces, answers, times) goes through shared memory, see shared_workload.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "bench/contestants/contestant.h"
#include "bench/workload/answer.h"
#include "core/detector.h"

namespace touchmark::bench::workers {

/// The descriptors a worker finds open.
inline constexpr int worker_control = 3;
inline constexpr int worker_input = 4;
inline constexpr int worker_output = 5;

/// The key of a reply that says what the worker itself, not its contestant, was short of.
inline constexpr const char* out_of_resources = "out_of_resources";

/// Which steps of which trace are meant: those of `ranges`, or, where there are none, of
/// sample_steps(steps of the trace, `steps`).
struct Task {
  std::size_t trace = 0;
  workload::Query query = workload::Query::nearest;
  std::size_t steps = 1;
  std::vector<workload::StepRange> ranges = {};  ///< ascending
};

/// Reply to "open": the worker has read the mesh and the traces.
struct Opened {
  double clock_cost_ns = 0;  ///< one reading's in the latency pass
  double ns_per_tick = 1;
  bool flushed_to_zero = false;  ///< a library had switched denormal numbers off; the worker switched them on
};

/// Reply to "build", which may be ordered again.
struct Built {
  std::string refused;  ///< the message of what build threw; empty when it built
  double build_ms = 0;
  std::uint64_t bytes = 0;
  std::uint64_t heap_bytes = 0;  ///< growth of the heap
  Accuracy accuracy;
  std::vector<workload::Query> queries;
  bool prepares = false;
  bool builds_lazily = false;  ///< its first queries build parts of it
};

/// Reply to "answer": answers and work lie in the output buffers, from a fresh session.
struct Answered {
  std::uint64_t checksum = 0;
  Work work;  ///< all steps'
};

/// Reply to "first" (one step, fresh session), "calibrate", "first_pass" (fresh session), "time", "sample"
/// and "latency" (ticks lie in the output buffers).
struct Timed {
  double ns_per_query = 0;      ///< elapsed; of "calibrate" the shorter of that and the processor time
  double cpu_ns_per_query = 0;  ///< "time" and "sample" only
  std::uint64_t checksum = 0;
  bool steady = true;                ///< every pass gave the same checksum
  Work work;                         ///< "first_pass" only: all steps'
  std::vector<double> samples = {};  ///< "sample" only: see sample_throughput
  std::size_t interrupted = 0;       ///< how many samples were
};

/// Reply to "update": the detector follows the deformed mesh now. Updates, there and back, and builds of the
/// deformed mesh took turns before; medians over the rounds.
struct Updated {
  bool supported = false;
  std::string refused;  ///< the message of what update threw
  std::size_t rounds = 0;
  double build_ms = 0;
  double update_ms = 0;
  double update_over_build = 0;  ///< within a round
};

void to_json(nlohmann::json& json, const Updated& updated);
void from_json(const nlohmann::json& json, Updated& updated);
void to_json(nlohmann::json& json, const Task& task);
void from_json(const nlohmann::json& json, Task& task);
void to_json(nlohmann::json& json, const Opened& opened);
void from_json(const nlohmann::json& json, Opened& opened);
void to_json(nlohmann::json& json, const Built& built);
void from_json(const nlohmann::json& json, Built& built);
void to_json(nlohmann::json& json, const Answered& answered);
void from_json(const nlohmann::json& json, Answered& answered);
void to_json(nlohmann::json& json, const Timed& timed);
void from_json(const nlohmann::json& json, Timed& timed);

}  // namespace touchmark::bench::workers
