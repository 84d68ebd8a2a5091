/// How roster.cpp ties the names of options on the command line to values of a detector's Options.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bench/contestant.h"
#include "bench/contestant_info.h"

namespace touchmark::bench {

template <Detector D>
std::unique_ptr<Contestant> contestant(const TriangleMesh& mesh, const typename D::Options& options) {
  return std::make_unique<ContestantOf<D>>(D::build(mesh, options));
}

/// A choice's names with what they stand for. The first one is the default.
template <class Value>
using Names = std::vector<std::pair<std::string, Value>>;

template <class Value>
OptionInfo choice(std::string key, const Names<Value>& names, std::string summary) {
  OptionInfo option{std::move(key), OptionKind::choice, {}, names.front().first, std::move(summary)};
  for (const auto& [name, value] : names) option.choices.push_back(name);
  return option;
}

/// The roster has checked that the value is one of the names.
template <class Value>
Value chosen(const OptionValues& values, const std::string& key, const Names<Value>& names) {
  for (const auto& [name, value] : names) {
    if (name == values.text(key)) return value;
  }
  return names.front().second;
}

}  // namespace touchmark::bench
