#include "core/named/option_text.h"

#include <map>
#include <stdexcept>

namespace touchmark::named {
namespace {

/// Returns the values by their keys.
std::map<std::string, std::string> pairs_of(const std::string& detector, std::string_view text) {
  std::map<std::string, std::string> pairs;
  while (!text.empty()) {
    const std::size_t comma = text.find(',');
    const std::string_view pair = text.substr(0, comma);
    const std::size_t equals = pair.find('=');
    if (equals == std::string_view::npos)
      throw std::invalid_argument(detector + ": \"" + std::string(pair) + "\" is not key=value");
    const std::string key(pair.substr(0, equals));
    if (!pairs.emplace(key, pair.substr(equals + 1)).second)
      throw std::invalid_argument(detector + ": " + key + " is given twice");
    if (comma == std::string_view::npos) break;
    text.remove_prefix(comma + 1);
    if (text.empty()) throw std::invalid_argument(detector + ": nothing follows the last comma");
  }
  return pairs;
}

}  // namespace

void read_options(const std::string& detector, std::string_view text, const TriangleMesh& mesh,
                  std::span<const Option> options) {
  std::map<std::string, std::string> pairs = pairs_of(detector, text);
  std::string keys;
  for (const Option& option : options) {
    keys += (keys.empty() ? "" : ", ") + option.key;
    const auto pair = pairs.extract(option.key);
    if (pair.empty() || option.set(pair.mapped(), mesh)) continue;
    throw std::invalid_argument(detector + ": " + option.key + "=\"" + pair.mapped() + "\" is " +
                                option.refusal());
  }
  if (pairs.empty()) return;
  throw std::invalid_argument(detector + " has no option \"" + pairs.begin()->first +
                              "\"; its options: " + keys);
}

}  // namespace touchmark::named
