/// Reads CSV a record at a time, so a file may be larger than memory.
#pragma once

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh_io/input_file.h"

namespace touchmark::bench::support {

/// Commas, semicolons or tabs: what stands most often outside quotes. A line without a word in it holds
/// numbers, in which a comma beside semicolons or tabs is a decimal one.
char separator_of(std::string_view line) noexcept;

/// What a record that is no header has: "e" and "E" are of numbers, and so is a text of no letter.
bool has_words(std::string_view line) noexcept;

class CsvReader {
 public:
  /// Throws std::invalid_argument when the file cannot be opened, or is UTF-16.
  explicit CsvReader(std::string path);

  /// For files of other programs, before the first record: lines that begin with #, % or // are comments, a
  /// first line "sep=;" names the separator, and without one the first record tells whether commas,
  /// semicolons or tabs separate.
  void accept_any_dialect();
  char separator() const noexcept { return separator_; }
  /// The comment that came last before the last record, without its mark; empty where there was none.
  const std::string& last_comment() const noexcept { return last_comment_; }

  /// The next record's fields without their quotes; false at the end. Empty lines are skipped. Throws
  /// std::invalid_argument for an open quote, a field of more than 64 KiB or a read error.
  bool next(std::vector<std::string>& fields);
  /// Returns the line on which the last record began, from 1.
  std::size_t line() const { return record_line_; }
  /// An exception that names the file and, once a record was read, its line.
  std::invalid_argument error(const std::string& what) const;

 private:
  int get();
  int peek();
  bool fill();
  std::string_view line_ahead();
  void skip_line();
  bool skip_comment();
  void skip_what_is_no_record();
  int read_field(std::string& field);
  int read_quoted(std::string& field);

  std::string path_;
  std::unique_ptr<mesh_io::InputFile> file_;
  std::vector<char> buffer_;
  std::size_t at_ = 0, filled_ = 0;
  std::size_t line_ = 1, record_line_ = 0;
  char separator_ = ',';
  bool has_comments_ = false;
  std::string last_comment_;
};

}  // namespace touchmark::bench::support
