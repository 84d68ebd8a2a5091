#include "bench/contestants/plugins/script_plugin.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <mutex>
#include <span>
#include <stdexcept>
#include <string>
#include <system_error>
#include <tuple>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench/contestants/broken.h"
#include "bench/contestants/build_notes.h"
#include "bench/contestants/plugins/c_plugin.h"
#include "bench/contestants/plugins/interpreters.h"
#include "core/contestant.h"

namespace touchmark::bench::contestants {
namespace {

// An interpreter beside a worker, which runs the user's script: the one that is first in PATH, so the Python
// of a virtual environment where one is active. A message is 72 bytes there and 72 bytes back, the machine's
// own numbers; python_plugin.py and javascript_plugin.js are the other ends.

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

/// The exit status of a child that could not become the interpreter, as shells have it.
constexpr int not_found = 127;

/// In the child: only async-signal-safe calls.
[[noreturn]] void become_interpreter(char* const* argv, int channel, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(not_found);
  // Whatever the worker has open is the worker's: its end must be seen by the program at once.
  constexpr int last_looked_at = 256;
  for (int descriptor = STDERR_FILENO + 1; descriptor < last_looked_at; ++descriptor)
    fcntl(descriptor, F_SETFD, descriptor == channel ? 0 : FD_CLOEXEC);
  execvp(argv[0], argv);
  _exit(not_found);
}

/// Ends with the object, and with its parent.
class ScriptProcess {
 public:
  /// Throws std::system_error.
  ScriptProcess(const Interpreter& interpreter, const std::string& script) : interpreter_(interpreter) {
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
      throw std::system_error(errno, std::generic_category(),
                              std::string("cannot talk to ") + interpreter.name);
    std::array<std::string, 5> words{interpreter.command, interpreter.option, interpreter.program, script,
                                     std::to_string(ends[1])};
    std::array<char*, 6> argv{};
    std::ranges::transform(words, argv.begin(), [](std::string& word) { return word.data(); });
    const pid_t parent = getpid();
    process_ = fork();
    if (process_ == 0) become_interpreter(argv.data(), ends[1], parent);
    const int error = errno;
    close(ends[1]);
    channel_ = ends[0];
    if (process_ > 0) return;
    close(channel_);
    throw std::system_error(error, std::generic_category(), std::string("cannot start ") + interpreter.name);
  }

  ScriptProcess(const ScriptProcess&) = delete;
  ScriptProcess& operator=(const ScriptProcess&) = delete;
  ~ScriptProcess() {
    if (process_ > 0) kill(process_, SIGKILL);
    how_it_ended();
    close(channel_);
  }

  /// Sends the message and what belongs to it, and returns the answer; the text that follows one is put into
  /// `text`. An answer of an interpreter that has ended is `failed`, and the text says how it ended.
  ScriptMessage ask(const ScriptMessage& question, std::span<const std::span<const std::byte>> data,
                    std::string& text) noexcept {
    ScriptMessage answer;
    bool whole = send(&question, sizeof question);
    for (const std::span<const std::byte> one : data) whole = whole && send(one.data(), one.size());
    whole = whole && receive(&answer, sizeof answer);
    const bool has_text = answer.code == ScriptMessage::failed || question.code == ScriptMessage::describe ||
                          question.code == ScriptMessage::reproduce;
    if (whole && has_text) {
      text.resize(answer.number);
      whole = receive(text.data(), text.size());
    }
    if (whole) return answer;
    text = how_it_ended();
    answer.code = ScriptMessage::failed;
    return answer;
  }

  ScriptMessage ask(const ScriptMessage& question, std::string& text) noexcept {
    return ask(question, {}, text);
  }

 private:
  bool send(const void* data, std::size_t size) const noexcept {
    const auto* from = static_cast<const std::byte*>(data);
    while (size > 0) {
      const ssize_t sent = ::send(channel_, from, size, MSG_NOSIGNAL);
      if (sent < 0 && errno == EINTR) continue;
      if (sent <= 0) return false;
      from += sent;
      size -= static_cast<std::size_t>(sent);
    }
    return true;
  }

  bool receive(void* data, std::size_t size) const noexcept {
    auto* to = static_cast<std::byte*>(data);
    while (size > 0) {
      const ssize_t got = recv(channel_, to, size, MSG_WAITALL);
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) return false;
      to += got;
      size -= static_cast<std::size_t>(got);
    }
    return true;
  }

  std::string how_it_ended() noexcept {
    int status = 0;
    const pid_t process = std::exchange(process_, -1);
    if (process <= 0 || waitpid(process, &status, 0) != process)
      return fmt::format("{} has ended", interpreter_.name);
    if (WIFSIGNALED(status))
      return fmt::format("{} was ended by SIG{}", interpreter_.name, sigabbrev_np(WTERMSIG(status)));
    if (WEXITSTATUS(status) == not_found)
      return fmt::format("there is no {} in PATH, which runs a plug-in in {}: {}", interpreter_.command,
                         interpreter_.language, interpreter_.way_out);
    return fmt::format("{} has ended with status {}", interpreter_.name, WEXITSTATUS(status));
  }

  const Interpreter& interpreter_;
  pid_t process_ = -1;
  int channel_ = -1;
};

/// What the functions of a touchmark_plugin, which are given no more than a detector, need of the script. One
/// question at a time: an interpreter answers no faster when two wait.
struct Script {
  Script(const Interpreter& interpreter, const std::string& path)
      : language(interpreter.language), process(interpreter, path) {}

  ScriptMessage ask(const ScriptMessage& question, std::string& text,
                    std::span<const std::span<const std::byte>> data = {}) noexcept {
    const std::lock_guard locked(asking);
    return process.ask(question, data, text);
  }

  const char* language;
  ScriptProcess process;
  std::mutex asking;
  std::string name, summary, guarantee, queries;
  std::uint32_t detectors = 0;  ///< built so far, which is the number of the next one
  bool overhead_told = false;
  touchmark_plugin plugin{};
};

std::unique_ptr<Script>& script() {
  static std::unique_ptr<Script> one;
  return one;
}

struct ScriptDetector {
  std::uint32_t number = 0;
  std::size_t bytes = 0;
  double error = 0;
};

/// What a question costs that the interpreter answers at once: the way there and back is in all its times.
void tell_overhead() {
  using Clock = std::chrono::steady_clock;
  constexpr int times = 200;
  std::string text;
  std::array<double, times> took{};
  for (double& one : took) {
    const Clock::time_point start = Clock::now();
    script()->ask({.code = ScriptMessage::nothing}, text);
    one = std::chrono::duration<double, std::micro>(Clock::now() - start).count();
  }
  std::ranges::nth_element(took, took.begin() + times / 2);
  remark(fmt::format(
      "of each of its times {:.1f} us are the way to {} and back, as the median of {} empty questions has it",
      took[times / 2], script()->language, times));
  script()->overhead_told = true;
}

/// Asks a question that a mesh belongs to.
ScriptMessage ask_of_mesh(const ScriptMessage& question, std::span<const double> coordinates,
                          std::span<const std::uint32_t> corners, std::string& text) {
  const std::array<std::uint64_t, 2> counts{coordinates.size() / 3, corners.size() / 3};
  const std::array<std::span<const std::byte>, 3> data{std::as_bytes(std::span(counts)),
                                                       std::as_bytes(coordinates), std::as_bytes(corners)};
  return script()->ask(question, text, data);
}

void* build(const touchmark_plugin_mesh* mesh, const touchmark_plugin_setting*, std::size_t, char* error,
            std::size_t error_size) {
  const std::uint32_t number = script()->detectors++;
  std::string text;
  const ScriptMessage answer =
      ask_of_mesh({.code = ScriptMessage::build, .number = number}, {mesh->vertices, 3 * mesh->vertex_count},
                  {mesh->triangles, 3 * mesh->triangle_count}, text);
  if (answer.code == ScriptMessage::failed) {
    const std::size_t length = std::min(text.size(), error_size - 1);
    std::memcpy(error, text.data(), length);
    error[length] = '\0';
    return nullptr;
  }
  if (!script()->overhead_told) tell_overhead();
  return new ScriptDetector{number, static_cast<std::size_t>(std::max(0.0, answer.values[0])),
                            answer.values[1]};
}

void destroy(void* detector) {
  const std::unique_ptr<ScriptDetector> owned(static_cast<ScriptDetector*>(detector));
  std::string text;
  script()->ask({.code = ScriptMessage::destroy, .number = owned->number}, text);
}

std::size_t bytes(const void* detector) { return static_cast<const ScriptDetector*>(detector)->bytes; }

void accuracy(const void* detector, touchmark_plugin_accuracy* accuracy) {
  accuracy->absolute = static_cast<const ScriptDetector*>(detector)->error;
}

/// Whatever the script raises ends the worker, with what it raised as the status.
ScriptMessage answered(const void* detector, ScriptMessage question) noexcept {
  question.number = static_cast<const ScriptDetector*>(detector)->number;
  std::string text;
  const ScriptMessage answer = script()->ask(question, text);
  if (answer.code == ScriptMessage::failed) end_as_broken(text);
  return answer;
}

touchmark_plugin_contact contact_of(const ScriptMessage& answer) noexcept {
  const auto& v = answer.values;
  return {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}, v[6], answer.number, 0};
}

int touches(const void* detector, void*, const touchmark_plugin_probe* probe) {
  const double* c = probe->center;
  return answered(detector, {.code = ScriptMessage::touches, .values = {c[0], c[1], c[2], probe->radius}})
             .code == ScriptMessage::yes;
}

int nearest(const void* detector, void*, const touchmark_plugin_probe* probe, double reach,
            touchmark_plugin_contact* contact) {
  const double* c = probe->center;
  const ScriptMessage answer =
      answered(detector, {.code = ScriptMessage::nearest, .values = {c[0], c[1], c[2], reach}});
  if (answer.code != ScriptMessage::yes) return 0;
  *contact = contact_of(answer);
  return 1;
}

int first_hit(const void* detector, void*, const touchmark_plugin_sweep* sweep,
              touchmark_plugin_impact* impact) {
  const double *from = sweep->from, *to = sweep->to;
  const ScriptMessage answer =
      answered(detector, {.code = ScriptMessage::first_hit,
                          .values = {from[0], from[1], from[2], to[0], to[1], to[2], sweep->radius}});
  if (answer.code != ScriptMessage::yes) return 0;
  *impact = {answer.values[7], contact_of(answer)};
  return 1;
}

std::array<std::string, 4> lines_of(const std::string& text) {
  std::array<std::string, 4> lines;
  std::size_t begin = 0;
  for (std::string& line : lines) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    line = text.substr(begin, end - begin);
    begin = std::min(end + 1, text.size());
  }
  return lines;
}

touchmark_plugin described(const Script& script) {
  const auto has = [&](const char* query) { return script.queries.find(query) != std::string::npos; };
  touchmark_plugin plugin{};
  plugin.version = TOUCHMARK_PLUGIN_VERSION;
  plugin.name = script.name.c_str();
  plugin.summary = script.summary.c_str();
  plugin.guarantee = script.guarantee.c_str();
  plugin.build = &build;
  plugin.destroy = &destroy;
  plugin.bytes = &bytes;
  plugin.accuracy = &accuracy;
  if (has("touches")) plugin.touches = &touches;
  if (has("nearest")) plugin.nearest = &nearest;
  if (has("first_hit")) plugin.first_hit = &first_hit;
  return plugin;
}

}  // namespace

ContestantInfo load_script_plugin(const Interpreter& interpreter, const std::string& path) {
  script() = std::make_unique<Script>(interpreter, path);
  std::string text;
  if (script()->ask({.code = ScriptMessage::describe}, text).code == ScriptMessage::failed)
    throw std::invalid_argument(text);
  std::tie(script()->name, script()->summary, script()->guarantee, script()->queries) =
      std::tuple_cat(lines_of(text));
  script()->plugin = described(*script());
  return contestant_of(script()->plugin, path);
}

std::string reproduction(const ReproducedQuestion& asked) {
  if (script() == nullptr) return {};
  constexpr std::array codes{ScriptMessage::touches, ScriptMessage::nearest, ScriptMessage::first_hit};
  std::string text;
  const ScriptMessage question{.code = ScriptMessage::reproduce,
                               .number = codes.at(static_cast<std::size_t>(asked.query)),
                               .values = asked.values};
  if (ask_of_mesh(question, asked.coordinates, asked.corners, text).code == ScriptMessage::failed)
    throw std::invalid_argument(text);
  return text;
}

}  // namespace touchmark::bench::contestants
