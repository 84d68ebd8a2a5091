#include "bench/oracle/triangle_tree.h"

#include <cmath>
#include <future>
#include <limits>

#include "bench/oracle/exact/interval_distance.h"
#include "bench/oracle/float_limits.h"

namespace touchmark::bench::oracle {
namespace {

constexpr std::uint32_t leaf_size = 8;
constexpr double down = 1 - 8 * unit_roundoff;
constexpr double up = 1 + 8 * unit_roundoff;

/// The length of a vector of components >= 0, each of them off by one rounding, rounded down. Differences,
/// squares, sums and the root make less than 5 roundings, all relative.
double length_below(const Vec3& excess) noexcept {
  const double squared = excess.squaredNorm();
  if (squared > 0x1p-900 && squared < std::numeric_limits<double>::infinity())
    return std::sqrt(squared) * down;
  // Squares that left the range: the largest component alone is not above the length either.
  return std::min(excess.maxCoeff(), std::numeric_limits<double>::max()) * down;
}

/// Returns the length of `excess`, rounded up.
double length_above(const Vec3& excess) noexcept {
  const double squared = excess.squaredNorm();
  if (squared > 0x1p-900) return std::sqrt(squared) * up;
  constexpr double root_of_three = 1.7320508075688774;
  return excess.maxCoeff() * (root_of_three * up) + std::numeric_limits<double>::denorm_min();
}

std::uint32_t leaves(std::uint32_t triangles) noexcept {
  return triangles / leaf_size + (triangles % leaf_size != 0);
}

}  // namespace

double distance_below(const Box& box, const Vec3& point) noexcept {
  return length_below((box.min - point).cwiseMax(point - box.max).cwiseMax(0));
}

double distance_of_boxes_below(const Box& box, const Vec3& from, const Vec3& to) noexcept {
  const Vec3 low = from.cwiseMin(to), high = from.cwiseMax(to);
  return length_below((box.min - high).cwiseMax(low - box.max).cwiseMax(0));
}

double distance_below(const Box& box, const Vec3& from, const Vec3& to) noexcept {
  const double from_box = distance_of_boxes_below(box, from, to);
  // The box of a path that is no longer than this one holds little more than the path.
  if ((to - from).cwiseAbs().maxCoeff() <= (box.max - box.min).maxCoeff()) return from_box;
  // Else its own box says little: measure to a ball around the box instead.
  const Vec3 center = 0.5 * box.min + 0.5 * box.max;
  const double radius = length_above((box.max - center).cwiseMax(center - box.min));
  const Interval to_center = segment_distance_interval(from, to, {center, center, center});
  const double from_ball = (to_center.lo - radius) * down;
  return from_ball > from_box ? from_ball : from_box;
}

/// A triangle and its centroid in units of the mesh's extent. Only the shape of the tree depends on it.
struct TriangleTree::Key {
  std::array<float, 3> centroid;
  std::uint32_t triangle;
};

TriangleTree::TriangleTree(const TriangleMesh& mesh) {
  const auto size = static_cast<std::uint32_t>(mesh.size());
  Vec3 low = mesh.corner(0, 0), high = low;
  for (std::uint32_t i = 0; i < size; ++i) {
    for (const Vec3& v : triangle_of(mesh, i)) {
      low = low.cwiseMin(v);
      high = high.cwiseMax(v);
    }
  }
  // A quarter of every coordinate, since a difference of whole ones may overflow.
  const double extent = std::max((0.25 * high - 0.25 * low).maxCoeff(), std::numeric_limits<double>::min());
  std::vector<Key> keys(size);
  for (std::uint32_t i = 0; i < size; ++i) {
    const Triangle t = triangle_of(mesh, i);
    const Vec3 centroid = (0.25 / 3) * t[0] + (0.25 / 3) * t[1] + (0.25 / 3) * t[2];
    const Vec3 relative = (centroid - 0.25 * low) / extent;
    keys[i].triangle = i;
    for (std::size_t k = 0; k < 3; ++k)
      keys[i].centroid[k] = static_cast<float>(relative[static_cast<Eigen::Index>(k)]);
  }
  nodes_.resize(2 * std::size_t{leaves(size)} - 1);
  order_.resize(size);
  build(mesh, keys, 0, size, 0, 0);
}

Box TriangleTree::leaf_box(const TriangleMesh& mesh, std::uint32_t begin, std::uint32_t end) const {
  Box box{mesh.corner(order_[begin], 0), mesh.corner(order_[begin], 0)};
  for (std::uint32_t i = begin; i < end; ++i) {
    for (const Vec3& v : triangle_of(mesh, order_[i])) {
      box.min = box.min.cwiseMin(v);
      box.max = box.max.cwiseMax(v);
    }
  }
  return box;
}

void TriangleTree::build(const TriangleMesh& mesh, std::vector<Key>& keys, std::uint32_t begin,
                         std::uint32_t end, std::uint32_t node, int depth) {
  const std::uint32_t all = leaves(end - begin);
  if (all == 1) {
    for (std::uint32_t i = begin; i < end; ++i) order_[i] = keys[i].triangle;
    nodes_[node] = {leaf_box(mesh, begin, end), begin, end - begin};
    return;
  }
  std::array<float, 3> low = keys[begin].centroid, high = low;
  for (std::uint32_t i = begin; i < end; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], keys[i].centroid[k]);
      high[k] = std::max(high[k], keys[i].centroid[k]);
    }
  }
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
  // Full leaves on the left: the number of nodes below is known before they are built.
  const std::uint32_t left = all / 2, middle = begin + left * leaf_size;
  std::nth_element(keys.begin() + begin, keys.begin() + middle, keys.begin() + end,
                   [axis](const Key& a, const Key& b) { return a.centroid[axis] < b.centroid[axis]; });
  const std::uint32_t first = node + 1, second = node + 2 * left;
  constexpr int parallel_depth = 3;
  constexpr std::uint32_t worth_a_thread = 50000;
  if (depth < parallel_depth && end - begin > worth_a_thread) {
    auto other =
        std::async(std::launch::async, [&, depth] { build(mesh, keys, begin, middle, first, depth + 1); });
    build(mesh, keys, middle, end, second, depth + 1);
    other.get();
  } else {
    build(mesh, keys, begin, middle, first, depth + 1);
    build(mesh, keys, middle, end, second, depth + 1);
  }
  nodes_[node] = {{nodes_[first].box.min.cwiseMin(nodes_[second].box.min),
                   nodes_[first].box.max.cwiseMax(nodes_[second].box.max)},
                  second,
                  0};
}

}  // namespace touchmark::bench::oracle
