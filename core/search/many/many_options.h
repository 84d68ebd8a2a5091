/// How many points are asked at once. Answers do not depend on it.
#pragma once

#include <cstdint>

namespace touchmark {

/// The order in which many points are asked. Answers do not depend on it.
enum class AskOrder : std::uint8_t {
  automatic,  ///< along a space-filling curve, unless consecutive points are near each other already
  as_given,
  curve  ///< along a space-filling curve
};

/// What `nearest_many` may be told.
struct ManyOptions {
  unsigned threads = 1;  ///< the caller's one of them, at most 256; 0: one a processor
  AskOrder order = AskOrder::automatic;
};

}  // namespace touchmark
