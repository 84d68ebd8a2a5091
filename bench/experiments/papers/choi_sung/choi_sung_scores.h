/// Choi & Sung's Table 2: five criteria, scored 0 to 5, and their total.
#pragma once

#include <array>
#include <vector>

#include "bench/experiments/papers/choi_sung/choi_sung.h"

namespace touchmark::bench::experiments::papers {

/// The paper gives no formula but "the resulting values of differences are converted to the scores ranging
/// from 0 to 5". Here: each criterion's difference from level 0, averaged over the levels, scored linearly
/// from 0 (the worst method) to 5 (the best).
struct MethodScores {
  SubdivisionMethod method;
  /// The paper's is "how natural the model is", by eye. Here half is for few creases and half for passing
  /// near the original's vertices, which are where the modelled object is known to be. Creases alone reward
  /// what shrinks.
  double appearance = 0;
  double volume = 0;     ///< |relative volume - 1|: the less, the better
  double tightness = 0;  ///< relative tightness without clustering: the less, the better
  double detection = 0;  ///< detection time without and with clustering, to level 0's: the less, the better
  double update = 0;     ///< update rate without and with clustering, to level 0's: the more, the better
  double creases = 0;    ///< a part of appearance: the fewer and blunter, the better
  double closeness =
      0;  ///< a part of appearance: mean distance of the original's vertices, the less, the better

  double total() const noexcept { return appearance + volume + tightness + detection + update; }
};

/// In the order of choi_sung_methods. Empty unless every row was measured and timed.
std::vector<MethodScores> choi_sung_scores(const ChoiSungResult& result);

/// 5 for the least value, 0 for the greatest, in between in proportion; 5 for all when they are equal.
std::vector<double> scores_of(const std::vector<double>& badness);

}  // namespace touchmark::bench::experiments::papers
