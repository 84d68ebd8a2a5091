/// Which of several levels of detail answers the next query, by the time that recent ones took.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace touchmark::bench::experiments::papers {

/// Levels are numbered from the fastest on. Every time is set in relation to what its level is expected to
/// take, so what one level says of the machine's present load holds for the others. A slower level is taken
/// only where it leaves room and after some calm, a faster one at once: between the two lies what keeps it
/// from switching to and fro.
class LevelSwitch {
 public:
  /// A slower level is taken where its queries are expected to end within this part of the period.
  static constexpr double room = 0.8;
  /// Queries in a row that must have left that room before.
  static constexpr std::size_t calm = 32;
  /// How many recent queries count. The longest of them is taken for an interruption; the second is not.
  static constexpr std::size_t recent = 16;

  /// `expected_ns`: what a query of each level takes, ascending; at least one level, all above 0. Starts at
  /// the fastest.
  LevelSwitch(std::vector<double> expected_ns, double period_ns);

  std::size_t level() const noexcept { return level_; }
  std::size_t switches() const noexcept { return switches_; }
  /// The query that level() answered took so long.
  void took(double ns) noexcept;

 private:
  double slowness() const noexcept;
  void go_to(std::size_t level) noexcept;

  std::vector<double> expected_ns_;
  double period_ns_;
  std::array<double, recent> ratios_{};  ///< times over what was expected, a ring
  std::size_t next_ = 0, level_ = 0, calm_ = 0, switches_ = 0;
};

}  // namespace touchmark::bench::experiments::papers
