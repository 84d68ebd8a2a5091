#include "bench/workers/worker.h"

#include <algorithm>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <malloc.h>
#include <nlohmann/json.hpp>

#include "bench/contestants/build_notes.h"
#include "bench/contestants/tick_clock.h"
#include "bench/scenes/deformation.h"
#include "bench/support/available_memory.h"
#include "bench/support/denormals.h"
#include "bench/support/failures.h"
#include "bench/support/processor_time.h"
#include "bench/support/system_limit.h"
#include "bench/workers/line_channel.h"
#include "bench/workers/shared_memory.h"
#include "bench/workers/shared_workload.h"
#include "bench/workers/throughput.h"
#include "bench/workers/update_timing.h"
#include "bench/workers/worker_protocol.h"
#include "bench/workload/query_name.h"
#include "bench/workload/sample_steps.h"

namespace touchmark::bench::workers {
namespace {

std::uint64_t heap_in_use() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

/// Messages of rivals and file names may hold bytes that are not UTF-8.
std::string dumped(const nlohmann::json& json) {
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

class Worker {
 public:
  explicit Worker(const contestants::Roster& roster)
      : roster_(roster),
        input_(SharedMemory::attach(worker_input, SharedMemory::Access::read)),
        output_(SharedMemory::attach(worker_output, SharedMemory::Access::write)) {}

  /// Returns the reply to one request.
  nlohmann::json dispatch(const nlohmann::json& request) {
    const std::string what = request.at("order");
    if (what == "open") return open(request.at("layout"), request.at("calibrate_clock"));
    if (what == "build") {
      contestants::take_remarks();
      nlohmann::json reply = build(request.at("contestant"));
      reply["remarks"] = contestants::take_remarks();
      return reply;
    }
    if (contestant_ == nullptr) throw std::logic_error("nothing is built");
    if (what == "update") return update(request.at("contestant"), request.at("deformation"));
    if (what == "rebuild") return rebuild(request.at("contestant"), request.at("deformation"));
    const Task task = request.at("task");
    if (what == "first") return first(task);
    if (what == "calibrate") return calibrate(task, request.at("budget_ns"));
    if (what == "answer") return answer(task);
    if (what == "answer_afresh") return answer_afresh(task, request.at("step"));
    if (what == "first_pass") return first_pass(task);
    if (what == "time") return time(task, request.at("passes"));
    if (what == "sample") return sample(task, request.at("passes"), request.at("together"));
    if (what == "latency") return latency(task);
    throw std::logic_error("unknown order " + what);
  }

 private:
  nlohmann::json open(const WorkloadLayout& layout, bool with_clock);
  nlohmann::json build(const std::string& spec);
  nlohmann::json update(const std::string& spec, const scenes::Deformation& deformation);
  nlohmann::json rebuild(const std::string& spec, const scenes::Deformation& deformation);
  nlohmann::json refused(std::string why);
  nlohmann::json first(const Task& task);
  nlohmann::json calibrate(const Task& task, double budget_ns);
  nlohmann::json answer(const Task& task);
  nlohmann::json answer_afresh(const Task& task, std::size_t step);
  nlohmann::json first_pass(const Task& task);
  nlohmann::json time(const Task& task, std::int64_t passes);
  nlohmann::json sample(const Task& task, std::int64_t passes, std::int64_t replays);
  nlohmann::json latency(const Task& task);

  workload::QueryTrace trace_of(const Task& task) const { return {task.query, traces_.at(task.trace)}; }
  std::vector<workload::StepRange> ranges_of(const Task& task) const {
    return task.ranges.empty() ? workload::sample_steps(traces_.at(task.trace).size(), task.steps)
                               : task.ranges;
  }
  double timed_build(const contestants::ContestantSpec& spec);
  Timed timed_replay(const workload::QueryTrace& trace, const std::vector<workload::StepRange>& ranges);

  const contestants::Roster& roster_;
  SharedMemory input_;
  SharedMemory output_;
  WorkloadLayout layout_;
  std::optional<OutputBuffers> buffers_;
  std::optional<TriangleMesh> mesh_;
  std::vector<std::vector<workload::Step>> traces_;
  std::unique_ptr<contestants::Contestant> contestant_;
};

nlohmann::json Worker::open(const WorkloadLayout& layout, bool with_clock) {
  Opened opened;
  opened.flushed_to_zero = support::restore_denormals();
  layout_ = layout;
  mesh_ = read_mesh(input_.bytes(), layout);
  traces_ = read_traces(input_.bytes(), layout);
  buffers_.emplace(output_.bytes(), layout.longest_trace());
  const contestants::ClockCalibration clock =
      with_clock ? contestants::calibrate_clock() : contestants::ClockCalibration{};
  opened.clock_cost_ns = clock.cost_ns;
  opened.ns_per_tick = clock.ns_per_tick;
  return opened;
}

double Worker::timed_build(const contestants::ContestantSpec& spec) {
  contestant_.reset();
  roster_.require_memory_for(spec, mesh_->size());
  const Clock::time_point start = Clock::now();
  contestant_ = roster_.build(spec, *mesh_);
  return ns_since(start);
}

nlohmann::json Worker::build(const std::string& spec_text) {
  const contestants::ContestantSpec spec = roster_.parse(spec_text);
  if (!mesh_) mesh_ = read_mesh(input_.bytes(), layout_);
  Built built;
  const std::uint64_t heap_before = heap_in_use();
  std::vector<double> times_ns;
  try {
    times_ns.push_back(timed_build(spec));
    const std::uint64_t heap_after = heap_in_use();
    built.heap_bytes = heap_after > heap_before ? heap_after - heap_before : 0;
    // A short build is repeated, since the first one pays for page faults that have nothing to do with it.
    constexpr double short_build_ns = 20e6;
    while (times_ns.size() < 5 && times_ns.front() < short_build_ns) times_ns.push_back(timed_build(spec));
  } catch (const std::bad_alloc&) {
    return refused(fmt::format("{}all of it is taken", support::no_memory));
  } catch (const support::ResourceError& error) {
    return refused(fmt::format("{}{}", support::no_memory, error.what()));
  } catch (const std::system_error& error) {
    if (support::limit_behind(error.code().value()).empty()) return refused(error.what());
    throw;  // for want of threads or descriptors, which is no fault of the mesh
  } catch (const std::exception& error) {
    return refused(error.what());
  }
  std::nth_element(times_ns.begin(), times_ns.begin() + static_cast<std::ptrdiff_t>(times_ns.size() / 2),
                   times_ns.end());
  built.build_ms = times_ns[times_ns.size() / 2] / 1e6;
  mesh_.reset();  // detectors hold copies of what they need
  built.bytes = contestant_->bytes();
  built.accuracy = contestant_->accuracy();
  for (const workload::Query query : workload::all_queries) {
    if (contestant_->answers(query)) built.queries.push_back(query);
  }
  built.prepares = contestant_->prepares();
  built.builds_lazily = contestant_->builds_lazily();
  return built;
}

nlohmann::json Worker::refused(std::string why) {
  contestant_.reset();
  Built built;
  built.refused = std::move(why);
  return built;
}

Timed Worker::timed_replay(const workload::QueryTrace& trace,
                           const std::vector<workload::StepRange>& ranges) {
  workload::Checksum checksum;
  const Clock::time_point start = Clock::now();
  for (const workload::StepRange& range : ranges) contestant_->replay(trace, range, checksum);
  const double elapsed = ns_since(start);
  return {elapsed / static_cast<double>(workload::steps_in(ranges)), 0, checksum.value(), true, {}};
}

nlohmann::json Worker::update(const std::string& spec_text, const scenes::Deformation& deformation) {
  if (!contestant_->updates()) return Updated{};
  const TriangleMesh rest = read_mesh(input_.bytes(), layout_);
  return time_updates(*contestant_, roster_, roster_.parse(spec_text), rest, deformation);
}

nlohmann::json Worker::rebuild(const std::string& spec, const scenes::Deformation& deformation) {
  const contestants::ContestantSpec parsed = roster_.parse(spec);
  const TriangleMesh moved = scenes::deformed(read_mesh(input_.bytes(), layout_), deformation);
  roster_.require_memory_for(parsed, moved.size());
  contestant_ = roster_.build(parsed, moved);
  return nlohmann::json::object();
}

nlohmann::json Worker::first(const Task& task) {
  contestant_->forget();
  return timed_replay(trace_of(task), {{0, 1}});
}

nlohmann::json Worker::calibrate(const Task& task, double budget_ns) {
  if (!task.ranges.empty()) {
    const double start = support::processor_ns();
    Timed timed = timed_replay(trace_of(task), task.ranges);
    const double processor =
        (support::processor_ns() - start) / static_cast<double>(workload::steps_in(task.ranges));
    timed.ns_per_query = std::min(timed.ns_per_query, processor);
    return timed;
  }
  const std::size_t total = traces_.at(task.trace).size();
  for (std::size_t steps = 2;; steps *= 4) {
    const std::vector<workload::StepRange> ranges = workload::sample_steps(total, steps);
    const Timed timed = timed_replay(trace_of(task), ranges);
    const double elapsed = timed.ns_per_query * static_cast<double>(workload::steps_in(ranges));
    if (elapsed * 4 >= budget_ns || steps >= total) return timed;
  }
}

nlohmann::json Worker::answer(const Task& task) {
  const workload::QueryTrace trace = trace_of(task);
  const std::vector<workload::StepRange> ranges = ranges_of(task);
  const std::size_t steps = workload::steps_in(ranges);
  contestant_->forget();
  std::size_t done = 0;
  for (const workload::StepRange& range : ranges) {
    contestant_->answer(trace, range, buffers_->answers(steps).subspan(done, range.size()),
                        buffers_->work(steps).subspan(done, range.size()));
    done += range.size();
  }
  workload::Checksum checksum;
  for (const workload::Answer& answer : buffers_->answers(steps)) checksum.add(answer);
  return Answered{checksum.value(), contestant_->work()};
}

nlohmann::json Worker::answer_afresh(const Task& task, std::size_t step) {
  contestant_->forget();
  contestant_->answer(trace_of(task), {step, step + 1}, buffers_->answers(1), buffers_->work(1));
  workload::Checksum checksum;
  checksum.add(buffers_->answers(1).front());
  return Answered{checksum.value(), contestant_->work()};
}

nlohmann::json Worker::first_pass(const Task& task) {
  contestant_->forget();
  Timed timed = timed_replay(trace_of(task), ranges_of(task));
  timed.work = contestant_->work();
  return timed;
}

nlohmann::json Worker::time(const Task& task, std::int64_t passes) {
  const Throughput throughput = measure_throughput(*contestant_, trace_of(task), ranges_of(task), passes);
  return Timed{
      throughput.ns_per_query, throughput.cpu_ns_per_query, throughput.checksum, throughput.steady, {}};
}

nlohmann::json Worker::sample(const Task& task, std::int64_t passes, std::int64_t replays) {
  const Throughput throughput =
      sample_throughput(*contestant_, trace_of(task), ranges_of(task), passes, replays);
  return Timed{
      throughput.ns_per_query, throughput.cpu_ns_per_query, throughput.checksum, throughput.steady, {},
      throughput.samples,      throughput.interrupted};
}

nlohmann::json Worker::latency(const Task& task) {
  const workload::QueryTrace trace = trace_of(task);
  const std::vector<workload::StepRange> ranges = ranges_of(task);
  const std::span<std::uint64_t> ticks = buffers_->ticks(workload::steps_in(ranges));
  const std::span<std::uint64_t> prepare_ticks = buffers_->prepare_ticks(ticks.size());
  // No page fault inside a timed step.
  std::fill(ticks.begin(), ticks.end(), 0);
  std::fill(prepare_ticks.begin(), prepare_ticks.end(), 0);
  workload::Checksum checksum;
  std::size_t done = 0;
  const Clock::time_point start = Clock::now();
  for (const workload::StepRange& range : ranges) {
    contestant_->replay_clocked(trace, range, checksum, ticks.subspan(done, range.size()),
                                prepare_ticks.subspan(done, range.size()));
    done += range.size();
  }
  return Timed{ns_since(start) / static_cast<double>(done), 0, checksum.value(), true, {}};
}

void serve(Worker worker, LineChannel channel) {
  std::string line;
  while (channel.receive(line, std::nullopt, [] {}) == LineChannel::Outcome::line) {
    if (!channel.send(dumped(worker.dispatch(nlohmann::json::parse(line))))) return;
  }
}

}  // namespace

int run_worker(int argc, char** argv, const contestants::Roster& roster) {
  const LineChannel channel(worker_control);
  const auto reply_exhausted = [&](const std::string& what) {
    channel.send(dumped({{out_of_resources, what}}));
    return support::exit_resources;
  };
  try {
    initialize_throughput({argv + 1, argv + argc});
    serve(Worker(roster), LineChannel(worker_control));
    return support::exit_done;
  } catch (const std::bad_alloc&) {
    return reply_exhausted("out of memory" + support::memory_limit());
  } catch (const support::ResourceError& error) {
    return reply_exhausted(error.what());
  } catch (const std::system_error& error) {
    return reply_exhausted(error.what() + support::limit_behind(error.code().value()));
  } catch (const std::exception& error) {
    fmt::print(stderr, "worker: {}\n", error.what());
    return support::exit_resources;
  }
}

}  // namespace touchmark::bench::workers
