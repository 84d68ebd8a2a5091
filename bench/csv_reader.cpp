#include "bench/csv_reader.h"

#include <cerrno>
#include <cstring>
#include <utility>

#include <fmt/format.h>

namespace touchmark::bench {
namespace {

constexpr std::size_t longest_field = 1 << 16;  // a file without commas or line ends must not fill the memory
constexpr std::size_t most_fields = 1 << 16;
constexpr const char* byte_order_mark = "\xef\xbb\xbf";

bool ends_record(int c) { return c == '\n' || c == EOF; }

}  // namespace

CsvReader::CsvReader(std::string path)
    : path_(std::move(path)), file_(std::fopen(path_.c_str(), "rb")), buffer_(1 << 16) {
  if (!file_) throw error(std::strerror(errno));
  if (fill() && filled_ >= 3 && std::memcmp(buffer_.data(), byte_order_mark, 3) == 0) at_ = 3;
}

std::invalid_argument CsvReader::error(const std::string& what) const {
  return std::invalid_argument(record_line_ > 0 ? fmt::format("{}:{}: {}", path_, record_line_, what)
                                                : fmt::format("{}: {}", path_, what));
}

bool CsvReader::next(std::vector<std::string>& fields) {
  while (peek() == '\n' || peek() == '\r') get();
  if (peek() == EOF) return false;
  record_line_ = line_;
  fields.clear();
  int last = ',';
  while (last == ',') {
    if (fields.size() == most_fields) throw error("a record has more than 65536 fields");
    fields.emplace_back();
    last = read_field(fields.back());
  }
  return true;
}

/// Reads up to the comma or the end of the record, and returns which it was.
int CsvReader::read_field(std::string& field) {
  if (peek() == '"') return read_quoted(field);
  int c = get();
  for (; c != ',' && !ends_record(c); c = get()) {
    if (field.size() >= longest_field) throw error("a field is longer than 64 KiB");
    field.push_back(static_cast<char>(c));
  }
  if (ends_record(c) && !field.empty() && field.back() == '\r') field.pop_back();
  return c;
}

int CsvReader::read_quoted(std::string& field) {
  get();  // the quote
  for (int c = get(); c != '"' || peek() == '"'; c = get()) {
    if (c == EOF) throw error("a quote is never closed");
    if (field.size() >= longest_field) throw error("a field is longer than 64 KiB");
    if (c == '"') get();  // two quotes stand for one
    field.push_back(static_cast<char>(c));
  }
  int c = get();
  if (c == '\r' && ends_record(peek())) c = get();
  if (c != ',' && !ends_record(c)) throw error("text follows a closing quote");
  return c;
}

int CsvReader::get() {
  const int c = peek();
  if (c == EOF) return c;
  ++at_;
  if (c == '\n') ++line_;
  return c;
}

int CsvReader::peek() {
  if (at_ >= filled_ && !fill()) return EOF;
  return static_cast<unsigned char>(buffer_[at_]);
}

bool CsvReader::fill() {
  at_ = 0;
  filled_ = std::fread(buffer_.data(), 1, buffer_.size(), file_.get());
  if (filled_ == 0 && std::ferror(file_.get()) != 0) throw error(std::strerror(errno));
  return filled_ > 0;
}

}  // namespace touchmark::bench
