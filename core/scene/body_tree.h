/// A binary tree of boxes over bodies that come, go and move: a broad phase.
///
/// Each body's box is padded, so that most moves change nothing but a comparison. A body that has left its
/// box is taken out and put in where that costs least (surface areas, as Omohundro's and Box2D's trees do),
/// and rotations keep the heights of siblings within one of each other, so that no tree is deeper than 1.45
/// log2 of its leaves and a search needs a stack of that. Boxes are in single precision, rounded outward,
/// about an origin of their own: 64 bytes a body in all.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <type_traits>
#include <vector>

#include "core/aabb.h"
#include "core/probe.h"

namespace touchmark {

class BodyTree {
 public:
  /// Puts the body in, in a box that holds these bounds and `margin` on every side.
  void insert(std::uint32_t body, const Aabb& bounds, double margin);
  void remove(std::uint32_t body) noexcept;
  /// Does the body's box hold these bounds? Else it must be taken out and put in again.
  bool holds(std::uint32_t body, const Aabb& bounds) const noexcept;
  /// Puts the body in, in the box that it has in another tree.
  void insert_as_in(std::uint32_t body, const BodyTree& other);
  /// Has the body the box that it has in another tree? It must be in both.
  bool is_as_in(std::uint32_t body, const BodyTree& other) const noexcept {
    return leaves_[body].box == other.leaves_[body].box;
  }
  std::size_t bytes() const noexcept {
    return leaves_.capacity() * sizeof(Leaf) + nodes_.capacity() * sizeof(Node);
  }
  /// Takes the memory for so many bodies ahead.
  void reserve(std::size_t bodies);
  int height() const noexcept { return root_ == none ? 0 : height_of(root_); }

  /// Calls visit(body) for every body whose box is within `limit` of the region, nearer boxes of two first,
  /// and goes on with the limit that it returns. Returns how many boxes were looked at.
  template <class Visit>
  std::uint64_t for_each_within(const Aabb& region, double limit, Visit&& visit) const noexcept {
    return walk(region, limit, &visit, [](void* object, std::uint32_t body) noexcept {
      return (*static_cast<std::remove_reference_t<Visit>*>(object))(body);
    });
  }

 private:
  using Ref = std::uint32_t;  ///< an inner node, or a leaf with the top bit set
  static constexpr Ref none = std::numeric_limits<Ref>::max();
  static constexpr Ref leaf_bit = Ref{1} << 31;
  static constexpr std::size_t max_height = 64;  ///< 1.45 * 31 and more

  struct Box {
    std::array<float, 3> min, max;

    friend bool operator==(const Box&, const Box&) = default;
  };
  struct Leaf {
    Box box;
    Ref parent = none;
  };
  struct Node {
    Box box;
    Ref parent = none;
    std::array<Ref, 2> child{};
    std::int32_t height = 1;  ///< a leaf's is 0
  };
  class Region;

  /// What for_each_within does: compiled here, so that no program's flags change what it computes.
  std::uint64_t walk(const Aabb& region, double limit, void* object,
                     double (*visit)(void*, std::uint32_t) noexcept) const noexcept;
  static bool is_leaf(Ref ref) noexcept { return (ref & leaf_bit) != 0; }
  static std::uint32_t body_of(Ref leaf) noexcept { return leaf & ~leaf_bit; }
  const Box& box(Ref ref) const noexcept {
    return is_leaf(ref) ? leaves_[body_of(ref)].box : nodes_[ref].box;
  }
  Ref& parent(Ref ref) noexcept { return is_leaf(ref) ? leaves_[body_of(ref)].parent : nodes_[ref].parent; }
  int height_of(Ref ref) const noexcept { return is_leaf(ref) ? 0 : nodes_[ref].height; }
  static Box united(const Box& a, const Box& b) noexcept;
  static float half_area(const Box& box) noexcept;
  Box rounded_outward(const Aabb& bounds) const noexcept;
  Ref sibling_for(const Box& box) const noexcept;
  Ref take_node();
  /// Puts in the leaf, whose box is set.
  void link(std::uint32_t body);
  /// Makes `to` a child of the parent in place of `from`; of no parent the root.
  void replace_child(Ref of_parent, Ref from, Ref to) noexcept;
  void update(Ref node) noexcept;
  /// Updates and balances from this node to the root.
  void repair(Ref node) noexcept;
  Ref balanced(Ref node) noexcept;
  Ref rotate(Ref node, std::size_t high) noexcept;

  std::vector<Leaf> leaves_;  ///< by body
  std::vector<Node> nodes_;
  Ref free_ = none;  ///< the first unused node; each names the next as its parent
  Ref root_ = none;
  std::optional<Vec3> origin_;  ///< the middle of the first body that was put in
};

}  // namespace touchmark
