/// Reads CSV a record at a time, so a file may be larger than memory.
#pragma once

#include <cstddef>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace touchmark::bench {

class CsvReader {
 public:
  /// Throws std::invalid_argument when the file cannot be opened.
  explicit CsvReader(std::string path);

  /// The next record's fields without their quotes; false at the end. Empty lines are skipped. Throws
  /// std::invalid_argument for an open quote, a field of more than 64 KiB or a read error.
  bool next(std::vector<std::string>& fields);
  /// Where the last record began, from 1.
  std::size_t line() const { return record_line_; }
  /// An exception that names the file and, once a record was read, its line.
  std::invalid_argument error(const std::string& what) const;

 private:
  int get();
  int peek();
  bool fill();
  int read_field(std::string& field);
  int read_quoted(std::string& field);

  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::string path_;
  std::unique_ptr<std::FILE, Close> file_;
  std::vector<char> buffer_;
  std::size_t at_ = 0, filled_ = 0;
  std::size_t line_ = 1, record_line_ = 0;
};

}  // namespace touchmark::bench
