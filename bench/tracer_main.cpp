/// touchmark-tracer: asks one of our detectors the steps of a trajectory, with a core that notes what a query
/// looks at, and prints that of some steps as JSON (docs/reference/visited-json.md). `touchmark query
/// --visits` starts it. Its standard input is what bench/cli/commands/query.cpp writes.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "bench/meshes/mesh_lists.h"
#include "bench/support/files/raw_lists.h"
#include "core/named/named_detector.h"
#include "core/search/tracing.h"

namespace touchmark {
namespace {

using Json = nlohmann::ordered_json;
using bench::support::take_list, bench::support::take_text;

static_assert(tracing, "this program is for a core that is compiled with TOUCHMARK_TRACING");

/// More of one kind are left out, those looked at last.
constexpr std::size_t max_of_a_kind = 300;

using Question = std::array<double, 5>;  // centre, radius, reach

struct Trace {
  std::string query;
  std::vector<Question> steps;
};

Json json_of(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
Json json_of(const Aabb& box) {
  return {box.min.x(), box.min.y(), box.min.z(), box.max.x(), box.max.y(), box.max.z()};
}
template <class Marked>
Json json_of(const Marked& marked) requires requires {
  marked.box;
}
{
  Json json = json_of(marked.box);
  json.push_back(marked.entered ? 1 : 0);
  if constexpr (requires { marked.members; }) json.push_back(marked.members);
  return json;
}
Json json_of(const Visits::Cylinder& one) {
  Json json = json_of(one.center);
  for (const double x : {one.normal.x(), one.normal.y(), one.normal.z(), one.radius, one.half})
    json.push_back(x);
  json.push_back(one.entered ? 1 : 0);
  return json;
}
Json json_of(std::uint32_t number) { return number; }

template <class T>
void add(Json& json, const char* name, const std::vector<T>& items) {
  if (items.empty()) return;
  for (std::size_t i = 0; i < std::min(items.size(), max_of_a_kind); ++i)
    json[name].push_back(json_of(items[i]));
  if (items.size() > max_of_a_kind) json["left_out"][name] = items.size() - max_of_a_kind;
}

Json json_of(std::size_t step, const Visits& visited, const TriangleMesh& mesh) {
  Json json{{"step", step}};
  add(json, "cells", visited.cells);
  add(json, "groups", visited.groups);
  add(json, "boxes", visited.boxes);
  add(json, "cylinders", visited.cylinders);
  std::vector<std::uint32_t> ids;
  for (const std::uint32_t index : visited.triangles) ids.push_back(mesh.id(index));
  add(json, "triangles", ids);
  return json;
}

/// Returns whether there was a contact, something in reach, or a hit on the way.
bool ask(const NamedDetector& detector, const Trace& trace, std::size_t step,
         NamedDetector::Session& session) {
  const auto center_of = [&](std::size_t i) {
    const Question& asked = trace.steps.at(i);
    return Vec3(asked[0], asked[1], asked[2]);
  };
  const auto [x, y, z, radius, reach] = trace.steps.at(step);
  const Vec3 center(x, y, z);
  if (trace.query == "touches") return detector.touches({center, radius}, session);
  if (trace.query == "nearest") return detector.nearest({center, radius}, reach, session).has_value();
  const Vec3 from = step == 0 ? center : center_of(step - 1);
  return detector.first_hit({from, center, radius}, session).has_value();
}

/// Asks all steps up to the last wanted one, and notes those that are wanted.
Json visits_of(const NamedDetector& detector, const TriangleMesh& mesh, const Trace& trace,
               std::span<const std::uint64_t> wanted) {
  Json steps = Json::array();
  const std::unique_ptr<NamedDetector::Session> session = detector.begin_session();
  for (std::size_t step = 0; step <= wanted.back(); ++step) {
    Visits visited;
    const bool noted = std::ranges::binary_search(wanted, step);
    visits = noted ? &visited : nullptr;
    const bool found = ask(detector, trace, step, *session);
    visits = nullptr;
    if (!noted) continue;
    steps.push_back(json_of(step, visited, mesh));
    steps.back()["found"] = found;
  }
  return steps;
}

Json taken_and_traced() {
  const TriangleMesh mesh = bench::meshes::take_mesh(stdin);
  Trace trace;
  trace.query = take_text(stdin);
  trace.steps = take_list<Question>(stdin);
  const std::unique_ptr<NamedDetector> detector = NamedDetector::build(mesh, take_text(stdin));
  return visits_of(*detector, mesh, trace, take_list<std::uint64_t>(stdin));
}

}  // namespace
}  // namespace touchmark

int main() {
  try {
    const std::string text = touchmark::taken_and_traced().dump() + "\n";
    return std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0 ? 0
                                                                                                       : 3;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "touchmark-tracer: %s\n", error.what());
    return 2;
  }
}
