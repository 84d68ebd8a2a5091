/// A file that appears under its name only when it is complete.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

namespace touchmark::bench::support {

class AtomicFile {
 public:
  /// Opens a file beside `path`; throws ResourceError when that fails.
  explicit AtomicFile(const std::string& path);
  /// Removes what was written, unless commit() was reached.
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Throws ResourceError when the disk is full or fails.
  void write(std::string_view text);
  /// Gives the file its name, in one step, in place of an older one.
  void commit();

 private:
  [[noreturn]] void fail(int error) const;
  void discard() const;

  std::string path_;       ///< as given, for messages
  std::string target_;     ///< behind symbolic links
  std::string temporary_;  ///< the target itself where that is no regular file: /dev/stdout
  std::FILE* file_;
};

}  // namespace touchmark::bench::support
