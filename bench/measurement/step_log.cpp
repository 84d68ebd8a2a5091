#include "bench/measurement/step_log.h"

namespace touchmark::bench::measurement {
namespace {

std::uint8_t kinds_of(const oracle::ErrorCounts& one) noexcept {
  const auto bit = [](std::uint64_t count, ChargeKind kind) { return count > 0 ? kind : 0; };
  return static_cast<std::uint8_t>(
      bit(one.missed, charged_missed) | bit(one.false_contacts, charged_false_contact) |
      bit(one.wrong_triangle, charged_triangle) | bit(one.beyond_bound, charged_distance) |
      bit(one.wrong_point, charged_point) | bit(one.wrong_normal, charged_normal) |
      bit(one.malformed, charged_malformed) | bit(one.wrong_side, charged_side));
}

}  // namespace

StepLog log_of(const std::vector<workload::StepRange>& ranges, std::span<const workload::Answer> answers,
               std::span<const std::uint64_t> work, const std::vector<oracle::Charge>& charges) {
  StepLog log{ranges,
              {answers.begin(), answers.end()},
              {work.begin(), work.end()},
              std::vector<std::uint8_t>(answers.size()),
              {}};
  for (const oracle::Charge& one : charges) log.charged[one.step] = kinds_of(one.counts);
  return log;
}

}  // namespace touchmark::bench::measurement
