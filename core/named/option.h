/// One option of a detector, as the command line, C, Python and `touchmark list` have it.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/triangle_mesh.h"

namespace touchmark::named {

enum class OptionKind {
  choice,
  number,  ///< 0 or more
  count,   ///< a whole number of 0 or more
  length   ///< 0 or more, in mesh units or in percent of the mesh's box diagonal
};

struct OptionInfo {
  std::string key;
  OptionKind kind = OptionKind::choice;
  std::vector<std::string> choices;  ///< what a choice may be
  std::string default_value;
  std::string summary;    ///< one line
  std::string code = {};  ///< sets it in a member of the detector's Options: "cell = {}"; empty: no such one
};

/// An option and the member that it sets, which must outlive it.
struct Option : OptionInfo {
  /// Sets the member. Returns false, and sets nothing, if the text is none that the option may have.
  std::function<bool(const std::string& text, const TriangleMesh& mesh)> set;

  /// Returns the end of an error about a text that `set` refused, as "not a number of 0 or more".
  std::string refusal() const;
  /// Returns the option with the code that sets it: "MEMBER = {}", or "MEMBER = TYPE::{}" for an enumeration.
  Option in_code(const std::string& member, const std::string& type = "") &&;
};

// Each takes its default from the member as it is.
Option number(std::string key, double& member, std::string summary);
Option count(std::string key, std::size_t& member, std::string summary);
/// A number that does not fit becomes the largest, which every detector refuses.
Option count(std::string key, unsigned& member, std::string summary);
/// `default_value` is the text of a default in percent, which the member cannot hold.
Option length(std::string key, double& member, std::string summary, std::string default_value = "0");

/// The default is the first name of what the member holds.
template <class Value>
Option choice(std::string key, Value& member, std::vector<std::pair<std::string, Value>> names,
              std::string summary) {
  Option option{{std::move(key), OptionKind::choice, {}, "", std::move(summary)}, nullptr};
  for (const auto& [name, value] : names) {
    if (value == member && option.default_value.empty()) option.default_value = name;
    option.choices.push_back(name);
  }
  option.set = [&member, names = std::move(names)](const std::string& text, const TriangleMesh&) {
    for (const auto& [name, value] : names) {
      if (name != text) continue;
      member = value;
      return true;
    }
    return false;
  };
  return option;
}

}  // namespace touchmark::named
