#include "bench/workers/worker_protocol.h"

#include <array>
#include <bit>

#include <nlohmann/json.hpp>

namespace touchmark {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Coupling, radius, stiffness, static_friction, dynamic_friction, damping,
                                   tick_s, shading, max_work)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Work, cells, spheres, boxes, triangles, exact_decisions)

// JSON has no infinity, so doubles that may be infinite travel as their bits.
static void to_json(nlohmann::json& json, const Accuracy& accuracy) {
  json = {accuracy.guarantee, std::bit_cast<std::uint64_t>(accuracy.relative),
          std::bit_cast<std::uint64_t>(accuracy.absolute), accuracy.decides_exactly, accuracy.names_exactly};
}
static void from_json(const nlohmann::json& json, Accuracy& accuracy) {
  const auto number = [&](std::size_t i) { return std::bit_cast<double>(json.at(i).get<std::uint64_t>()); };
  accuracy = {json.at(0), number(1), number(2), json.at(3), json.at(4)};
}

namespace named {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(OptionInfo, key, kind, choices, default_value, summary)
}  // namespace named

namespace bench {

namespace contestants {
// A reach may be infinite.
static void to_json(nlohmann::json& json, const ReproducedQuestion& asked) {
  json = {asked.query, std::bit_cast<std::array<std::uint64_t, 8>>(asked.values), asked.coordinates,
          asked.corners};
}
static void from_json(const nlohmann::json& json, ReproducedQuestion& asked) {
  const auto bits = json.at(1).get<std::array<std::uint64_t, 8>>();
  asked = {json.at(0), std::bit_cast<std::array<double, 8>>(bits), json.at(2), json.at(3)};
}
}  // namespace contestants

namespace workload {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(StepRange, begin, end)
}  // namespace workload

namespace meshes {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Deformation, share, seed)
}  // namespace meshes

namespace workers {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(WorkloadLayout, vertices, triangles, ids, trace_steps, shapes, bodies,
                                   trace_moves, min_output_steps)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Pace, rate_hz, slowdown, work_us, first_tick, overrun_ticks)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Task, trace, query, steps, ranges)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(NotStarted, error)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(OutOfResources, what)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Broken, why)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Opened, clock_cost_ns, ns_per_tick, flushed_to_zero)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Built, refused, build_ms, bytes, heap_bytes, accuracy, queries, prepares,
                                   builds_lazily, remarks)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Described, refused, name, summary, accuracy, queries, options)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Reproduced, refused, script)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Answered, checksum, work)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Timed, ns_per_query, cpu_ns_per_query, checksum, steady, work, samples,
                                   interrupted)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Updated, supported, refused, rounds, build_ms, update_ms,
                                   update_over_build)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ServoStretch, warmed, recorded, placed, overrun, minor_faults,
                                   major_faults, involuntary_switches, scheduler, memory)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ColdSamples, taken)
static void to_json(nlohmann::json& json, const Done&) { json = nlohmann::json::object(); }
static void from_json(const nlohmann::json&, Done&) {}

namespace request {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Open, layout, calibrate_clock)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Describe, plugin)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Reproduce, plugin, question)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Build, contestant, plugin)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Update, deformation)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Rebuild, deformation)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(First, task)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Calibrate, task, budget_ns)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Answer, task, fresh)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(AnswerAfresh, task, step)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(FirstPass, task)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Time, task, passes)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Sample, task, passes, replays)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Latency, task)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Proxy, wanted, coupling, start)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Servo, task, pace, warm_up, ticks, idle, evicted_bytes, proxy)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Cold, task, evicted_bytes, floor_samples, first_sample, min_samples,
                                   max_samples, budget_ns)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Lines, task, samples)
}  // namespace request

namespace {

template <class Variant>
std::string line_of_variant(const Variant& variant) {
  nlohmann::json members;
  std::visit([&](const auto& value) { members = value; }, variant);
  return nlohmann::json::array({variant.index(), members})
      .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

template <class Variant>
struct Reading;
template <class... Type>
struct Reading<std::variant<Type...>> {
  static std::variant<Type...> of(const std::string& line) {
    using Read = std::variant<Type...> (*)(const nlohmann::json&);
    constexpr std::array<Read, sizeof...(Type)> readers{
        [](const nlohmann::json& members) -> std::variant<Type...> { return members.get<Type>(); }...};
    const nlohmann::json json = nlohmann::json::parse(line);
    return readers.at(json.at(0).get<std::size_t>())(json.at(1));
  }
};

}  // namespace

std::string line_of(const Request& request) { return line_of_variant(request); }
std::string line_of(const Reply& reply) { return line_of_variant(reply); }
Request request_in(const std::string& line) { return Reading<Request>::of(line); }
Reply reply_in(const std::string& line) { return Reading<Reply>::of(line); }

}  // namespace workers
}  // namespace bench
}  // namespace touchmark
