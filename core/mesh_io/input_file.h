/// A file that is read once from its start, and may be a pipe; a named pipe that nobody writes to does not
/// keep the program waiting.
#pragma once

#include <cstddef>
#include <filesystem>
#include <stdexcept>

namespace touchmark::mesh_io {

/// What went wrong, without the file's name: "No such file or directory".
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class InputFile {
 public:
  /// Throws InputError when the file cannot be opened.
  explicit InputFile(const std::filesystem::path& path);
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  ~InputFile();

  /// Reads up to `most` bytes, at least 1, and returns how many; 0 at the end. The first reading of a pipe
  /// waits a second for somebody who writes. Throws InputError.
  std::size_t read(char* to, std::size_t most);
  bool is_regular() const noexcept { return kind_ == std::filesystem::file_type::regular; }
  bool is_pipe() const noexcept { return kind_ == std::filesystem::file_type::fifo; }
  bool is_directory() const noexcept { return kind_ == std::filesystem::file_type::directory; }
  /// Returns the size in bytes; 0 for all but regular files.
  std::size_t size() const noexcept { return size_; }

 private:
  void stop_waiting_for_a_writer();

  int descriptor_;
  std::filesystem::file_type kind_;
  std::size_t size_ = 0;
  bool may_lack_a_writer_ = false;
};

}  // namespace touchmark::mesh_io
