#include "bench/experiments/stress/score.h"

#include <array>

#include "bench/support/names.h"

namespace touchmark::bench::experiments::stress {
namespace {

/// What exactness is about: contact, the triangle and the distance. A normal or point that is off is told,
/// and is no broken claim: where squares of lengths leave the range of doubles no direction is promised.
bool breaks_the_claim(const measurement::ResultRow& row) {
  if (!row.claims_exactness()) return false;
  const bool declined = row.status == "unsupported" || row.status.starts_with("refused");
  if (!row.counts) return !declined;
  const oracle::ErrorCounts& counts = *row.counts;
  return row.status != "ok" || counts.missed + counts.false_contacts + counts.wrong_triangle +
                                       counts.beyond_bound + counts.malformed >
                                   0;
}

}  // namespace

constexpr std::array<support::Name<Standing>, 7> standing_names{{{Standing::clean, "ok"},
                                                                 {Standing::unsupported, "unsupported"},
                                                                 {Standing::refused, "refused"},
                                                                 {Standing::inexact, "inexact"},
                                                                 {Standing::wrong, "wrong"},
                                                                 {Standing::timeout, "timeout"},
                                                                 {Standing::crashed, "crashed"}}};

std::string_view name_of(Standing standing) noexcept { return support::name_in(standing_names, standing); }

Score::Score(const measurement::ResultRow& first, const Family& of)
    : detector(first.detector), options(first.options), family(&of), query(first.query) {
  contestant = first.contestant();
}

bool Score::is_of(const measurement::ResultRow& row, const Family& of) const {
  return family == &of && query == row.query && detector == row.detector && options == row.options;
}

void Score::add(const measurement::ResultRow& row, bool of_another_mesh) {
  meshes += of_another_mesh ? 1 : 0;
  Summary::add(row);
  busy_s += row.busy_s;
  if (row.counts && row.throughput) {
    ns_ += row.throughput->ns_per_query * static_cast<double>(row.counts->judged);
    timed_ += row.counts->judged;
  }
  // A worker whose memory cannot be trusted.
  crashes += row.status == "checksum mismatch" ? 1 : 0;
  broken = broken || breaks_the_claim(row);
}

Standing Score::standing() const noexcept {
  if (crashes > 0) return Standing::crashed;
  if (timeouts > 0) return Standing::timeout;
  if (counts.missed + counts.false_contacts + counts.malformed > 0) return Standing::wrong;
  if (counts.wrong_triangle + measurement::answers_off(counts) > 0) return Standing::inexact;
  if (refusals > 0) return Standing::refused;
  return unsupported > 0 ? Standing::unsupported : Standing::clean;
}

std::optional<double> Score::ns_per_query() const {
  if (timed_ == 0) return std::nullopt;
  return ns_ / static_cast<double>(timed_);
}

}  // namespace touchmark::bench::experiments::stress
