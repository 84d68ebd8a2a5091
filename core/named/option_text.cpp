#include "core/named/option_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <system_error>

namespace touchmark::named {
namespace {

/// The whole text as a number, or nothing.
template <class Number>
std::optional<Number> parsed(std::string_view text) {
  Number number{};
  const char* const end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || stopped != end) return std::nullopt;
  return number;
}

bool is_size(const std::optional<double>& number) {
  return number && std::isfinite(*number) && !std::signbit(*number);
}

}  // namespace

OptionText::OptionText(std::string detector, std::string_view text) : detector_(std::move(detector)) {
  while (!text.empty()) {
    const std::size_t comma = text.find(',');
    const std::string_view pair = text.substr(0, comma);
    const std::size_t equals = pair.find('=');
    if (equals == std::string_view::npos) {
      throw std::invalid_argument(detector_ + ": \"" + std::string(pair) + "\" is not key=value");
    }
    const std::string key(pair.substr(0, equals));
    if (std::ranges::find(pairs_, key, &Pair::key) != pairs_.end()) {
      throw std::invalid_argument(detector_ + ": " + key + " is given twice");
    }
    pairs_.push_back({key, std::string(pair.substr(equals + 1))});
    if (comma == std::string_view::npos) return;
    text.remove_prefix(comma + 1);
    if (text.empty()) throw std::invalid_argument(detector_ + ": nothing follows the last comma");
  }
}

const std::string* OptionText::take(std::string_view key) {
  known_.emplace_back(key);
  const auto found = std::ranges::find(pairs_, key, &Pair::key);
  if (found == pairs_.end()) return nullptr;
  found->taken = true;
  return &found->value;
}

void OptionText::refuse(std::string_view key, std::string_view value, const std::string& wrong) const {
  throw std::invalid_argument(detector_ + ": " + std::string(key) + "=\"" + std::string(value) + "\" is " +
                              wrong);
}

void OptionText::read_number(std::string_view key, double& value) {
  const std::string* text = take(key);
  if (text == nullptr) return;
  const std::optional<double> number = parsed<double>(*text);
  if (!is_size(number)) refuse(key, *text, "not a number of 0 or more");
  value = *number;
}

void OptionText::read_count(std::string_view key, std::size_t& value) {
  const std::string* text = take(key);
  if (text == nullptr) return;
  const std::optional<std::size_t> number = parsed<std::size_t>(*text);
  if (!number) refuse(key, *text, "not a whole number of 0 or more");
  value = *number;
}

void OptionText::read_length(std::string_view key, const TriangleMesh& mesh, double& value) {
  const std::string* text = take(key);
  if (text == nullptr) return;
  const bool percent = text->ends_with('%');
  const std::optional<double> number =
      parsed<double>(std::string_view(*text).substr(0, text->size() - (percent ? 1 : 0)));
  if (!is_size(number)) refuse(key, *text, "not a length of 0 or more, as 0.01 or 0.5%");
  value = percent ? *number / 100 * mesh.diagonal() : *number;
}

void OptionText::expect_nothing_left() const {
  const auto left = std::ranges::find(pairs_, false, &Pair::taken);
  if (left == pairs_.end()) return;
  std::string keys;
  for (const std::string& key : known_) keys += (keys.empty() ? "" : ", ") + key;
  throw std::invalid_argument(detector_ + " has no option \"" + left->key + "\"; its options: " + keys);
}

}  // namespace touchmark::named
