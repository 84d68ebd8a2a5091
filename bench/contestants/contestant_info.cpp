#include "bench/contestants/contestant_info.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "bench/support/length.h"
#include "bench/support/numbers.h"
#include "bench/support/split.h"

namespace touchmark::bench::contestants {
namespace {

Guarantee guarantee_named(std::string_view name) {
  if (name == "exact") return Guarantee::exact;
  if (name == "conservative") return Guarantee::conservative;
  if (name == "approximate") return Guarantee::approximate;
  throw std::invalid_argument(fmt::format("\"{}\" is not exact, conservative or approximate", name));
}

/// Is every "key=value", joined by " with ", among the chosen ones?
bool all_chosen(std::string_view conditions, const OptionValues& values) {
  constexpr std::string_view with = " with ";
  for (;;) {
    const std::size_t end = conditions.find(with);
    const std::string_view pair = conditions.substr(0, end);
    const std::size_t equals = pair.find('=');
    const bool is_other = equals != std::string_view::npos && equals > 0 && pair[equals - 1] == '!';
    const auto chosen = values.all().find(std::string(pair.substr(0, is_other ? equals - 1 : equals)));
    if (equals == std::string_view::npos || chosen == values.all().end())
      throw std::invalid_argument(fmt::format("\"{}\" is not an option and its value", pair));
    if ((chosen->second != pair.substr(equals + 1)) != is_other) return false;
    if (end == std::string_view::npos) return true;
    conditions.remove_prefix(end + with.size());
  }
}

}  // namespace

std::optional<Guarantee> claimed_guarantee(const std::string& accuracy, const OptionValues& values) {
  if (accuracy.empty()) return std::nullopt;
  std::optional<Guarantee> claimed;
  for (std::string_view part : support::split(accuracy, ';')) {
    if (!claimed) {
      claimed = guarantee_named(part);
      continue;
    }
    part.remove_prefix(std::min(part.find_first_not_of(' '), part.size()));
    const std::size_t colon = part.find(": ");
    if (colon == std::string_view::npos)
      throw std::invalid_argument(fmt::format("\"{}\" is not KEY=VALUE: GUARANTEE", part));
    if (all_chosen(part.substr(0, colon), values)) claimed = guarantee_named(part.substr(colon + 2));
  }
  return claimed;
}

double OptionValues::number(const std::string& key) const { return support::parse_number(text(key)).value(); }

std::size_t OptionValues::count(const std::string& key) const {
  return support::parse_count(text(key)).value();
}

double OptionValues::length(const std::string& key, const TriangleMesh& mesh) const {
  return support::parse_length(text(key)).value().in_mesh_units(mesh);
}

bool ContestantInfo::answers(workload::Query query) const noexcept {
  return std::ranges::find(queries, query) != queries.end();
}

}  // namespace touchmark::bench::contestants
