/// Does a detector hold a servo rate? What so many ticks tell, and how surely.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace touchmark::bench::experiments::servo {

inline constexpr double usual_confidence = 0.95;

/// Returns the largest share of missed ticks that is still compatible with `missed` of `ticks` at this
/// confidence: the exact one-sided bound of the binomial distribution (Clopper & Pearson 1934). Without a
/// miss that is about 3 / ticks, the rule of three. 1 without ticks.
double max_miss_rate(std::uint64_t missed, std::uint64_t ticks, double confidence = usual_confidence);

/// What was counted of a detector's loop and of the same loop with nothing asked. Both ran in short stretches
/// that took turns; a stall of the machine takes many ticks of one stretch, so stretches are compared, not
/// ticks.
struct Misses {
  std::uint64_t ticks = 0, missed = 0;
  std::uint64_t idle_ticks = 0, idle_missed = 0;
  std::uint64_t worse = 0;       ///< turns in which the detector's stretch missed more than the idle one
  std::uint64_t idle_worse = 0;  ///< turns in which it was the other way round
};

/// Returns how likely the detector's loop is the worse one in so many turns, or more, if both are alike: the
/// sign test, one-sided. 1 where no turn tells them apart.
double chance_of_as_many(const Misses& misses);

enum class Verdict { holds, inconclusive, does_not_hold };

/// "holds", "inconclusive" or "does not hold".
std::string_view name_of(Verdict verdict) noexcept;

/// A detector holds if it never missed where the machine could have: the idle loop did not miss, either.
/// It does not hold if it missed and the idle loop did not, or was the worse one in surely (99 %) more turns.
/// Else the machine decides, and nothing can be said; nor without ticks.
Verdict verdict_on(const Misses& misses);

/// The worst of them; inconclusive where there are none.
Verdict verdict_on_all(const std::vector<Verdict>& verdicts) noexcept;

}  // namespace touchmark::bench::experiments::servo
