#include "core/sphere_cluster/tree_split.h"

#include <algorithm>
#include <array>
#include <limits>

#include "core/sphere_cluster/tree_layout.h"
#include "core/sphere_cluster/triangle_spheres.h"

namespace touchmark::spheres {
namespace {

constexpr std::size_t bins = 16;
constexpr float infinity = std::numeric_limits<float>::infinity();

template <class Box>
void extend(Box& box, const Box& other) noexcept {
  box.min = box.min.min(other.min);
  box.max = box.max.max(other.max);
}

template <class Box>
float half_area(const Box& box) noexcept {
  const Eigen::Array3f d = (box.max - box.min).max(0);
  return d.x() * d.y() + d.y() * d.z() + d.z() * d.x();
}

}  // namespace

TriangleSplitter::TriangleSplitter(const TriangleMesh& mesh, const SphereClusters& clusters,
                                   const FilterFrame& frame) {
  const auto local = [&](const Vec3& v) -> Eigen::Array3f {
    return (frame.scale() * (v - frame.origin())).cast<float>().array();
  };
  items_.reserve(mesh.size());
  for (std::size_t cluster = 0; cluster < clusters.size(); ++cluster)
    for (const std::uint32_t triangle : clusters.triangles_of(cluster)) {
      const Eigen::Array3f a = local(mesh.corner(triangle, 0)), b = local(mesh.corner(triangle, 1)),
                           c = local(mesh.corner(triangle, 2));
      items_.push_back({local(clusters.spheres[cluster].center),
                        local(centroid(mesh, triangle)),
                        {a.min(b).min(c), a.max(b).max(c)},
                        triangle});
    }
}

float TriangleSplitter::area(const TriangleRange& range) const noexcept {
  Box box = items_[range.begin].box;
  for (std::uint32_t i = range.begin + 1; i < range.end; ++i) extend(box, items_[i].box);
  return half_area(box);
}

/// Of one of an item's points, over the range.
TriangleSplitter::Box TriangleSplitter::spread(const TriangleRange& range, Point point) const noexcept {
  Box box{items_[range.begin].*point, items_[range.begin].*point};
  for (std::uint32_t i = range.begin + 1; i < range.end; ++i)
    extend(box, Box{items_[i].*point, items_[i].*point});
  return box;
}

/// Left of the place whatever is less along the axis.
void TriangleSplitter::part_at(const TriangleRange& range, std::uint32_t place, Point point, int axis) {
  std::nth_element(items_.begin() + range.begin, items_.begin() + place, items_.begin() + range.end,
                   [&](const Item& a, const Item& b) {
                     const float x = (a.*point)[axis], y = (b.*point)[axis];
                     return x != y ? x < y : a.triangle < b.triangle;
                   });
}

/// The cheapest of the places between two bins; nothing when all of the range is in one bin.
std::optional<TriangleSplitter::Cut> TriangleSplitter::cheapest_cut(const TriangleRange& range, Point point,
                                                                    const Box& box) const noexcept {
  const Eigen::Array3f extent = box.max - box.min;
  const Eigen::Array3f scale =
      (extent > 0).select(static_cast<float>(bins) * (1 - 0x1p-20F) / extent, Eigen::Array3f::Zero());
  struct Bin {
    Box box{Eigen::Array3f::Constant(infinity), Eigen::Array3f::Constant(-infinity)};
    std::uint32_t count = 0;

    void add(const Bin& other) noexcept {
      extend(box, other.box);
      count += other.count;
    }
    /// Blocks times the chance that a search meets them.
    float cost() const noexcept {
      return half_area(box) * static_cast<float>((count + tree_width - 1) / tree_width);
    }
  };
  std::array<std::array<Bin, bins>, 3> bin;
  for (std::uint32_t i = range.begin; i < range.end; ++i) {
    const Eigen::Array3f at = (items_[i].*point - box.min) * scale;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float along = at[static_cast<Eigen::Index>(axis)];
      bin[axis][std::min(static_cast<std::size_t>(along), bins - 1)].add({items_[i].box, 1});
    }
  }
  std::optional<Cut> cheapest;
  float least = infinity;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::array<float, bins> right_cost;
    Bin right;
    for (std::size_t b = bins - 1; b > 0; --b) {
      right.add(bin[axis][b]);
      right_cost[b] = right.count > 0 ? right.cost() : infinity;
    }
    Bin left;
    for (std::size_t b = 1; b < bins; ++b) {
      left.add(bin[axis][b - 1]);
      if (left.count == 0 || !(left.cost() + right_cost[b] < least)) continue;
      least = left.cost() + right_cost[b];
      cheapest = {static_cast<int>(axis), left.count};
    }
  }
  return cheapest;
}

std::pair<TriangleRange, TriangleRange> TriangleSplitter::split(const TriangleRange& range) {
  Point point = &Item::key;
  Box box = spread(range, point);
  if (!((box.max - box.min).maxCoeff() > 0)) {
    point = &Item::center;
    box = spread(range, point);
  }
  std::optional<Cut> cut;
  if (range.depth < most_uneven_splits) cut = cheapest_cut(range, point, box);
  if (!cut) {
    Eigen::Index longest = 0;
    (box.max - box.min).maxCoeff(&longest);
    cut = {static_cast<int>(longest), range.size() / 2};
  }
  // Whole blocks on the left.
  const std::uint32_t blocks = (cut->left + tree_width / 2) / tree_width;
  const std::uint32_t most = (range.size() - 1) / tree_width;
  const std::uint32_t place = range.begin + tree_width * std::clamp(blocks, 1U, most);
  part_at(range, place, point, cut->axis);
  return {{range.begin, place, range.depth + 1}, {place, range.end, range.depth + 1}};
}

}  // namespace touchmark::spheres
