#include "core/sphere_cluster/tree/cylinder_bvh.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/search/certified_nearest.h"
#include "core/sphere_cluster/tree/builder.h"
#include "core/sphere_cluster/tree/search.h"

namespace touchmark {
namespace {

using spheres::TreeParts;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A point that moves by more of the mean block's radius a tick starts anew: it has left a list of blocks
/// before that is used.
constexpr double max_move_in_leaf_radii = 4;

/// See TreeParts::far.
constexpr double far_in_leaf_radii = 1;

/// The next tick may be this much longer than the last one without a list being made in it.
constexpr float ticks_prepared = 2;

constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();

/// Keeps the least candidate; the limit follows it.
struct NearestVisitor {
  const TreeParts& tree;
  const FilterFrame& frame;
  const Vec3& center;
  float limit;
  ClosestCandidates candidates;
  Work work;
  Vec3 offset;  ///< to the nearest so far

  /// Not an aggregate, whose initialization would clear all of what is yet to be written.
  NearestVisitor(const TreeParts& parts, const FilterFrame& tree_frame, const Vec3& point, float first_limit,
                 double error) noexcept
      : tree(parts),
        frame(tree_frame),
        center(point),
        limit(first_limit),
        candidates(parts.triangles.data(), point, error) {}

  bool accepts(std::uint32_t at) const noexcept { return at != candidates.at(); }
  void update(std::uint32_t at, const Offset& found) noexcept {
    if (!candidates.update({found.squared, tree.triangles[at].index}, at)) return;
    offset = found.vector;
    limit = std::min(limit, frame.limit(found.squared));
  }
};

/// Is content with any triangle that is surely within the radius, and keeps those that doubles leave open.
struct TouchVisitor {
  /// Not an aggregate, whose initialization would clear all of what is yet to be written.
  TouchVisitor(const TreeParts& parts, const Vec3& point, double touch_radius, double kernel_error,
               bool is_certified) noexcept
      : tree(parts),
        center(point),
        radius(touch_radius),
        within(is_certified ? -kernel_error : std::numeric_limits<double>::denorm_min()),
        open_up_to(is_certified ? kernel_error : -std::numeric_limits<double>::infinity()) {}

  const TreeParts& tree;
  const Vec3& center;
  double radius;
  double within;      ///< a computed distance that exceeds the radius by less than this is surely within it
  double open_up_to;  ///< one that exceeds it by more than this is surely not
  float limit = -1;
  float enough = -1;  ///< in the tree's frame: a triangle no farther is surely within the radius
  Work work{};
  double least = std::numeric_limits<double>::infinity();  ///< distance of the one kept, else of those shown
  std::uint32_t kept_at = nowhere;
  std::uint32_t open_count = 0;
  std::array<std::uint32_t, 16> open;  ///< the first of those that are left open

  bool accepts(std::uint32_t) const noexcept { return kept_at == nowhere; }
  void update(std::uint32_t at, const Offset& found) noexcept {
    const double distance = std::sqrt(found.squared);
    least = std::min(least, distance);
    const double excess = distance - radius;
    if (excess < within) return keep(at, distance);
    if (excess <= open_up_to) leave_open(at);
  }
  void update_within(std::uint32_t at) noexcept { keep(at, radius); }
  bool leaves_too_many_open() const noexcept { return kept_at == nowhere && open_count > open.size(); }
  void keep(std::uint32_t at, double distance) noexcept {
    kept_at = at;
    least = distance;
    limit = -1;  // nothing is within it: the search ends
  }

 private:
  void leave_open(std::uint32_t at) noexcept {
    if (open_count < open.size()) open[open_count] = at;
    ++open_count;
  }
};

/// Keeps the first of those that doubles left open which is within the radius, if there is one.
[[gnu::cold, gnu::noinline]] void decide_open(TouchVisitor& visitor, double error, Work& work) noexcept {
  WithinRadius is_within(visitor.center, visitor.radius, error);
  const std::size_t count = std::min<std::size_t>(visitor.open_count, visitor.open.size());
  for (std::size_t i = 0; i < count && visitor.kept_at == nowhere; ++i) {
    const PreparedTriangle& triangle = visitor.tree.triangles[visitor.open[i]];
    const double distance = std::sqrt(squared_distance(triangle, visitor.center));
    if (is_within(triangle, distance, work.exact_decisions)) visitor.keep(visitor.open[i], distance);
  }
}

/// Wants nothing: a search for it brings what it looks at nearer to the processor.
struct FetchVisitor {
  const Vec3& center;
  float limit;
  Work work{};

  bool accepts(std::uint32_t) const noexcept { return false; }
  void update(std::uint32_t, const Offset&) const noexcept {}
};

}  // namespace

SphereTree::SphereTree(const TriangleMesh& mesh, const SphereClusters& clusters, const Options& options)
    : epoch_(Epoch::next()),
      simd_(std::min(options.widest, widest_simd())),
      searchable_(FilterFrame::fits(mesh.bounds())),
      bounds_(mesh.bounds()),
      certified_(options.certified),
      lazy_(options.lazy),
      ids_(mesh.triangle_ids()) {
  if (!searchable_) {
    parts_.triangles = prepare(mesh);
    return;
  }
  frame_ = FilterFrame::around(mesh.bounds());
  radius_ = frame_.radius() * frame_.unit();
  parts_ = spheres::build_tree(mesh, clusters, frame_);
  measure_leaves();
  fill_distances();
}

void SphereTree::measure_leaves() noexcept {
  double sum = 0;
  for (const spheres::TreeNode& node : parts_.nodes)
    for (std::size_t i = 0; i < spheres::tree_width; ++i)
      if (node.child[i].is_block()) sum += node.radius[i];
  const double mean = sum / static_cast<double>(parts_.blocks.size());
  mean_leaf_radius_ = mean / frame_.scale();
  parts_.far = static_cast<float>(far_in_leaf_radii * far_in_leaf_radii * mean * mean);
}

void SphereTree::start_anew(Memory& memory) const noexcept {
  memory = {};
  memory.epoch = epoch_;
}

/// What the kernel's rounding may do, here and wherever `clearance` is going to be used: it grows with the
/// way there, which is at most `clearance` itself, so a relative 2^-40 of that does for the rest.
double SphereTree::clearance_pad(const FilterPoint& point) const noexcept {
  return 0.5 * frame_.kernel_error(point.plane_error);
}

/// No triangle is nearer than this: neither those shown, the nearest of which is at `shown`, nor those
/// unseen.
double SphereTree::clearance_from(float unseen, double shown, double pad) const noexcept {
  return std::min(std::sqrt(frame_.squared(unseen)), shown * (1 - 0x1p-40)) - pad;
}

/// Is nothing within reach, by what was sampled? Then that is what is remembered of the point. It asks the
/// tight bound where nothing was near, for else something still is, as a rule.
[[gnu::always_inline]] inline bool SphereTree::rejects_by_distance_field(const FilterPoint& point,
                                                                         const Vec3& center, double reach,
                                                                         Memory& memory) const noexcept {
  double clearance = static_cast<double>(distances_.lower_bound(point)) * frame_.unit();
  if (!(clearance > reach) && !memory.is_near())
    clearance = static_cast<double>(distances_.tight_lower_bound(point)) * frame_.unit();
  if (!(clearance > reach)) return false;
  memory.center = center;
  memory.lower = clearance;
  memory.upper = infinity;
  return true;
}

/// Rejects once the point has its samples, two at most, which take no more than half of the work that a query
/// may take before it looks at every triangle. `budget` is what is left of that.
bool SphereTree::rejects_once_sampled(const FilterPoint& point, const Vec3& center, double reach,
                                      Memory& memory, std::uint64_t& budget, Work& work) const noexcept {
  // With a reach as long as the mesh no sample helps.
  if (!(reach < radius_)) return false;
  Sampling sampling{budget / 2, memory.slot};
  bool is_known_far = false;
  while (!is_known_far && distances_.sample_near(point, [&](const Vec3& position, double farthest) {
    return sample(position, farthest, sampling);
  }))
    is_known_far = rejects_by_distance_field(point, center, reach, memory);
  work += sampling.work;
  budget = remaining(budget, sampling.work.total());
  return is_known_far;
}

/// For as many ticks ahead as there is room for blocks, about a place ahead: a point that goes on as it moved
/// comes to it and then leaves it.
bool SphereTree::refill(const Vec3& center, const Vec3& move, float distance, Memory& memory,
                        std::uint64_t budget, Work& work) const noexcept {
  // With fewer ticks the listing costs more, with more the longer list does.
  constexpr float min_ticks = 2, max_ticks = 16;
  constexpr double ahead = 0.5;  // of the ticks
  constexpr std::uint32_t max_cooldown = 255;
  spheres::LeafCache& cache = memory.cache;
  if (cache.cooldown > 0) {
    --cache.cooldown;
    return false;
  }
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
      cache.last_cooldown = std::min(max_cooldown, 2 * cache.last_cooldown + 1);
      cache.cooldown = cache.last_cooldown;
      return false;
    }
    cache.horizon_ticks = std::max(0.5F * cache.horizon_ticks, min_ticks);
  }
  cache.last_cooldown = 0;
  if (cache.count <= spheres::LeafCache::few)
    cache.horizon_ticks = std::min(1.25F * cache.horizon_ticks, max_ticks);
  return true;
}

bool SphereTree::touches(const Probe& probe, Memory& memory, Work& work) const noexcept {
  const Vec3& center = probe.center;
  const double radius = probe.radius;
  claim(memory);
  const FilterPoint point = frame_.point(center);
  if (!can_search(point)) return nearest_without(center, radius, work).has_value();
  if (memory.is_near()) {
    const double moved = (center - memory.center).norm();
    if ((memory.upper + moved) * (1 + 0x1p-40) + clearance_pad(point) <= radius) return true;
    // It is still near what it touched, unless it came from elsewhere.
    if (std::abs(memory.upper - moved) <= radius) {
      TouchVisitor visitor(parts_, center, radius, frame_.kernel_error(point.plane_error), certified_);
      visit(memory.slot, visitor);
      if (visitor.open_count > 0) decide_open(visitor, frame_.kernel_error(point.plane_error), work);
      work += visitor.work;
      if (visitor.kept_at != nowhere) {
        remember_touch(center, 0, visitor.least, memory);
        return true;
      }
    }
  }
  std::uint64_t budget = work_limit();
  if (rejects_by_distance_field(point, center, radius, memory) ||
      (lazy_ && rejects_once_sampled(point, center, radius, memory, budget, work)))
    return false;
  const double error = frame_.kernel_error(point.plane_error);
  TouchVisitor visitor(parts_, center, radius, error, certified_);
  visitor.limit = frame_.limit((radius + error) * (radius + error));
  visitor.enough = frame_.to_frame_rounded_down(radius - error);
  const float unseen = traverse(point, visitor, budget);
  work += visitor.work;
  if (visitor.kept_at == nowhere && visitor.open_count > 0) decide_open(visitor, error, work);
  if (unseen == spheres::exhausted || visitor.leaves_too_many_open()) {
    memory.forget_distance();
    return fallback().touches(probe, work);
  }
  if (visitor.kept_at == nowhere) {
    remember_touch(center, clearance_from(unseen, visitor.least, clearance_pad(point)), infinity, memory);
    return false;
  }
  remember_touch(center, 0, visitor.least, memory);
  memory.slot = visitor.kept_at;
  return true;
}

/// Remembers what `touches` found.
void SphereTree::remember_touch(const Vec3& center, double lower, double upper, Memory& memory) noexcept {
  memory.move = Vec3::Constant(infinity);
  memory.center = center;
  memory.lower = lower;
  memory.upper = upper;
}

std::optional<Contact> SphereTree::nearest(const Vec3& center, double reach, Memory& memory, Work& work,
                                           bool* exhausted) const noexcept {
  claim(memory);
  const FilterPoint point = frame_.point(center);
  if (!can_search(point)) return nearest_without(center, reach, work);
  bool near = false;
  if (memory.is_near()) {
    const double moved = (center - memory.center).norm();
    near = moved <= max_move_in_leaf_radii * mean_leaf_radius_ && memory.upper + moved <= reach;
  }
  std::uint64_t budget = work_limit();
  if (!near && (rejects_by_distance_field(point, center, reach, memory) ||
                (lazy_ && rejects_once_sampled(point, center, reach, memory, budget, work))))
    return std::nullopt;
  const double error = frame_.kernel_error(point.plane_error);
  NearestVisitor visitor(parts_, frame_, center, frame_.limit((reach + error) * (reach + error)), error);
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
    if (exhausted == nullptr) return fallback().nearest(center, reach, work);
    *exhausted = true;
    return std::nullopt;
  }
  const ClosestCandidates& candidates = visitor.candidates;
  const double distance = std::sqrt(candidates.best().squared_distance);
  memory.move = center - memory.center;
  memory.center = center;
  memory.upper = distance;
  memory.slot = candidates.at();
  memory.lower = clearance_from(unseen, distance, clearance_pad(point));
  work += visitor.work;
  if (!candidates.found()) return std::nullopt;
  if (certified_ && !(is_certain(distance, reach, error) && candidates.is_surely_first(error))) {
    const double tight_error = distance_error(bounds_, center);
    if (!is_certain_first(candidates, parts_.triangles, distance, center, reach, tight_error))
      return nearest_of_ties(candidates, center, reach, tight_error, ids_, work.exact_decisions);
  }
  if (distance > reach) return std::nullopt;
  return contact_at(parts_.triangles[candidates.at()], center,
                    {visitor.offset, candidates.best().squared_distance}, ids_[candidates.best().index]);
}

void SphereTree::look_ahead(Memory& memory, Work& work) const noexcept {
  const double moved = memory.move.norm();
  if (!(moved <= max_move_in_leaf_radii * mean_leaf_radius_) || memory.cache.cooldown > 0) return;
  const FilterPoint point = frame_.point(memory.center);
  const float distance = static_cast<float>(frame_.scale() * memory.upper) + 2 * point.plane_error;
  // A tick's move counts twice: so much farther may the nearest be, and so much farther is the cache's
  // center.
  const float two_moves = static_cast<float>(2 * frame_.scale() * moved);
  const float away = displacement(memory.cache.center, memory.center, point);
  Work spent;
  if (distance + away + ticks_prepared * two_moves < memory.cache.covered_radius ||
      refill(memory.center, memory.move, distance, memory, work_limit(), spent)) {
    const Vec3 next = memory.center + memory.move;
    const double farthest = memory.upper + moved;
    FetchVisitor visitor{next, frame_.limit(farthest * farthest)};
    if (can_search(next)) search_cached(frame_.point(next), visitor, memory.cache, 0, work_limit());
    spent += visitor.work;
  }
  work += spent;
}

/// Looks at every triangle, where the hierarchy cannot be searched.
std::optional<Contact> SphereTree::nearest_without(const Vec3& center, double reach,
                                                   Work& work) const noexcept {
  return nearest_of_all(parts_.triangles, bounds_, center, reach, ids_, work);
}

std::size_t SphereTree::bytes() const noexcept {
  return parts_.nodes.capacity() * sizeof(spheres::TreeNode) +
         parts_.blocks.capacity() * sizeof(spheres::TriangleBlock) +
         parts_.triangles.capacity() * sizeof(PreparedTriangle) + distances_.bytes() + ids_.bytes();
}

}  // namespace touchmark
