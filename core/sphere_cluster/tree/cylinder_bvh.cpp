#include "core/sphere_cluster/tree/cylinder_bvh.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "core/search/certified_nearest.h"
#include "core/sphere_cluster/tree/builder.h"
#include "core/sphere_cluster/tree/refit.h"
#include "core/sphere_cluster/tree/search.h"

namespace touchmark {
namespace {

using spheres::TreeParts;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A point that moves by more of the mean block's radius a tick starts anew: it has left a list of blocks
/// before that is used.
constexpr double farthest_in_grains = 4;

/// See TreeParts::far.
constexpr double far_in_grains = 1;

/// The next tick may be this much longer than the last one without a list being made in it.
constexpr float ticks_prepared = 2;

constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();

/// Keeps the least candidate; the limit follows it.
struct NearestVisitor {
  const TreeParts& tree;
  const FilterFrame& frame;
  const Vec3& center;
  float limit;
  NearestSoFar so_far;
  Work work;
  Vec3 offset;  ///< to the nearest so far

  /// Not an aggregate, whose initialization would clear all of what is yet to be written.
  NearestVisitor(const TreeParts& parts, const FilterFrame& tree_frame, const Vec3& point, float first_limit,
                 double error) noexcept
      : tree(parts),
        frame(tree_frame),
        center(point),
        limit(first_limit),
        so_far(parts.triangles.data(), point, error) {}

  bool wants(std::uint32_t at) const noexcept { return at != so_far.at(); }
  void take(std::uint32_t at, const Offset& found) noexcept {
    if (!so_far.take({found.squared, tree.triangles[at].index}, at)) return;
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

  bool wants(std::uint32_t) const noexcept { return kept_at == nowhere; }
  void take(std::uint32_t at, const Offset& found) noexcept {
    const double distance = std::sqrt(found.squared);
    least = std::min(least, distance);
    const double excess = distance - radius;
    if (excess < within) return keep(at, distance);
    if (excess <= open_up_to) leave_open(at);
  }
  void take_within(std::uint32_t at) noexcept { keep(at, radius); }
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

  bool wants(std::uint32_t) const noexcept { return false; }
  void take(std::uint32_t, const Offset&) const noexcept {}
};

/// Tells the memories of different trees apart, also where one took another's place in memory. From 1.
std::uint64_t next_number() noexcept {
  static std::atomic<std::uint64_t> last = 0;
  return ++last;
}

}  // namespace

SphereTree::SphereTree(const TriangleMesh& mesh, const SphereClusters& clusters, const Options& options)
    : number_(next_number()),
      simd_(std::min(options.widest, widest_simd())),
      searchable_(FilterFrame::fits(mesh.bounds())),
      bounds_(mesh.bounds()),
      certified_(options.certified),
      samples_later_(options.samples_later),
      ids_(mesh.ids().begin(), mesh.ids().end()) {
  if (!searchable_) {
    parts_.triangles = prepare(mesh);
    return;
  }
  frame_ = FilterFrame::around(mesh.bounds());
  radius_ = frame_.radius() * frame_.unit();
  parts_ = spheres::build_tree(mesh, clusters, frame_);
  measure_grain();
  fill_distances();
}

void SphereTree::measure_grain() noexcept {
  double sum = 0;
  for (const spheres::TreeNode& node : parts_.nodes)
    for (std::size_t i = 0; i < spheres::tree_width; ++i)
      if (node.child[i].is_block()) sum += node.radius[i];
  const double mean = sum / static_cast<double>(parts_.blocks.size());
  grain_ = mean / frame_.scale();
  parts_.far = static_cast<float>(far_in_grains * far_in_grains * mean * mean);
}

void SphereTree::renew() noexcept { number_ = next_number(); }

void SphereTree::start_anew(Memory& memory) const noexcept {
  memory = {};
  memory.tree = number_;
}

/// What the kernel's rounding may do, here and wherever `free` is going to be used: it grows with the way
/// there, which is at most `free` itself, so a relative 2^-40 of that does for the rest.
double SphereTree::slack_at(const FilterPoint& point) const noexcept {
  return 0.5 * frame_.kernel_error(point.tau);
}

/// No triangle is nearer than this: neither those shown, the nearest of which is at `shown`, nor those
/// unseen.
double SphereTree::free_within(float unseen, double shown, double slack) const noexcept {
  return std::min(std::sqrt(frame_.squared(unseen)), shown * (1 - 0x1p-40)) - slack;
}

/// The same by what was sampled, which then is what is known of the place: closely where nothing was near,
/// for else something still is, as a rule.
[[gnu::always_inline]] inline bool SphereTree::is_far(const FilterPoint& point, const Vec3& center,
                                                      double reach, Memory& memory) const noexcept {
  double free = static_cast<double>(distances_.at_least(point)) * frame_.unit();
  if (!(free > reach) && !(memory.nearest < infinity))
    free = static_cast<double>(distances_.at_least_by_eight(point)) * frame_.unit();
  if (!(free > reach)) return false;
  memory.center = center;
  memory.free = free;
  memory.nearest = std::numeric_limits<double>::infinity();
  return true;
}

/// And when the place has its samples, two at most, which take no more than half of the work that a query may
/// take before it looks at every triangle. `most` is what is left of that.
bool SphereTree::is_far_once_sampled(const FilterPoint& point, const Vec3& center, double reach,
                                     Memory& memory, std::uint64_t& most, Work& work) const noexcept {
  // With a reach as long as the mesh no sample helps.
  if (!(reach < radius_)) return false;
  Sampling sampling{most / 2, memory.last};
  bool is_known_far = false;
  while (!is_known_far && distances_.sample_near(point, [&](const Vec3& place, double farthest) {
    return sample(place, farthest, sampling);
  }))
    is_known_far = is_far(point, center, reach, memory);
  work += sampling.work;
  most = left_of(most, sampling.work.total());
  return is_known_far;
}

/// For as many ticks ahead as there is room for blocks, about a place ahead: a point that goes on as it moved
/// comes to it and then leaves it.
bool SphereTree::list_blocks(const Vec3& center, const Vec3& move, float distance, Memory& memory,
                             std::uint64_t most, Work& work) const noexcept {
  // With fewer ticks the listing costs more, with more the longer list does.
  constexpr float fewest_ticks = 2, most_ticks = 16;
  constexpr double ahead = 0.5;  // of the ticks
  constexpr std::uint32_t longest_pause = 255;
  spheres::NearBlocks& blocks = memory.blocks;
  if (blocks.pause > 0) {
    --blocks.pause;
    return false;
  }
  const auto step = static_cast<float>(frame_.scale() * move.norm());
  for (;;) {
    Vec3 anchor = center + ahead * double{blocks.ticks} * move;
    if (!can_search(anchor)) anchor = center;
    const FilterPoint point = frame_.point(anchor);
    blocks.start(anchor, distance + blocks.ticks * step + 8 * point.tau);
    if (simd_ == Simd::portable ? spheres::portable::list_blocks(parts_, point, most, blocks, work)
                                : spheres::avx2::list_blocks(parts_, point, most, blocks, work))
      break;
    if (blocks.ticks <= fewest_ticks) {
      // What was left out may be anywhere.
      blocks.forget();
      blocks.last_pause = std::min(longest_pause, 2 * blocks.last_pause + 1);
      blocks.pause = blocks.last_pause;
      return false;
    }
    blocks.ticks = std::max(0.5F * blocks.ticks, fewest_ticks);
  }
  blocks.last_pause = 0;
  if (blocks.count <= spheres::NearBlocks::few) blocks.ticks = std::min(1.25F * blocks.ticks, most_ticks);
  return true;
}

bool SphereTree::touches(const Probe& probe, Memory& memory, Work& work) const noexcept {
  const Vec3& center = probe.center;
  const double radius = probe.radius;
  if (!(radius >= 0)) return false;
  claim(memory);
  const FilterPoint point = frame_.point(center);
  if (!can_search(point)) return nearest_without(center, radius, work).has_value();
  if (memory.nearest < infinity) {
    const double moved = (center - memory.center).norm();
    if ((memory.nearest + moved) * (1 + 0x1p-40) + slack_at(point) <= radius) return true;
    // It is still near what it touched, unless it came from elsewhere.
    if (std::abs(memory.nearest - moved) <= radius) {
      TouchVisitor visitor(parts_, center, radius, frame_.kernel_error(point.tau), certified_);
      show(memory.last, visitor);
      if (visitor.open_count > 0) decide_open(visitor, frame_.kernel_error(point.tau), work);
      work += visitor.work;
      if (visitor.kept_at != nowhere) {
        remember_touch(center, -1, visitor.least, memory);
        return true;
      }
    }
  }
  std::uint64_t most = most_work();
  if (is_far(point, center, radius, memory) ||
      (samples_later_ && is_far_once_sampled(point, center, radius, memory, most, work)))
    return false;
  const double error = frame_.kernel_error(point.tau);
  TouchVisitor visitor(parts_, center, radius, error, certified_);
  visitor.limit = frame_.limit((radius + error) * (radius + error));
  visitor.enough = frame_.at_most(radius - error);
  const float unseen = descend(point, visitor, most);
  work += visitor.work;
  if (visitor.kept_at == nowhere && visitor.open_count > 0) decide_open(visitor, error, work);
  if (unseen == spheres::gave_up || visitor.leaves_too_many_open()) {
    memory.free = -1;
    memory.nearest = infinity;
    return all().touches(probe, work);
  }
  if (visitor.kept_at == nowhere) {
    remember_touch(center, free_within(unseen, visitor.least, slack_at(point)), infinity, memory);
    return false;
  }
  remember_touch(center, -1, visitor.least, memory);
  memory.last = visitor.kept_at;
  return true;
}

/// Of `touches`, whatever it found.
void SphereTree::remember_touch(const Vec3& center, double free, double nearest, Memory& memory) noexcept {
  memory.move = Vec3::Constant(infinity);
  memory.center = center;
  memory.free = free;
  memory.nearest = nearest;
}

std::optional<Contact> SphereTree::nearest(const Vec3& center, double reach, Memory& memory, Work& work,
                                           bool* gives_up) const noexcept {
  if (!(reach >= 0)) return std::nullopt;
  claim(memory);
  const FilterPoint point = frame_.point(center);
  if (!can_search(point)) return nearest_without(center, reach, work);
  bool near = false;
  if (memory.nearest < infinity) {
    const double moved = (center - memory.center).norm();
    near = moved <= farthest_in_grains * grain_ && memory.nearest + moved <= reach;
  }
  std::uint64_t most = most_work();
  if (!near && (is_far(point, center, reach, memory) ||
                (samples_later_ && is_far_once_sampled(point, center, reach, memory, most, work))))
    return std::nullopt;
  const double error = frame_.kernel_error(point.tau);
  NearestVisitor visitor(parts_, frame_, center, frame_.limit((reach + error) * (reach + error)), error);
  float unseen = 0;
  if (near) {
    show(memory.last, visitor);
    unseen = search_near(point, visitor, memory, most);
  } else {
    const double farthest = distances_.at_most(point) * frame_.unit();
    if (farthest < reach) visitor.limit = frame_.limit((farthest + error) * (farthest + error));
    unseen = descend(point, visitor, most);
  }
  if (unseen == spheres::gave_up) {
    work += visitor.work;
    memory.free = -1;
    memory.nearest = infinity;
    if (gives_up == nullptr) return all().nearest(center, reach, work);
    *gives_up = true;
    return std::nullopt;
  }
  const NearestSoFar& so_far = visitor.so_far;
  const double distance = std::sqrt(so_far.best().squared_distance);
  memory.move = center - memory.center;
  memory.center = center;
  memory.nearest = distance;
  memory.last = so_far.at();
  memory.free = free_within(unseen, distance, slack_at(point));
  work += visitor.work;
  if (!so_far.found()) return std::nullopt;
  if (certified_ && !(is_certain(distance, reach, error) && so_far.is_surely_first(error))) {
    const double least_error = distance_error(bounds_, center);
    if (!is_certain_first(so_far, parts_.triangles, distance, center, reach, least_error))
      return nearest_of_ties(so_far, center, reach, least_error, ids_, work.exact_decisions);
  }
  if (distance > reach) return std::nullopt;
  return contact_at(parts_.triangles[so_far.at()], center, {visitor.offset, so_far.best().squared_distance},
                    id(so_far.best().index));
}

void SphereTree::look_ahead(Memory& memory, Work& work) const noexcept {
  const double moved = memory.move.norm();
  if (!(moved <= farthest_in_grains * grain_) || memory.blocks.pause > 0) return;
  const FilterPoint point = frame_.point(memory.center);
  const float distance = static_cast<float>(frame_.scale() * memory.nearest) + 2 * point.tau;
  // A tick's move counts twice: so much farther may the nearest be, and so much farther is the list's anchor.
  const float two_moves = static_cast<float>(2 * frame_.scale() * moved);
  const float away = way(memory.blocks.anchor, memory.center, point);
  Work spent;
  if (distance + away + ticks_prepared * two_moves < memory.blocks.rest ||
      list_blocks(memory.center, memory.move, distance, memory, most_work(), spent)) {
    const Vec3 next = memory.center + memory.move;
    const double farthest = memory.nearest + moved;
    FetchVisitor visitor{next, frame_.limit(farthest * farthest)};
    if (can_search(next)) search_listed(frame_.point(next), visitor, memory.blocks, 0, most_work());
    spent += visitor.work;
  }
  work += spent;
}

/// Where the hierarchy does not serve.
std::optional<Contact> SphereTree::nearest_without(const Vec3& center, double reach,
                                                   Work& work) const noexcept {
  return nearest_of_all(parts_.triangles, bounds_, center, reach, ids_, work);
}

std::size_t SphereTree::bytes() const noexcept {
  return parts_.nodes.capacity() * sizeof(spheres::TreeNode) +
         parts_.blocks.capacity() * sizeof(spheres::TriangleBlock) +
         parts_.triangles.capacity() * sizeof(PreparedTriangle) + distances_.bytes() +
         ids_.capacity() * sizeof(TriangleId);
}

}  // namespace touchmark
