/// Two constants of double.
#pragma once

#include <limits>

namespace touchmark {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double unit_roundoff = std::numeric_limits<double>::epsilon() / 2;  ///< 2^-53

}  // namespace touchmark
