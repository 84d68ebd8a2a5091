#include "core/sign/triangle_tree.h"

#include <algorithm>
#include <cstddef>

namespace touchmark::sign {
namespace {

constexpr std::size_t leaf_size = 4;

Vec3 middle_of(const TriangleCorners& t) noexcept {
  return (1.0 / 3) * t[0] + (1.0 / 3) * t[1] + (1.0 / 3) * t[2];
}

}  // namespace

/// Halves at the median of the longest axis.
class TriangleTree::Builder {
 public:
  Builder(TriangleTree& tree, const TriangleMesh& mesh) : tree_(tree) {
    keys_.reserve(mesh.size());
    for (std::uint32_t t = 0; t < mesh.size(); ++t) {
      const TriangleCorners corner = {mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)};
      keys_.push_back({middle_of(corner), {corner, t}});
    }
  }

  void build() {
    tree_.nodes_.reserve(keys_.size() / 2 + 1);
    split(0, keys_.size());
    tree_.nodes_.shrink_to_fit();
    tree_.items_.reserve(keys_.size());
    for (const Key& key : keys_) tree_.items_.push_back(key.item);
  }

 private:
  struct Key {
    Vec3 middle;
    Item item;
  };

  void split(std::size_t begin, std::size_t end) {
    const std::size_t index = tree_.nodes_.size();
    tree_.nodes_.emplace_back();
    Aabb middles;
    for (std::size_t i = begin; i < end; ++i) {
      middles.extend(keys_[i].middle);
      for (const Vec3& corner : keys_[i].item.corner) tree_.nodes_[index].box.extend(corner);
    }
    if (end - begin <= leaf_size) {
      tree_.nodes_[index].first = static_cast<std::uint32_t>(begin);
      tree_.nodes_[index].count = static_cast<std::uint32_t>(end - begin);
      return;
    }
    int axis = 0;
    middles.extent().maxCoeff(&axis);
    const std::size_t half = begin + (end - begin) / 2;
    const auto at = [&](std::size_t i) { return keys_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(half), at(end),
                     [axis](const Key& a, const Key& b) { return a.middle[axis] < b.middle[axis]; });
    split(begin, half);
    tree_.nodes_[index].first = static_cast<std::uint32_t>(tree_.nodes_.size());
    split(half, end);
  }

  TriangleTree& tree_;
  std::vector<Key> keys_;
};

TriangleTree::TriangleTree(const TriangleMesh& mesh) { Builder(*this, mesh).build(); }

}  // namespace touchmark::sign
