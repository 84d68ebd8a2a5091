#include "bench/support/files/csv_dialect.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <map>

namespace touchmark::bench::support {
namespace {

constexpr std::size_t max_lines = 64;  // that are looked at to find the separator

/// Returns the first lines of the text that hold something else than a comment.
std::vector<std::string_view> first_records(std::string_view text) {
  std::vector<std::string_view> records;
  while (!text.empty() && records.size() < max_lines) {
    const std::string_view line = text.substr(0, text.find_first_of("\r\n"));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    if (!trimmed(line).empty() && !comment_in(line)) records.push_back(line);
  }
  return records;
}

/// Returns how many lines have the number of fields that is most frequent, or 0 if no line has three numbers.
std::size_t lines_alike(const std::vector<std::string_view>& lines, char separator) {
  std::map<std::size_t, std::size_t> lines_of_size;
  std::size_t alike = 0;
  bool has_numbers = false;
  for (const std::string_view line : lines) {
    const std::vector<std::string> fields = split_fields(line, separator);
    alike = std::max(alike, ++lines_of_size[fields.size()]);
    has_numbers = has_numbers || std::ranges::count_if(fields, [&](const std::string& field) {
                                   return is_number(field, separator);
                                 }) >= 3;
  }
  return has_numbers ? alike : 0;
}

}  // namespace

std::string_view trimmed(std::string_view text) noexcept {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

bool has_words(std::string_view text) noexcept {
  return std::ranges::any_of(text, [](char c) {
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c & 0x80) != 0;
    return is_letter && c != 'e' && c != 'E';
  });
}

std::errc parse_decimal(std::string_view text, char separator, double& value) {
  std::string number(text);
  const std::size_t mark = number.find_first_of(".,");
  if (mark != number.npos && separator != ',') number[mark] = '.';
  const char* const begin = number.data() + (number.starts_with('+') && !number.starts_with("+-") ? 1 : 0);
  const char* const end = number.data() + number.size();
  const auto [stop, failure] = std::from_chars(begin, end, value);
  return stop == end ? failure : std::errc::invalid_argument;
}

bool is_number(std::string_view field, char separator) {
  double value = 0;
  return parse_decimal(trimmed(field), separator, value) != std::errc::invalid_argument;
}

std::optional<std::string_view> comment_in(std::string_view line) noexcept {
  const std::size_t first = line.find_first_not_of(" \t");
  if (first == line.npos) return std::nullopt;
  line.remove_prefix(first);
  for (const std::string_view mark : {"#", "%", "//"})
    if (line.starts_with(mark)) return line.substr(mark.size());
  return std::nullopt;
}

std::vector<std::string> split_fields(std::string_view line, char separator) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
    } else if (quoted || (c != separator && (separator != ' ' || c != '\t'))) {
      fields.back().push_back(c);
    } else if (separator != ' ' || !fields.back().empty()) {
      fields.emplace_back();
    }
  }
  for (std::string& field : fields) field = trimmed(field);
  if (separator == ' ' && fields.size() > 1 && fields.back().empty()) fields.pop_back();
  return fields;
}

char separator_of(std::string_view text) {
  const std::vector<std::string_view> lines = first_records(text);
  char separator = ' ';
  std::size_t most = 0;
  for (const char candidate : {',', '\t', ';', ' '}) {
    const std::size_t alike = lines_alike(lines, candidate);
    if (alike > most) separator = candidate;
    most = std::max(most, alike);
  }
  if (most > 0 || lines.empty()) return separator;
  most = 1;
  for (const char candidate : {',', ';', '\t'}) {
    const std::size_t fields = split_fields(lines.front(), candidate).size();
    if (fields > most) separator = candidate;
    most = std::max(most, fields);
  }
  return separator;
}

}  // namespace touchmark::bench::support
