#include "bench/regression/driver/commands.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#if __has_include(<valgrind/callgrind.h>)
#include <valgrind/callgrind.h>
#define TOUCHMARK_HAS_CALLGRIND 1
#else
#define TOUCHMARK_HAS_CALLGRIND 0
#endif

#include "bench/regression/driver/cases.h"
#include "bench/regression/driver/plugin_library.h"
#include "bench/regression/driver/workloads.h"
#include "bench/support/failures.h"
#include "bench/support/files/atomic_file.h"
#include "bench/support/interleaving.h"
#include "bench/support/random.h"
#include "bench/support/system/processor_time.h"

namespace touchmark::bench::regression::driver {
namespace {

std::string row_without_numbers(const Case& asked, std::string_view why) {
  return fmt::format("\"{}\",{:d},,,,,,,,\"{}\"\n", asked.name(), asked.needs_file(), why);
}

std::string answers_row(const PluginLibrary& plugin, Workloads& workloads, const Case& asked) {
  if (!workloads.available(asked)) return row_without_numbers(asked, "the mesh is not installed");
  const Workload workload = workloads.of(asked);
  try {
    const auto detector = plugin.build(asked.detector, workload.mesh);
    const TouchmarkGateResult answer = plugin.answer(detector, workload.pass);
    const TouchmarkGateResult replay = plugin.replay(detector, workload.pass);
    const bool same = answer.answers == replay.answers;
    return fmt::format("\"{}\",{:d},{:016x},{},{},{},{},{:016x},{:016x},{}\n", asked.name(),
                       asked.needs_file(), workload.inputs, answer.cells, answer.spheres, answer.boxes,
                       answer.triangles, answer.answers, answer.details,
                       same ? "" : "a second pass answered otherwise");
  } catch (const std::runtime_error& refusal) {
    return row_without_numbers(asked, refusal.what());
  }
}

/// Cases one after the other that share mesh and detector, so that these are built once.
using Group = std::vector<Case>;

bool share_detector(const Case& a, const Case& b) {
  return std::string_view(a.detector) == b.detector && std::string_view(a.mesh) == b.mesh;
}

/// Returns the cases whose mesh is here. Throws std::invalid_argument when `only` names what is no timed
/// case.
std::vector<Group> timed_groups(const std::vector<std::string>& only, Workloads& workloads) {
  std::vector<Group> groups;
  std::size_t found = 0;
  for (const Case& asked : cases()) {
    const bool wanted = only.empty() || std::ranges::find(only, asked.name()) != only.end();
    if (!asked.timed || !wanted) continue;
    ++found;
    if (!workloads.available(asked)) continue;
    if (groups.empty() || !share_detector(groups.back().front(), asked)) groups.emplace_back();
    groups.back().push_back(asked);
  }
  if (found < only.size())
    throw std::invalid_argument(
        fmt::format("{} of {} names are no timed cases", only.size() - found, only.size()));
  return groups;
}

constexpr std::size_t sittings = 6;  ///< how often detectors are built anew, so that memory lies elsewhere
constexpr std::size_t rounds = 25;   ///< in each sitting: every plug-in once, in random order

class Sitting {
 public:
  Sitting(const std::array<PluginLibrary, 3>& plugins, support::Random& random)
      : plugins_(plugins), random_(random) {}

  /// False when one of the plug-ins refuses.
  bool build(const char* detector, const TouchmarkGateMesh& mesh) {
    for (auto& old : detectors_) old.reset();
    try {
      for (const auto& [_, i] : support::interleaved({3}, random_))
        detectors_[i] = plugins_[i].build(detector, mesh);
    } catch (const std::runtime_error&) {
      return false;
    }
    return true;
  }

  /// A turn begins with an untimed pass, so that none pays for what the one before left in the caches.
  std::array<double, 3> round(const TouchmarkGatePass& pass) {
    std::array<double, 3> ns = {};
    for (const auto& [_, i] : support::interleaved({3}, random_)) {
      (void)plugins_[i].replay(detectors_[i], pass);
      const double before = support::processor_ns();
      (void)plugins_[i].replay(detectors_[i], pass);
      ns[i] = support::processor_ns() - before;
    }
    return ns;
  }

 private:
  const std::array<PluginLibrary, 3>& plugins_;
  support::Random& random_;
  std::array<PluginLibrary::Detector, 3> detectors_;
};

}  // namespace

void write_answers(const std::string& plugin, const std::string& out, bool generated) {
  const PluginLibrary library(plugin);
  Workloads workloads;
  support::AtomicFile file(out);
  file.write("case,needs_file,inputs,cells,spheres,boxes,triangles,answers,details,note\n");
  for (const Case& asked : cases())
    file.write(generated && asked.needs_file() ? row_without_numbers(asked, "left out")
                                               : answers_row(library, workloads, asked));
  file.commit();
}

void count_instructions(const std::string& plugin) {
#if TOUCHMARK_HAS_CALLGRIND
  const PluginLibrary library(plugin);
  Workloads workloads;
  for (const Group& group : timed_groups({}, workloads)) {
    const Case& first = group.front();
    PluginLibrary::Detector detector;
    try {
      detector = library.build(first.detector, workloads.of(first).mesh);
    } catch (const std::runtime_error&) {
      continue;  // the answers say so
    }
    for (const Case& asked : group) {
      const std::string name = asked.name();  // the dump takes it when it is made
      const TouchmarkGatePass pass = workloads.of(asked).pass;
      CALLGRIND_START_INSTRUMENTATION;
      CALLGRIND_ZERO_STATS;
      (void)library.replay(detector, pass);
      CALLGRIND_DUMP_STATS_AT(name.c_str());
      CALLGRIND_STOP_INSTRUMENTATION;
    }
  }
#else
  (void)plugin;
  throw support::ResourceError("built without valgrind's headers: install valgrind and build again");
#endif
}

void write_times(const Timing& timing, const std::string& out) {
  const std::array<PluginLibrary, 3> plugins = {PluginLibrary(timing.base), PluginLibrary(timing.control),
                                                PluginLibrary(timing.head)};
  Workloads workloads;
  const std::vector<Group> groups = timed_groups(timing.only, workloads);
  support::Random random(timing.seed);
  support::AtomicFile file(out);
  file.write("case,sitting,round,base_ns,control_ns,head_ns\n");
  for (std::size_t sitting = 0; sitting < sittings; ++sitting) {
    for (const Group& group : groups) {
      Sitting now(plugins, random);
      if (!now.build(group.front().detector, workloads.of(group.front()).mesh)) continue;
      for (const Case& asked : group) {
        const Workload workload = workloads.of(asked);
        for (std::size_t round = 0; round < rounds; ++round) {
          const auto ns = now.round(workload.pass);
          file.write(
              fmt::format("\"{}\",{},{},{},{},{}\n", asked.name(), sitting, round, ns[0], ns[1], ns[2]));
        }
      }
    }
  }
  file.commit();
}

}  // namespace touchmark::bench::regression::driver
