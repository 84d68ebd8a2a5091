#include "bench/experiments/many/many_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "bench/support/interleaving.h"
#include "bench/support/median.h"
#include "bench/support/system/interrupt.h"
#include "bench/support/system/processor_time.h"
#include "bench/workload/answer.h"
#include "core/aabb_tree/aabb_tree.h"

namespace touchmark::bench::experiments::many {
namespace {

workload::Answer bits_of(const std::optional<Contact>& contact) {
  workload::Answer answer;
  if (contact) answer = workload::Answer::of(*contact);
  answer.side = Side::unasked;
  return answer;
}

bool same_bits(const std::optional<Contact>& a, const std::optional<Contact>& b) {
  const workload::Answer left = bits_of(a), right = bits_of(b);
  return std::memcmp(&left, &right, sizeof left) == 0;
}

/// Elapsed time. Of one thread it is its processor time if that is shorter: what others took of the core
/// does not count.
class Clock {
 public:
  explicit Clock(unsigned threads) : threads_(threads) {}
  double ns() const {
    const double elapsed = std::chrono::duration<double, std::nano>(Steady::now() - start_).count();
    return threads_ == 1 ? std::min(elapsed, support::processor_ns() - processor_start_) : elapsed;
  }

 private:
  using Steady = std::chrono::steady_clock;
  unsigned threads_;
  double processor_start_ = support::processor_ns();
  Steady::time_point start_ = Steady::now();
};

}  // namespace

ManyRun::ManyRun(const contestants::Roster& roster, const std::vector<contestants::ContestantSpec>& specs,
                 std::string mesh_name, const TriangleMesh& mesh)
    : mesh_name_(std::move(mesh_name)), mesh_(mesh) {
  for (const contestants::ContestantSpec& spec : specs) {
    const contestants::ContestantInfo& info = roster.find(spec.name);
    if (info.built() && info.worker_program(spec.values) != contestants::default_worker_program)
      throw std::invalid_argument(fmt::format("--detector \"{}\" needs a program of its own", spec.text()));
    roster.prepare_to_build(spec, mesh.size());
    asked_.push_back({spec, roster.build(spec, mesh)});
    if (!asked_.back().contestant->answers(workload::Query::nearest))
      throw std::invalid_argument(fmt::format("--detector \"{}\" does not answer nearest", spec.text()));
  }
}

void ManyRun::take(Workload workload) {
  workload_ = std::move(workload);
  const AabbTree tree = AabbTree::build(mesh_);
  AabbTree::Session session;
  right_.clear();
  for (const std::vector<Vec3>& points : workload_.calls) {
    support::check_for_interrupt();
    Answers& right = right_.emplace_back();
    for (const Vec3& point : points) right.push_back(tree.nearest({point, 0}, workload_.reach, session));
  }
  answers_.resize(workload_.calls.front().size());
}

std::size_t ManyRun::count_wrong(const Accuracy& accuracy, std::size_t call) const {
  if (accuracy.guarantee != Guarantee::exact) return 0;
  const double largest = 2 * mesh_.diagonal() + workload_.reach;  // difference of coordinates
  const double bound = (accuracy.relative + certified.relative) * largest + accuracy.absolute;
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < answers_.size(); ++i) {
    const std::optional<Contact>&answer = answers_[i], &right = right_[call][i];
    if (accuracy.names_exactly) {
      wrong += same_bits(answer, right) ? 0 : 1;
    } else if (answer && right) {
      wrong += std::abs(answer->distance - right->distance) <= bound ? 0 : 1;
    } else if (answer || right) {
      wrong += std::abs((answer ? answer : right)->distance - workload_.reach) <= bound ? 0 : 1;
    }
  }
  return wrong;
}

std::size_t ManyRun::check_all(Asked& asked, const ManyOptions& options, std::size_t& answered) {
  asked.contestant->forget();
  std::size_t wrong = 0;
  for (std::size_t call = 0; call < workload_.calls.size(); ++call) {
    support::check_for_interrupt();
    asked.contestant->nearest_many(workload_.calls[call], workload_.reach, answers_, options);
    wrong += count_wrong(asked.contestant->accuracy(), call);
    answered += static_cast<std::size_t>(
        std::ranges::count_if(answers_, [](const auto& answer) { return answer.has_value(); }));
  }
  return wrong;
}

double ManyRun::timed(Asked& asked, const ManyOptions& options) {
  support::check_for_interrupt();
  asked.contestant->forget();
  const Clock clock(options.threads);
  for (const std::vector<Vec3>& points : workload_.calls)
    asked.contestant->nearest_many(points, workload_.reach, answers_, options);
  return clock.ns() / static_cast<double>(workload_.calls.size() * answers_.size());
}

std::vector<ManyRow> ManyRun::run(const ManyOptions& options, std::size_t rounds, std::uint64_t seed,
                                  const std::function<void(const std::string& contestant)>& progress) {
  std::vector<ManyRow> rows;
  for (Asked& asked : asked_) {
    progress(asked.spec.text());
    ManyRow& row = rows.emplace_back(ManyRow{
        asked.spec.name, asked.spec.options, mesh_name_, mesh_.size(), std::string(name_of(workload_.kind)),
        answers_.size(), workload_.calls.size(), workload_.reach, options.threads, options.order, rounds});
    row.differing = check_all(asked, options, row.answered);
  }
  std::vector<std::vector<double>> times(asked_.size());
  support::Random random(seed);
  for (const support::Turn& turn :
       support::interleaved(std::vector<std::size_t>(rounds, asked_.size()), random)) {
    Asked& asked = asked_[turn.which];
    progress(asked.spec.text());
    times[turn.which].push_back(timed(asked, options));
    rows[turn.which].differing += count_wrong(asked.contestant->accuracy(), workload_.calls.size() - 1);
  }
  const auto embree = std::ranges::find_if(rows, [](const ManyRow& row) { return row.detector == "embree"; });
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].ns_per_point = support::median(times[i]);
    if (rows[i].differing > 0) rows[i].status = "wrong";
    if (embree == rows.end()) continue;
    const std::vector<double>& of_embree = times[static_cast<std::size_t>(embree - rows.begin())];
    std::vector<double> ratios;
    for (std::size_t round = 0; round < rounds; ++round) ratios.push_back(of_embree[round] / times[i][round]);
    rows[i].embree_ratio = support::median(ratios);
  }
  return rows;
}

}  // namespace touchmark::bench::experiments::many
