#include "bench/measurement/histogram.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace touchmark::bench::measurement {
namespace {

/// Below 2^(bits + 1) each number has a bucket; above, each power of two has 2^bits of them (as in the
/// HDR histogram of G. Tene).
std::size_t bucket_of(std::uint64_t ns, unsigned bits) noexcept {
  const auto width = static_cast<unsigned>(std::bit_width(ns));
  const unsigned shift = width > bits + 1 ? width - bits - 1 : 0;
  return (static_cast<std::size_t>(shift) << bits) + (ns >> shift);
}

std::int64_t end_of(std::size_t bucket, unsigned bits) noexcept {
  const std::size_t power = bucket >> bits;
  const auto shift = static_cast<unsigned>(power > 1 ? power - 1 : 0);
  const std::uint64_t within = bucket - (static_cast<std::uint64_t>(shift) << bits);
  return static_cast<std::int64_t>(((within + 1) << shift) - 1);
}

}  // namespace

void LatencyHistogram::add(std::int64_t ns) noexcept {
  const std::int64_t value = std::max<std::int64_t>(ns, 0);
  ++counts_[bucket_of(static_cast<std::uint64_t>(value), bits)];
  ++count_;
  max_ = std::max(max_, value);
}

std::int64_t LatencyHistogram::percentile(double fraction) const noexcept {
  if (count_ == 0) return 0;
  const double rank = std::max(std::ceil(fraction * static_cast<double>(count_)), 1.0);
  std::uint64_t below = 0;
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    below += counts_[i];
    if (static_cast<double>(below) >= rank) return std::min(end_of(i, bits), max_);
  }
  return max_;
}

std::vector<LatencyHistogram::Bucket> LatencyHistogram::buckets() const {
  std::vector<Bucket> filled;
  for (std::size_t i = 0; i < counts_.size(); ++i)
    if (counts_[i] > 0) filled.push_back({std::min(end_of(i, bits), max_), counts_[i]});
  return filled;
}

}  // namespace touchmark::bench::measurement
