/// Ties an entry of ours to the table of its detector's options, core/named/detector_options.h.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "bench/contestants/entry.h"
#include "core/named/detector_options.h"

namespace touchmark::bench::contestants {

/// Sets options from the values of the same keys. Throws std::invalid_argument for a number that a command
/// line may hold and a detector may not.
inline void set_options(const std::vector<named::Option>& options, const OptionValues& values,
                        const TriangleMesh& mesh) {
  for (const named::Option& option : options)
    if (!option.set(values.text(option.key), mesh))
      throw std::invalid_argument(
          fmt::format("{}=\"{}\" is {}", option.key, values.text(option.key), option.refusal()));
}

/// Returns the detector's options with these values.
template <class Form>
Form form_of(const TriangleMesh& mesh, const OptionValues& values) {
  Form form;
  set_options(named::options_of(form), values, mesh);
  return form;
}

template <class Form>
auto fast_options_of(const TriangleMesh& mesh, const OptionValues& values) {
  return form_of<Form>(mesh, values).fast;
}

template <class Form>
auto published_options_of(const TriangleMesh& mesh, const OptionValues& values) {
  return form_of<Form>(mesh, values).published_options();
}

/// Returns the detector's options and those that the program measures with. Each of the latter follows the
/// option whose key stands beside it.
template <class Form>
std::vector<OptionInfo> options_with(const std::vector<std::pair<std::string, OptionInfo>>& of_the_program) {
  Form form;
  const std::vector<named::Option> table = named::options_of(form);
  std::vector<OptionInfo> options(table.begin(), table.end());
  for (const auto& [key, option] : of_the_program)
    options.insert(std::ranges::find(options, key, &OptionInfo::key) + 1, option);
  options.push_back(side_option());
  return options;
}

inline OptionInfo prepare_option(std::string summary) {
  return choice("prepare", Names<bool>{{"false", false}, {"true", true}}, std::move(summary));
}

}  // namespace touchmark::bench::contestants
