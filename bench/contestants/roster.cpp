#include "bench/contestants/roster.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "bench/support/did_you_mean.h"
#include "bench/support/length.h"
#include "bench/support/numbers.h"
#include "bench/support/split.h"

namespace touchmark::bench::contestants {
namespace {

const OptionInfo& find_option(const ContestantInfo& contestant, std::string_view key) {
  const auto found =
      std::ranges::find_if(contestant.options, [&](const OptionInfo& option) { return option.key == key; });
  if (found != contestant.options.end()) return *found;
  if (contestant.options.empty())
    throw std::invalid_argument(fmt::format("{} has no option \"{}\": it takes none", contestant.name, key));
  std::vector<std::string> keys;
  for (const OptionInfo& option : contestant.options) keys.push_back(option.key);
  throw std::invalid_argument(
      fmt::format("{} has no option \"{}\"; its options: {}", contestant.name, key, fmt::join(keys, ", ")));
}

/// What is expected of the value, if it is not that; else empty.
std::string complaint(const OptionInfo& option, std::string_view value) {
  switch (option.kind) {
    case OptionKind::choice:
      if (std::ranges::find(option.choices, value) != option.choices.end()) return "";
      return fmt::format("none of {}", fmt::join(option.choices, ", "));
    case OptionKind::number:
      return support::parse_number(value).value_or(-1) >= 0 ? "" : "not a number of 0 or more";
    case OptionKind::count:
      return support::parse_count(value) ? "" : "not a whole number of 0 or more";
    case OptionKind::length:
      return support::parse_length(value) ? "" : "not a length of 0 or more, as 0.01 or 0.5%";
  }
  return "";
}

void check_value(const ContestantInfo& contestant, const OptionInfo& option, std::string_view value) {
  const std::string wrong = complaint(option, value);
  if (wrong.empty()) return;
  throw std::invalid_argument(fmt::format("{}: {}=\"{}\" is {}", contestant.name, option.key, value, wrong));
}

/// Returns the former name that this is, or null.
const FormerName* former_name(const ContestantInfo& contestant, std::string_view name) {
  const auto found = std::ranges::find(contestant.former_names, name, &FormerName::name);
  return found != contestant.former_names.end() ? &*found : nullptr;
}

/// The pairs as written, checked. Throws for what is not key=value, an unknown or repeated key, a bad value.
/// Pairs that have no effect are left out, and their keys added to `dead`.
std::map<std::string, std::string> parse_options(const ContestantInfo& contestant, std::string_view text,
                                                 const FormerName* former, std::vector<std::string>& dead) {
  std::map<std::string, std::string> written;
  for (const std::string_view pair : support::split(text, ',')) {
    const std::size_t equals = pair.find('=');
    if (equals == std::string_view::npos)
      throw std::invalid_argument(fmt::format("{}: \"{}\" is not key=value", contestant.name, pair));
    if (former != nullptr && std::ranges::count(former->dead_options, pair.substr(0, equals)) > 0) {
      dead.emplace_back(pair.substr(0, equals));
      continue;
    }
    const OptionInfo& option = find_option(contestant, pair.substr(0, equals));
    const std::string_view value = pair.substr(equals + 1);
    check_value(contestant, option, value);
    if (!written.emplace(option.key, value).second)
      throw std::invalid_argument(fmt::format("{}: {} is given twice", contestant.name, option.key));
  }
  return written;
}

}  // namespace

Roster::Roster(std::vector<ContestantInfo> contestants) : contestants_(std::move(contestants)) { sort(); }

void Roster::sort() {
  std::ranges::stable_sort(contestants_, [](const ContestantInfo& a, const ContestantInfo& b) {
    return std::tie(a.rank, a.name) < std::tie(b.rank, b.name);
  });
}

void Roster::add(ContestantInfo contestant) {
  for (const ContestantInfo& other : contestants_) {
    if (other.name != contestant.name && former_name(other, contestant.name) == nullptr) continue;
    throw std::invalid_argument(
        fmt::format("its name \"{}\" is taken by {}", contestant.name,
                    other.plugin.empty() ? "a contestant of this program" : other.plugin));
  }
  contestants_.push_back(std::move(contestant));
  sort();
}

const ContestantInfo& Roster::find(const std::string& name) const {
  const auto found = std::ranges::find_if(contestants_, [&](const ContestantInfo& info) {
    return info.name == name || former_name(info, name) != nullptr;
  });
  if (found != contestants_.end()) return *found;
  std::vector<std::string> names;
  for (const ContestantInfo& info : contestants_) names.push_back(info.name);
  throw std::invalid_argument(fmt::format("unknown contestant \"{}\"; the nearest names: {}", name,
                                          support::near_names(name, names)));
}

ContestantSpec Roster::parse(const std::string& text) const {
  const std::size_t colon = text.find(':');
  const std::string name = text.substr(0, colon);
  const ContestantInfo& contestant = find(name);
  const FormerName* const former = former_name(contestant, name);
  std::vector<std::string> dead;
  std::map<std::string, std::string> written;
  if (colon != std::string::npos) written = parse_options(contestant, text.substr(colon + 1), former, dead);

  std::vector<std::string> in_order;
  std::map<std::string, std::string> values;
  for (const OptionInfo& option : contestant.options) {
    const auto given = written.find(option.key);
    if (given != written.end()) in_order.push_back(option.key + "=" + given->second);
    values.emplace(option.key, given != written.end() ? given->second : option.default_value);
  }
  OptionValues chosen(std::move(values));
  const std::optional<Guarantee> claimed = claimed_guarantee(contestant.accuracy, chosen);
  ContestantSpec spec{contestant.name, fmt::format("{}", fmt::join(in_order, ",")), std::move(chosen),
                      claimed, contestant.plugin};
  if (former != nullptr) spec.remark = fmt::format("{} answers as {}", text, spec.text());
  if (!dead.empty()) spec.remark += fmt::format("; without effect: {}", fmt::join(dead, ", "));
  return spec;
}

std::vector<ContestantSpec> Roster::parse_all(const std::vector<std::string>& texts) const {
  std::vector<ContestantSpec> specs;
  for (const std::string& text : texts) specs.push_back(parse(text));
  for (auto spec = specs.begin(); spec != specs.end();) {
    const bool is_again =
        !spec->remark.empty() && std::ranges::count(specs, spec->text(), &ContestantSpec::text) > 1;
    if (!spec->remark.empty())
      fmt::print(stderr, "touchmark: {}{}\n", spec->remark, is_again ? "; asked once" : "");
    spec = is_again ? specs.erase(spec) : spec + 1;
  }
  return specs;
}

std::vector<ContestantSpec> Roster::forms(std::vector<std::string> Forms::*set) const {
  std::vector<ContestantSpec> specs;
  for (const ContestantInfo& info : contestants_) {
    if (!info.built()) continue;
    for (const std::string& options : info.forms.*set)
      specs.push_back(parse(options.empty() ? info.name : info.name + ":" + options));
  }
  return specs;
}

std::vector<ContestantSpec> Roster::thorough_set() const {
  std::vector<ContestantSpec> specs = default_set();
  for (ContestantSpec& spec : forms(&Forms::verified)) specs.push_back(std::move(spec));
  return specs;
}

std::vector<ContestantSpec> Roster::candidates(workload::Query query) const {
  std::vector<ContestantSpec> specs = forms(&Forms::scaled);
  for (ContestantSpec& spec : forms(&Forms::chosen)) specs.push_back(std::move(spec));
  return exact_ones(std::move(specs), query);
}

std::vector<ContestantSpec> Roster::scene_candidates(workload::Query query) const {
  return exact_ones(forms(&Forms::scenes), query);
}

std::vector<ContestantSpec> Roster::exact_ones(std::vector<ContestantSpec> specs,
                                               workload::Query query) const {
  std::erase_if(specs, [&](const ContestantSpec& spec) {
    return spec.claimed != Guarantee::exact || !find(spec.name).answers(query);
  });
  return specs;
}

const ContestantInfo& Roster::find_built(const std::string& name) const {
  const ContestantInfo& contestant = find(name);
  if (!contestant.built())
    throw std::invalid_argument(
        "it is not built; scripts/setup rivals and scripts/build-program "
        "touchmark-extra build all rivals");
  return contestant;
}

void Roster::prepare_to_build(const ContestantSpec& spec, std::size_t triangles) const {
  const ContestantInfo& contestant = find_built(spec.name);
  contestant.load();
  support::require_memory_for_triangles(triangles, contestant.bytes_per_triangle(spec.values));
}

std::unique_ptr<Contestant> Roster::build(const ContestantSpec& spec, const TriangleMesh& mesh) const {
  const ContestantInfo& contestant = find_built(spec.name);
  return contestant.build(mesh, spec.values);
}

std::unique_ptr<Contestant> Roster::build(const ContestantSpec& spec,
                                          const scenes::PlacedScene& scene) const {
  const ContestantInfo& contestant = find_built(spec.name);
  if (!contestant.build_scene)
    throw std::invalid_argument(
        "it is of one mesh, and takes no scene of bodies (touchmark list says who does)");
  return contestant.build_scene(scene, spec.values);
}

}  // namespace touchmark::bench::contestants
