/// What the program and a worker say to each other: one JSON object a line, an order and its reply in turn.
/// Bulk data (mesh, courses, answers, times) goes through shared memory, see shared_workload.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "bench/contestants/contestant.h"
#include "bench/workload/answer.h"
#include "core/detector.h"

namespace touchmark::bench {

/// The descriptors a worker finds open.
inline constexpr int worker_control = 3;
inline constexpr int worker_input = 4;
inline constexpr int worker_output = 5;

/// The key of a reply that says what the worker itself, not its contestant, was short of.
inline constexpr const char* out_of_resources = "out_of_resources";

/// Which steps of which course are meant: those of `windows`, or, where there are none, of
/// plan_windows(steps of the course, `steps`).
struct Task {
  std::size_t course = 0;
  Query query = Query::nearest;
  std::size_t steps = 1;
  std::vector<Window> windows = {};  ///< ascending
};

/// Reply to "open": the worker has read the mesh and the courses.
struct Opened {
  double clock_cost_ns = 0;  ///< of one reading in the latency pass
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
  std::vector<Query> queries;
  bool prepares = false;
  bool builds_lazily = false;  ///< parts of itself, by the first queries
};

/// Reply to "answer": answers and work lie in the output room, from a fresh session.
struct Answered {
  std::uint64_t checksum = 0;
  Work work;  ///< of all steps
};

/// Reply to "first" (one step, fresh session), "calibrate", "first_pass" (fresh session), "time", "sample"
/// and "latency" (ticks lie in the output room).
struct Timed {
  double ns_per_query = 0;      ///< elapsed; of "calibrate" the shorter of that and the processor time
  double cpu_ns_per_query = 0;  ///< of "time" and "sample" only
  std::uint64_t checksum = 0;
  bool steady = true;                ///< every pass gave the same checksum
  Work work;                         ///< of "first_pass" only, of all steps
  std::vector<double> samples = {};  ///< of "sample" only: see sample_throughput
  std::size_t interrupted = 0;       ///< of the samples
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

}  // namespace touchmark::bench
