#include "bench/regression/driver/commands.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#if __has_include(<valgrind/callgrind.h>)
#include <valgrind/callgrind.h>
#define TOUCHMARK_HAS_CALLGRIND 1
#else
#define TOUCHMARK_HAS_CALLGRIND 0
#endif

#include "bench/meshes/meshes.h"
#include "bench/regression/driver/cases.h"
#include "bench/regression/driver/plugin.h"
#include "bench/support/failures.h"
#include "bench/support/files/atomic_file.h"
#include "bench/support/interleaving.h"
#include "bench/support/random.h"
#include "bench/support/system/processor_time.h"
#include "bench/trajectories/trajectories.h"
#include "core/triangle_mesh.h"

#if defined(_WIN32)
#include <windows.h>
#else
#include <dlfcn.h>
#endif

namespace touchmark::bench::regression::driver {
namespace {

/// A case's mesh and trajectory, as plain numbers that a plug-in takes.
struct Workload {
  TouchmarkGateMesh mesh = {};
  TouchmarkGatePass pass = {};
  std::uint64_t inputs = 0;  ///< a checksum of mesh and pass
};

constexpr double radius_of_diagonal = 0.005;

std::vector<double> flat(std::span<const Vec3> points) {
  std::vector<double> numbers;
  numbers.reserve(3 * points.size());
  for (const Vec3& p : points) numbers.insert(numbers.end(), {p.x(), p.y(), p.z()});
  return numbers;
}

/// FNV-1a, a word at a time.
class Fingerprint {
 public:
  void add(std::uint64_t word) noexcept { value_ = (value_ ^ word) * 0x100000001b3ULL; }
  void add(const double* numbers, std::size_t count) noexcept {
    for (std::size_t i = 0; i < count; ++i) add(std::bit_cast<std::uint64_t>(numbers[i]));
  }
  std::uint64_t value() const noexcept { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

std::uint64_t fingerprint(const Workload& workload) {
  Fingerprint print;
  print.add(workload.mesh.vertices, 3 * workload.mesh.vertex_count);
  for (std::size_t i = 0; i < 3 * workload.mesh.triangle_count; ++i) print.add(workload.mesh.triangles[i]);
  print.add(workload.pass.centers, 3 * workload.pass.count);
  print.add(&workload.pass.radius, 1);
  print.add(&workload.pass.reach, 1);
  return print.value();
}

/// Each mesh and each trajectory is made once.
class Workloads {
 public:
  /// False where its mesh is not installed.
  bool available(const Case& asked) {
    if (!asked.needs_file()) return true;
    const std::vector<meshes::NamedMesh> known = meshes::named_meshes();
    return std::ranges::any_of(
        known, [&](const meshes::NamedMesh& info) { return info.name == asked.mesh && info.available; });
  }

  /// The pointers stay good for as long as this object lives. The probe's radius and reach are 0.5 % of the
  /// diagonal.
  Workload of(const Case& asked) {
    const LoadedMesh& loaded = this->mesh(asked.mesh);
    const double radius = radius_of_diagonal * loaded.mesh.diagonal();
    std::vector<double>& centers =
        centers_[{asked.mesh + std::string(1, '/') + asked.trajectory, asked.steps}];
    if (centers.empty())
      centers = flat(
          trajectories::make_trajectory(asked.trajectory, loaded.mesh, {asked.steps, 1, radius}).positions);
    Workload workload;
    workload.mesh = {loaded.vertices.data(), loaded.vertices.size() / 3, loaded.triangles.data(),
                     loaded.triangles.size() / 3};
    workload.pass = {asked.query, centers.data(), centers.size() / 3, radius, radius};
    workload.inputs = fingerprint(workload);
    return workload;
  }

 private:
  struct LoadedMesh {
    TriangleMesh mesh;
    std::vector<double> vertices;
    std::vector<std::uint32_t> triangles;
  };
  const LoadedMesh& mesh(const std::string& name) {
    const auto found = meshes_.find(name);
    if (found != meshes_.end()) return found->second;
    TriangleMesh mesh = meshes::load_mesh(name);
    std::vector<double> vertices = flat(mesh.vertices());
    std::vector<std::uint32_t> triangles;
    triangles.reserve(3 * mesh.size());
    for (const TriangleMesh::Corners& corners : mesh.triangles())
      triangles.insert(triangles.end(), corners.begin(), corners.end());
    return meshes_.emplace(name, LoadedMesh{std::move(mesh), std::move(vertices), std::move(triangles)})
        .first->second;
  }

  std::map<std::string, LoadedMesh> meshes_;
  std::map<std::pair<std::string, std::size_t>, std::vector<double>> centers_;
};

#if defined(_WIN32)
HMODULE load(const std::filesystem::path& path) { return ::LoadLibraryW(path.c_str()); }
void* symbol(HMODULE from, const char* name) { return reinterpret_cast<void*>(::GetProcAddress(from, name)); }
std::string last_error() { return "error " + std::to_string(::GetLastError()); }
#else
void* load(const std::filesystem::path& path) { return ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL); }
void* symbol(void* from, const char* name) { return ::dlsym(from, name); }
std::string last_error() { return ::dlerror(); }
#endif

template <class Library, class Function>
void find(Library library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(symbol(library, name));
  if (function == nullptr) throw std::invalid_argument("not a plug-in: " + last_error());
}

/// A loaded plug-in: one build of the core. Never unloaded: a detector may outlive it.
class PluginLibrary {
 public:
  struct Destroy {
    decltype(&touchmark_gate_destroy) destroy = nullptr;
    void operator()(TouchmarkGateDetector* detector) const { destroy(detector); }
  };
  using Detector = std::unique_ptr<TouchmarkGateDetector, Destroy>;

  /// Files of different names are loaded apart, even when one is a copy of the other. Throws
  /// std::invalid_argument for a file that is no plug-in.
  explicit PluginLibrary(const std::string& path) {
    // A path without a slash would be looked for among the system's libraries.
    const auto library = load(std::filesystem::absolute(path).make_preferred());
    if (library == nullptr) throw std::invalid_argument("cannot load plug-in " + path + ": " + last_error());
    find(library, "touchmark_gate_build", build_);
    find(library, "touchmark_gate_answer", answer_);
    find(library, "touchmark_gate_replay", replay_);
    find(library, "touchmark_gate_destroy", destroy_);
  }

  /// Throws std::runtime_error, with the core's own words, when it refuses.
  Detector build(const std::string& name, const TouchmarkGateMesh& mesh) const {
    std::array<char, 500> error = {};
    Detector detector(build_(name.c_str(), &mesh, error.data(), error.size()), Destroy{destroy_});
    if (!detector) throw std::runtime_error(error.data());
    return detector;
  }

  TouchmarkGateResult answer(const Detector& detector, const TouchmarkGatePass& pass) const {
    TouchmarkGateResult result = {};
    answer_(detector.get(), &pass, &result);
    return result;
  }

  TouchmarkGateResult replay(const Detector& detector, const TouchmarkGatePass& pass) const {
    TouchmarkGateResult result = {};
    replay_(detector.get(), &pass, &result);
    return result;
  }

 private:
  decltype(&touchmark_gate_build) build_;
  decltype(&touchmark_gate_answer) answer_;
  decltype(&touchmark_gate_replay) replay_;
  decltype(&touchmark_gate_destroy) destroy_;
};

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
