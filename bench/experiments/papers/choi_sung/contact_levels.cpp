#include "bench/experiments/papers/choi_sung/contact_levels.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "bench/contestants/tick_clock.h"
#include "bench/experiments/papers/frontier.h"
#include "bench/experiments/papers/paper_trace.h"
#include "bench/measurement/latency.h"
#include "bench/support/failures.h"
#include "bench/support/interleaving.h"
#include "bench/support/median.h"
#include "bench/support/random.h"
#include "bench/support/system/interrupt.h"

namespace touchmark::bench::experiments::papers {

ContactLevels::Session::Session(const ContactLevels& levels, std::vector<double> expected_ns,
                                double period_ns, Clock clock)
    : switch_(std::move(expected_ns), period_ns), memories_(levels.size()), clock_(std::move(clock)) {}

std::optional<Contact> ContactLevels::nearest(const Probe& probe, double reach, Session& session) const {
  const std::size_t level = session.switch_.level();
  const double begin = session.clock_();
  const std::optional<Contact> contact =
      levels_[level].detector.nearest(probe, reach, session.memories_[level]);
  session.switch_.took(session.clock_() - begin);
  return contact;
}

ContactLevels choi_sung_levels(const TriangleMesh& original, const ContactLevelSettings& settings) {
  const auto scan = [&](const TriangleMesh& mesh, bool precise) {
    return PublishedSphereCluster::build(mesh, {.clustering = settings.clustering, .precise = precise});
  };
  std::vector<ContactLevels::Level> levels;
  levels.push_back({"spheres", scan(original, false)});
  levels.push_back({"triangles", scan(original, true)});
  for (int level = 1; level <= settings.levels; ++level)
    levels.push_back({fmt::format("ls3 {}", level),
                      scan(choi_sung_surface(original, SubdivisionMethod::ls3, level), true)});
  return ContactLevels(std::move(levels));
}

namespace {

/// One run of the trajectory by one row's detector.
struct Pass {
  std::vector<double> ns, error;
  std::size_t switches = 0;
  double finest = 0;
};

class Experiment {
 public:
  Experiment(const TriangleMesh& original, const ContactLevelSettings& settings, const PrintProgress& print)
      : settings_(settings), print_(print), levels_(choi_sung_levels(original, settings)) {
    print_("contact levels: the smooth surface");
    const TriangleMesh smooth = smooth_surface(original, settings.levels + 2).mesh;
    trace_ = paper_trace("approach", smooth, settings.steps, settings.seed, settings.radius);
    true_depth_ = depths_of(SphereCluster::build(smooth));
    trees_.push_back(SphereCluster::build(original));
    for (int level = 1; level <= settings.levels; ++level)
      trees_.push_back(SphereCluster::build(choi_sung_surface(original, SubdivisionMethod::ls3, level)));
    result_.steps = trace_.size();
  }

  ContactLevelResult run() {
    for (std::size_t i = 0; i < levels_.size(); ++i) add("alone", levels_[i].name);
    for (std::size_t i = 0; i < trees_.size(); ++i)
      add("tree", i == 0 ? "triangles" : fmt::format("ls3 {}", i));
    try {
      expect();
      add_rates();
      std::vector<std::vector<Pass>> passes(result_.rows.size());
      support::Random random(settings_.seed);
      const std::vector<std::size_t> rounds(settings_.rounds, result_.rows.size());
      for (const auto& turn : support::interleaved(rounds, random)) {
        support::check_for_interrupt();
        print_(fmt::format("contact levels: timing, round {} of {}", turn.round + 1, settings_.rounds));
        passes[turn.which].push_back(pass_of(turn.which));
      }
      for (std::size_t i = 0; i < passes.size(); ++i) fill(result_.rows[i], passes[i]);
      result_.finished = true;
    } catch (const support::Interrupted&) {
      result_.rows.clear();
    }
    return std::move(result_);
  }

 private:
  void add(const char* form, std::string level, double wanted_hz = 0) {
    result_.rows.push_back({form, std::move(level), wanted_hz});
  }

  double depth(const std::optional<Contact>& contact) const {
    return contact ? std::max(settings_.radius - contact->distance, 0.0) : 0;
  }

  std::vector<double> depths_of(const SphereCluster& detector) const {
    SphereCluster::Session session;
    std::vector<double> depths;
    for (const workload::Step& step : trace_)
      depths.push_back(depth(detector.nearest(step.probe, step.reach, session)));
    return depths;
  }

  /// `ask` answers a step.
  template <class Ask>
  Pass replay(const Ask& ask) const {
    Pass pass;
    pass.ns.reserve(trace_.size());
    pass.error.reserve(trace_.size());
    for (std::size_t i = 0; i < trace_.size(); ++i) {
      const std::uint64_t begin = contestants::TickClock::now();
      const std::optional<Contact> contact = ask(trace_[i]);
      const std::uint64_t ticks = contestants::TickClock::now() - begin;
      pass.ns.push_back(std::max(clock_.ns_of(ticks), clock_.ns_per_tick));
      pass.error.push_back(std::abs(depth(contact) - true_depth_[i]));
    }
    return pass;
  }

  template <class D>
  Pass pass_alone(const D& detector) const {
    typename D::Session session;
    return replay(
        [&](const workload::Step& step) { return detector.nearest(step.probe, step.reach, session); });
  }

  Pass pass_switched(double wanted_hz) const {
    ContactLevels::Session session(levels_, expected_ns_, 1e9 / wanted_hz, [ns = clock_.ns_per_tick] {
      return static_cast<double>(contestants::TickClock::now()) * ns;
    });
    std::size_t finest = 0;
    Pass pass = replay([&](const workload::Step& step) {
      finest += session.levels().level() + 1 == levels_.size() ? 1 : 0;
      return levels_.nearest(step.probe, step.reach, session);
    });
    pass.switches = session.levels().switches();
    pass.finest = static_cast<double>(finest) / static_cast<double>(trace_.size());
    return pass;
  }

  Pass pass_of(std::size_t row) const {
    if (row < levels_.size()) return pass_alone(levels_[row].detector);
    row -= levels_.size();
    if (row < trees_.size()) return pass_alone(trees_[row]);
    return pass_switched(result_.rows[levels_.size() + row].wanted_hz);
  }

  /// Fills expected_ns_ with the levels' median times, of a run that warms the machine up, too.
  void expect() {
    for (std::size_t i = 0; i < levels_.size(); ++i) {
      support::check_for_interrupt();
      expected_ns_.push_back(support::median(pass_alone(levels_[i].detector).ns));
      if (i > 0) expected_ns_[i] = std::max(expected_ns_[i], expected_ns_[i - 1]);
    }
  }

  /// Wanted rates from a fifth of what the slowest level has in the median to half as much again as the
  /// fastest has.
  void add_rates() {
    add("switched", "", 1000);
    const double low = 0.2e9 / expected_ns_.back(), high = 1.5e9 / expected_ns_.front();
    for (std::size_t i = 0; i < settings_.rates; ++i) {
      const double part =
          static_cast<double>(i) / static_cast<double>(std::max<std::size_t>(settings_.rates, 2) - 1);
      add("switched", "", low * std::pow(high / low, part));
    }
  }

  static void fill(ContactLevelRow& row, const std::vector<Pass>& passes) {
    std::vector<double> p99, in_time, switches;
    for (const Pass& pass : passes) {
      p99.push_back(measurement::summarize_latency(pass.ns, {{0, pass.ns.size()}}).p99);
      const double period = row.wanted_hz > 0 ? 1e9 / row.wanted_hz : 0;
      const auto held = std::ranges::count_if(pass.ns, [&](double ns) { return ns <= period; });
      in_time.push_back(static_cast<double>(held) / static_cast<double>(pass.ns.size()));
      switches.push_back(static_cast<double>(pass.switches));
      const double rounds = static_cast<double>(passes.size());
      row.finest += pass.finest / rounds;
      for (const double error : pass.error) {
        row.mean_error += error / static_cast<double>(pass.error.size()) / rounds;
        row.max_error = std::max(row.max_error, error);
      }
    }
    row.rate_hz = 1e9 / support::median(p99);
    row.in_time = support::median(in_time);
    row.switches = static_cast<std::size_t>(support::median(switches));
  }

  const ContactLevelSettings& settings_;
  const PrintProgress& print_;
  ContactLevels levels_;
  std::vector<SphereCluster> trees_;
  std::vector<workload::Step> trace_;
  std::vector<double> true_depth_;
  std::vector<double> expected_ns_;
  contestants::ClockCalibration clock_ = contestants::calibrate_clock();
  ContactLevelResult result_;
};

}  // namespace

ContactLevelResult run_contact_levels(const TriangleMesh& original, const ContactLevelSettings& settings,
                                      const PrintProgress& print_progress) {
  return Experiment(original, settings, print_progress).run();
}

}  // namespace touchmark::bench::experiments::papers
