#include "bench/support/files/csv_reader.h"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "bench/support/files/csv_dialect.h"

namespace touchmark::bench::support {
namespace {

constexpr std::size_t max_field = 1 << 16;  // a file without commas or line ends must not fill the memory
constexpr std::size_t max_fields = 1 << 16;
constexpr std::size_t max_comments = 64;
constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

bool ends_line(int c) { return c == '\n' || c == '\r' || c == EOF; }

bool is_blank(int c) { return c == ' ' || c == '\t'; }

}  // namespace

CsvReader::CsvReader(std::string path) : path_(std::move(path)), buffer_(1 << 16) {
  try {
    file_ = std::make_unique<mesh_io::InputFile>(path_);
  } catch (const mesh_io::InputError& failure) {
    throw error(failure.what());
  }
  if (!fill()) return;
  const std::string_view begin(buffer_.data(), filled_);
  if (begin.starts_with(byte_order_mark)) at_ = byte_order_mark.size();
  if (begin.starts_with("\xff\xfe") || begin.starts_with("\xfe\xff"))
    throw error("is UTF-16 text: save it as UTF-8 (\"CSV UTF-8\" in spreadsheets)");
}

void CsvReader::accept_any_dialect() {
  has_comments_ = true;
  skip_what_is_no_record();
  const std::string_view directive = "sep=", line = line_ahead();
  if (line.starts_with(directive) && line.size() > directive.size()) {
    separator_ = line[directive.size()];
    skip_line();
  } else {
    fill();
    separator_ = separator_of({buffer_.data() + at_, filled_ - at_});
  }
  const bool is_ascii = static_cast<unsigned char>(separator_) < 0x80;
  if (!is_ascii || separator_ == '"' || separator_ == '\r' || separator_ == '\n')
    throw error("the first line names no separator");
}

std::invalid_argument CsvReader::error(const std::string& what) const { return error_at(record_line_, what); }

std::invalid_argument CsvReader::error_at(std::size_t line, const std::string& what) const {
  return std::invalid_argument(line > 0 ? fmt::format("{}:{}: {}", path_, line, what)
                                        : fmt::format("{}: {}", path_, what));
}

bool CsvReader::next(std::vector<std::string>& fields) {
  if (record_line_ > 0) comments_.clear();
  skip_what_is_no_record();
  if (peek() == EOF) return false;
  record_line_ = line_;
  fields.clear();
  int last = separator_;
  while (last == separator_) {
    if (fields.size() == max_fields) throw error("a record has more than 65536 fields");
    fields.emplace_back();
    last = read_field(fields.back());
  }
  return true;
}

/// Reads up to the separator or the end of the record, and returns which it was: '\n' or EOF for the end.
int CsvReader::read_field(std::string& field) {
  skip_blanks();
  if (peek() == '"') return read_quoted(field);
  int c = take();
  for (; c != separator_ && !ends_line(c); c = take()) {
    if (field.size() >= max_field) throw error("a field is longer than 64 KiB");
    field.push_back(static_cast<char>(c));
  }
  return c;
}

int CsvReader::read_quoted(std::string& field) {
  get();  // the quote
  for (int c = get(); c != '"' || peek() == '"'; c = get()) {
    if (c == EOF) throw error("a quote is never closed");
    if (field.size() >= max_field) throw error("a field is longer than 64 KiB");
    if (c == '"') get();  // two quotes stand for one
    field.push_back(static_cast<char>(c));
  }
  if (separator_ != ' ') skip_blanks();
  const int c = take();
  if (c != separator_ && !ends_line(c)) throw error("text follows a closing quote");
  return c;
}

/// In files of other programs blanks around a field do not count.
void CsvReader::skip_blanks() {
  while (has_comments_ && is_blank(peek()) && (separator_ == ' ' || peek() != separator_)) get();
}

/// Takes what stands outside quotes: a line end of any kind as '\n', a run of separating blanks as one.
int CsvReader::take() {
  int c = get();
  if (separator_ == ' ' && is_blank(c)) {
    skip_blanks();
    if (!ends_line(peek())) return ' ';
    c = get();
  }
  if (c != '\r') return c;
  if (peek() == '\n') get();
  return '\n';
}

int CsvReader::get() {
  const int c = peek();
  if (c == EOF) return c;
  ++at_;
  if (c == '\n' || (c == '\r' && peek() != '\n')) ++line_;
  return c;
}

int CsvReader::peek() {
  if (at_ >= filled_ && !fill()) return EOF;
  return static_cast<unsigned char>(buffer_[at_]);
}

/// Reads until the buffer is full or the file ends: a pipe brings a little at a time.
bool CsvReader::fill() {
  // What has not been taken yet goes to the front.
  std::move(buffer_.begin() + static_cast<std::ptrdiff_t>(at_),
            buffer_.begin() + static_cast<std::ptrdiff_t>(filled_), buffer_.begin());
  filled_ -= at_;
  at_ = 0;
  try {
    for (std::size_t more = 1; more > 0 && filled_ < buffer_.size(); filled_ += more)
      more = file_->read(buffer_.data() + filled_, buffer_.size() - filled_);
  } catch (const mesh_io::InputError& failure) {
    throw error(failure.what());
  }
  return filled_ > 0;
}

/// The line that comes next, or as much of it as the buffer holds; it is not taken.
std::string_view CsvReader::line_ahead() {
  std::string_view ahead(buffer_.data() + at_, filled_ - at_);
  if (ahead.find_first_of("\r\n") == ahead.npos) {
    fill();
    ahead = std::string_view(buffer_.data() + at_, filled_ - at_);
  }
  return ahead.substr(0, ahead.find_first_of("\r\n"));
}

void CsvReader::skip_line() {
  while (!ends_line(peek())) get();
}

/// True if a comment was there; it is kept as far as the buffer holds it.
bool CsvReader::skip_comment() {
  const int c = peek();
  if (c != '#' && c != '%' && c != '/' && c != ' ' && c != '\t') return false;
  const std::optional<std::string_view> comment = comment_in(line_ahead());
  if (!comment) return false;
  if (comments_.size() == max_comments) comments_.erase(comments_.begin());
  comments_.push_back({std::string(*comment), line_});
  skip_line();
  return true;
}

void CsvReader::skip_what_is_no_record() {
  for (;;) {
    while (peek() == '\n' || peek() == '\r') get();
    if (!has_comments_ || !skip_comment()) return;
  }
}

}  // namespace touchmark::bench::support
