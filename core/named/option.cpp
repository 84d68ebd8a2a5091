#include "core/named/option.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include "core/named/parsed.h"

namespace touchmark::named {
namespace {

/// A finite number of 0 or more, or nothing.
std::optional<double> parsed_size(std::string_view text) {
  const std::optional<double> number = parsed<double>(text);
  return number && std::isfinite(*number) && !std::signbit(*number) ? number : std::nullopt;
}

template <class Number>
std::string text_of(Number number) {
  std::array<char, 32> text;
  return std::string(text.data(), std::to_chars(text.data(), text.data() + text.size(), number).ptr);
}

template <class Count>
Option counted(std::string key, Count& member, std::string summary) {
  return {{std::move(key), OptionKind::count, {}, text_of(member), std::move(summary)},
          [&member](const std::string& text, const TriangleMesh&) {
            const std::optional<std::size_t> number = parsed<std::size_t>(text);
            if (number)
              member = static_cast<Count>(std::min<std::size_t>(*number, std::numeric_limits<Count>::max()));
            return number.has_value();
          }};
}

}  // namespace

Option Option::in_code(const std::string& member, const std::string& type) && {
  code = member + " = " + (type.empty() ? "" : type + "::") + "{}";
  return std::move(*this);
}

std::string Option::refusal() const {
  if (kind == OptionKind::number) return "not a number of 0 or more";
  if (kind == OptionKind::count) return "not a whole number of 0 or more";
  if (kind == OptionKind::length) return "not a length of 0 or more, as 0.01 or 0.5%";
  std::string names;
  for (const std::string& name : choices) names += (names.empty() ? "none of " : ", ") + name;
  return names;
}

Option number(std::string key, double& member, std::string summary) {
  return {{std::move(key), OptionKind::number, {}, text_of(member), std::move(summary)},
          [&member](const std::string& text, const TriangleMesh&) {
            const std::optional<double> number = parsed_size(text);
            member = number.value_or(member);
            return number.has_value();
          }};
}

Option count(std::string key, std::size_t& member, std::string summary) {
  return counted(std::move(key), member, std::move(summary));
}

Option count(std::string key, unsigned& member, std::string summary) {
  return counted(std::move(key), member, std::move(summary));
}

Option length(std::string key, double& member, std::string summary, std::string default_value) {
  return {{std::move(key), OptionKind::length, {}, std::move(default_value), std::move(summary)},
          [&member](const std::string& text, const TriangleMesh& mesh) {
            const bool percent = text.ends_with('%');
            const std::optional<double> number =
                parsed_size(std::string_view(text).substr(0, text.size() - (percent ? 1 : 0)));
            if (number) member = percent ? *number / 100 * mesh.diagonal() : *number;
            return number.has_value();
          }};
}

}  // namespace touchmark::named
