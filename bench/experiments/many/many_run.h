/// Asks contestants many points at once, in turns, and checks what they answer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/contestants/roster.h"
#include "bench/experiments/many/many_row.h"
#include "bench/experiments/many/many_workload.h"
#include "core/search/many/many_options.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::experiments::many {

class ManyRun {
 public:
  /// Builds them all, in this process, so that threads and memory are those of a program that asks them.
  /// Throws what builds throw, and std::invalid_argument for one that does not answer `nearest` or needs a
  /// program of its own. The mesh must outlive this.
  ManyRun(const contestants::Roster& roster, const std::vector<contestants::ContestantSpec>& specs,
          std::string mesh_name, const TriangleMesh& mesh);

  /// Takes up a set of points: what is right is asked of aabb-tree, one by one.
  void take(Workload workload);
  /// A row for each contestant. In the first round, which is not timed, all answers are checked; in the
  /// others, those of the last call. Each round begins with nothing known. Throws Interrupted.
  std::vector<ManyRow> run(const ManyOptions& options, std::size_t rounds, std::uint64_t seed,
                           const std::function<void(const std::string& contestant)>& progress);

 private:
  struct Asked {
    contestants::ContestantSpec spec;
    std::unique_ptr<contestants::Contestant> contestant;
  };
  using Answers = std::vector<std::optional<Contact>>;

  /// How many answers to a call are wrong: differ in a bit where the contestant names the lowest of exactly
  /// nearest triangles; for other exact ones, are off by more than both claim.
  std::size_t count_wrong(const Accuracy& accuracy, std::size_t call) const;
  std::size_t check_all(Asked& asked, const ManyOptions& options, std::size_t& answered);
  double timed(Asked& asked, const ManyOptions& options);

  std::string mesh_name_;
  const TriangleMesh& mesh_;
  std::vector<Asked> asked_;
  Workload workload_;
  std::vector<Answers> right_;  ///< one a call
  Answers answers_;             ///< to the call that was asked last
};

}  // namespace touchmark::bench::experiments::many
