#include "bench/workers/worker.h"

#include <algorithm>
#include <chrono>
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
#include "bench/support/median.h"
#include "bench/support/processor_time.h"
#include "bench/support/system_limit.h"
#include "bench/workers/line_channel.h"
#include "bench/workers/shared_memory.h"
#include "bench/workers/shared_workload.h"
#include "bench/workers/throughput.h"
#include "bench/workers/worker_protocol.h"
#include "bench/workload/query_name.h"
#include "bench/workload/sample_steps.h"

namespace touchmark::bench {
namespace {

using Clock = std::chrono::steady_clock;

double ns_since(Clock::time_point start) {
  return std::chrono::duration<double, std::nano>(Clock::now() - start).count();
}

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
  explicit Worker(const Roster& roster)
      : roster_(roster),
        input_(SharedMemory::attach(worker_input, SharedMemory::Access::read)),
        output_(SharedMemory::attach(worker_output, SharedMemory::Access::write)) {}

  /// The reply to one order.
  nlohmann::json obey(const nlohmann::json& order) {
    const std::string what = order.at("order");
    if (what == "open") return open(order.at("layout"), order.at("calibrate_clock"));
    if (what == "build") {
      take_remarks();
      nlohmann::json reply = build(order.at("contestant"));
      reply["remarks"] = take_remarks();
      return reply;
    }
    if (contestant_ == nullptr) throw std::logic_error("nothing is built");
    if (what == "update") return update(order.at("contestant"), order.at("deformation"));
    if (what == "rebuild") return rebuild(order.at("contestant"), order.at("deformation"));
    const Task task = order.at("task");
    if (what == "first") return first(task);
    if (what == "calibrate") return calibrate(task, order.at("budget_ns"));
    if (what == "answer") return answer(task);
    if (what == "answer_afresh") return answer_afresh(task, order.at("step"));
    if (what == "first_pass") return first_pass(task);
    if (what == "time") return time(task, order.at("passes"));
    if (what == "sample") return sample(task, order.at("passes"), order.at("together"));
    if (what == "latency") return latency(task);
    throw std::logic_error("unknown order " + what);
  }

 private:
  nlohmann::json open(const WorkloadLayout& layout, bool with_clock);
  nlohmann::json build(const std::string& spec);
  nlohmann::json update(const std::string& spec, const Deformation& deformation);
  nlohmann::json rebuild(const std::string& spec, const Deformation& deformation);
  nlohmann::json refused(std::string why);
  nlohmann::json first(const Task& task);
  nlohmann::json calibrate(const Task& task, double budget_ns);
  nlohmann::json answer(const Task& task);
  nlohmann::json answer_afresh(const Task& task, std::size_t step);
  nlohmann::json first_pass(const Task& task);
  nlohmann::json time(const Task& task, std::int64_t passes);
  nlohmann::json sample(const Task& task, std::int64_t passes, std::int64_t together);
  nlohmann::json latency(const Task& task);

  Course course_of(const Task& task) const { return {task.query, courses_.at(task.course)}; }
  std::vector<Window> windows_of(const Task& task) const {
    return task.windows.empty() ? plan_windows(courses_.at(task.course).size(), task.steps) : task.windows;
  }
  double timed_build(const ContestantSpec& spec);
  Timed timed_replay(const Course& course, const std::vector<Window>& windows);

  const Roster& roster_;
  SharedMemory input_;
  SharedMemory output_;
  WorkloadLayout layout_;
  std::optional<OutputRoom> room_;
  std::optional<TriangleMesh> mesh_;
  std::vector<std::vector<Step>> courses_;
  std::unique_ptr<Contestant> contestant_;
};

nlohmann::json Worker::open(const WorkloadLayout& layout, bool with_clock) {
  Opened opened;
  opened.flushed_to_zero = restore_denormals();
  layout_ = layout;
  mesh_ = read_mesh(input_.bytes(), layout);
  courses_ = read_courses(input_.bytes(), layout);
  room_.emplace(output_.bytes(), layout.longest_course());
  const ClockCalibration clock = with_clock ? calibrate_clock() : ClockCalibration{};
  opened.clock_cost_ns = clock.cost_ns;
  opened.ns_per_tick = clock.ns_per_tick;
  return opened;
}

double Worker::timed_build(const ContestantSpec& spec) {
  contestant_.reset();
  roster_.require_memory_for(spec, mesh_->size());
  const Clock::time_point start = Clock::now();
  contestant_ = roster_.build(spec, *mesh_);
  return ns_since(start);
}

nlohmann::json Worker::build(const std::string& spec_text) {
  const ContestantSpec spec = roster_.parse(spec_text);
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
    return refused(fmt::format("{}all of it is taken", no_memory));
  } catch (const ResourceError& error) {
    return refused(fmt::format("{}{}", no_memory, error.what()));
  } catch (const std::system_error& error) {
    if (limit_behind(error.code().value()).empty()) return refused(error.what());
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
  for (const Query query : all_queries) {
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

Timed Worker::timed_replay(const Course& course, const std::vector<Window>& windows) {
  Checksum checksum;
  const Clock::time_point start = Clock::now();
  for (const Window& window : windows) contestant_->replay(course, window, checksum);
  const double elapsed = ns_since(start);
  return {elapsed / static_cast<double>(steps_in(windows)), 0, checksum.value(), true, {}};
}

nlohmann::json Worker::update(const std::string& spec_text, const Deformation& deformation) {
  constexpr std::size_t fewest_rounds = 3, most_rounds = 25;
  constexpr double enough_ns = 1e9;
  Updated updated;
  updated.supported = contestant_->updates();
  if (!updated.supported) return updated;
  const ContestantSpec spec = roster_.parse(spec_text);
  const TriangleMesh rest = read_mesh(input_.bytes(), layout_), moved = deformed(rest, deformation);
  const auto timed_update = [&](const TriangleMesh& mesh) {
    const Clock::time_point start = Clock::now();
    contestant_->update(mesh);
    return ns_since(start);
  };
  std::vector<double> builds, updates, ratios;
  try {
    contestant_->update(rest);
    roster_.require_memory_for(spec, moved.size());
    const Clock::time_point start = Clock::now();
    while (builds.size() < fewest_rounds || (builds.size() < most_rounds && ns_since(start) < enough_ns)) {
      const double there = timed_update(moved), back = timed_update(rest);
      const Clock::time_point before = Clock::now();
      std::unique_ptr<Contestant> anew = roster_.build(spec, moved);
      builds.push_back(ns_since(before));
      updates.insert(updates.end(), {there, back});
      ratios.push_back(0.5 * (there + back) / builds.back());
    }
    contestant_->update(moved);
  } catch (const std::exception& error) {
    updated.refused = error.what();
    return updated;
  }
  updated.rounds = builds.size();
  updated.build_ms = median(builds) / 1e6;
  updated.update_ms = median(updates) / 1e6;
  updated.update_over_build = median(ratios);
  return updated;
}

nlohmann::json Worker::rebuild(const std::string& spec, const Deformation& deformation) {
  const ContestantSpec parsed = roster_.parse(spec);
  const TriangleMesh moved = deformed(read_mesh(input_.bytes(), layout_), deformation);
  roster_.require_memory_for(parsed, moved.size());
  contestant_ = roster_.build(parsed, moved);
  return nlohmann::json::object();
}

nlohmann::json Worker::first(const Task& task) {
  contestant_->forget();
  return timed_replay(course_of(task), {{0, 1}});
}

nlohmann::json Worker::calibrate(const Task& task, double budget_ns) {
  if (!task.windows.empty()) {
    const double start = processor_ns();
    Timed timed = timed_replay(course_of(task), task.windows);
    const double processor = (processor_ns() - start) / static_cast<double>(steps_in(task.windows));
    timed.ns_per_query = std::min(timed.ns_per_query, processor);
    return timed;
  }
  const std::size_t total = courses_.at(task.course).size();
  for (std::size_t steps = 2;; steps *= 4) {
    const std::vector<Window> windows = plan_windows(total, steps);
    const Timed timed = timed_replay(course_of(task), windows);
    const double elapsed = timed.ns_per_query * static_cast<double>(steps_in(windows));
    if (elapsed * 4 >= budget_ns || steps >= total) return timed;
  }
}

nlohmann::json Worker::answer(const Task& task) {
  const Course course = course_of(task);
  const std::vector<Window> windows = windows_of(task);
  const std::size_t steps = steps_in(windows);
  contestant_->forget();
  std::size_t done = 0;
  for (const Window& window : windows) {
    contestant_->answer(course, window, room_->answers(steps).subspan(done, window.size()),
                        room_->work(steps).subspan(done, window.size()));
    done += window.size();
  }
  Checksum checksum;
  for (const Answer& answer : room_->answers(steps)) checksum.add(answer);
  return Answered{checksum.value(), contestant_->work()};
}

nlohmann::json Worker::answer_afresh(const Task& task, std::size_t step) {
  contestant_->forget();
  contestant_->answer(course_of(task), {step, step + 1}, room_->answers(1), room_->work(1));
  Checksum checksum;
  checksum.add(room_->answers(1).front());
  return Answered{checksum.value(), contestant_->work()};
}

nlohmann::json Worker::first_pass(const Task& task) {
  contestant_->forget();
  Timed timed = timed_replay(course_of(task), windows_of(task));
  timed.work = contestant_->work();
  return timed;
}

nlohmann::json Worker::time(const Task& task, std::int64_t passes) {
  const Throughput throughput = measure_throughput(*contestant_, course_of(task), windows_of(task), passes);
  return Timed{
      throughput.ns_per_query, throughput.cpu_ns_per_query, throughput.checksum, throughput.steady, {}};
}

nlohmann::json Worker::sample(const Task& task, std::int64_t passes, std::int64_t together) {
  const Throughput throughput =
      sample_throughput(*contestant_, course_of(task), windows_of(task), passes, together);
  return Timed{
      throughput.ns_per_query, throughput.cpu_ns_per_query, throughput.checksum, throughput.steady, {},
      throughput.samples,      throughput.interrupted};
}

nlohmann::json Worker::latency(const Task& task) {
  const Course course = course_of(task);
  const std::vector<Window> windows = windows_of(task);
  const std::span<std::uint64_t> ticks = room_->ticks(steps_in(windows));
  const std::span<std::uint64_t> prepare_ticks = room_->prepare_ticks(ticks.size());
  // No page fault inside a timed step.
  std::fill(ticks.begin(), ticks.end(), 0);
  std::fill(prepare_ticks.begin(), prepare_ticks.end(), 0);
  Checksum checksum;
  std::size_t done = 0;
  const Clock::time_point start = Clock::now();
  for (const Window& window : windows) {
    contestant_->replay_clocked(course, window, checksum, ticks.subspan(done, window.size()),
                                prepare_ticks.subspan(done, window.size()));
    done += window.size();
  }
  return Timed{ns_since(start) / static_cast<double>(done), 0, checksum.value(), true, {}};
}

void serve(Worker worker, LineChannel channel) {
  std::string line;
  while (channel.receive(line, std::nullopt, [] {}) == LineChannel::Outcome::line) {
    if (!channel.send(dumped(worker.obey(nlohmann::json::parse(line))))) return;
  }
}

}  // namespace

int run_worker(int argc, char** argv, const Roster& roster) {
  const LineChannel channel(worker_control);
  const auto give_up = [&](const std::string& what) {
    channel.send(dumped({{out_of_resources, what}}));
    return exit_resources;
  };
  try {
    initialize_throughput({argv + 1, argv + argc});
    serve(Worker(roster), LineChannel(worker_control));
    return exit_done;
  } catch (const std::bad_alloc&) {
    return give_up("out of memory" + memory_limit());
  } catch (const ResourceError& error) {
    return give_up(error.what());
  } catch (const std::system_error& error) {
    return give_up(error.what() + limit_behind(error.code().value()));
  } catch (const std::exception& error) {
    fmt::print(stderr, "worker: {}\n", error.what());
    return exit_resources;
  }
}

}  // namespace touchmark::bench
