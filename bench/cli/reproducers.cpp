#include "bench/cli/reproducers.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "bench/oracle/judge.h"
#include "bench/support/files/atomic_file.h"
#include "bench/support/system/interrupt.h"
#include "bench/workers/plugin_description.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench::cli {
namespace {

constexpr std::size_t attempts = 60;  // a process each, which builds the engine
constexpr std::size_t longest_script = 40;

using Counts = oracle::ErrorCounts;
struct Kind {
  const char* name;
  std::uint64_t Counts::*count;
};
constexpr std::array<Kind, 8> kinds{{{"missed", &Counts::missed},
                                     {"made-up", &Counts::false_contacts},
                                     {"no-number", &Counts::malformed},
                                     {"distance", &Counts::beyond_bound},
                                     {"triangle", &Counts::wrong_triangle},
                                     {"point", &Counts::wrong_point},
                                     {"normal", &Counts::wrong_normal},
                                     {"side", &Counts::wrong_side}}};

TriangleMesh part_of(const TriangleMesh& mesh, const std::vector<std::uint32_t>& kept) {
  std::map<std::uint32_t, std::uint32_t> places;
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Corners> triangles;
  for (const std::uint32_t triangle : kept) {
    TriangleMesh::Corners& corners = triangles.emplace_back(mesh.triangles()[triangle]);
    for (std::uint32_t& corner : corners) {
      const auto [place, is_new] = places.try_emplace(corner, static_cast<std::uint32_t>(vertices.size()));
      if (is_new) vertices.push_back(mesh.vertices()[corner]);
      corner = place->second;
    }
  }
  return {std::move(vertices), std::move(triangles)};
}

/// One question to one contestant, about parts of a mesh.
struct Question {
  const contestants::Roster& roster;
  const workers::WorkerOptions& workers;
  contestants::ContestantSpec spec;
  workload::Query query;
  Vec3 from;
  workload::Step step;

  /// What is wrong with the answer of a new process; nothing where it fails.
  Counts charged(const TriangleMesh& mesh) const {
    support::check_for_interrupt();
    workload::Workload asked{"part",     mesh,         step.probe.radius,
                             step.reach, {"question"}, {{{{from, step.probe.radius}, step.reach}, step}}};
    const workers::SharedArena arena(asked, workers);
    workers::ContestantProcess process(arena, spec, roster.find(spec.name).worker_program(spec.values));
    try {
      const Accuracy accuracy = process.build().accuracy;
      process.ask(workers::request::Answer{{0, query, 1, {{1, 2}}}});
      return judged(mesh, arena.buffers().answers(1).front(), accuracy);
    } catch (const workers::WorkerFailure&) {
      return {};
    }
  }

 private:
  Counts judged(const TriangleMesh& mesh, const workload::Answer& answer, const Accuracy& accuracy) const {
    const oracle::Oracle truth(mesh, 1);
    if (query != workload::Query::sweep)
      return judge_one(truth, truth.solve(step.probe.center), query, step.probe, step.reach, answer,
                       accuracy);
    const Sweep sweep{from, step.probe.center, step.probe.radius};
    return judge_one(truth, truth.solve(sweep), sweep, answer, accuracy);
  }
};

/// Leaves out halves of the triangles, quarters and so on, those farthest from the probe first, as long as
/// the fault stays.
TriangleMesh cut(const TriangleMesh& mesh, const Question& question, const Kind& kind) {
  std::vector<std::pair<double, std::uint32_t>> far;
  for (std::uint32_t i = 0; i < mesh.size(); ++i)
    far.emplace_back(
        -(mesh.corner(i, 0) + mesh.corner(i, 1) + mesh.corner(i, 2) - 3 * question.step.probe.center).norm(),
        i);
  std::ranges::sort(far);
  std::vector<std::uint32_t> kept;
  for (const auto& [distance, triangle] : far) kept.push_back(triangle);
  std::size_t left = attempts;
  for (std::size_t size = kept.size() / 2; size > 0 && left > 0; size /= 2) {
    for (std::size_t begin = 0; begin < kept.size() && kept.size() > size && left > 0; --left) {
      std::vector<std::uint32_t> fewer = kept;
      const auto gone = fewer.begin() + static_cast<std::ptrdiff_t>(begin);
      fewer.erase(gone, gone + static_cast<std::ptrdiff_t>(std::min(size, fewer.size() - begin)));
      if (question.charged(part_of(mesh, fewer)).*kind.count > 0)
        kept = std::move(fewer);
      else
        begin += size;
    }
  }
  std::ranges::sort(kept);
  return part_of(mesh, kept);
}

std::string numbers_of(const Vec3& v) { return fmt::format("[{}, {}, {}]", v.x(), v.y(), v.z()); }

/// The question as the plug-in's detector is asked it, points in this form.
std::string call(const Question& question, std::string_view point) {
  const auto vector = [&](const Vec3& v) { return fmt::format("{}({})", point, numbers_of(v)); };
  const Probe& probe = question.step.probe;
  const std::string to = vector(probe.center);
  if (question.query == workload::Query::sweep)
    return fmt::format("first_hit({}, {}, {})", vector(question.from), to, probe.radius);
  return question.query == workload::Query::touches ? fmt::format("touches({}, {})", to, probe.radius)
                                                    : fmt::format("nearest({}, {})", to, question.step.reach);
}

/// A script that imports the plug-in.
std::string importing(const TriangleMesh& mesh, const Question& question, bool python) {
  std::vector<std::string> vertices, corners;
  for (const Vec3& v : mesh.vertices()) vertices.push_back(numbers_of(v));
  for (const auto& [a, b, c] : mesh.triangles()) corners.push_back(fmt::format("[{}, {}, {}]", a, b, c));
  const std::string v = fmt::format("[{}]", fmt::join(vertices, ", ")),
                    f = fmt::format("[{}]", fmt::join(corners, ", "));
  const std::string path = nlohmann::json(std::filesystem::absolute(question.spec.plugin).string()).dump();
  if (python)
    return fmt::format(
        "import importlib.util\nimport numpy as np\nfrom math import inf\n"
        "spec = importlib.util.spec_from_file_location(\"engine\", {})\n"
        "engine = importlib.util.module_from_spec(spec)\nspec.loader.exec_module(engine)\n"
        "vertices = np.array({}, dtype=float)\nfaces = np.array({}, dtype=np.uint32)\n"
        "print(\"answer:\", engine.Detector(vertices, faces).{})\n",
        path, v, f, call(question, "np.array"));
  return fmt::format(
      "import {{ pathToFileURL }} from \"node:url\";\n"
      "const inf = Infinity, engine = await import(pathToFileURL({}));\n"
      "const vertices = new Float64Array({}.flat());\nconst triangles = new Uint32Array({}.flat());\n"
      "const detector = await engine.build(vertices, triangles);\nconsole.log(\"answer:\", detector.{});\n",
      path, v, f, call(question, "new Float64Array"));
}

std::string expectation(const TriangleMesh& mesh, const Question& question) {
  const oracle::Oracle truth(mesh, 1);
  const Probe& probe = question.step.probe;
  if (question.query != workload::Query::sweep)
    return fmt::format("the distance is {}", truth.solve(probe.center).high);
  return truth.solve(Sweep{question.from, probe.center, probe.radius}).hit ? "it hits" : "it hits nothing";
}

/// Only letters, digits, points and dashes.
std::string in_file_name(std::string text) {
  for (char& c : text)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '.') c = '-';
  return text;
}

}  // namespace

Reproducers::Reproducers(const std::string& folder, const contestants::Roster& roster,
                         workers::WorkerOptions workers)
    : folder_(folder), roster_(roster), workers_(std::move(workers)) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) throw std::invalid_argument(fmt::format("--reproduce \"{}\": {}", folder, error.message()));
}

void Reproducers::add(const workload::Workload& workload, std::span<const measurement::ResultRow> rows) {
  for (const measurement::ResultRow& row : rows) {
    const std::string ending = std::filesystem::path(row.plugin).extension().string();
    if (ending != ".py" && ending != ".mjs") continue;
    for (const ground_truth::WrongAnswer& wrong : row.wrong) write(workload, row, wrong);
  }
}

void Reproducers::write(const workload::Workload& workload, const measurement::ResultRow& row,
                        const ground_truth::WrongAnswer& wrong) {
  const auto* const kind =
      std::ranges::find_if(kinds, [&](const Kind& one) { return wrong.charged.*one.count > 0; });
  const bool python = row.plugin.ends_with(".py");
  if (kind == kinds.end()) return;
  const std::filesystem::path path =
      folder_ / (in_file_name(fmt::format("{}-{}-{}-{}", row.contestant(), workload.mesh_name,
                                          workload::name_of(wrong.query), kind->name)) +
                 (python ? ".py" : ".mjs"));
  if (!written_.insert(path).second) return;
  const Question question{roster_,     workers_,   roster_.parse(row.contestant()),
                          wrong.query, wrong.from, wrong.asked};
  if (question.charged(workload.mesh).*kind->count == 0) {
    fmt::print(stderr, "touchmark: {}: not written, since a new process answers step {} rightly\n",
               path.string(), wrong.step);
    written_.erase(path);
    return;
  }
  const TriangleMesh part = cut(workload.mesh, question, *kind);
  std::string script = workers::reproduction(row.plugin, part, wrong.query, wrong.from, wrong.asked);
  if (script.empty()) script = importing(part, question, python);
  script = fmt::format("{} {} by {}, {} of {}'s {} triangles: {}\n{}", python ? "#" : "//", kind->name,
                       workload::name_of(wrong.query), part.size(), workload.mesh_name, workload.mesh.size(),
                       expectation(part, question), script);
  const auto lines = static_cast<std::size_t>(std::ranges::count(script, '\n'));
  support::AtomicFile file(path);
  file.write(script);
  file.commit();
  fmt::print(stderr, "touchmark: {}: {} of {} triangles{}\n", path.string(), part.size(),
             workload.mesh.size(),
             lines > longest_script ? fmt::format("; {} lines, more than {}", lines, longest_script) : "");
}

}  // namespace touchmark::bench::cli
