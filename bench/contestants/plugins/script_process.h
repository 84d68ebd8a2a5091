/// An interpreter beside a worker, which runs the user's script: the one that is first in PATH, so the Python
/// of a virtual environment where one is active. A message is 72 bytes there and 72 bytes back, the machine's
/// own numbers; python_plugin.py and javascript_plugin.js are the other ends.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include <sys/types.h>

#include "bench/contestants/plugins/interpreters.h"

namespace touchmark::bench::contestants {

/// What an interpreter is asked, and what it answers.
struct ScriptMessage {
  enum Ask : std::uint8_t { describe, build, destroy, touches, nearest, first_hit, nothing, reproduce };
  enum Said : std::uint8_t { no, yes, failed };

  std::uint8_t code = 0;  ///< Ask, or Said
  std::array<std::uint8_t, 3> unused{};
  std::uint32_t number = 0;  ///< a detector's, a triangle's, the query's to reproduce, or a text's length
  std::array<double, 8> values{};  ///< points, a normal, sizes: the other ends say which
};
static_assert(sizeof(ScriptMessage) == 72);

/// Ends with the object, and with its parent.
class ScriptProcess {
 public:
  /// Throws std::system_error.
  ScriptProcess(const Interpreter& interpreter, const std::string& script);
  ScriptProcess(const ScriptProcess&) = delete;
  ScriptProcess& operator=(const ScriptProcess&) = delete;
  ~ScriptProcess();

  /// Sends the message and what belongs to it, and returns the answer; the text that follows one is put into
  /// `text`. An answer of an interpreter that has ended is `failed`, and the text says how it ended.
  ScriptMessage ask(const ScriptMessage& question, std::span<const std::span<const std::byte>> data,
                    std::string& text) noexcept;
  ScriptMessage ask(const ScriptMessage& question, std::string& text) noexcept {
    return ask(question, {}, text);
  }

 private:
  bool send(const void* data, std::size_t size) const noexcept;
  bool receive(void* data, std::size_t size) const noexcept;
  std::string how_it_ended() noexcept;

  const Interpreter& interpreter_;
  pid_t process_ = -1;
  int channel_ = -1;
};

}  // namespace touchmark::bench::contestants
