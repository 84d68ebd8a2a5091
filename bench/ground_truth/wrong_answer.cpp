#include "bench/ground_truth/wrong_answer.h"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "bench/workload/query_name.h"

namespace touchmark::bench::ground_truth {
namespace {

std::string text(const Vec3& v) { return fmt::format("({}, {}, {})", v.x(), v.y(), v.z()); }
std::string text(const double (&xyz)[3]) { return fmt::format("({}, {}, {})", xyz[0], xyz[1], xyz[2]); }

std::string with_side(std::optional<Side> side) {
  return side && *side != Side::unasked ? fmt::format(", {}", workload::name_of(*side)) : "";
}

std::string question(const WrongAnswer& wrong) {
  const Probe& probe = wrong.asked.probe;
  switch (wrong.query) {
    case workload::Query::touches:
      return fmt::format("probe {} radius {}", text(probe.center), probe.radius);
    case workload::Query::nearest:
      return fmt::format("probe {} reach {}", text(probe.center), wrong.asked.reach);
    case workload::Query::sweep:
    case workload::Query::moving:
      return fmt::format("sweep from {} to {} radius {}", text(wrong.from), text(probe.center), probe.radius);
  }
  return "";
}

/// Bodies are told apart by their number in the scene, from 0.
std::string of_body(const WrongAnswer& wrong, std::uint32_t body) {
  return wrong.body ? fmt::format(" of body {}", body) : "";
}

std::string contact_of(const WrongAnswer& wrong) {
  const oracle::GroundTruth& truth = wrong.truth;
  if (!truth.defined || !wrong.triangle) return "";
  return fmt::format("{} to triangle {}{} at {}, normal {}{}", truth.high, *wrong.triangle,
                     of_body(wrong, wrong.body.value_or(0)), text(truth.point), text(truth.direction),
                     with_side(wrong.side));
}

std::string expected(const WrongAnswer& wrong) {
  switch (wrong.query) {
    case workload::Query::touches:
      return fmt::format("{}, distance {}", wrong.found ? "contact" : "none", wrong.truth.high);
    case workload::Query::nearest:
      return (wrong.found ? "" : "none, but ") + contact_of(wrong);
    case workload::Query::sweep:
    case workload::Query::moving: {
      const std::string there = contact_of(wrong);
      return fmt::format("{}{}", wrong.found ? "a hit" : "none",
                         there.empty() ? "" : "; where it was told " + there);
    }
  }
  return "";
}

std::string got(const WrongAnswer& wrong) {
  const workload::Answer& answer = wrong.got;
  if (answer.found == 0) return "none";
  if (wrong.query == workload::Query::touches) return "contact";
  const std::string named =
      answer.triangle == oracle::no_triangle ? "" : fmt::format(" to triangle {}", answer.triangle);
  const std::string owner = of_body(wrong, answer.body);
  const std::string contact = fmt::format("{}{}{} at {}, normal {}{}", answer.distance, named, owner,
                                          text(answer.point), text(answer.normal), with_side(answer.side));
  return workload::is_of_a_way(wrong.query)
             ? fmt::format("a hit at fraction {}: {}", answer.fraction, contact)
             : contact;
}

}  // namespace

std::string charges_of(const oracle::ErrorCounts& counts) {
  const std::array<std::pair<std::uint64_t, const char*>, 8> kinds{{{counts.missed, "missed"},
                                                                    {counts.false_contacts, "false"},
                                                                    {counts.wrong_triangle, "triangle"},
                                                                    {counts.beyond_bound, "distance"},
                                                                    {counts.wrong_point, "point"},
                                                                    {counts.wrong_normal, "normal"},
                                                                    {counts.wrong_side, "side"},
                                                                    {counts.malformed, "no number"}}};
  std::vector<std::string> charges;
  for (const auto& [count, name] : kinds)
    if (count > 0) charges.push_back(fmt::format("{} {}", count, name));
  return fmt::format("{}", fmt::join(charges, ", "));
}

std::string described(const WrongAnswer& wrong) {
  return fmt::format("step {} ({}): {}; expected {}; got {}", wrong.step, charges_of(wrong.charged),
                     question(wrong), expected(wrong), got(wrong));
}

}  // namespace touchmark::bench::ground_truth
