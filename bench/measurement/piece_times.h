/// How long a query takes where nothing interrupts it, from many short samples: what other work on the
/// machine lengthens is some of them, and a low quantile does not look at those.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace touchmark::bench::measurement {

/// A stretch of steps that is timed as a whole, again and again.
struct Piece {
  std::size_t steps = 0;
  std::size_t stratum = 0;  ///< see Stratum
};

/// A part of the trajectory that pieces were drawn from.
struct Stratum {
  double weight = 1;   ///< its share of the trajectory's steps
  double untimed = 0;  ///< the share of its steps that is in no piece
};

struct UndisturbedTime {
  double ns = 0;   ///< a query, the mean over the whole trajectory
  double low = 0;  ///< ends of the interval that holds it in 95 of 100 cases, as far as the samples tell
  double high = 0;
};

class PieceTimes {
 public:
  /// The share of each piece's samples that take no longer than what counts for it.
  static constexpr double quantile = 0.15;

  /// Each stratum of a weight above 0 has a piece.
  PieceTimes(std::vector<Piece> pieces, std::vector<Stratum> strata);

  /// The times of one round: of each piece in turn, then of each once more, and so on.
  void add_round(const std::vector<double>& ns);
  std::size_t rounds() const noexcept { return rounds_.size(); }

  /// The low quantile of each piece, summed up by stratum. The interval is the percentile bootstrap's (Efron
  /// & Tibshirani 1993, 13.3): rounds drawn anew, and where pieces are a sample of their stratum these as
  /// well, with the correction for a finite population. At least one round; the same for the same seed.
  UndisturbedTime estimate(std::uint64_t seed) const;

 private:
  std::vector<double> low_quantiles(const std::vector<std::size_t>& rounds) const;
  /// The means of the strata, a query each, over the pieces that are named.
  std::vector<double> means(const std::vector<double>& ns, const std::vector<std::size_t>& pieces) const;
  double total(const std::vector<double>& means) const;

  std::vector<Piece> pieces_;
  std::vector<Stratum> strata_;
  std::vector<std::vector<std::size_t>> of_stratum_;  ///< its pieces
  std::vector<std::vector<double>> rounds_;           ///< as they were added
};

}  // namespace touchmark::bench::measurement
