/// What a method's ticks come to, counted by the exact oracle.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "bench/measurement/histogram.h"
#include "bench/proxies/course.h"
#include "bench/proxies/proxy_method.h"
#include "bench/proxies/way_oracle.h"

namespace touchmark::bench::proxies {

struct Tally {
  std::uint64_t ticks = 0;
  std::uint64_t pieces = 0;        ///< straight pieces of the way
  std::uint64_t crossings = 0;     ///< ticks whose way meets a triangle, closed
  std::uint64_t pops = 0;          ///< those that come out at the other side beyond all rounding
  std::uint64_t violations = 0;    ///< ticks whose way comes nearer than the radius
  double max_shortfall = 0;        ///< m, by how much at a tick's end
  std::uint64_t missed_goals = 0;  ///< ticks that end off a goal though the straight way to it was free;
                                   ///< none are counted while a crossing leaves it open where the proxy is
  /// Ticks that end off their goal though straight on towards it more was free than rounding explains.
  std::uint64_t stopped_short = 0;
  std::uint64_t contact_ticks = 0, stuck_ticks = 0, unanswered = 0;
  std::uint64_t rest_ticks = 0;     ///< ticks whose goal has rested for ten ticks or more
  std::uint64_t jitters = 0;        ///< those at which the proxy moved, by one bit or more
  std::uint64_t optimum_ticks = 0;  ///< ticks whose constrained optimum is unique and known
  double optimum_errors = 0;        ///< m, their sum
  double max_optimum_error = 0;     ///< m, the largest distance of the proxy from it
  double max_force_jump = 0;  ///< N, by how much a tick's change of force exceeded stiffness times motion
  double max_energy = 0;      ///< J, the most that the device got over one closed turn of the goal; 0: none
  std::uint64_t work = 0;
  std::uint64_t unfinished = 0;  ///< ticks that their limit of work ended, which are not judged by their ends
  double max_lag = 0;            ///< m, the farthest from where the proxy would be without that limit
  measurement::LatencyHistogram times;
  std::uint64_t preempted = 0;  ///< ticks in each replay of which others took the core: their times hold that
  measurement::LatencyHistogram
      bare_times;  ///< what the bare query takes at the same goals, between the ticks
};

/// The goal's constrained optima along a course; empty where they are not known.
std::vector<Vec3> optima_of(const Course& course);

/// True if the surface, when it last moved, went through a proxy that was taken from one place to another.
using Passage = std::function<bool(const Vec3& from, const Vec3& to)>;

/// Judges one method on one course, tick by tick. The oracle and the references must outlive it.
class Judge {
 public:
  Judge(const Course& course, const std::vector<Vec3>& optima, const Coupling& coupling, Tally& tally)
      : course_(course), optima_(optima), coupling_(coupling), tally_(tally), position_(course.start) {}

  /// To be called before the first tick and whenever the mesh has moved. What the surface does to a proxy
  /// that rests is not the method's doing: until it is off again its ticks count for neither. `move` moves
  /// what the oracle of before knows, where it is the same. A proxy that the surface passes meanwhile has
  /// crossed in the next tick, unless that says that it was squeezed.
  void see(
      const WayOracle& oracle, const std::function<void()>& move = [] {}, Passage passage = nullptr);
  void tick(std::size_t index, const Step& step);

 private:
  void judge_carried(const Step& step);
  void judge_end(const Step& step, const Vec3& goal);
  void judge_way(const Step& step, const Vec3& goal);
  void judge_side(const Step& step, bool crossed);
  void judge_rest(std::size_t index, const Step& step);
  void judge_force(std::size_t index, const Step& step);
  bool violates(const Vec3& position) const;

  const Course& course_;
  const std::vector<Vec3>& optima_;
  const Coupling& coupling_;
  Tally& tally_;
  const WayOracle* oracle_ = nullptr;
  Vec3 position_, force_ = Vec3::Zero();
  bool excused_ = false;
  Passage passage_;
  /// The place where it was last clear of the surface, or seen first: on which side is asked after a crossing
  /// only, as it takes exact arithmetic over the whole mesh.
  Vec3 clear_at_ = Vec3::Zero();
  bool crossed_since_ = false;
  std::size_t rested_ = 0;
  double energy_ = 0;
};

}  // namespace touchmark::bench::proxies
