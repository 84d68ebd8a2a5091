/// How many ticks took how long, in buckets a thirty-second wide, however many ticks there are.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace touchmark::bench::measurement {

class LatencyHistogram {
 public:
  struct Bucket {
    std::int64_t up_to_ns = 0;  ///< the largest that is counted here
    std::uint64_t ticks = 0;
  };

  /// What is below zero counts as zero.
  void add(std::int64_t ns) noexcept;

  std::uint64_t count() const noexcept { return count_; }
  std::int64_t max_ns() const noexcept { return max_; }
  /// Returns the least bucket's end that at least `fraction` of all ticks are not above, or the maximum where
  /// that is less: at most 1/32 above the true percentile (nearest rank). 0 where nothing was added.
  std::int64_t percentile(double fraction) const noexcept;
  /// Those that are not empty, ascending; the last ends with the maximum.
  std::vector<Bucket> buckets() const;

 private:
  static constexpr unsigned bits = 5;  // a power of two is parted into so many halves, quarters, ...
  static constexpr std::size_t bucket_count = 60UL << bits;

  std::array<std::uint64_t, bucket_count> counts_{};
  std::uint64_t count_ = 0;
  std::int64_t max_ = 0;
};

}  // namespace touchmark::bench::measurement
