#include "core/aabb_tree/aabb_tree.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "core/aabb_tree/builder.h"
#include "core/flushed_denormals.h"
#include "core/geometry/sweep_box.h"
#include "core/search/first_moving_touch.h"
#include "core/search/threads/parallel.h"
#include "core/search/ties/certified_nearest.h"
#include "core/search/ties/closest_candidates.h"
#include "core/search/tracing.h"

namespace touchmark {
namespace {

/// Returns AabbTree::lower_bound, inside the loops that ask it of every box.
[[gnu::always_inline]] inline double bound_below(const Aabb& box, const Vec3& center, double pad) noexcept {
  return box.excess(center).norm() - pad;
}

[[maybe_unused]] void note_box(const Aabb& box, bool entered) {
  if (visits != nullptr) visits->note(box, entered);
}

/// A box or subtree that waits, with the bound it was left for.
struct StackEntry {
  double bound;
  std::uint32_t node;
};

}  // namespace

AabbTree AabbTree::build(const TriangleMesh& mesh, const Options& options) {
  if (options.leaf_size < 1 || options.leaf_size > 255)
    throw std::invalid_argument("the leaf size must be 1 to 255, not " + std::to_string(options.leaf_size));
  const unsigned threads = threads_to_use(options.threads, "aabb-tree");
  check_flushed_denormals(mesh);
  AabbTree tree;
  tree.options_ = options;
  tree.connectivity_ = Connectivity(mesh);
  tree.certified_ = options.certified;
  tree.ids_ = mesh.triangle_ids();
  Builder(mesh, options.leaf_size, threads).build(tree);
  return tree;
}

/// Returns the cost of a query by the surface area heuristic: how often a node is looked into times what is
/// in it.
double AabbTree::expected_cost() const noexcept {
  double cost = 0;
  for (const Node& node : nodes_) cost += half_area(node.box) * std::max(node.count, 2U);
  const double all = half_area(bounds());
  return all > 0 ? cost / all : 0;
}

void AabbTree::update(const TriangleMesh& mesh) {
  connectivity_.expect(mesh);
  if (cost_as_built_ == 0) cost_as_built_ = expected_cost();
  // Children come after their parents.
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    Node& node = nodes_[i];
    Aabb box;
    if (node.count == 0) {
      box = nodes_[node.first].box;
      box.extend(nodes_[node.first + 1].box);
    }
    for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
      if (has_moved(triangles_[k], mesh)) triangles_[k] = prepare(mesh, triangles_[k].index);
      for (const Vec3& corner : triangles_[k].corner) box.extend(corner);
    }
    node.box = box;
  }
  if (!(expected_cost() <= max_growth * cost_as_built_)) *this = build(mesh, options_);
}

double AabbTree::lower_bound(const Aabb& box, const Vec3& center, double pad) noexcept {
  return bound_below(box, center, pad);
}

bool AabbTree::touches(const Probe& probe, Session& session) const noexcept {
  if (!(probe.radius >= 0)) return false;
  const double difference = largest_difference(bounds(), probe.center);
  const double error = certified_ ? distance_error(difference) : 0, pad = culling_pad(difference);
  Work& work = session.work;
  if (std::isinf(error)) return fallback().touches(probe, work);
  const std::uint64_t budget = work_limit(work);
  WithinRadius is_within(probe.center, probe.radius, error);
  const auto touching = [&](std::uint32_t i) {
    ++work.triangles;
    if constexpr (tracing) note_triangle(triangles_[i].index);
    const double distance = std::sqrt(squared_distance(triangles_[i], probe.center));
    return certified_ ? is_within(triangles_[i], distance, work.exact_decisions) : distance <= probe.radius;
  };
  if (session.last < triangles_.size() && touching(session.last)) return true;
  session.last = no_triangle;
  std::array<StackEntry, max_levels> stack;
  std::size_t count = 0;
  stack[count++] = {bound_below(nodes_[0].box, probe.center, pad), 0};
  while (count > 0) {
    if (work.boxes + work.triangles > budget) return fallback().touches(probe, work);
    const StackEntry next = stack[--count];
    if (!(next.bound <= probe.radius + error)) continue;
    const Node& node = nodes_[next.node];
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      if (!touching(i)) continue;
      session.last = i;
      return true;
    }
    if (node.count > 0) continue;
    work.boxes += 2;
    StackEntry near{bound_below(nodes_[node.first].box, probe.center, pad), node.first};
    StackEntry far{bound_below(nodes_[node.first + 1].box, probe.center, pad), node.first + 1};
    if constexpr (tracing) {
      note_box(nodes_[near.node].box, near.bound <= probe.radius + error);
      note_box(nodes_[far.node].box, far.bound <= probe.radius + error);
    }
    if (far.bound < near.bound) std::swap(near, far);
    stack[count++] = far;
    stack[count++] = near;
  }
  return false;
}

/// Returns what exhausted(candidates, unseen) does where boxes and triangles come to more than the budget;
/// `unseen` bounds the distance of what was not looked at. Always inline: a search without a budget has a
/// loop of its own.
template <class Exhausted>
[[gnu::always_inline]] inline std::optional<Contact> AabbTree::search_nearest(
    const Vec3& center, double reach, Session& session, std::uint64_t budget,
    const Exhausted& exhausted) const noexcept {
  const double difference = largest_difference(bounds(), center);
  const double error = certified_ ? distance_error(difference) : 0, pad = culling_pad(difference);
  Work& work = session.work;
  if (std::isinf(error)) return fallback().nearest(center, reach, work);
  ClosestCandidates candidates(triangles_.data(), center, error);
  const auto consider = [&](std::uint32_t i) {
    ++work.triangles;
    if constexpr (tracing) note_triangle(triangles_[i].index);
    candidates.update({squared_distance(triangles_[i], center), triangles_[i].index}, i);
  };
  if (session.last < triangles_.size()) consider(session.last);
  session.last = no_triangle;
  double limit = std::min(reach, std::sqrt(candidates.best().squared_distance)) + error;
  std::array<StackEntry, max_levels> stack;
  std::size_t count = 0;
  stack[count++] = {bound_below(nodes_[0].box, center, pad), 0};
  while (count > 0) {
    if (work.boxes + work.triangles > budget) {
      double unseen = limit;
      for (std::size_t i = 0; i < count; ++i) unseen = std::min(unseen, stack[i].bound);
      return exhausted(candidates, unseen);
    }
    const StackEntry next = stack[--count];
    if (!(next.bound <= limit)) continue;
    const Node& node = nodes_[next.node];
    if (node.count > 0) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) consider(i);
      limit = std::min(limit, std::sqrt(candidates.best().squared_distance) + error);
      continue;
    }
    work.boxes += 2;
    StackEntry near{bound_below(nodes_[node.first].box, center, pad), node.first};
    StackEntry far{bound_below(nodes_[node.first + 1].box, center, pad), node.first + 1};
    if constexpr (tracing) {
      note_box(nodes_[near.node].box, near.bound <= limit);
      note_box(nodes_[far.node].box, far.bound <= limit);
    }
    if (far.bound < near.bound) std::swap(near, far);
    stack[count++] = far;
    stack[count++] = near;
  }
  if (candidates.found() && std::sqrt(candidates.best().squared_distance) <= reach)
    session.last = candidates.at();
  return contact_of(candidates, triangles_, center, reach, error, ids_, work, certified_);
}

std::optional<Contact> AabbTree::nearest(const Probe& probe, double reach, Session& session) const noexcept {
  if (!(reach >= 0)) return std::nullopt;
  const auto look_at_all = [&](const ClosestCandidates&, double) {
    return fallback().nearest(probe.center, reach, session.work);
  };
  return search_nearest(probe.center, reach, session, work_limit(session.work), look_at_all);
}

Bracket AabbTree::nearest(const Probe& probe, double reach, Session& session,
                          std::uint64_t budget) const noexcept {
  if (!(reach >= 0)) return {std::nullopt, reach, true};
  Bracket bracket;
  const Vec3& center = probe.center;
  // The first triangle of the tree is as good as another where none was found before.
  if (session.last >= triangles_.size()) session.last = 0;
  const auto exhausted = [&](const ClosestCandidates& candidates, double unseen) -> std::optional<Contact> {
    session.last = candidates.at();
    const PreparedTriangle& triangle = triangles_[session.last];
    const Offset offset = offset_from(triangle, center);
    const double error = distance_error(largest_difference(bounds(), center));
    bracket.lower = std::max(std::min(unseen, std::sqrt(offset.squared)) - error, 0.0);
    bracket.is_nearest = bracket.lower > reach;
    if (bracket.is_nearest) return std::nullopt;
    return contact_at(triangle, center, offset, ids_[triangle.index]);
  };
  bracket.contact = budget < work_budget(triangles_.size())
                        ? search_nearest(center, reach, session,
                                         session.work.boxes + session.work.triangles + budget, exhausted)
                        : nearest(probe, reach, session);
  if (bracket.is_nearest) bracket.lower = bracket.contact ? bracket.contact->distance : reach;
  return bracket;
}

std::optional<Impact> AabbTree::first_hit(const Sweep& sweep, Session& session) const noexcept {
  if (!(sweep.radius >= 0)) return std::nullopt;
  Work& work = session.work;
  const std::uint64_t budget = work_limit(work);
  const double difference = largest_difference(bounds(), sweep);
  if (!fourth_powers_fit(difference)) return fallback().first_hit(sweep, work);
  const double padded_radius = padded_sweep_radius(sweep, difference);
  FirstTouch first(sweep);
  std::array<std::uint32_t, max_levels> stack;
  std::size_t count = 0;
  stack[count++] = 0;
  while (count > 0) {
    if (work.boxes + work.triangles > budget) return fallback().first_hit(sweep, work);
    const Node& node = nodes_[stack[--count]];
    ++work.boxes;
    const bool met = enters(node.box, sweep, padded_radius, first.limit()) <= first.limit();
    if constexpr (tracing) note_box(node.box, met);
    if (!met) continue;
    if (node.count == 0) {
      stack[count++] = node.first + 1;
      stack[count++] = node.first;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      ++work.triangles;
      first.consider(triangles_[i], work.exact_decisions);
    }
  }
  return impact_of(first, ids_, certified_, [&](double reach) {
    return nearest({sweep.from, sweep.radius}, reach, session);
  });
}

std::optional<Impact> AabbTree::first_hit_moving(const Sweep& sweep, const MeshMotion& motion,
                                                 Session& session) const noexcept {
  if (!(motion.max_shift() > 0)) return first_hit(sweep, session);
  if (!(sweep.radius >= 0)) return std::nullopt;
  const auto [center, reach] = MovingReach(sweep, motion);
  if (!fourth_powers_fit(largest_difference(bounds(), center)))
    return fallback().first_hit_moving(sweep, motion, session.work);
  FirstMovingTouch first(sweep, motion);
  for_each_near(center, reach, session.work, [&](const PreparedTriangle& triangle) {
    first.consider(triangle, session.work.exact_decisions);
  });
  return first.impact(ids_);
}

std::size_t AabbTree::bytes() const noexcept {
  return nodes_.capacity() * sizeof(Node) + triangles_.capacity() * sizeof(PreparedTriangle) + ids_.bytes();
}

}  // namespace touchmark
