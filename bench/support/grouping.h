/// Rows by what they have in common.
#pragma once

#include <algorithm>
#include <type_traits>
#include <utility>
#include <vector>

namespace touchmark::bench::support {

/// Returns the keys in the order of first appearance, each with its rows. A group of rows may be grouped
/// again.
template <class Row, class KeyOf>
auto grouped_by(const std::vector<Row>& rows, KeyOf key_of) {
  using Element = std::remove_pointer_t<Row>;
  using Key = std::decay_t<std::invoke_result_t<KeyOf, const Element&>>;
  std::vector<std::pair<Key, std::vector<const Element*>>> groups;
  for (const Row& row : rows) {
    const Element* element = nullptr;
    if constexpr (std::is_pointer_v<Row>)
      element = row;
    else
      element = &row;
    const Key key = key_of(*element);
    auto group = std::ranges::find_if(groups, [&](const auto& known) { return known.first == key; });
    if (group == groups.end()) group = groups.insert(group, {key, {}});
    group->second.push_back(element);
  }
  return groups;
}

}  // namespace touchmark::bench::support
