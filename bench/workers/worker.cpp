#include "bench/workers/worker.h"

#include <algorithm>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <malloc.h>

#include "bench/contestants/broken.h"
#include "bench/contestants/build_notes.h"
#include "bench/contestants/guided_proxy.h"
#include "bench/contestants/tick_clock.h"
#include "bench/meshes/deformation.h"
#include "bench/support/failures.h"
#include "bench/support/median.h"
#include "bench/support/system/available_memory.h"
#include "bench/support/system/denormals.h"
#include "bench/support/system/own_time.h"
#include "bench/support/system/system_limit.h"
#include "bench/workers/build_cores.h"
#include "bench/workers/geometry.h"
#include "bench/workers/line_channel.h"
#include "bench/workers/shared_memory.h"
#include "bench/workers/shared_workload.h"
#include "bench/workers/timing/cache_lines.h"
#include "bench/workers/timing/cold_replay.h"
#include "bench/workers/timing/run_servo.h"
#include "bench/workers/timing/throughput.h"
#include "bench/workers/timing/update_timing.h"
#include "bench/workers/worker_protocol.h"
#include "bench/workers/worker_roster.h"
#include "bench/workload/query_name.h"
#include "bench/workload/sample_steps.h"

namespace touchmark::bench::workers {
namespace {

std::uint64_t heap_in_use() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

class Worker {
 public:
  Worker(const contestants::Roster& roster, LoadPlugin load)
      : roster_(roster, load),
        input_(SharedMemory::attach(worker_input, SharedMemory::Access::read)),
        output_(SharedMemory::attach(worker_output, SharedMemory::Access::write)) {}

  Reply dispatch(const Request& request) {
    return std::visit(
        [&](const auto& one) -> Reply {
          using Kind = std::decay_t<decltype(one)>;
          constexpr bool before = std::is_same_v<Kind, request::Open> || requires { one.plugin; };
          if (!before && contestant_ == nullptr) throw std::logic_error("nothing is built");
          return typename Kind::Reply(handle(one));
        },
        request);
  }

 private:
  Opened handle(const request::Open& request) {
    Opened opened;
    opened.flushed_to_zero = support::restore_denormals();
    layout_ = request.layout;
    geometry_.emplace(input_.bytes(), layout_);
    traces_ = read_traces(input_.bytes(), layout_);
    schedules_ = read_schedules(input_.bytes(), layout_);
    buffers_.emplace(output_.bytes(), layout_.output_steps());
    const contestants::ClockCalibration clock =
        request.calibrate_clock ? contestants::calibrate_clock() : contestants::ClockCalibration(1, 0);
    opened.clock_cost_ns = clock.cost_ns;
    opened.ns_per_tick = clock.ns_per_tick;
    return opened;
  }

  /// Describe and Reproduce.
  template <class Asked>
  typename Asked::Reply handle(const Asked& request) {
    return roster_.reply(request);
  }
  Built handle(const request::Build& request) {
    contestants::take_remarks();
    Built reply;
    const auto refuse = [&](std::string why) {
      contestant_.reset();
      reply.refused = std::move(why);
    };
    try {
      spec_ = roster_.chosen(request);
      reply = built();
    } catch (const std::bad_alloc&) {
      refuse(fmt::format("{}all of it is taken", support::no_memory));
    } catch (const support::ResourceError& error) {
      refuse(fmt::format("{}{}", support::no_memory, error.what()));
    } catch (const std::system_error& error) {
      if (!support::limit_behind(error.code().value()).empty()) throw;  // no fault of the mesh
      refuse(error.what());
    } catch (const std::exception& error) {
      refuse(error.what());
    }
    reply.remarks = contestants::take_remarks();
    return reply;
  }

  Updated handle(const request::Update& request) {
    if (!contestant_->updates() || layout_.bodies > 0) return {};
    return time_updates(*contestant_, *roster_, *spec_, read_mesh(input_.bytes(), layout_),
                        request.deformation);
  }

  Done handle(const request::Rebuild& request) {
    const TriangleMesh moved = meshes::deformed(read_mesh(input_.bytes(), layout_), request.deformation);
    roster_->prepare_to_build(*spec_, moved.size());
    proxy_.reset();
    contestant_ = roster_->build(*spec_, moved);
    return {};
  }

  Timed handle(const request::First& request) {
    contestant_->forget();
    return timed_replay(trace_of(request.task), {{0, 1}});
  }

  Timed handle(const request::Calibrate& request) {
    const Task& task = request.task;
    if (!task.ranges.empty()) {
      const support::OwnTime clock;
      Timed timed = timed_replay(trace_of(task), task.ranges);
      timed.ns_per_query = clock.so_far().ns / static_cast<double>(workload::steps_in(task.ranges));
      return timed;
    }
    const std::size_t total = traces_.at(task.trace).size();
    for (std::size_t steps = 2;; steps *= 4) {
      const std::vector<workload::StepRange> ranges = workload::sample_steps(total, steps);
      const Timed timed = timed_replay(trace_of(task), ranges);
      const double elapsed = timed.ns_per_query * static_cast<double>(workload::steps_in(ranges));
      if (elapsed * 4 >= request.budget_ns || steps >= total) return timed;
    }
  }

  Answered handle(const request::Answer& request) {
    if (request.fresh) contestant_->forget();
    return answered(trace_of(request.task), ranges_of(request.task));
  }

  Answered handle(const request::AnswerAfresh& request) {
    contestant_->forget();
    return answered(trace_of(request.task), {{request.step, request.step + 1}});
  }

  Timed handle(const request::FirstPass& request) {
    contestant_->forget();
    Timed timed = timed_replay(trace_of(request.task), ranges_of(request.task));
    timed.work = contestant_->work();
    return timed;
  }

  Timed handle(const request::Time& request) {
    return measure_throughput(*contestant_, trace_of(request.task), ranges_of(request.task), request.passes);
  }
  Timed handle(const request::Sample& request) {
    return sample_throughput(*contestant_, trace_of(request.task), ranges_of(request.task), request.passes,
                             request.replays);
  }
  Timed handle(const request::Latency& request) {
    return clock_steps(*contestant_, trace_of(request.task), ranges_of(request.task), *buffers_);
  }
  ServoStretch handle(const request::Servo& request) {
    const auto mesh = [&]() -> std::optional<TriangleMesh> {
      if (layout_.bodies > 0) return std::nullopt;
      return read_mesh(input_.bytes(), layout_);
    };
    return run_servo(*contestant_, proxy_, mesh, trace_of(request.task), request, *buffers_, output_.bytes());
  }
  ColdSamples handle(const request::Cold& request) {
    return run_cold(*contestant_, trace_of(request.task), ranges_of(request.task), request, *buffers_,
                    output_.bytes());
  }

  Done handle(const request::Lines& request) {
    count_lines(*contestant_, trace_of(request.task), ranges_of(request.task), request.samples);
    return {};
  }

  workload::QueryTrace trace_of(const Task& task) const {
    return {task.query, traces_.at(task.trace), layout_.bodies > 0 ? &schedules_.at(task.trace) : nullptr};
  }
  std::vector<workload::StepRange> ranges_of(const Task& task) const {
    return task.ranges.empty() ? workload::sample_steps(traces_.at(task.trace).size(), task.steps)
                               : task.ranges;
  }
  Built built() {
    if (!geometry_) geometry_.emplace(input_.bytes(), layout_);
    Built built;
    const std::uint64_t heap_before = heap_in_use();
    std::vector<double> times_ns{timed_build()};
    const std::uint64_t heap_after = heap_in_use();
    built.heap_bytes = heap_after > heap_before ? heap_after - heap_before : 0;
    // A short build is repeated, since the first one pays for page faults that have nothing to do with it.
    constexpr double short_build_ns = 20e6;
    while (times_ns.size() < 5 && times_ns.front() < short_build_ns) times_ns.push_back(timed_build());
    built.build_ms = support::median(times_ns) / 1e6;
    geometry_.reset();  // detectors hold copies of what they need
    built.bytes = contestant_->bytes();
    built.accuracy = contestant_->accuracy();
    for (const workload::Query query : workload::queries_of_scenes)
      if (contestant_->answers(query)) built.queries.push_back(query);
    built.prepares = contestant_->prepares();
    built.builds_lazily = contestant_->builds_lazily();
    return built;
  }
  /// The ranges' answers and work, one after the other in the output buffers.
  Answered answered(const workload::QueryTrace& trace, const std::vector<workload::StepRange>& ranges) {
    const std::size_t steps = workload::steps_in(ranges);
    const Work before = contestant_->work();
    std::size_t done = 0;
    for (const workload::StepRange& range : ranges) {
      contestant_->answer(trace, range, buffers_->answers(steps).subspan(done, range.size()),
                          buffers_->work(steps).subspan(done, range.size()));
      done += range.size();
    }
    workload::Checksum checksum;
    for (const workload::Answer& answer : buffers_->answers(steps)) checksum.add(answer);
    return {checksum.value(), contestants::work_between(before, contestant_->work())};
  }

  double timed_build() {
    proxy_.reset();
    contestant_.reset();
    roster_->prepare_to_build(*spec_, geometry_->triangles());
    const BuildCores cores(*spec_);
    const Clock::time_point start = Clock::now();
    contestant_ = geometry_->build(*roster_, *spec_);
    return ns_since(start);
  }

  Timed timed_replay(const workload::QueryTrace& trace, const std::vector<workload::StepRange>& ranges) {
    workload::Checksum checksum;
    const Clock::time_point start = Clock::now();
    for (const workload::StepRange& range : ranges) contestant_->replay(trace, range, checksum);
    const double elapsed = ns_since(start);
    return {elapsed / static_cast<double>(workload::steps_in(ranges)), 0, checksum.value(), true, {}};
  }

  WorkerRoster roster_;
  SharedMemory input_;
  SharedMemory output_;
  WorkloadLayout layout_;
  std::optional<OutputBuffers> buffers_;
  std::optional<Geometry> geometry_;
  std::vector<std::vector<workload::Step>> traces_;
  std::vector<scenes::ScheduleView> schedules_;
  std::optional<contestants::ContestantSpec> spec_;
  std::unique_ptr<contestants::Contestant> contestant_;
  std::optional<contestants::GuidedProxy> proxy_;  ///< over the same detector
};

void tell_broken(const std::string& why) noexcept {
  LineChannel(worker_control).send(line_of(Reply(Broken{why})));
}

void serve(Worker worker, LineChannel channel) {
  std::string line;
  while (channel.receive(line, std::nullopt, [] {}) == LineChannel::Outcome::line)
    if (!channel.send(line_of(worker.dispatch(request_in(line))))) return;
}

}  // namespace

int run_worker(int argc, char** argv, const contestants::Roster& roster, LoadPlugin load) {
  const LineChannel channel(worker_control);
  const auto reply_exhausted = [&](const std::string& what) {
    channel.send(line_of(OutOfResources{what}));
    return support::exit_resources;
  };
  contestants::set_tell_broken(&tell_broken);
  try {
    initialize_throughput({argv + 1, argv + argc});
    serve(Worker(roster, load), LineChannel(worker_control));
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
