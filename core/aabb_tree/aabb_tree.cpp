#include "core/aabb_tree/aabb_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "core/geometry/sweep_box.h"
#include "core/search/certified_nearest.h"
#include "core/search/closest_candidates.h"

namespace touchmark {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double half_area(const Aabb& box) noexcept {
  if (box.empty()) return 0;
  const Vec3 e = box.extent();
  return e.x() * e.y() + e.y() * e.z() + e.z() * e.x();
}

/// Returns AabbTree::lower_bound, inside the loops that ask it of every box.
[[gnu::always_inline]] inline double bound_below(const Aabb& box, const Vec3& center, double pad) noexcept {
  return box.excess(center).norm() - pad;
}

/// A box or subtree that waits, with the bound it was left for.
struct StackEntry {
  double bound;
  std::uint32_t node;
};

}  // namespace

/// Splits top down where the sum of area times triangles is least over sixteen planes an axis (MacDonald &
/// Booth, "Heuristics for ray tracing using space subdivision", 1990).
class AabbTree::Builder {
 public:
  Builder(AabbTree& tree, std::size_t leaf_size) : tree_(tree), leaf_size_(leaf_size) {
    for (const PreparedTriangle& triangle : tree.triangles_) {
      Item item;
      for (const Vec3& corner : triangle.corner) item.box.extend(corner);
      item.center = item.box.center();
      item.triangle = triangle.index;
      items_.push_back(item);
    }
  }

  void build() {
    tree_.nodes_.reserve(items_.size());
    tree_.nodes_.emplace_back();
    split(0, 0, items_.size(), 0);
    tree_.nodes_.shrink_to_fit();
    std::vector<PreparedTriangle> ordered;
    ordered.reserve(items_.size());
    for (const Item& item : items_) ordered.push_back(tree_.triangles_[item.triangle]);
    tree_.triangles_ = std::move(ordered);
  }

 private:
  struct Item {
    Aabb box;
    Vec3 center;
    std::uint32_t triangle;
  };
  static constexpr std::size_t bins = 16;

  void split(std::uint32_t node, std::size_t begin, std::size_t end, std::size_t level) {
    Aabb box, centers;
    for (std::size_t i = begin; i < end; ++i) {
      box.extend(items_[i].box);
      centers.extend(items_[i].center);
    }
    tree_.nodes_[node].box = box;
    if (end - begin <= leaf_size_) {
      tree_.nodes_[node].first = static_cast<std::uint32_t>(begin);
      tree_.nodes_[node].count = static_cast<std::uint32_t>(end - begin);
      return;
    }
    std::size_t middle = level < halving_level ? partition_by_area(begin, end, centers) : begin;
    if (middle == begin || middle == end) middle = halve(begin, end, centers);
    const auto child = static_cast<std::uint32_t>(tree_.nodes_.size());
    tree_.nodes_[node].first = child;
    tree_.nodes_.resize(child + 2);
    split(child, begin, middle, level + 1);
    split(child + 1, middle, end, level + 1);
  }

  std::size_t partition_by_area(std::size_t begin, std::size_t end, const Aabb& centers) {
    double least = infinity;
    int best_axis = 0;
    std::size_t best_plane = 0;
    for (int axis = 0; axis < 3; ++axis) {
      std::array<Aabb, bins> box;
      std::array<std::size_t, bins> count{};
      for (std::size_t i = begin; i < end; ++i) {
        const std::size_t bin = bin_of(items_[i], axis, centers);
        box[bin].extend(items_[i].box);
        ++count[bin];
      }
      std::array<double, bins> right_cost{};
      Aabb right;
      std::size_t right_count = 0;
      for (std::size_t plane = bins - 1; plane > 0; --plane) {
        right.extend(box[plane]);
        right_count += count[plane];
        right_cost[plane] = half_area(right) * static_cast<double>(right_count);
      }
      Aabb left;
      std::size_t left_count = 0;
      for (std::size_t plane = 1; plane < bins; ++plane) {
        left.extend(box[plane - 1]);
        left_count += count[plane - 1];
        const double cost = half_area(left) * static_cast<double>(left_count) + right_cost[plane];
        if (left_count == 0 || left_count == end - begin || !(cost < least)) continue;
        least = cost;
        best_axis = axis;
        best_plane = plane;
      }
    }
    const auto middle =
        std::partition(items_.begin() + static_cast<std::ptrdiff_t>(begin),
                       items_.begin() + static_cast<std::ptrdiff_t>(end),
                       [&](const Item& item) { return bin_of(item, best_axis, centers) < best_plane; });
    return static_cast<std::size_t>(middle - items_.begin());
  }

  std::size_t halve(std::size_t begin, std::size_t end, const Aabb& centers) {
    int axis = 0;
    centers.extent().maxCoeff(&axis);
    const std::size_t middle = begin + (end - begin) / 2;
    std::nth_element(items_.begin() + static_cast<std::ptrdiff_t>(begin),
                     items_.begin() + static_cast<std::ptrdiff_t>(middle),
                     items_.begin() + static_cast<std::ptrdiff_t>(end), [axis](const Item& a, const Item& b) {
                       return a.center[axis] < b.center[axis] ||
                              (a.center[axis] == b.center[axis] && a.triangle < b.triangle);
                     });
    return middle;
  }

  static std::size_t bin_of(const Item& item, int axis, const Aabb& centers) noexcept {
    const double extent = centers.max[axis] - centers.min[axis];
    const double where = (item.center[axis] - centers.min[axis]) / extent * static_cast<double>(bins);
    return where >= 0 ? std::min(static_cast<std::size_t>(where), bins - 1) : 0;  // no extent: all in one
  }

  AabbTree& tree_;
  std::size_t leaf_size_;
  std::vector<Item> items_;
};

AabbTree AabbTree::build(const TriangleMesh& mesh, const Options& options) {
  if (options.leaf_size < 1 || options.leaf_size > 255) {
    throw std::invalid_argument("the leaf size must be 1 to 255, not " + std::to_string(options.leaf_size));
  }
  AabbTree tree;
  tree.options_ = options;
  tree.connectivity_ = Connectivity(mesh);
  tree.certified_ = options.certified;
  tree.triangles_ = prepare(mesh);
  tree.ids_ = mesh.triangle_ids();
  Builder(tree, options.leaf_size).build();
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
    if (far.bound < near.bound) std::swap(near, far);
    stack[count++] = far;
    stack[count++] = near;
  }
  return false;
}

std::optional<Contact> AabbTree::nearest(const Probe& probe, double reach, Session& session) const noexcept {
  const Vec3& center = probe.center;
  if (!(reach >= 0)) return std::nullopt;
  const double difference = largest_difference(bounds(), center);
  const double error = certified_ ? distance_error(difference) : 0, pad = culling_pad(difference);
  Work& work = session.work;
  if (std::isinf(error)) return fallback().nearest(center, reach, work);
  const std::uint64_t budget = work_limit(work);
  ClosestCandidates candidates(triangles_.data(), center, error);
  const auto consider = [&](std::uint32_t i) {
    ++work.triangles;
    candidates.update({squared_distance(triangles_[i], center), triangles_[i].index}, i);
  };
  if (session.last < triangles_.size()) consider(session.last);
  session.last = no_triangle;
  double limit = std::min(reach, std::sqrt(candidates.best().squared_distance)) + error;
  std::array<StackEntry, max_levels> stack;
  std::size_t count = 0;
  stack[count++] = {bound_below(nodes_[0].box, center, pad), 0};
  while (count > 0) {
    if (work.boxes + work.triangles > budget) return fallback().nearest(center, reach, work);
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
    if (far.bound < near.bound) std::swap(near, far);
    stack[count++] = far;
    stack[count++] = near;
  }
  if (candidates.found() && std::sqrt(candidates.best().squared_distance) <= reach)
    session.last = candidates.at();
  return contact_of(candidates, triangles_, center, reach, error, ids_, work, certified_);
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
    if (!(enters(node.box, sweep, padded_radius, first.limit()) <= first.limit())) continue;
    if (node.count == 0) {
      stack[count++] = node.first + 1;
      stack[count++] = node.first;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      ++work.triangles;
      first.consider(triangles_[i], i, work.exact_decisions);
    }
  }
  return impact_of(first, triangles_, ids_, certified_, [&](double reach) {
    return nearest({sweep.from, sweep.radius}, reach, session);
  });
}

std::size_t AabbTree::bytes() const noexcept {
  return nodes_.capacity() * sizeof(Node) + triangles_.capacity() * sizeof(PreparedTriangle) + ids_.bytes();
}

}  // namespace touchmark
