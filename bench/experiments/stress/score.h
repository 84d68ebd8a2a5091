/// How a contestant stood one family of one query: rows of results added up.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "bench/experiments/stress/family.h"
#include "bench/measurement/result_row.h"
#include "bench/results/verification_report.h"

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

class Score : public results::Summary {
 public:
  Score(const measurement::ResultRow& first, const Family& family);

  bool is_of(const measurement::ResultRow& row, const Family& family) const;
  void add(const measurement::ResultRow& row, bool of_another_mesh);

  Standing standing() const noexcept;
  /// Mean over the answers that were timed, roughly; nothing where none was.
  std::optional<double> ns_per_query() const;

  std::string detector;
  std::string options;
  const Family* family;
  workload::Query query;
  std::uint64_t meshes = 0;
  double busy_s = 0;  ///< that its workers were waited for

 private:
  double ns_ = 0;
  std::uint64_t timed_ = 0;
};

}  // namespace touchmark::bench::experiments::stress
