/// What the program and a worker say to each other: a request and its reply in turn, a line of JSON each. A
/// request is a struct below, a member of `Request`, and a function of worker.cpp that handles it. Bulk data
/// (mesh, traces, answers, times) goes through shared memory, see shared_workload.h.
#pragma once

#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "bench/contestants/contestant.h"
#include "bench/contestants/contestant_info.h"
#include "bench/contestants/plugins/script_plugin.h"
#include "bench/meshes/deformation.h"
#include "bench/workers/shared_workload.h"
#include "bench/workers/timing/paced_replay.h"
#include "bench/workload/answer.h"
#include "core/detector.h"
#include "core/haptics/coupling.h"

namespace touchmark::bench::workers {

/// The descriptors a worker finds open.
inline constexpr int worker_control = 3;
inline constexpr int worker_input = 4;
inline constexpr int worker_output = 5;

/// Which steps of which trace are meant: those of `ranges`, or, where there are none, of
/// sample_steps(steps of the trace, `steps`).
struct Task {
  std::size_t trace = 0;
  workload::Query query = workload::Query::nearest;
  std::size_t steps = 1;
  std::vector<workload::StepRange> ranges = {};  ///< ascending
};

/// The worker's program could not be started: its first reply, which the child writes by hand.
struct NotStarted {
  int error = 0;  ///< the value of errno
};

/// The worker itself, not its contestant, was short of something.
struct OutOfResources {
  std::string what;
};

/// The contestant cannot answer any more; the worker has ended.
struct Broken {
  std::string why;  ///< one line
};

struct Done {};

/// The worker has read the mesh and the traces.
struct Opened {
  double clock_cost_ns = 0;  ///< one reading's in the latency pass
  double ns_per_tick = 1;
  bool flushed_to_zero = false;  ///< a library had switched denormal numbers off; the worker switched them on
};

struct Built {
  std::string refused;  ///< the message of what build threw; empty when it built
  double build_ms = 0;
  std::uint64_t bytes = 0;
  std::uint64_t heap_bytes = 0;  ///< growth of the heap
  Accuracy accuracy;
  std::vector<workload::Query> queries;
  bool prepares = false;
  bool builds_lazily = false;  ///< its first queries build parts of it
  std::vector<std::string> remarks;
};

/// What a plug-in says that it is.
struct Described {
  std::string refused;  ///< what keeps it from being a contestant; empty: nothing
  std::string name, summary, accuracy;
  std::vector<workload::Query> queries;
  std::vector<contestants::OptionInfo> options;
};

/// What a plug-in's own script of a question is.
struct Reproduced {
  std::string refused;  ///< what it raised; empty: nothing
  std::string script;   ///< empty: it writes none
};

struct Answered {
  std::uint64_t checksum = 0;
  Work work;  ///< all steps'
};

struct Timed {
  double ns_per_query = 0;      ///< elapsed; of Calibrate the shorter of that and the processor time
  double cpu_ns_per_query = 0;  ///< only Time and Sample: without what other processes took of the core
  std::uint64_t checksum = 0;
  bool steady = true;                ///< every pass gave the same checksum
  Work work;                         ///< only FirstPass: all steps
  std::vector<double> samples = {};  ///< only Sample: see sample_throughput
  std::size_t interrupted = 0;       ///< samples that took over 1.2 times their processor time
};

struct Updated {
  bool supported = false;
  std::string refused;  ///< the message of what update threw
  std::size_t rounds = 0;
  double build_ms = 0;
  double update_ms = 0;
  double update_over_build = 0;  ///< within a round
};

/// What came of each tick lies in the output buffers as its record: first those of the warm-up.
struct ServoStretch {
  std::size_t warmed = 0;    ///< ticks of the warm-up with a record
  std::size_t recorded = 0;  ///< ticks with a record, which lie behind `warm_up` others
  bool placed = false;       ///< the proxy was put at its start before
  bool overrun = false;      ///< see PacedReplay::overrun
  std::uint64_t minor_faults = 0, major_faults = 0;  ///< the thread's, during `ticks`
  std::uint64_t involuntary_switches = 0;            ///< likewise
  std::string scheduler, memory;                     ///< see RealTimeScope and lock_memory
};

/// How many of queries there are.
struct ColdSamples {
  std::size_t taken = 0;
};

namespace request {

struct Open {
  using Reply = Opened;
  WorkloadLayout layout;
  bool calibrate_clock = true;
};

/// Comes alone: there is no workload then.
struct Describe {
  using Reply = Described;
  std::string plugin;
};

/// Comes alone, too. What a script that shows the answer to a question would be, in the plug-in's own API.
struct Reproduce {
  using Reply = Reproduced;
  std::string plugin;
  contestants::ReproducedQuestion question;
};

/// May come again.
struct Build {
  using Reply = Built;
  std::string contestant;
  std::string plugin = {};  ///< the file that the contestant is in; empty: one of the worker's own
};

/// The detector follows the deformed mesh then. Updates, there and back, and builds of the deformed mesh take
/// turns before; medians over the rounds.
struct Update {
  using Reply = Updated;
  meshes::Deformation deformation;
};

/// The detector is built anew, of the deformed mesh.
struct Rebuild {
  using Reply = Done;
  meshes::Deformation deformation;
};

/// One step, by a fresh session.
struct First {
  using Reply = Timed;
  Task task;
};

/// Replays the task's ranges once, or, where it names none, as many steps as `budget_ns` allows.
struct Calibrate {
  using Reply = Timed;
  Task task;
  double budget_ns = 0;
};

/// Answers and work lie in the output buffers then, from a fresh session or the one that answered last.
struct Answer {
  using Reply = Answered;
  Task task;
  bool fresh = true;
};

/// The answer to that step alone, by a fresh session; it lies first in the output buffers.
struct AnswerAfresh {
  using Reply = Answered;
  Task task;
  std::size_t step = 0;
};

/// By a fresh session.
struct FirstPass {
  using Reply = Timed;
  Task task;
};

struct Time {
  using Reply = Timed;
  Task task;
  std::int64_t passes = 1;
};

/// See sample_throughput.
struct Sample {
  using Reply = Timed;
  Task task;
  std::int64_t passes = 1;
  std::int64_t replays = 1;
};

/// Ticks lie in the output buffers then.
struct Latency {
  using Reply = Timed;
  Task task;
};

/// A proxy for a paced loop to step.
struct Proxy {
  bool wanted = false;
  Coupling coupling = {};
  std::array<double, 3> start = {};  ///< Before its first step it is put there.
};

/// A stretch of a paced loop. The session goes on from stretch to stretch, and so does the proxy, which is
/// placed before the first.
struct Servo {
  using Reply = ServoStretch;
  Task task;
  Pace pace;
  std::size_t warm_up = 0;        ///< ticks before, which are not among them
  std::size_t ticks = 1;          ///< with the warm-up at most as many as the output has room for
  bool idle = false;              ///< nothing is asked
  std::size_t evicted_bytes = 0;  ///< walked over before each tick; 0: nothing is
  Proxy proxy = {};               ///< what is stepped in place of the query

  /// What it takes by the clock before the contestant takes any time.
  std::chrono::milliseconds paced_time() const {
    const double ticks_ms = 1e3 * static_cast<double>(warm_up + ticks + 2) * pace.slowdown / pace.rate_hz;
    return std::chrono::milliseconds(std::llround(ticks_ms));
  }
};

/// Queries with emptied caches: see ColdReplay. The samples lie in the output buffers as tick records,
/// without latencies: those with nothing asked, and then those of queries.
struct Cold {
  using Reply = ColdSamples;
  Task task;
  std::size_t evicted_bytes = 0;  ///< walked over before each sample; 0: nothing is
  std::size_t floor_samples = 0;  ///< with nothing asked: what the clock takes, and its own misses
  std::size_t first_sample = 0;   ///< how many of queries other requests had before
  std::size_t min_samples = 1;    ///< queries, however long they take
  std::size_t max_samples = 1;    ///< with the floor's at most as many as the output has room for
  double budget_ns = 0;           ///< no sample above the least is begun later
};

/// Replays samples, each counted alone: see count_lines.
struct Lines {
  using Reply = Done;
  Task task;
  std::size_t samples = 1;
};

}  // namespace request

using Request = std::variant<request::Open, request::Build, request::Update, request::Rebuild, request::First,
                             request::Calibrate, request::Answer, request::AnswerAfresh, request::FirstPass,
                             request::Time, request::Sample, request::Latency, request::Servo, request::Cold,
                             request::Lines, request::Describe, request::Reproduce>;
using Reply = std::variant<NotStarted, OutOfResources, Done, Opened, Built, Answered, Timed, Updated,
                           ServoStretch, ColdSamples, Described, Broken, Reproduced>;

// A line is [which of them, {its members}], so that a reply NotStarted is [0,{"error":2}]. Bytes that are not
// UTF-8, which messages of rivals and file names may hold, are replaced.
std::string line_of(const Request& request);
std::string line_of(const Reply& reply);
/// Throws std::exception for a line that is none.
Request request_in(const std::string& line);
Reply reply_in(const std::string& line);

}  // namespace touchmark::bench::workers
