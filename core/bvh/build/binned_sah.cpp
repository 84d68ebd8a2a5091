#include "core/bvh/build/binned_sah.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <iterator>
#include <limits>

#include "core/bvh/build/random_steps.h"
#include "core/bvh/node.h"
#include "core/search/threads/parallel.h"

namespace touchmark::bvh {
namespace {

constexpr std::size_t bins_an_axis = 16;
constexpr float infinity = std::numeric_limits<float>::infinity();

/// Returns half of the area of a box; in any order of the axes.
float half_area(Lanes min, Lanes max) noexcept {
  const Lanes d = simd::max(max - min, Lanes{});
  const Lanes faces = d * __builtin_shufflevector(d, d, 1, 2, 0, 3);
  return faces[0] + faces[1] + faces[2];
}

/// Which bins the numbers are in; what rounding puts beyond the last is in the last.
LaneBits bins_of(Lanes key, Lanes origin, Lanes scale) noexcept {
  constexpr float within_the_last = static_cast<float>(bins_an_axis) - 0.5F;
  return __builtin_convertvector(simd::min((key - origin) * scale, broadcast(within_the_last)), LaneBits);
}

/// The triangles of a bin, or of several.
struct Bin {
  Lanes min = broadcast(infinity), max = broadcast(-infinity);
  std::uint32_t count = 0;

  void add(const Bin& other) noexcept {
    min = simd::min(min, other.min);
    max = simd::max(max, other.max);
    count += other.count;
  }
  /// Blocks times the chance that a search meets them.
  float cost() const noexcept {
    return half_area(min, max) * static_cast<float>((count + width - 1) / width);
  }
};

}  // namespace

TriangleSplitter::TriangleSplitter(const TriangleMesh& mesh, const Clusters& clusters,
                                   const FilterFrame& frame, unsigned threads)
    : own_items_(mesh.size()),
      own_scratch_(mesh.size()),
      own_splits_((mesh.size() + width - 1) / width),
      items_(own_items_),
      scratch_(own_scratch_),
      cluster_keys_(clusters.size() < mesh.size() ? clusters.size() : 0),
      splits_(own_splits_) {
  constexpr std::size_t clusters_a_piece = 1024;
  in_ranges(clusters.size(), clusters_a_piece, threads,
            [&](std::size_t first, std::size_t end) { add_items(mesh, clusters, frame, first, end); });
  split_all(threads);
}

TriangleSplitter::TriangleSplitter(const TriangleMesh& mesh, const FilterFrame& frame, std::uint32_t smallest,
                                   unsigned threads)
    : smallest_(smallest),
      own_items_(mesh.size()),
      own_scratch_(mesh.size()),
      own_splits_((mesh.size() + width - 1) / width),
      items_(own_items_),
      scratch_(own_scratch_),
      splits_(own_splits_) {
  add_items(mesh, frame, threads);
  split_all(threads);
}

TriangleSplitter::TriangleSplitter(const TriangleMesh& mesh, std::span<const std::uint32_t> triangles,
                                   const FilterFrame& frame, Workspace& workspace) noexcept
    : items_(std::span(workspace.items).first(triangles.size())),
      scratch_(workspace.scratch),
      splits_(workspace.splits) {
  for (std::size_t i = 0; i < triangles.size(); ++i)
    items_[i] = item_of(mesh, triangles[i], frame, triangles[i]);
  split_to_smallest(all());
}

void TriangleSplitter::split_all(unsigned threads) {
  split_in_parallel(
      all(), threads, [this](const TriangleRange& range) { return split(range); },
      [this](const TriangleRange& range) { split_to_smallest(range); });
}

TriangleSplitter::Item TriangleSplitter::item_of(const TriangleMesh& mesh, std::uint32_t triangle,
                                                 const FilterFrame& frame, std::uint32_t cluster) noexcept {
  const auto corner = [&](int k) { return frame.to_frame(mesh.corner(triangle, k)).cast<float>().eval(); };
  const Eigen::Vector3f a = corner(0), b = corner(1), c = corner(2);
  const Eigen::Vector3f min = a.cwiseMin(b).cwiseMin(c), max = a.cwiseMax(b).cwiseMax(c);
  return {{min[0], min[1], min[2]}, triangle, {max[0], max[1], max[2]}, cluster};
}

/// Adds all triangles. Corners that triangles share are rounded once.
void TriangleSplitter::add_items(const TriangleMesh& mesh, const FilterFrame& frame, unsigned threads) {
  constexpr std::size_t a_piece = 4096;
  const std::span<const Vec3> vertices = mesh.vertices();
  std::vector<Lanes> rounded(vertices.size());
  in_ranges(vertices.size(), a_piece, threads, [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
      const Eigen::Vector3f at = frame.to_frame(vertices[i]).cast<float>();
      rounded[i] = Lanes{at.x(), at.y(), at.z(), 0};
    }
  });
  in_ranges(mesh.size(), a_piece, threads, [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
      const TriangleMesh::Corners& corners = mesh.triangles()[i];
      const Lanes a = rounded[corners[0]], b = rounded[corners[1]], c = rounded[corners[2]];
      const Lanes min = simd::min(a, simd::min(b, c)), max = simd::max(a, simd::max(b, c));
      const auto triangle = static_cast<std::uint32_t>(i);
      items_[i] = {{min[0], min[1], min[2]}, triangle, {max[0], max[1], max[2]}, triangle};
    }
  });
}

/// Adds the triangles of clusters [first, end), at the places of their cluster.
void TriangleSplitter::add_items(const TriangleMesh& mesh, const Clusters& clusters, const FilterFrame& frame,
                                 std::size_t first, std::size_t end) {
  Item* to = &items_[clusters.first[first]];
  for (auto cluster = static_cast<std::uint32_t>(first); cluster < end; ++cluster) {
    if (!cluster_keys_.empty()) {
      const Eigen::Vector3f center = frame.to_frame(clusters.spheres[cluster].center).cast<float>();
      cluster_keys_[cluster] = 2 * Lanes{center[0], center[1], center[2], 0};
    }
    for (const std::uint32_t triangle : clusters.triangles_of(cluster))
      *to++ = item_of(mesh, triangle, frame, cluster);
  }
}

TriangleSplitter::Box TriangleSplitter::box_of(const Item& item) noexcept {
  static_assert(sizeof(Item) == 2 * sizeof(Lanes));
  constexpr LaneBits coordinates = {-1, -1, -1, 0};
  // One by one: of an array of both the compiler makes a copy in pieces, which takes longer to read than to
  // write.
  LaneBits min, max;
  std::memcpy(&min, reinterpret_cast<const std::byte*>(&item), sizeof min);
  std::memcpy(&max, reinterpret_cast<const std::byte*>(&item) + sizeof min, sizeof max);
  return {reinterpret_cast<Lanes>(min & coordinates), reinterpret_cast<Lanes>(max & coordinates)};
}

Lanes TriangleSplitter::key_of(const Item& item, Key key) const noexcept {
  if (key == Key::cluster) return cluster_keys_[item.cluster];
  const Box box = box_of(item);
  return box.min + box.max;
}

float TriangleSplitter::key_of(const Item& item, Key key, int axis) const noexcept {
  if (key == Key::cluster) return cluster_keys_[item.cluster][axis];
  return item.min[static_cast<std::size_t>(axis)] + item.max[static_cast<std::size_t>(axis)];
}

TriangleSplitter::Bounds TriangleSplitter::bounds_of(const TriangleRange& range) const noexcept {
  Box all = box_of(items_[range.begin]);
  Box middles{all.min + all.max, all.min + all.max};
  RandomSteps steps(mean_step(range));
  for (std::uint32_t i = range.begin; i < range.end; i += steps.next()) {
    const Box box = box_of(items_[i]);
    const Lanes middle = box.min + box.max;
    all = {simd::min(all.min, box.min), simd::max(all.max, box.max)};
    middles = {simd::min(middles.min, middle), simd::max(middles.max, middle)};
  }
  return {all, middles};
}

TriangleSplitter::Box TriangleSplitter::cluster_bounds(const TriangleRange& range) const noexcept {
  Box all{cluster_keys_[items_[range.begin].cluster], cluster_keys_[items_[range.begin].cluster]};
  RandomSteps steps(mean_step(range));
  for (std::uint32_t i = range.begin; i < range.end; i += steps.next()) {
    const Lanes at = cluster_keys_[items_[i].cluster];
    all = {simd::min(all.min, at), simd::max(all.max, at)};
  }
  return all;
}

/// The cheapest of the positions between two bins, by a sample; nothing when all of that is in one bin.
std::optional<TriangleSplitter::Cut> TriangleSplitter::cheapest_cut(const TriangleRange& range, Key key,
                                                                    const Bins& bins) const noexcept {
  std::array<std::array<Bin, bins_an_axis>, 3> bin;
  RandomSteps steps(mean_step(range));
  for (std::uint32_t i = range.begin; i < range.end; i += steps.next()) {
    const LaneBits at = bins_of(key_of(items_[i], key), bins.origin, bins.scale);
    const Box box = box_of(items_[i]);
    for (std::size_t axis = 0; axis < 3; ++axis)
      bin[axis][static_cast<std::size_t>(at[axis])].add({box.min, box.max, 1});
  }
  std::optional<Cut> cheapest;
  float least = infinity;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::array<float, bins_an_axis> right_cost;
    Bin right;
    for (std::size_t b = bins_an_axis - 1; b > 0; --b) {
      right.add(bin[axis][b]);
      right_cost[b] = right.count > 0 ? right.cost() : infinity;
    }
    Bin left;
    for (std::size_t b = 1; b < bins_an_axis; ++b) {
      left.add(bin[axis][b - 1]);
      if (left.count == 0 || !(left.cost() + right_cost[b] < least)) continue;
      least = left.cost() + right_cost[b];
      cheapest = {static_cast<int>(axis), b};
    }
  }
  return cheapest;
}

/// Puts left whatever is less along the axis: by its bin, and then the few that fill a block. Returns where
/// the right begins.
std::uint32_t TriangleSplitter::partition_at(const TriangleRange& range, Key key, const Bins& bins,
                                             const Cut& cut) {
  const float origin = bins.origin[cut.axis], scale = bins.scale[cut.axis];
  // As bins_of has it: what is in the last bin is beyond every cut, so nothing needs to be put there.
  const auto first_bin_right = static_cast<float>(cut.bin);
  Item *left = items_.data() + range.begin, *right = scratch_.data() + range.begin;
  // Each to both sides, and kept on one: which one it is, no branch predictor knows.
  for (std::uint32_t i = range.begin; i < range.end; ++i) {
    const Item item = items_[i];
    const bool is_left = (key_of(item, key, cut.axis) - origin) * scale < first_bin_right;
    *left = item;
    *right = item;
    left += is_left;
    right += !is_left;
  }
  std::copy(scratch_.data() + range.begin, right, left);
  const auto found = static_cast<std::uint32_t>(left - items_.data());
  const std::uint32_t position = range.whole_blocks(found - range.begin);
  const auto less = [&](const Item& a, const Item& b) {
    const float x = key_of(a, key, cut.axis), y = key_of(b, key, cut.axis);
    return x != y ? x < y : a.triangle < b.triangle;
  };
  if (found > position)
    std::partial_sort(std::make_reverse_iterator(left), std::make_reverse_iterator(items_.data() + position),
                      std::make_reverse_iterator(items_.data() + range.begin),
                      [&](const Item& a, const Item& b) { return less(b, a); });
  else
    std::partial_sort(left, items_.data() + position, items_.data() + range.end, less);
  return position;
}

/// Partitions at any position along the axis.
void TriangleSplitter::halve(const TriangleRange& range, std::uint32_t position, Key key, int axis) {
  std::nth_element(items_.begin() + range.begin, items_.begin() + position, items_.begin() + range.end,
                   [&](const Item& a, const Item& b) {
                     const float x = key_of(a, key, axis), y = key_of(b, key, axis);
                     return x != y ? x < y : a.triangle < b.triangle;
                   });
}

std::pair<TriangleRange, TriangleRange> TriangleSplitter::split(const TriangleRange& range) {
  const auto has_extent = [](const Box& box) {
    const Lanes extent = box.max - box.min;
    return extent[0] > 0 || extent[1] > 0 || extent[2] > 0;
  };
  const Bounds bounds = bounds_of(range);
  Key key = Key::triangle;
  Box box = bounds.middles;
  if (!cluster_keys_.empty()) {
    const Box of_clusters = cluster_bounds(range);
    if (has_extent(of_clusters)) {
      key = Key::cluster;
      box = of_clusters;
    }
  }
  const Lanes extent = box.max - box.min;
  // A little less than whole bins, so that the last number is in the last bin.
  const Lanes per_extent = broadcast(static_cast<float>(bins_an_axis) * (1 - 0x1p-20F)) / extent;
  const Bins bins{box.min, extent > Lanes{} ? per_extent : Lanes{}};
  std::optional<Cut> cut;
  if (range.depth < max_uneven_splits) cut = cheapest_cut(range, key, bins);
  std::uint32_t position = range.whole_blocks(range.size() / 2);
  if (cut) {
    position = partition_at(range, key, bins, *cut);
  } else {
    const int longer = extent[1] > extent[0] ? 1 : 0;
    halve(range, position, key, extent[2] > extent[longer] ? 2 : longer);
  }
  splits_[range.number] = {half_area(bounds.all.min, bounds.all.max), position};
  return halves(range);
}

void TriangleSplitter::split_to_smallest(const TriangleRange& range) {
  if (range.size() <= smallest_) return;
  const auto [left, right] = split(range);
  split_to_smallest(left);
  split_to_smallest(right);
}

TriangleRange TriangleSplitter::block_of(TriangleRange range) {
  for (bool takes_left = false; range.size() > width; takes_left = !takes_left) {
    const auto [left, right] = split(range);
    range = takes_left ? left : right;
  }
  return range;
}

std::pair<Lanes, Lanes> TriangleSplitter::box(const TriangleRange& range) const noexcept {
  std::pair<Lanes, Lanes> all{broadcast(infinity), broadcast(-infinity)};
  for (const Item& item : items_.subspan(range.begin, range.size())) {
    const Box one = box_of(item);
    all = {simd::min(all.first, one.min), simd::max(all.second, one.max)};
  }
  return all;
}

std::pair<TriangleRange, TriangleRange> TriangleSplitter::halves(const TriangleRange& range) const noexcept {
  const std::uint32_t middle = splits_[range.number].middle;
  // As many splits as blocks, less one, are on the left.
  const std::uint32_t blocks = (middle - range.begin) / width;
  return {{range.begin, middle, range.depth + 1, range.number + 1},
          {middle, range.end, range.depth + 1, range.number + blocks}};
}

}  // namespace touchmark::bvh
