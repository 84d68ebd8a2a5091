#include "bench/experiments/audit/audit_run.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "bench/support/system/interrupt.h"
#include "bench/support/table.h"

namespace touchmark::bench::experiments::audit {
namespace {

constexpr std::size_t points_a_request = 64, fewest_points = 128;

workload::Workload workload_of(const AuditRow& about, const TriangleMesh& mesh,
                               const std::vector<AuditPoint>& points) {
  workload::Workload workload{about.body.name, mesh, about.lengths.radius, mesh.diagonal(), {"audit"}, {{}}};
  for (const AuditPoint& point : points)
    workload.traces[0].push_back({{point.center, about.lengths.radius}, mesh.diagonal()});
  return workload;
}

}  // namespace

BodyAudit::BodyAudit(AuditRow about, const TriangleMesh& mesh, const AuditLimits& limits,
                     workers::WorkerOptions workers)
    : about_(std::move(about)),
      limits_(limits),
      points_(audit_points(mesh, about_.lengths, limits.points, limits.seed)),
      arena_(workload_of(about_, mesh, points_), std::move(workers)) {}

void BodyAudit::ask_block(workers::ContestantProcess& process, workload::StepRange range,
                          workload::Query query) {
  process.ask(workers::request::Answer{{0, query, range.size(), {range}}});
  const std::span<const workload::Answer> answers = arena_.buffers().answers(range.size());
  for (std::size_t i = 0; i < answers.size(); ++i) {
    AuditAnswer& answer = answers_[range.begin + i];
    const workload::Answer& said = answers[i];
    constexpr double nothing = std::numeric_limits<double>::infinity();
    if (query == workload::Query::touches)
      answer.touches = said.found != 0;
    else  // what is no number is no distance
      answer.distance = said.found != 0 && said.distance >= 0 ? said.distance : nothing;
  }
}

void BodyAudit::ask_all(workers::ContestantProcess& process, AuditRow& row, const Progress& progress) {
  using workload::Query;
  std::vector<Query> queries = process.build().queries;
  std::erase(queries, Query::sweep);
  if (queries.empty()) row.status = "unsupported";
  const double begun_s = process.busy_s();
  for (std::size_t begin = 0; begin < points_.size() && !queries.empty(); begin += points_a_request) {
    support::check_for_interrupt();
    if (begin >= fewest_points && process.busy_s() - begun_s > limits_.seconds) break;
    progress(fmt::format("{}: {} of {} points", row.contestant(), begin, points_.size()));
    const std::size_t end = std::min(begin + points_a_request, points_.size());
    answers_.resize(end);
    try {
      for (const Query query : queries) ask_block(process, {begin, end}, query);
    } catch (const workers::WorkerFailure&) {
      answers_.resize(begin);
      throw;
    }
  }
}

AuditRow BodyAudit::ask(const contestants::ContestantSpec& spec, const contestants::Roster& roster,
                        const Progress& progress) {
  AuditRow row = about_;
  row.detector = spec.name;
  row.options = spec.options;
  answers_.clear();
  workers::ContestantProcess process(arena_, spec, roster.find(spec.name).worker_program(spec.values));
  try {
    ask_all(process, row, progress);
  } catch (const workers::WorkerFailure& failure) {
    row.status = failure.what();
  }
  judge(row, points_, answers_);
  return row;
}

void BodyAudit::append_points(const AuditRow& row, std::string& csv) const {
  for (std::size_t i = 0; i < answers_.size(); ++i) {
    const AuditPoint& point = points_[i];
    const AuditAnswer& answer = answers_[i];
    csv += support::csv_line({row.body.name, row.detector, row.options, std::string(name_of(point.place)),
                              fmt::format("{}", point.center.x()), fmt::format("{}", point.center.y()),
                              fmt::format("{}", point.center.z()), fmt::format("{}", point.truth.high),
                              answer.distance ? fmt::format("{}", *answer.distance) : "",
                              fmt::format("{:d}", answer.contact(row.lengths)),
                              std::string(fault_of(point, answer, row))});
  }
}

std::string audit_points_header() {
  return "body,detector,options,place,x,y,z,true_distance,distance,contact,fault\n";
}

}  // namespace touchmark::bench::experiments::audit
