/// What can be chosen on the command line: contestants, their options, and `NAME[:key=value,...]`.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/contestants/contestant.h"
#include "bench/contestants/storage_rounding.h"
#include "bench/support/system/available_memory.h"
#include "core/named/option.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::contestants {

using named::OptionInfo;
using named::OptionKind;

/// Every option of a contestant with its value, checked against its OptionInfo.
class OptionValues {
 public:
  explicit OptionValues(std::map<std::string, std::string> values) : values_(std::move(values)) {}

  const std::string& text(const std::string& key) const { return values_.at(key); }
  double number(const std::string& key) const;
  std::size_t count(const std::string& key) const;
  double length(const std::string& key, const TriangleMesh& mesh) const;  ///< in mesh units
  bool flag(const std::string& key) const { return text(key) == "true"; }
  const std::map<std::string, std::string>& all() const noexcept { return values_; }

 private:
  std::map<std::string, std::string> values_;
};

using BuildContestant = std::function<std::unique_ptr<Contestant>(const TriangleMesh&, const OptionValues&)>;

/// Builds a contestant over a scene of bodies.
using BuildSceneContestant =
    std::function<std::unique_ptr<Contestant>(const scenes::PlacedScene&, const OptionValues&)>;

/// The program beside this one that most contestants run in.
inline constexpr const char* default_worker_program = "touchmark-worker";

/// The forms of a contestant that a command asks when no contestant is named. A form is its options as they
/// are typed, "key=value,key=value"; "" is the default form.
struct Forms {
  std::vector<std::string> compared = {};  ///< by `bench`, and by whatever else has no set of its own
  std::vector<std::string> verified = {};  ///< by `verify` besides
  std::vector<std::string> frontier =
      {};  ///< by `bench --frontier`: over what trades its accuracy for its time
  std::vector<std::string> scaled = {};  ///< by `scale`, and by `choose` if they claim exactness: those whose
                                         ///< time does not grow with the mesh as a scan's
  std::vector<std::string> chosen = {};  ///< by `choose` besides
  std::vector<std::string> updated = {};  ///< by `update`
  std::vector<std::string> suite = {};    ///< by `bench --suite`: the fastest ones, exact or not
  std::vector<std::string> scenes = {};   ///< by commands that are given a scene of bodies
  std::vector<std::string> tested = {};   ///< by no command, but by the tests and the fuzzer besides
};

/// Names what a program includes, `<touchmark/HEADER.h>`, and the class in it.
struct LibraryClass {
  std::string header, name;
  std::vector<std::string> lacks = {};  ///< keys of options that this class has no member for

  bool has(const std::string& key) const { return std::ranges::find(lacks, key) == lacks.end(); }
};

/// A name of a detector that went out. Another answers to it.
struct FormerName {
  std::string name;
  std::vector<std::string> dead_options = {};  ///< keys that are read, and have no effect
};

struct ContestantInfo {
  std::string name;
  std::vector<FormerName> former_names = {};
  int rank = std::numeric_limits<int>::max();  ///< Lists go from the lowest to the highest, then by name.
  bool ours = false;                           ///< True if its entry is one of bench/contestants/own.
  std::string summary;                         ///< one line
  /// What its forms claim: "GUARANTEE" or "GUARANTEE; KEY=VALUE[ with KEY=VALUE]: GUARANTEE[; ...]", of which
  /// the last whose options are chosen holds. KEY!=VALUE holds for any other value.
  std::string accuracy;
  std::vector<workload::Query> queries;
  std::vector<OptionInfo> options;
  /// Throws std::invalid_argument or MeshError for options or a mesh it refuses. Empty: not built in.
  BuildContestant build;
  /// Loads its library, where that takes long and is left until it is built. May be called again.
  std::function<void()> load = [] {};
  BuildSceneContestant build_scene = {};  ///< builds one over a scene of bodies; empty: it takes none
  bool scenes_only = false;               ///< True if it takes scenes of bodies and refuses a mesh alone.
  /// What it surely takes, and so must be there before it is built.
  std::function<double(const OptionValues&)> bytes_per_triangle = [](const OptionValues&) {
    return support::min_bytes_per_triangle;
  };
  /// Which program beside this one runs it.
  std::function<std::string(const OptionValues&)> worker_program = [](const OptionValues&) {
    return std::string(default_worker_program);
  };

  /// What its library keeps of coordinates where it decides by other numbers than the given ones; else empty.
  std::function<std::optional<StorageRounding>(const TriangleMesh&, const OptionValues&)> storage_rounding =
      [](const TriangleMesh&, const OptionValues&) { return std::nullopt; };

  Forms forms;
  /// The class that these options choose. Empty: another library's.
  std::function<LibraryClass(const OptionValues&)> library = {};
  std::string plugin = {};  ///< the file that a worker loads for it; empty: built into the worker

  bool built() const noexcept { return static_cast<bool>(build); }
  bool answers(workload::Query query) const noexcept;
};

/// A contestant as chosen: the name and the options that were written out.
struct ContestantSpec {
  std::string name;
  std::string options;  ///< "key=value,key=value" in the contestant's own order; empty: all defaults
  OptionValues values;
  std::optional<Guarantee> claimed;  ///< by its entry, so known before it is built; nothing: none
  std::string plugin = {};           ///< its contestant's
  std::string remark = {};  ///< what a former name and its options mean, in words; empty: none was used

  std::string text() const { return options.empty() ? name : name + ":" + options; }
};

/// The guarantee that an `accuracy` of the form above claims for these options; nothing where it is empty.
/// Throws std::invalid_argument for another form.
std::optional<Guarantee> claimed_guarantee(const std::string& accuracy, const OptionValues& values);

}  // namespace touchmark::bench::contestants
