#include "bench/contestants/plugins/python_plugin.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <memory>
#include <mutex>
#include <span>
#include <stdexcept>
#include <string>
#include <tuple>

#include <fmt/format.h>

#include "bench/contestants/broken.h"
#include "bench/contestants/build_notes.h"
#include "bench/contestants/plugins/c_plugin.h"
#include "bench/contestants/plugins/python_process.h"
#include "core/contestant.h"

namespace touchmark::bench::contestants {
namespace {

/// What the functions of a touchmark_plugin, which are given no more than a detector, need of the script. One
/// question at a time: Python answers no faster when two wait.
struct Script {
  explicit Script(const std::string& path) : python(path) {}

  PythonMessage ask(const PythonMessage& question, std::string& text,
                    std::span<const std::span<const std::byte>> data = {}) noexcept {
    const std::lock_guard locked(asking);
    return python.ask(question, data, text);
  }

  PythonProcess python;
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

struct PythonDetector {
  std::uint32_t number = 0;
  std::size_t bytes = 0;
  double error = 0;
};

/// What a question costs that Python answers at once: the way there and back is in all of its times.
void tell_overhead() {
  using Clock = std::chrono::steady_clock;
  constexpr int times = 200;
  std::string text;
  std::array<double, times> took{};
  for (double& one : took) {
    const Clock::time_point start = Clock::now();
    script()->ask({.code = PythonMessage::nothing}, text);
    one = std::chrono::duration<double, std::micro>(Clock::now() - start).count();
  }
  std::ranges::nth_element(took, took.begin() + times / 2);
  remark(
      fmt::format("of each of its times {:.1f} us are the way to Python and back, as the median of {} empty "
                  "questions has it",
                  took[times / 2], times));
  script()->overhead_told = true;
}

void* build(const touchmark_plugin_mesh* mesh, const touchmark_plugin_setting*, std::size_t, char* error,
            std::size_t error_size) {
  const std::array<std::uint64_t, 2> counts{mesh->vertex_count, mesh->triangle_count};
  const std::array<std::span<const std::byte>, 3> data{
      std::as_bytes(std::span(counts)), std::as_bytes(std::span(mesh->vertices, 3 * mesh->vertex_count)),
      std::as_bytes(std::span(mesh->triangles, 3 * mesh->triangle_count))};
  const std::uint32_t number = script()->detectors++;
  std::string text;
  const PythonMessage answer = script()->ask({.code = PythonMessage::build, .number = number}, text, data);
  if (answer.code == PythonMessage::failed) {
    const std::size_t length = std::min(text.size(), error_size - 1);
    std::memcpy(error, text.data(), length);
    error[length] = '\0';
    return nullptr;
  }
  if (!script()->overhead_told) tell_overhead();
  return new PythonDetector{number, static_cast<std::size_t>(std::max(0.0, answer.values[0])),
                            answer.values[1]};
}

void destroy(void* detector) {
  const std::unique_ptr<PythonDetector> owned(static_cast<PythonDetector*>(detector));
  std::string text;
  script()->ask({.code = PythonMessage::destroy, .number = owned->number}, text);
}

std::size_t bytes(const void* detector) { return static_cast<const PythonDetector*>(detector)->bytes; }

void accuracy(const void* detector, touchmark_plugin_accuracy* accuracy) {
  accuracy->absolute = static_cast<const PythonDetector*>(detector)->error;
}

/// Whatever the script raises ends the worker, with what it raised as the status.
PythonMessage answered(const void* detector, PythonMessage question) noexcept {
  question.number = static_cast<const PythonDetector*>(detector)->number;
  std::string text;
  const PythonMessage answer = script()->ask(question, text);
  if (answer.code == PythonMessage::failed) end_as_broken(text);
  return answer;
}

touchmark_plugin_contact contact_of(const PythonMessage& answer) noexcept {
  const auto& v = answer.values;
  return {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}, v[6], answer.number, 0};
}

int touches(const void* detector, void*, const touchmark_plugin_probe* probe) {
  const double* c = probe->center;
  return answered(detector, {.code = PythonMessage::touches, .values = {c[0], c[1], c[2], probe->radius}})
             .code == PythonMessage::yes;
}

int nearest(const void* detector, void*, const touchmark_plugin_probe* probe, double reach,
            touchmark_plugin_contact* contact) {
  const double* c = probe->center;
  const PythonMessage answer =
      answered(detector, {.code = PythonMessage::nearest, .values = {c[0], c[1], c[2], reach}});
  if (answer.code != PythonMessage::yes) return 0;
  *contact = contact_of(answer);
  return 1;
}

int first_hit(const void* detector, void*, const touchmark_plugin_sweep* sweep,
              touchmark_plugin_impact* impact) {
  const double *from = sweep->from, *to = sweep->to;
  const PythonMessage answer =
      answered(detector, {.code = PythonMessage::first_hit,
                          .values = {from[0], from[1], from[2], to[0], to[1], to[2], sweep->radius}});
  if (answer.code != PythonMessage::yes) return 0;
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

ContestantInfo load_python_plugin(const std::string& path) {
  script() = std::make_unique<Script>(path);
  std::string text;
  if (script()->ask({.code = PythonMessage::describe}, text).code == PythonMessage::failed)
    throw std::invalid_argument(text);
  std::tie(script()->name, script()->summary, script()->guarantee, script()->queries) =
      std::tuple_cat(lines_of(text));
  script()->plugin = described(*script());
  return contestant_of(script()->plugin, path);
}

}  // namespace touchmark::bench::contestants
