/// All methods over all families, judged as they go.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "bench/contestants/roster.h"
#include "bench/experiments/proxy/families.h"
#include "bench/proxies/course.h"
#include "bench/proxies/methods.h"
#include "bench/proxies/tally.h"

namespace touchmark::bench::experiments::proxy {

using proxies::Course, proxies::MethodSpec, proxies::Step, proxies::Tally;

struct ProxyRequest {
  std::vector<const Family*> families;
  std::vector<MethodSpec> methods;
  std::size_t ticks = 0;  ///< about so many, all families together
  std::uint64_t seed = 1;
  Coupling coupling;     ///< the radius and the friction are the courses'
  std::string detector;  ///< for `certified`
  std::uint64_t replays = 3;
};

/// A method and a family, balls and bare points apart.
struct Score {
  MethodSpec method;
  std::size_t place = 0;  ///< the method's, among those asked for
  std::string family;
  bool point = false;  ///< It counts the courses without a radius; else those of a ball.
  std::string detector;
  std::uint64_t courses = 0;
  Tally tally;
  std::string
      first_fault;  ///< the course and tick of the first crossing of a method that claims to have none

  bool broken() const { return method.info->claims && tally.crossings + tally.violations > 0; }
};

/// Runs a method over a course, several times the same way: a tick's time is the least of these. The oracle
/// judges between the ticks of each, so that all find the same caches; the last one counts, and
/// `seen(tick, step, ns)` may look at its ticks. Throws what the method's making throws. Where the start is
/// not free the method's ticks count from when it is off the surface.
using Seen = std::function<void(std::size_t tick, const Step& step, std::int64_t ns)>;
void run_course(const contestants::Roster& roster, const Course& course, const std::vector<Vec3>& optima,
                const MethodSpec& method, const Coupling& coupling, const std::string& detector, Tally& tally,
                const Seen& seen = nullptr, std::uint64_t replays = 1);

class ProxyRun {
 public:
  ProxyRun(const contestants::Roster& roster, ProxyRequest request);

  /// Rounds of all families until the ticks are done. Throws Interrupted between courses.
  void run(const std::function<void(const std::string&)>& progress);
  /// One course for all methods, counted under that family's name.
  void run_course_of(const std::string& family, const Course& course,
                     const std::function<void(const std::string&)>& progress, const Seen& seen = nullptr);

  const std::vector<Score>& scores() const noexcept { return scores_; }
  const ProxyRequest& request() const noexcept { return request_; }

 private:
  Score& score_of(std::size_t place, const std::string& family, bool point);

  const contestants::Roster& roster_;
  ProxyRequest request_;
  std::vector<Score> scores_;
};

}  // namespace touchmark::bench::experiments::proxy
