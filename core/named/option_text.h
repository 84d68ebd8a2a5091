/// Reads what follows a detector's name, "key=value,key=value", as the command line has it.
#pragma once

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/triangle_mesh.h"

namespace touchmark::named {

/// The pairs of one text. A detector asks for every key that it knows, and then that none is left over.
/// Everything throws std::invalid_argument, naming the detector, the key and the value.
class OptionText {
 public:
  /// Throws for what is not key=value, and for a key that is given twice.
  OptionText(std::string detector, std::string_view text);

  /// Each of these leaves the value as it is where the key is not given.
  void read_number(std::string_view key, double& value);  ///< finite, 0 or more
  void read_count(std::string_view key, std::size_t& value);
  /// In mesh units, or with a percent sign in percent of the mesh's box diagonal.
  void read_length(std::string_view key, const TriangleMesh& mesh, double& value);

  template <class Value, std::size_t count>
  void read_choice(std::string_view key, const std::array<std::pair<std::string_view, Value>, count>& choices,
                   Value& value) {
    const std::string* text = take(key);
    if (text == nullptr) return;
    std::string names;
    for (const auto& [name, meant] : choices) {
      if (name == *text) {
        value = meant;
        return;
      }
      names += (names.empty() ? "" : ", ") + std::string(name);
    }
    refuse(key, *text, "none of " + names);
  }

  /// Throws for a key that nobody has asked for, and lists those that somebody has.
  void expect_nothing_left() const;

 private:
  struct Pair {
    std::string key, value;
    bool taken = false;
  };

  const std::string* take(std::string_view key);
  [[noreturn]] void refuse(std::string_view key, std::string_view value, const std::string& wrong) const;

  std::string detector_;
  std::vector<Pair> pairs_;
  std::vector<std::string> known_;
};

}  // namespace touchmark::named
