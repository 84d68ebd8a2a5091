/// "did you mean": the known names nearest to a mistyped one.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace touchmark::bench::support {

/// Up to three of `known`, the fewest edits away first; all of them joined by ", ".
std::string near_names(std::string_view mistyped, const std::vector<std::string>& known);

/// Returns the item of `list` whose `name` is `name`. Throws std::invalid_argument with the nearest names
/// where there is none; `what` is what an item is.
template <class List>
const auto& item_named(std::string_view name, const List& list, const std::string& what) {
  std::vector<std::string> names;
  for (const auto& item : list) {
    if (item.name == name) return item;
    names.emplace_back(item.name);
  }
  throw std::invalid_argument("unknown " + what + " \"" + std::string(name) +
                              "\"; the nearest names: " + near_names(name, names));
}

}  // namespace touchmark::bench::support
