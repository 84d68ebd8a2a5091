#include "bench/proxies/tally.h"

#include <algorithm>
#include <utility>

#include "bench/oracle/exact/constrained_optimum.h"

namespace touchmark::bench::proxies {
namespace {

/// A share of the diagonal: beyond it no rounding of coordinates explains on which side a proxy is.
constexpr double clear_of_rounding = 1e-9;
/// So much of the radius, or of the diagonal where there is none, is not left to go by a proxy that is held;
/// nor so much of its coordinates, which leaves room for their rounding.
constexpr double share_of_radius = 1e-3, share_of_diagonal = 1e-6, share_of_coordinates = 0x1p-32;
constexpr std::size_t settled = 10;  ///< ticks after which a proxy is to rest with its goal

}  // namespace

std::vector<Vec3> optima_of(const Course& course) {
  std::vector<Vec3> optima;
  if (course.bounds.empty()) return optima;
  std::vector<oracle::Triangle> triangles;
  for (const std::uint32_t index : course.bounds)
    triangles.push_back(oracle::triangle_of(course.mesh, index));
  const oracle::ConvexFreeSpace space(triangles, course.start, course.radius);
  for (std::size_t i = 0; i < course.goals.size(); ++i) {
    if (i > 0 && course.goals[i] == course.goals[i - 1]) {
      optima.push_back(optima.back());
      continue;
    }
    const std::optional<Vec3> optimum = space.nearest(course.goals[i]);
    if (!optimum) return {};
    optima.push_back(*optimum);
  }
  return optima;
}

bool Judge::violates(const Vec3& position) const {
  return course_.radius > 0 ? oracle_->is_nearer(position, position, course_.radius)
                            : oracle_->meets(position, position);
}

void Judge::see(const WayOracle& oracle, const std::function<void()>& move, Passage passage) {
  passage_ = std::move(passage);
  const bool was_fine = oracle_ == nullptr || excused_ || !violates(position_);
  move();
  oracle_ = &oracle;
  excused_ = was_fine && violates(position_);
  clear_at_ = position_;
  crossed_since_ = false;
}

void Judge::tick(std::size_t index, const Step& step) {
  ++tally_.ticks;
  if (step.unfinished) ++tally_.unfinished;
  const Vec3& goal = course_.goals[index];
  if (step.status == Status::no_answer || !step.position().allFinite()) {
    ++tally_.unanswered;
    return;
  }
  if (step.status == Status::in_contact) ++tally_.contact_ticks;
  if (step.status == Status::stuck) ++tally_.stuck_ticks;
  const std::uint64_t crossings = tally_.crossings;
  judge_carried(step);
  tally_.pieces += step.way.size() - 1;
  judge_way(step, goal);
  tally_.crossings = std::min(tally_.crossings, crossings + 1);
  judge_rest(index, step);
  judge_force(index, step);
  if (!optima_.empty()) {
    ++tally_.optimum_ticks;
    const double error = (step.position() - optima_[index]).norm();
    tally_.optimum_errors += error;
    tally_.max_optimum_error = std::max(tally_.max_optimum_error, error);
  }
  position_ = step.position();
}

void Judge::judge_carried(const Step& step) {
  const Vec3& to = step.way.front();
  if (passage_ && !step.squeezed && passage_(position_, to)) ++tally_.crossings;
  passage_ = nullptr;
  if (to == position_) return;
  position_ = clear_at_ = to;
  excused_ = violates(to);
}

/// While a crossing leaves it open where the proxy is, nothing is said.
void Judge::judge_end(const Step& step, const Vec3& goal) {
  const Vec3& at = step.position();
  if (step.unfinished) return;
  if (at == goal || excused_ || crossed_since_) return;
  const double radius = course_.radius;
  if (!oracle_->is_within(position_, goal, radius)) ++tally_.missed_goals;
  const double share = radius > 0 ? share_of_radius * radius : share_of_diagonal * oracle_->diagonal();
  const double little = std::max(share, share_of_coordinates * at.cwiseAbs().maxCoeff());
  const Vec3 left = goal - at;
  const Vec3 on = at + std::min(1.0, little / left.norm()) * left;
  if (on != at && !oracle_->is_within(at, on, radius)) ++tally_.stopped_short;
}

void Judge::judge_way(const Step& step, const Vec3& goal) {
  const double radius = course_.radius;
  judge_end(step, goal);
  if (step.way.size() == 1) return;  // it rests
  bool crossed = false, violated = false;
  for (std::size_t i = 1; i < step.way.size(); ++i) {
    const Vec3 &from = step.way[i - 1], &to = step.way[i];
    const bool nearer = radius > 0 && oracle_->is_nearer(from, to, radius);
    violated = violated || nearer;
    if (radius == 0 || nearer) crossed = crossed || oracle_->meets(from, to);
  }
  if (excused_) {
    if (radius > 0 && crossed && !oracle_->meets(position_, position_)) ++tally_.crossings;
    excused_ = violates(step.position());
    return;
  }
  if (violated) {
    ++tally_.violations;
    tally_.max_shortfall = std::max(tally_.max_shortfall, oracle_->shortfall(step.position(), radius));
  }
  if (crossed) ++tally_.crossings;
  judge_side(step, crossed);
}

/// A pop is a piece that surely crosses, or, with a closed surface, a tick that ends clear of it on another
/// side than the proxy was on when it was last clear.
void Judge::judge_side(const Step& step, bool crossed) {
  crossed_since_ = crossed_since_ || crossed;
  if (!crossed_since_) return;
  const double margin = clear_of_rounding * oracle_->diagonal();
  bool popped = false;
  for (std::size_t i = 1; crossed && !popped && i < step.way.size(); ++i)
    popped = oracle_->surely_crosses(step.way[i - 1], step.way[i], margin);
  const Vec3& at = step.position();
  if (!oracle_->is_within(at, at, margin)) {
    popped = popped || oracle_->side(clear_at_) != oracle_->side(at);
    clear_at_ = at;
    crossed_since_ = false;
  }
  if (popped) ++tally_.pops;
}

void Judge::judge_rest(std::size_t index, const Step& step) {
  const bool same = index > 0 && course_.goals[index] == course_.goals[index - 1];
  const bool moved_mesh = course_.update_every > 0 && index % course_.update_every == 0;
  rested_ = same && !moved_mesh ? rested_ + 1 : 0;
  if (rested_ <= settled) return;
  ++tally_.rest_ticks;
  if (step.position() != position_) ++tally_.jitters;
}

void Judge::judge_force(std::size_t index, const Step& step) {
  const Vec3& goal = course_.goals[index];
  const Vec3 moved = goal - (index > 0 ? course_.goals[index - 1] : course_.start);
  const double jump = (step.force - force_).norm() - coupling_.stiffness * moved.norm();
  tally_.max_force_jump = std::max(tally_.max_force_jump, jump);
  if (course_.loop > 0) {
    energy_ += (step.force + force_).dot(moved) / 2;
    if ((index + 1) % course_.loop == 0) {
      tally_.max_energy = std::max(tally_.max_energy, energy_);
      energy_ = 0;
    }
  }
  force_ = step.force;
}

}  // namespace touchmark::bench::proxies
