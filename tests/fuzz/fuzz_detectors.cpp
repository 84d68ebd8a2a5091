// Every exact form of every detector on a mesh and probes out of the bytes: brute force keeps its word by the
// oracle, the others give its bits. Radii and reaches are the very distance, an ulp to each side of it, or
// anything.
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "bench/oracle/judge.h"
#include "bench/oracle/oracle.h"
#include "core/float_limits.h"
#include "tests/fuzz/script.h"
#include "tests/fuzz/target.h"
#include "tests/own_forms.h"

namespace touchmark::fuzz {
namespace {

using bench::oracle::GroundTruth;
using bench::workload::Answer;
using bench::workload::Query;
using bench::workload::Step;

double read_length(Script& script, double distance) {
  switch (script.below(8)) {
    case 0:
    case 1:
      return distance;
    case 2:
      return std::nextafter(distance, 0);
    case 3:
      return std::nextafter(distance, infinity);
    case 4:
      return infinity;
    case 5:
      return std::numeric_limits<double>::quiet_NaN();
    case 6:
      return script.number() * script.magnitude();
    default:
      return script.number() * distance;
  }
}

/// One way through one mesh, with what is asked at each step and the truth there.
struct QueryTrace {
  TriangleMesh mesh;
  bench::oracle::Oracle oracle;
  std::vector<Step> steps;
  std::vector<GroundTruth> truths;

  QueryTrace(TriangleMesh given, Script& script) : mesh(std::move(given)), oracle(mesh, 1) {
    for (std::size_t left = 1 + script.below(8); left > 0; --left) {
      const Vec3 center = read_center(script, mesh);
      truths.push_back(oracle.solve(center));
      const double radius = read_length(script, truths.back().high),
                   reach = read_length(script, truths.back().high);
      steps.push_back({{center, radius}, reach});
    }
  }
};

std::vector<Answer> ask(bench::contestants::Contestant& detector, Query query,
                        const std::vector<Step>& steps) {
  std::vector<Answer> answers(steps.size());
  std::vector<std::uint64_t> work(steps.size());
  detector.answer({query, steps}, {0, steps.size()}, answers, work);
  return answers;
}

const char* name_of(Query query) {
  return query == Query::touches ? "touches" : query == Query::nearest ? "nearest" : "sweep";
}

void judge(const QueryTrace& trace, Query query, std::size_t step, const Answer& answer,
           const Accuracy& accuracy) {
  const Probe& probe = trace.steps[step].probe;
  bench::oracle::ErrorCounts counts;
  if (query == Query::sweep) {
    const std::vector<Sweep> sweep = {
        {trace.steps[step > 0 ? step - 1 : 0].probe.center, probe.center, probe.radius}};
    counts =
        bench::oracle::judge(trace.oracle, trace.oracle.solve(sweep), sweep, std::span(&answer, 1), accuracy);
  } else {
    counts =
        bench::oracle::judge(trace.oracle, std::span(&trace.truths[step], 1), query, std::span(&probe, 1),
                             trace.steps[step].reach, std::span(&answer, 1), accuracy);
  }
  if (bench::oracle::meets_guarantee(counts, accuracy)) return;
  fail(std::string("brute force, ") + name_of(query) + " at step " + std::to_string(step) + ": " +
       std::to_string(counts.missed) + " missed, " + std::to_string(counts.false_contacts) + " false, " +
       std::to_string(counts.wrong_triangle) + " wrong triangle, " + std::to_string(counts.beyond_bound) +
       " beyond, " + std::to_string(counts.wrong_point) + " point, " + std::to_string(counts.wrong_normal) +
       " normal, " + std::to_string(counts.malformed) + " malformed");
}

void examine(const QueryTrace& trace) {
  const std::vector<ExactForm> forms = exact_forms(trace.mesh, Fields::coarse);
  bench::contestants::Contestant& reference = *forms.front().detector;
  for (const Query query : {Query::nearest, Query::touches, Query::sweep}) {
    const std::vector<Answer> expected = ask(reference, query, trace.steps);
    for (std::size_t i = 0; i < expected.size(); ++i)
      judge(trace, query, i, expected[i], reference.accuracy());
    for (const ExactForm& form : forms) {
      const std::vector<Answer> answers = ask(*form.detector, query, trace.steps);
      for (std::size_t i = 0; i < answers.size(); ++i) {
        if (std::memcmp(&answers[i], &expected[i], sizeof(Answer)) == 0) continue;
        fail(form.name + " differs from brute force, " + name_of(query) + " at step " + std::to_string(i));
      }
    }
  }
}

}  // namespace
}  // namespace touchmark::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace touchmark;
  fuzz::Script script({data, size});
  std::optional<fuzz::QueryTrace> trace;
  try {
    trace.emplace(fuzz::read_mesh(script), script);
  } catch (const MeshError&) {
    return 0;
  }
  fuzz::examine(*trace);
  return 0;
}
