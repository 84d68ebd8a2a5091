#include "core/mesh_io/mesh_file.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <numeric>
#include <system_error>
#include <utility>

#include <Eigen/Geometry>

namespace touchmark::mesh_io {
namespace {

bool is_blank(char c) noexcept { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
bool is_line_end(char c) noexcept { return c == '\n' || c == '\r'; }

using Point2 = Eigen::Vector2d;

/// Twice the signed area of (a, b, c).
double turn(const Point2& a, const Point2& b, const Point2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// The polygon seen along the largest component of its (Newell) normal, counter-clockwise.
std::vector<Point2> flattened(const std::vector<Vec3>& vertices, const std::vector<std::uint32_t>& corners) {
  Vec3 normal = Vec3::Zero();
  const Vec3& origin = vertices[corners[0]];
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 a = vertices[corners[i]] - origin, b = vertices[corners[(i + 1) % corners.size()]] - origin;
    normal += a.cross(b);
  }
  int drop = 0;
  normal.cwiseAbs().maxCoeff(&drop);
  const int u = (drop + 1) % 3, v = (drop + 2) % 3;
  std::vector<Point2> points;
  points.reserve(corners.size());
  for (const std::uint32_t corner : corners) {
    const Vec3 p = vertices[corner] - origin;
    points.emplace_back(normal[drop] < 0 ? p[v] : p[u], normal[drop] < 0 ? p[u] : p[v]);
  }
  return points;
}

bool is_ear(const std::vector<Point2>& points, const std::vector<std::size_t>& ring, std::size_t at) {
  const std::size_t n = ring.size();
  const Point2 &a = points[ring[(at + n - 1) % n]], &b = points[ring[at]], &c = points[ring[(at + 1) % n]];
  if (!(turn(a, b, c) > 0)) return false;
  for (const std::size_t other : ring) {
    const Point2& p = points[other];
    if (p == a || p == b || p == c) continue;
    if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
  }
  return true;
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
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw MeshError("no such file");
  if (std::filesystem::is_directory(status)) throw MeshError("is a directory");
  std::ifstream in(path, std::ios::binary);
  if (!in) throw MeshError("cannot be opened for reading");
  std::string bytes;
  if (std::filesystem::is_regular_file(status)) {
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (!error) bytes.reserve(size);
  }
  bytes.assign(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  if (in.bad()) throw MeshError("cannot be read");
  if (bytes.empty()) throw MeshError("is empty");
  return bytes;
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
    } else if (across_lines && is_line_end(c)) {
      skip_line();
    } else {
      return;
    }
  }
}

std::string_view TextCursor::take_word() {
  std::size_t length = 0;
  while (length < rest_.size() && !is_blank(rest_[length]) && !is_line_end(rest_[length])) ++length;
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

void TextCursor::skip_line() {
  const std::size_t end = rest_.find_first_of("\r\n");
  if (end == std::string_view::npos) {
    rest_ = {};
    return;
  }
  const bool both = rest_[end] == '\r' && end + 1 < rest_.size() && rest_[end + 1] == '\n';
  rest_.remove_prefix(end + (both ? 2 : 1));
  ++line_;
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
    cursor.fail(std::string(what) + " " + quoted(word) + " is not a number");
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
  if (error != std::errc() || end != digits.data() + digits.size()) {
    cursor.fail(std::string(what) + " " + quoted(word) + " is not a whole number");
  }
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

void MeshBuilder::add_polygon(const std::vector<std::uint32_t>& corners) {
  const std::uint32_t id = faces_++;
  if (ids_.empty()) {
    ids_.resize(triangles_.size());
    std::iota(ids_.begin(), ids_.end(), 0u);
  }
  const std::vector<Point2> points = flattened(vertices_, corners);
  std::vector<std::size_t> ring(corners.size());
  std::iota(ring.begin(), ring.end(), std::size_t{0});
  const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
    triangles_.push_back({corners[a], corners[b], corners[c]});
    ids_.push_back(id);
  };
  std::size_t at = 0, since_last_ear = 0;
  while (ring.size() > 3) {
    // No ear left: the polygon crosses itself or has no area; what remains becomes a fan.
    const bool stuck = since_last_ear >= ring.size();
    if (stuck || is_ear(points, ring, at)) {
      const std::size_t n = ring.size();
      add(ring[(at + n - 1) % n], ring[at], ring[(at + 1) % n]);
      ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(at));
      at %= ring.size();
      since_last_ear = 0;
    } else {
      at = (at + 1) % ring.size();
      ++since_last_ear;
    }
  }
  add(ring[0], ring[1], ring[2]);
}

TriangleMesh MeshBuilder::build() && {
  return TriangleMesh(std::move(vertices_), std::move(triangles_), std::move(ids_));
}

}  // namespace touchmark::mesh_io
