#include "bench/support/did_you_mean.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include <fmt/format.h>

namespace touchmark::bench::support {
namespace {

/// Insertions, deletions and replacements of one character (Levenshtein).
std::size_t edits_between(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

}  // namespace

std::string near_names(std::string_view mistyped, const std::vector<std::string>& known) {
  std::vector<std::string> names = known;
  std::ranges::stable_sort(names, [&](const std::string& a, const std::string& b) {
    return edits_between(mistyped, a) < edits_between(mistyped, b);
  });
  names.resize(std::min<std::size_t>(names.size(), 3));
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace touchmark::bench::support
