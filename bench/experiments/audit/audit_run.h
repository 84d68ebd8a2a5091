/// Asks engines about one body, and writes down what they answer.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "bench/contestants/roster.h"
#include "bench/experiments/audit/audit_row.h"
#include "bench/workers/contestant_process.h"

namespace touchmark::bench::experiments::audit {

struct AuditLimits {
  std::size_t points = 0;  ///< a body's
  double seconds = 0;      ///< for a body and an engine; at least some points are asked however slow it is
  std::uint64_t seed = 1;
};

/// The points of one body, for as many engines as are to be asked.
class BodyAudit {
 public:
  using Progress = std::function<void(const std::string& what)>;

  /// Finds points and what is true of them.
  BodyAudit(AuditRow about, const TriangleMesh& mesh, const AuditLimits& limits,
            workers::WorkerOptions workers);

  /// Throws Interrupted or ResourceError. An engine that fails is a row with that status, and with what it
  /// answered before.
  AuditRow ask(const contestants::ContestantSpec& spec, const contestants::Roster& roster,
               const Progress& progress);
  /// Appends the points of a row that was asked last, as rows of audit_points.csv.
  void append_points(const AuditRow& row, std::string& csv) const;

 private:
  void ask_all(workers::ContestantProcess& process, AuditRow& row, const Progress& progress);
  void ask_block(workers::ContestantProcess& process, workload::StepRange range, workload::Query query);

  AuditRow about_;
  AuditLimits limits_;
  std::vector<AuditPoint> points_;
  workers::SharedArena arena_;
  std::vector<AuditAnswer> answers_;
};

std::string audit_points_header();

}  // namespace touchmark::bench::experiments::audit
