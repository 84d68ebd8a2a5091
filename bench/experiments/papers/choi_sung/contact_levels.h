/// Contact levels of detail switched at run time, which Choi & Sung leave to future work: the clustered
/// spheres, the triangles, or those of a finer subdivision answer, by the time that a query is given.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/experiments/papers/choi_sung/choi_sung.h"
#include "bench/experiments/papers/choi_sung/level_switch.h"
#include "bench/support/table.h"
#include "core/sphere_cluster/published/published_sphere_cluster.h"

namespace touchmark::bench::experiments::papers {

/// The levels of one object, the fastest first. No detector as core has them: what it answers depends on the
/// clock, and a session that was forgotten may answer otherwise.
class ContactLevels {
 public:
  /// Returns the present time in nanoseconds.
  using Clock = std::function<double()>;
  struct Level {
    std::string name;
    PublishedSphereCluster detector;
  };
  class Session {
   public:
    Session(const ContactLevels& levels, std::vector<double> expected_ns, double period_ns, Clock clock);
    const LevelSwitch& levels() const noexcept { return switch_; }

   private:
    friend class ContactLevels;
    LevelSwitch switch_;
    std::vector<PublishedSphereCluster::Session> memories_;
    Clock clock_;
  };

  explicit ContactLevels(std::vector<Level> levels) : levels_(std::move(levels)) {}

  std::size_t size() const noexcept { return levels_.size(); }
  const Level& operator[](std::size_t level) const { return levels_[level]; }

  /// Answers from the session's level, and lets the session choose the next one by the time it took.
  std::optional<Contact> nearest(const Probe& probe, double reach, Session& session) const;

 private:
  std::vector<Level> levels_;
};

struct ContactLevelSettings {
  int levels = 3;         ///< subdivisions by LS3
  double clustering = 0;  ///< distance, mesh units
  double radius = 0;      ///< the probe's, mesh units
  std::size_t steps = 4000;
  std::size_t rates = 16;  ///< wanted rates that are tried, besides 1 kHz
  std::uint64_t seed = 1;
  std::size_t rounds = 5;
};

/// One level alone, the session at a wanted rate, or an exact tree.
struct ContactLevelRow {
  std::string form;       ///< "alone", "switched", "tree"
  std::string level;      ///< its name; empty: switched
  double wanted_hz = 0;   ///< switched only
  double rate_hz = 0;     ///< 99 of 100 queries hold it
  double in_time = 0;     ///< switched only: the part of the queries that ended within the wanted period
  double mean_error = 0;  ///< wrong depth of contact, mesh units
  double max_error = 0;
  std::size_t switches = 0;  ///< switched only, in one run of the trajectory
  double finest = 0;         ///< switched only: the part of the queries that the slowest level answered
};

struct ContactLevelResult {
  std::vector<ContactLevelRow> rows;
  std::size_t steps = 0;
  bool finished = false;
};

/// The levels of the paper: the spheres of the original, its triangles, those of each subdivision.
ContactLevels choi_sung_levels(const TriangleMesh& original, const ContactLevelSettings& settings);

/// One approach, press and retreat after another on the smooth surface. The error of a step is by how much
/// the depth of contact (radius minus distance, at least 0) differs from that of the smooth surface.
ContactLevelResult run_contact_levels(const TriangleMesh& original, const ContactLevelSettings& settings,
                                      const PrintProgress& print_progress);

/// levels.csv. `diagonal`: of the original mesh.
support::Table contact_levels_table(const ContactLevelResult& result, double diagonal);
/// What the rows say, for the report: sentences.
std::string contact_levels_verdict(const ContactLevelResult& result, double diagonal);

}  // namespace touchmark::bench::experiments::papers
