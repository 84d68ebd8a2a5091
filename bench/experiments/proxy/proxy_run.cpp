#include "bench/experiments/proxy/proxy_run.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "bench/oracle/exact/moving_meeting.h"
#include "bench/support/system/interrupt.h"
#include "bench/support/system/own_time.h"

namespace touchmark::bench::experiments::proxy {
namespace {

/// A round asks every family so much, so that a campaign that is ended has something of every one.
constexpr std::size_t ticks_a_round = 4000;

using Clock = std::chrono::steady_clock;

std::int64_t ns_since(Clock::time_point start) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - start).count();
}

/// One tick that crossed, for the message.
std::string where(const Course& course, std::size_t tick) {
  return fmt::format("{}, tick {}", course.name, tick);
}

/// Returns nothing for several bodies, which may carry a proxy one after another. What it refers to outlives
/// the next tick.
proxies::Passage passage(const Course& course, std::size_t change, const TriangleMesh& before,
                         const TriangleMesh& after, const proxies::WayOracle& oracle) {
  if (course.bodies.empty())
    return [&](const Vec3& from, const Vec3& to) { return oracle::any_meets(before, after, from, to); };
  if (course.bodies.size() > 1) return nullptr;
  // In the frame of one body that goes straight, the proxy came straight from where that saw it before.
  return [&oracle, shift = Vec3(course.places(change)[0] - course.places(change - 1)[0])](
             const Vec3& from, const Vec3& to) { return oracle.meets(from + shift, to); };
}

/// What a tick took at least, over the replays of its course.
struct TickTimes {
  static constexpr std::int64_t none = std::numeric_limits<std::int64_t>::max();
  std::int64_t step = none, query = none;  ///< ns
  bool was_preempted = true;               ///< in each of them
};

void run_once(const contestants::Roster& roster, const Course& course, const std::vector<Vec3>& optima,
              const MethodSpec& method, const Coupling& coupling, const std::string& detector, Tally& tally,
              const Seen& seen, std::vector<TickTimes>& times) {
  auto oracle = std::make_unique<const proxies::WayOracle>(course.mesh);
  const std::vector<Vec3> places = course.places ? course.places(0) : std::vector<Vec3>();
  const std::unique_ptr<proxies::ProxyMethod> proxy =
      method.info->make({roster, course.mesh, coupling, method.values, detector, course.bodies, places});
  proxy->place(course.start);
  proxies::Judge judge(course, optima, coupling, tally);
  judge.see(*oracle);
  Step step;
  TriangleMesh mesh = course.mesh, last = mesh;
  for (std::size_t tick = 0; tick < course.goals.size(); ++tick) {
    if (course.update_every > 0 && tick > 0 && tick % course.update_every == 0) {
      const std::size_t change = tick / course.update_every;
      last = std::exchange(mesh, course.moved(change));
      auto next = std::make_unique<const proxies::WayOracle>(mesh);
      if (course.places)
        proxy->move(course.places(change), mesh);
      else
        proxy->update(mesh);
      judge.see(
          *next, [] {}, passage(course, change, last, mesh, *next));  // which still asks the last one
      oracle = std::move(next);
    }
    TickTimes& least = times[tick];
    const Clock::time_point asked = Clock::now();
    if (proxy->ask_nearest(course.goals[tick])) least.query = std::min(least.query, ns_since(asked));
    const long preemptions = support::preemptions_so_far();
    const Clock::time_point before = Clock::now();
    proxy->step(course.goals[tick], step);
    least.step = std::min(least.step, ns_since(before));
    least.was_preempted = least.was_preempted && support::preemptions_so_far() != preemptions;
    judge.tick(tick, step);
    tally.max_lag = std::max(tally.max_lag, proxy->lag(course.goals[tick]));
    if (seen) seen(tick, step, least.step);
  }
  tally.work += proxy->work();
}

}  // namespace

void run_course(const contestants::Roster& roster, const Course& course, const std::vector<Vec3>& optima,
                const MethodSpec& method, const Coupling& coupling, const std::string& detector, Tally& tally,
                const Seen& seen, std::uint64_t replays) {
  std::vector<TickTimes> times(course.goals.size());
  for (std::uint64_t left = replays; left-- > 0;) {
    Tally uncounted;
    run_once(roster, course, optima, method, coupling, detector, left == 0 ? tally : uncounted,
             left == 0 ? seen : nullptr, times);
  }
  for (const TickTimes& least : times) {
    tally.times.add(least.step);
    tally.preempted += least.was_preempted ? 1 : 0;
    if (least.query != TickTimes::none) tally.bare_times.add(least.query);
  }
}

ProxyRun::ProxyRun(const contestants::Roster& roster, ProxyRequest request)
    : roster_(roster), request_(std::move(request)) {}

Score& ProxyRun::score_of(std::size_t place, const std::string& family, bool point) {
  const auto known = std::find_if(scores_.begin(), scores_.end(), [&](const Score& score) {
    return score.place == place && score.family == family && score.point == point;
  });
  if (known != scores_.end()) return *known;
  // Family by family they are run; method by method they are told.
  const auto after =
      std::find_if(scores_.begin(), scores_.end(), [&](const Score& score) { return score.place > place; });
  Score score;
  score.method = request_.methods[place];
  score.place = place;
  score.family = family;
  score.point = point;
  if (score.method.info->claims) score.detector = request_.detector;
  return *scores_.insert(after, std::move(score));
}

void ProxyRun::run_course_of(const std::string& family, const Course& course,
                             const std::function<void(const std::string&)>& progress, const Seen& seen) {
  Coupling coupling = request_.coupling;
  if (course.friction > 0) coupling.static_friction = coupling.dynamic_friction = course.friction;
  Course points = course;
  points.radius = 0;
  const std::vector<Vec3> optima = optima_of(course);
  const std::vector<Vec3> point_optima = course.radius > 0 ? optima_of(points) : optima;
  for (std::size_t place = 0; place < request_.methods.size(); ++place) {
    const MethodSpec& method = request_.methods[place];
    support::check_for_interrupt();
    progress(fmt::format("{}, {}: {}", family, course.name, method.text()));
    const bool as_point = method.info->points_only;
    coupling.radius = as_point ? 0 : course.radius;
    Score& score = score_of(place, family, coupling.radius == 0);
    const std::uint64_t crossings = score.tally.crossings + score.tally.violations;
    const auto watch = [&](std::size_t tick, const Step& step, std::int64_t ns) {
      if (method.info->claims && score.first_fault.empty() &&
          score.tally.crossings + score.tally.violations > crossings)
        score.first_fault = where(course, tick);
      if (seen) seen(tick, step, ns);
    };
    run_course(roster_, as_point ? points : course,
               course.friction > 0 ? std::vector<Vec3>()
               : as_point          ? point_optima
                                   : optima,
               method, coupling, request_.detector, score.tally, watch, request_.replays);
    ++score.courses;
  }
}

void ProxyRun::run(const std::function<void(const std::string&)>& progress) {
  const std::size_t of_each = std::max<std::size_t>(request_.ticks / request_.families.size(), 1);
  std::size_t left = of_each;
  for (std::uint64_t round = 0; left > 0; ++round) {
    const std::size_t some = std::min(left, ticks_a_round);
    for (const Family* family : request_.families) {
      for (const Course& course : family->make(request_.seed + round, some))
        run_course_of(std::string(family->name), course, progress);
    }
    left -= some;
  }
}

}  // namespace touchmark::bench::experiments::proxy
