#include "core/mesh_io/mesh_builder.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <system_error>
#include <utility>

#include "core/mesh_io/input_file.h"

namespace touchmark::mesh_io {
namespace {

bool is_blank(char c) noexcept { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
bool is_line_end(char c) noexcept { return c == '\n' || c == '\r'; }

/// Limits of a file and of a pipe, which tells no size that could be held against the machine's memory.
constexpr std::uint64_t max_size = std::uint64_t{4} << 30, max_piped = std::uint64_t{1} << 30;

std::string read_whole(const std::filesystem::path& path) {
  InputFile file(path);
  if (!file.is_regular() && !file.is_pipe()) throw MeshError("is neither a file nor a pipe");
  if (file.size() > max_size)
    throw MeshError("has " + std::to_string(file.size()) + " bytes; at most " + std::to_string(max_size) +
                    " are read (4 GiB)");
  constexpr std::size_t min_room = 1 << 16;
  std::string bytes(file.size() + 1, '\0');  // the one more finds the end
  std::size_t filled = 0;
  for (;;) {
    if (filled == bytes.size()) bytes.resize(std::max(2 * filled, min_room));
    const std::size_t more = file.read(bytes.data() + filled, bytes.size() - filled);
    if (more == 0) break;
    filled += more;
    if (file.is_pipe() && filled > max_piped)
      throw MeshError("is a pipe that brings more than " + std::to_string(max_piped) + " bytes");
  }
  if (filled == 0) throw MeshError("is empty");
  bytes.resize(filled);
  return bytes;
}

/// True of "0,5": a number where the decimal point is a comma.
bool has_decimal_comma(std::string word) {
  const std::size_t comma = word.find(',');
  if (comma == word.npos || comma + 1 == word.size()) return false;
  word[comma] = '.';
  double ignored = 0;
  return std::from_chars(word.data(), word.data() + word.size(), ignored).ptr == word.data() + word.size();
}

}  // namespace

std::string quoted(std::string_view word) {
  constexpr std::size_t longest = 40;
  std::string text = "'";
  for (const char c : word.substr(0, longest))
    text += std::isprint(static_cast<unsigned char>(c)) != 0 ? c : '?';
  return text + (word.size() > longest ? "...'" : "'");
}

std::string read_file(const std::filesystem::path& path) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (!std::filesystem::exists(status)) throw MeshError("no such file");
  if (std::filesystem::is_directory(status)) throw MeshError("is a directory");
  try {
    return read_whole(path);
  } catch (const InputError& error) {
    throw MeshError(error.what());
  }
}

std::string_view without_byte_order_mark(std::string_view bytes) {
  constexpr std::string_view utf8 = "\xef\xbb\xbf", utf16_little = "\xff\xfe", utf16_big = "\xfe\xff";
  if (bytes.starts_with(utf16_little) || bytes.starts_with(utf16_big))
    throw MeshError("line 1: is UTF-16 text, which is not supported; save it as UTF-8 or ASCII");
  if (bytes.starts_with(utf8)) bytes.remove_prefix(utf8.size());
  return bytes;
}

std::optional<std::string> decoded_percents(std::string_view text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    decoded += text[i];
    if (text[i] != '%') continue;
    unsigned char byte = 0;
    const char* const digits = text.data() + i + 1;
    if (i + 2 >= text.size() || std::from_chars(digits, digits + 2, byte, 16).ptr != digits + 2 || byte == 0)
      return {};
    decoded.back() = static_cast<char>(byte);
    i += 2;
  }
  return decoded;
}

bool is_padding(std::string_view bytes) noexcept {
  constexpr char end_of_file = '\x1a';  // that of CP/M and MS-DOS
  return std::all_of(bytes.begin(), bytes.end(),
                     [](char c) { return c == '\0' || c == end_of_file || is_blank(c) || is_line_end(c); });
}

void TextCursor::fail(const std::string& message) const {
  throw MeshError("line " + std::to_string(line_) + ": " + message);
}

void TextCursor::skip_spaces(bool across_lines) {
  while (!rest_.empty()) {
    const char c = rest_.front();
    if (comment_ != 0 && c == comment_) {
      rest_.remove_prefix(std::min(rest_.find_first_of("\r\n"), rest_.size()));
    } else if (is_blank(c)) {
      rest_.remove_prefix(1);
    } else if (joins_at(0)) {
      rest_.remove_prefix(1);
      take_line_end();
    } else if (across_lines && is_line_end(c)) {
      take_line_end();
    } else {
      return;
    }
  }
}

std::string_view TextCursor::take_word() {
  const auto ends_at = [&](std::size_t at) {
    const char c = rest_[at];
    return is_blank(c) || is_line_end(c) || (comment_ != 0 && c == comment_) || joins_at(at);
  };
  std::size_t length = 0;
  while (length < rest_.size() && !ends_at(length)) ++length;
  const std::string_view word = rest_.substr(0, length);
  rest_.remove_prefix(length);
  return word;
}

std::string_view TextCursor::word() {
  skip_spaces(true);
  return take_word();
}

std::string_view TextCursor::word_on_line() {
  skip_spaces(false);
  return take_word();
}

bool TextCursor::joins_at(std::size_t at) const noexcept {
  return joins_lines_ && rest_[at] == '\\' && at + 1 < rest_.size() && is_line_end(rest_[at + 1]);
}

void TextCursor::take_line_end() {
  rest_.remove_prefix(rest_.starts_with("\r\n") ? 2 : 1);
  ++line_;
}

void TextCursor::skip_line() {
  while (!word_on_line().empty()) continue;
  if (!rest_.empty()) take_line_end();
}

bool TextCursor::at_end() {
  skip_spaces(true);
  return rest_.empty();
}

double TextCursor::number(std::string_view what) { return parse_double(word(), what, *this); }
double TextCursor::number_on_line(std::string_view what) { return parse_double(word_on_line(), what, *this); }
std::int64_t TextCursor::integer(std::string_view what) { return parse_integer(word(), what, *this); }

double parse_double(std::string_view word, std::string_view what, const TextCursor& cursor) {
  if (word.empty()) cursor.fail(std::string(what) + " is missing");
  std::string_view digits = word;
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::result_out_of_range) {
    // Too small is zero or denormal and harmless; strtod says which, and rounds it.
    value = std::strtod(std::string(digits).c_str(), nullptr);
    if (!std::isfinite(value)) cursor.fail(std::string(what) + " " + quoted(word) + " does not fit a double");
  } else if (error != std::errc() || end != digits.data() + digits.size()) {
    cursor.fail(std::string(what) + " " + quoted(word) +
                (has_decimal_comma(std::string(digits)) ? " has a decimal comma; write a decimal point"
                                                        : " is not a number"));
  }
  if (!std::isfinite(value)) cursor.fail(std::string(what) + " " + quoted(word) + " is not finite");
  return value;
}

std::int64_t parse_integer(std::string_view word, std::string_view what, const TextCursor& cursor) {
  if (word.empty()) cursor.fail(std::string(what) + " is missing");
  std::string_view digits = word;
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size())
    cursor.fail(std::string(what) + " " + quoted(word) + " is not a whole number");
  return value;
}

void MeshBuilder::reserve(std::size_t vertices, std::size_t faces) {
  vertices_.reserve(vertices);
  triangles_.reserve(faces);
}

void MeshBuilder::add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  triangles_.push_back({a, b, c});
  if (!ids_.empty()) ids_.push_back(faces_);
  ++faces_;
}

void MeshBuilder::add_polygon(const std::vector<std::uint32_t>& corners,
                              const std::vector<PolygonTriangle>& triangles) {
  const std::uint32_t id = faces_++;
  if (ids_.empty()) {
    ids_.resize(triangles_.size());
    std::iota(ids_.begin(), ids_.end(), 0u);
  }
  for (const PolygonTriangle& triangle : triangles) {
    triangles_.push_back({corners[triangle[0]], corners[triangle[1]], corners[triangle[2]]});
    ids_.push_back(id);
  }
}

TriangleMesh MeshBuilder::build() && {
  return TriangleMesh(std::move(vertices_), std::move(triangles_), std::move(ids_));
}

}  // namespace touchmark::mesh_io
