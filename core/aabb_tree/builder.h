/// Builds the tree of boxes, by any number of threads.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <vector>

#include "core/aabb.h"
#include "core/aabb_tree/aabb_tree.h"
#include "core/geometry/point_triangle.h"
#include "core/search/threads/parallel.h"
#include "core/triangle_mesh.h"

namespace touchmark {

inline double half_area(const Aabb& box) noexcept {
  if (box.empty()) return 0;
  const Vec3 e = box.extent();
  return e.x() * e.y() + e.y() * e.z() + e.z() * e.x();
}

/// Splits top down where the sum of area times triangles is least over sixteen planes an axis (MacDonald &
/// Booth, "Heuristics for ray tracing using space subdivision", 1990).
class AabbTree::Builder {
 public:
  Builder(const TriangleMesh& mesh, std::size_t leaf_size, unsigned threads)
      : mesh_(mesh), leaf_size_(leaf_size), threads_(threads), items_(mesh.size()) {
    in_ranges(mesh.size(), triangles_a_piece, threads_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        Item& item = items_[i];
        for (int k = 0; k < 3; ++k) item.box.extend(mesh_.corner(i, k));
        item.center = item.box.center();
        item.triangle = static_cast<std::uint32_t>(i);
      }
    });
  }

  void build(AabbTree& tree) {
    split_top();
    tree.nodes_.reserve(items_.size());
    tree.nodes_.emplace_back();
    put_together(0, 0, tree.nodes_);
    tree.nodes_.shrink_to_fit();
    tree.triangles_.resize(items_.size());
    in_ranges(items_.size(), triangles_a_piece, threads_, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) tree.triangles_[i] = prepare(mesh_, items_[i].triangle);
    });
  }

 private:
  struct Item {
    Aabb box;
    Vec3 center;
    std::uint32_t triangle;
  };
  struct Range {
    std::size_t begin, end, level;
    std::size_t size() const noexcept { return end - begin; }
  };
  struct Split {
    Aabb box;
    std::size_t middle;
  };
  /// A part of the tree that one thread makes: a node that two others follow, or all below one.
  struct Part {
    Range range;
    Aabb box;               ///< only in a part that is a node
    std::size_t child = 0;  ///< the first of two parts that follow it; 0: all is in `nodes`
    std::vector<Node> nodes;
  };
  static constexpr std::size_t bins = 16;
  static constexpr std::size_t triangles_a_piece = 1024;

  /// Splits where it pays to leave the halves to several threads. One thread makes a single part.
  void split_top() {
    constexpr std::size_t parts_a_thread = 16;
    const std::size_t small = threads_ > 1
                                  ? std::max(items_.size() / (parts_a_thread * threads_), triangles_a_piece)
                                  : items_.size();
    parts_.push_back({{0, items_.size(), 0}, {}, 0, {}});
    for (std::size_t first = 0; first < parts_.size();) {
      const std::size_t end = parts_.size();
      std::vector<std::size_t> middle(end - first, 0);
      in_parallel(end - first, threads_, [&](unsigned, std::size_t i) {
        Part& part = parts_[first + i];
        if (part.range.size() <= small || part.range.size() <= leaf_size_) {
          part.nodes.emplace_back();
          split_to_leaves(0, part.range, part.nodes);
        } else {
          const Split found = split(part.range);
          part.box = found.box;
          middle[i] = found.middle;
        }
      });
      for (std::size_t i = first; i < end; ++i) {
        const std::size_t at = middle[i - first];
        if (at == 0) continue;
        const Range range = parts_[i].range;
        parts_[i].child = parts_.size();
        parts_.push_back({{range.begin, at, range.level + 1}, {}, 0, {}});
        parts_.push_back({{at, range.end, range.level + 1}, {}, 0, {}});
      }
      first = end;
    }
  }

  /// Writes a part's node at its place and what is below it at the end, as if one thread had made all.
  void put_together(std::size_t number, std::uint32_t at, std::vector<Node>& nodes) const {
    const Part& part = parts_[number];
    const auto end = static_cast<std::uint32_t>(nodes.size());
    if (part.child == 0) {
      // Node k of the part, from 1 on, is put at the end and k - 1.
      const auto placed = [&](Node node) {
        if (node.count == 0) node.first += end - 1;
        return node;
      };
      nodes[at] = placed(part.nodes.front());
      std::transform(part.nodes.begin() + 1, part.nodes.end(), std::back_inserter(nodes), placed);
      return;
    }
    nodes.resize(end + 2);
    nodes[at].box = part.box;
    nodes[at].first = end;
    put_together(part.child, end, nodes);
    put_together(part.child + 1, end + 1, nodes);
  }

  void split_to_leaves(std::uint32_t node, const Range& range, std::vector<Node>& nodes) {
    if (range.size() <= leaf_size_) {
      for (std::size_t i = range.begin; i < range.end; ++i) nodes[node].box.extend(items_[i].box);
      nodes[node].first = static_cast<std::uint32_t>(range.begin);
      nodes[node].count = static_cast<std::uint32_t>(range.size());
      return;
    }
    const auto [box, middle] = split(range);
    const auto child = static_cast<std::uint32_t>(nodes.size());
    nodes[node].box = box;
    nodes[node].first = child;
    nodes.resize(child + 2);
    split_to_leaves(child, {range.begin, middle, range.level + 1}, nodes);
    split_to_leaves(child + 1, {middle, range.end, range.level + 1}, nodes);
  }

  Split split(const Range& range) {
    const auto [begin, end, level] = range;
    Aabb box, centers;
    for (std::size_t i = begin; i < end; ++i) {
      box.extend(items_[i].box);
      centers.extend(items_[i].center);
    }
    std::size_t middle = level < halving_level ? partition_by_area(begin, end, centers) : begin;
    if (middle == begin || middle == end) middle = halve(begin, end, centers);
    return {box, middle};
  }

  std::size_t partition_by_area(std::size_t begin, std::size_t end, const Aabb& centers) {
    double least = std::numeric_limits<double>::infinity();
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

  const TriangleMesh& mesh_;
  std::size_t leaf_size_;
  unsigned threads_;
  std::vector<Item> items_;
  std::vector<Part> parts_;  ///< the whole tree's comes first
};

}  // namespace touchmark
