/// "did you mean": the known names nearest to a mistyped one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace touchmark::bench::support {

/// Up to three of `known`, the fewest edits away first; all of them joined by ", ".
std::string near_names(std::string_view mistyped, const std::vector<std::string>& known);

}  // namespace touchmark::bench::support
