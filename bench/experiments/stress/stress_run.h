/// Every contestant on every family, in rounds of so many probes that a round's ground truth fits into
/// memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "bench/contestants/roster.h"
#include "bench/experiments/stress/family.h"
#include "bench/experiments/stress/score.h"
#include "bench/workers/contestant_process.h"

namespace touchmark::bench::experiments::stress {

struct StressRequest {
  std::vector<const Family*> families;
  std::vector<contestants::ContestantSpec> contestants;
  std::vector<workload::Query> queries;
  std::uint64_t seed = 1;  ///< the first round's; each further one has the next
  std::size_t probes = 0;  ///< in each family
  workers::WorkerOptions workers;
};

/// The rounds' seeds are the request's and those that follow it.
struct FamilyCount {
  std::uint64_t rounds = 0;
  std::uint64_t probes = 0;
};

class StressRun {
 public:
  using Progress = std::function<void(const std::string& what)>;

  /// The roster must outlive it.
  StressRun(const contestants::Roster& roster, StressRequest request);

  /// Throws ResourceError or Interrupted. What was finished before is in scores().
  void run(const Progress& progress);

  /// Contestants in their order, of each the families and of those the queries.
  const std::vector<Score>& scores() const noexcept { return scores_; }
  /// Rows that are not clean, the first so many.
  const std::vector<measurement::ResultRow>& faults() const noexcept { return faults_; }
  const StressRequest& request() const noexcept { return request_; }
  /// What was put to every contestant of a family so far.
  FamilyCount count_of(const Family& family) const;
  /// Had a library of that contestant switched denormal numbers off?
  bool flushed_to_zero(std::size_t contestant) const { return flushed_to_zero_[contestant]; }

 private:
  void run_round(const Family& family, std::uint64_t seed, std::size_t probes, const Progress& progress);
  /// `place` is the workload's in what family.make(seed, probes) makes.
  void run_workload(const Family& family, std::uint64_t seed, std::size_t probes, std::size_t workload_index,
                    const workload::Workload& workload, const Progress& progress);
  void refuse_all(const Family& family, const std::string& why);
  std::size_t place_of(const Score& score) const;
  void add(const Family& family, const measurement::ResultRow& row, bool of_another_mesh);

  const contestants::Roster& roster_;
  StressRequest request_;
  std::vector<Score> scores_;
  std::vector<measurement::ResultRow> faults_;
  std::map<const Family*, FamilyCount> counts_;
  std::vector<bool> flushed_to_zero_;  // one a contestant
};

}  // namespace touchmark::bench::experiments::stress
