/// A Python interpreter beside a worker, which runs the user's script: the python3 that is first in PATH, so
/// that of a virtual environment where one is active. A message is 72 bytes there and 72 bytes back, the
/// machine's own numbers; python_plugin.py is the other end.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include <sys/types.h>

namespace touchmark::bench::contestants {

/// What Python is asked, and what it answers.
struct PythonMessage {
  enum Ask : std::uint8_t { describe, build, destroy, touches, nearest, first_hit, nothing };
  enum Said : std::uint8_t { no, yes, failed };

  std::uint8_t code = 0;  ///< Ask, or Said
  std::array<std::uint8_t, 3> unused{};
  std::uint32_t number = 0;        ///< a detector's, or a triangle's, or the length of the text that follows
  std::array<double, 8> values{};  ///< points, a normal, sizes: python_plugin.py says which
};
static_assert(sizeof(PythonMessage) == 72);

/// Ends with the object, and with its parent.
class PythonProcess {
 public:
  /// Throws std::invalid_argument where there is no Python, or std::system_error.
  explicit PythonProcess(const std::string& script);
  PythonProcess(const PythonProcess&) = delete;
  PythonProcess& operator=(const PythonProcess&) = delete;
  ~PythonProcess();

  /// Sends the message and what belongs to it, and returns the answer; the text that follows one is put into
  /// `text`. An answer of a Python that has ended is `failed`, and the text says how it ended.
  PythonMessage ask(const PythonMessage& question, std::span<const std::span<const std::byte>> data,
                    std::string& text) noexcept;
  PythonMessage ask(const PythonMessage& question, std::string& text) noexcept {
    return ask(question, {}, text);
  }

 private:
  bool send(const void* data, std::size_t size) const noexcept;
  bool receive(void* data, std::size_t size) const noexcept;
  std::string how_it_ended() noexcept;

  pid_t process_ = -1;
  int channel_ = -1;
};

}  // namespace touchmark::bench::contestants
