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

struct CsvComment {
  std::string text;  ///< without its mark
  std::size_t line;  ///< from 1
};

class CsvReader {
 public:
  /// Throws std::invalid_argument when the file cannot be opened, or is UTF-16.
  explicit CsvReader(std::string path);

  /// For files of other programs, before the first record: lines that begin with #, % or // are comments,
  /// blanks around fields do not count, a first line "sep=;" names the separator, and without one
  /// separator_of() finds it.
  void accept_any_dialect();
  char separator() const noexcept { return separator_; }
  /// Returns the comments between the last record and the one before it; of more than 64 the last.
  const std::vector<CsvComment>& comments() const noexcept { return comments_; }

  /// The next record's fields without their quotes; false at the end. Lines end with LF, CRLF or CR; empty
  /// ones are skipped. Throws std::invalid_argument for an open quote, a field of more than 64 KiB or a read
  /// error.
  bool next(std::vector<std::string>& fields);
  /// Returns the line on which the last record began, from 1.
  std::size_t line() const { return record_line_; }
  /// An exception that names the file and, once a record was read, its line.
  std::invalid_argument error(const std::string& what) const;
  /// An exception that names the file and this line.
  std::invalid_argument error_at(std::size_t line, const std::string& what) const;

 private:
  int get();
  int peek();
  int take();
  void skip_blanks();
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
  std::vector<CsvComment> comments_;
};

}  // namespace touchmark::bench::support
