#include "core/sphere_cluster/tree/cylinder_bvh.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "core/search/certified_nearest.h"
#include "core/sphere_cluster/tree/lazy_builder.h"
#include "core/sphere_cluster/tree/search.h"  // IWYU pragma: keep
#include "core/sphere_cluster/tree/visitors.h"

namespace touchmark {
namespace {

using spheres::NearestVisitor;

/// A point that moves by more of the mean leaf's radius a tick starts anew: it has left the cached leaves
/// before they are used.
constexpr double max_move_in_leaf_radii = 4;

/// The next tick may be this much longer than the last one and still need no refill.
constexpr float ticks_prepared = 2;

}  // namespace

/// Does a point that moves so far a tick stay among the leaves that are listed for it?
bool SphereTree::is_slow(const Vec3& move) const noexcept {
  return move.norm() <= max_move_in_leaf_radii * mean_leaf_radius_;
}

void SphereTree::start_anew(Memory& memory) const noexcept {
  memory.start_anew();
  memory.epoch = epoch_;
}

/// Bounds what the kernel's rounding may do, here and wherever the clearance is going to be used: it grows
/// with the path there, which is at most the clearance itself, so a relative 2^-40 of that does for the rest.
double SphereTree::clearance_pad(const FilterPoint& point) const noexcept {
  return 0.5 * frame_.kernel_error(point.plane_error);
}

/// Returns a bound that no triangle is nearer than: neither those shown, the nearest of which is at `shown`,
/// nor those unseen.
double SphereTree::clearance_from(float unseen, double shown, double pad) const noexcept {
  return std::min(std::sqrt(frame_.squared(unseen)), shown * (1 - 0x1p-40)) - pad;
}

/// Refills the cache for as many ticks ahead as there is capacity for leaves, around a point ahead: a point
/// that goes on as it moved comes to it and then leaves it.
bool SphereTree::refill(const Vec3& center, const Vec3& move, float distance, Memory& memory,
                        std::uint64_t budget, Work& work) const noexcept {
  // With fewer ticks refills cost more, with more the fuller cache does.
  constexpr float min_ticks = 2, max_ticks = 16;
  constexpr double ahead = 0.5;  // of the ticks
  spheres::LeafCache& cache = memory.cache;
  if (!cache.may_refill()) return false;
  const std::uint64_t spheres_before = work.spheres;
  const auto step = static_cast<float>(frame_.scale() * move.norm());
  for (;;) {
    Vec3 cache_center = center + ahead * double{cache.horizon_ticks} * move;
    if (!can_search(cache_center)) cache_center = center;
    const FilterPoint point = frame_.point(cache_center);
    cache.start(cache_center, distance + cache.horizon_ticks * step + 8 * point.plane_error);
    if (simd_ == Simd::portable ? spheres::portable::refill(parts_, point, budget, cache, work)
                                : spheres::avx2::refill(parts_, point, budget, cache, work))
      break;
    if (cache.horizon_ticks <= min_ticks) {
      // What was left out may be anywhere.
      cache.forget();
      cache.wait();
      return false;
    }
    cache.horizon_ticks = std::max(0.5F * cache.horizon_ticks, min_ticks);
  }
  cache.count_refill(work.spheres - spheres_before);
  if (cache.count <= spheres::LeafCache::few)
    cache.horizon_ticks = std::min(1.25F * cache.horizon_ticks, max_ticks);
  return true;
}

/// Ends with one of what `ends` has for that: nothing(), found(visitor, error, distance), exhausted() where
/// the work budget is used up, and without() where the hierarchy cannot be searched. Always inline, so that
/// no contact is copied.
template <class Ends>
[[gnu::always_inline]] inline auto SphereTree::search_nearest(const Vec3& center, double reach,
                                                              Memory& memory, Work& work,
                                                              std::uint64_t budget,
                                                              const Ends& ends) const noexcept {
  claim(memory);
  if constexpr (tracing)
    if (visits != nullptr) visits->frame = &frame_;
  const FilterPoint point = frame_.point(center);
  if (!can_search(point)) return ends.without();
  bool near = false;
  if (memory.is_near()) {
    const double moved = (center - memory.center).norm();
    near = moved <= max_move_in_leaf_radii * mean_leaf_radius_ && memory.upper + moved <= reach;
  }
  if (!near && (rejects_by_distance_field(point, center, reach, memory) ||
                (lazy_ && rejects_once_sampled(point, center, reach, memory, budget, work))))
    return ends.nothing();
  const double error = frame_.kernel_error(point.plane_error);
  NearestVisitor visitor(parts_, frame_, center, frame_.limit((reach + error) * (reach + error)), error);
  visitor.names_all = Ends::names_all;
  float unseen = 0;
  if (near) {
    visit(memory.slot, visitor);
    unseen = search_near(point, visitor, memory, budget);
  } else {
    const double farthest = distances_.upper_bound(point) * frame_.unit();
    if (farthest < reach) visitor.limit = frame_.limit((farthest + error) * (farthest + error));
    unseen = traverse(point, visitor, budget);
  }
  if (unseen == spheres::exhausted) {
    work += visitor.work;
    memory.forget_distance();
    return ends.exhausted();
  }
  const ClosestCandidates& candidates = visitor.candidates;
  const double distance = std::sqrt(candidates.best().squared_distance);
  memory.move = center - memory.center;
  memory.center = center;
  memory.upper = distance;
  memory.lower = clearance_from(unseen, distance, clearance_pad(point));
  work += visitor.work;
  if (!candidates.found()) return ends.nothing();
  memory.slot = candidates.at();
  return ends.found(visitor, error, distance);
}

/// A search that ends with a contact.
template <class Exhausted>
struct SphereTree::ContactEnds {
  const SphereTree& tree;
  const Vec3& center;
  double reach;
  Work& work;
  const Exhausted& exhausted;

  static constexpr bool names_all = false;
  static std::optional<Contact> nothing() noexcept { return std::nullopt; }
  std::optional<Contact> without() const noexcept { return tree.nearest_without(center, reach, work); }
  template <class Visitor>
  [[gnu::always_inline]] std::optional<Contact> found(const Visitor& visitor, double error,
                                                      double distance) const noexcept {
    const ClosestCandidates& candidates = visitor.candidates;
    if (tree.certified_ && !(is_certain(distance, reach, error) && candidates.is_surely_first(error)))
      return contact_of(candidates, tree.parts_.triangles, center, reach,
                        distance_error(tree.bounds_, center), tree.ids_, work);
    if (distance > reach) return std::nullopt;
    return contact_at(tree.parts_.triangles[candidates.at()], center,
                      {visitor.offset, candidates.best().squared_distance},
                      tree.ids_[candidates.best().index]);
  }
};

/// A search that ends with the triangles that may be nearest.
struct SphereTree::CloseEnds {
  const SphereTree& tree;
  double reach, slack;
  CloseTriangles& into;

  static constexpr bool names_all = true;
  bool nothing() const noexcept {
    into.count = 0;
    return true;
  }
  static bool without() noexcept { return false; }
  static bool exhausted() noexcept { return false; }
  template <class Visitor>
  bool found(const Visitor& visitor, double error, double distance) const noexcept {
    into.count = 0;
    if (distance > reach + error) return true;
    // The search was shown what is farther by at most the error, as computed: half of it is rounding's.
    if (!(2 * slack <= error)) return false;
    into.least = distance;
    into.error = error;
    bool fits = true;
    const auto add = [&](std::uint32_t at) {
      fits = fits && into.count < into.triangle.size();
      if (fits) into.triangle[into.count++] = tree.parts_.triangles[at].index;
    };
    return visitor.candidates.visit_close(add) && fits;
  }
};

std::optional<Contact> SphereTree::nearest(const Vec3& center, double reach, Memory& memory,
                                           Work& work) const noexcept {
  const auto exhausted = [&] { return fallback(work).nearest(center, reach, work); };
  return search_nearest(center, reach, memory, work, nearest_limit(),
                        ContactEnds<decltype(exhausted)>{*this, center, reach, work, exhausted});
}

bool SphereTree::close_triangles(const Vec3& center, double reach, double slack, Memory& memory,
                                 CloseTriangles& into, Work& work) const noexcept {
  return search_nearest(center, reach, memory, work, nearest_limit(), CloseEnds{*this, reach, slack, into});
}

SphereTree::WithinBudget SphereTree::nearest_within_budget(const Vec3& center, double reach, Memory& memory,
                                                           Work& work) const noexcept {
  bool is_exhausted = false;
  const auto exhausted = [&]() -> std::optional<Contact> {
    is_exhausted = true;
    return std::nullopt;
  };
  std::optional<Contact> contact =
      search_nearest(center, reach, memory, work, work_limit(),
                     ContactEnds<decltype(exhausted)>{*this, center, reach, work, exhausted});
  return {std::move(contact), is_exhausted};
}

void SphereTree::prepare(const LastQuestion& question, Memory& memory, Work& work) const noexcept {
  if (memory.epoch != epoch_ || is_clear(memory.center, question.reach, memory)) return;
  const Vec3 move = is_slow(memory.move) ? memory.move : Vec3(Vec3::Zero());
  if (question.query != LastQuestion::Query::touches && memory.is_near()) refill_ahead(memory, work);
  const Vec3 kept = memory.move, free_center = memory.free_center;
  const double free_radius = memory.free_radius;
  ask_again(*this, question, memory.center + move, move, memory, work);
  memory.move = kept;
  memory.free_center = free_center;
  memory.free_radius = free_radius;
}

/// Refills the cache if the next tick would leave it.
void SphereTree::refill_ahead(Memory& memory, Work& work) const noexcept {
  if (!is_slow(memory.move) || memory.cache.cooldown > 0) return;
  const FilterPoint point = frame_.point(memory.center);
  const float distance = static_cast<float>(frame_.scale() * memory.upper) + 2 * point.plane_error;
  // A tick's move counts twice: so much farther may the nearest be, and so much farther is the cache's
  // center.
  const float two_moves = static_cast<float>(2 * frame_.scale() * memory.move.norm());
  const float away = displacement(memory.cache.center, memory.center, point);
  if (distance + away + ticks_prepared * two_moves < memory.cache.covered_radius) return;
  Work spent;
  refill(memory.center, memory.move, distance, memory, work_limit(), spent);
  work += spent;
}

/// Looks at every triangle, where the hierarchy cannot be searched.
std::optional<Contact> SphereTree::nearest_without(const Vec3& center, double reach,
                                                   Work& work) const noexcept {
  spheres::build_rest(parts_, work);
  return nearest_of_all(parts_.triangles, bounds_, center, reach, ids_, work);
}

std::size_t SphereTree::bytes() const noexcept {
  return parts_.nodes.capacity() * sizeof(spheres::TreeNode) +
         parts_.blocks.capacity() * sizeof(spheres::TriangleBlock) +
         parts_.triangles.capacity() * sizeof(PreparedTriangle) + parts_.unbuilt.bytes() +
         distances_.bytes() + ids_.bytes();
}

}  // namespace touchmark
