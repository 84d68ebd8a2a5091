/// How a contestant stood one family of one query: rows of results added up.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "bench/experiments/stress/family.h"
#include "bench/measurement/result_row.h"

namespace touchmark::bench::experiments::stress {

/// What is worst about it, the worst last.
enum class Standing {
  clean,
  unsupported,  ///< does not answer such queries
  refused,      ///< some mesh or all
  inexact,      ///< contact told rightly, but triangle, distance, point or normal off by more than declared
  wrong,        ///< a contact missed or made up, or an answer that is no number
  timeout,
  crashed
};
std::string_view name_of(Standing standing) noexcept;

class Score {
 public:
  Score(const measurement::ResultRow& first, const Family& family);

  bool is_of(const measurement::ResultRow& row, const Family& family) const;
  void add(const measurement::ResultRow& row, bool of_another_mesh);

  std::string contestant() const { return options.empty() ? detector : detector + ":" + options; }
  Standing standing() const noexcept;
  /// Mean over the answers that were timed, roughly; nothing where none was.
  std::optional<double> ns_per_query() const;

  std::string detector;
  std::string options;
  const Family* family;
  workload::Query query;
  std::string guarantee;  ///< as claimed; empty where it is not known
  oracle::ErrorCounts counts;
  std::uint64_t meshes = 0;
  std::uint64_t crashes = 0;  ///< traces that a worker did not survive, and so on
  std::uint64_t timeouts = 0;
  std::uint64_t refusals = 0;
  std::uint64_t unsupported = 0;
  std::string short_of_memory;  ///< the first status that says so
  bool broken =
      false;  ///< claims exactness, and contact, triangle or distance was wrong, or it did not survive

 private:
  double ns_ = 0;
  std::uint64_t timed_ = 0;
};

}  // namespace touchmark::bench::experiments::stress
