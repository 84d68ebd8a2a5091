/// A tree of boxes over bodies that come, go and move: a broad phase.
///
/// Each node has up to sixteen children, whose boxes are compared at once, and all bodies are at one depth,
/// as in the R-tree of Guttman (1984): no search needs a stack deeper than log2 of the bodies. Each body's
/// box may be padded, so that most moves change nothing. One that has left its box is taken out and put in
/// where boxes grow least. Boxes are in single precision, rounded outward, about an origin of their own.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <vector>

#include "core/aabb.h"
#include "core/probe.h"
#include "core/scene/body_tree/body_tree_node.h"
#include "core/simd/dispatch.h"

namespace touchmark {

class BodyTree {
 public:
  /// Puts the body in, in a box that holds these bounds and `margin` on every side.
  void insert(std::uint32_t body, const Aabb& bounds, double margin);
  void remove(std::uint32_t body) noexcept;
  /// Returns by how much the body's box exceeds these bounds on every side, rounded down; less than 0 or no
  /// number where it does not hold them. Then it must be taken out and put in again.
  double room(std::uint32_t body, const Aabb& bounds) const noexcept;
  /// Puts the body in, in the box that it has in another tree.
  void insert_as_in(std::uint32_t body, const BodyTree& other);
  std::size_t bytes() const noexcept {
    return places_.capacity() * sizeof(Place) + nodes_.capacity() * sizeof(Node);
  }
  /// Takes the memory for so many bodies ahead.
  void reserve(std::size_t bodies);

  /// Calls visit(body) for every body whose box is within `limit` of the region, nearer boxes of a node
  /// first, and goes on with the limit that it returns. Returns how many boxes were looked at.
  template <class Visit>
  std::uint64_t for_each_within(const Aabb& region, double limit, Visit&& visit) const noexcept {
    return walk(region, limit, visit_of(visit));
  }
  /// Does so about a point, in fewer steps.
  template <class Visit>
  std::uint64_t for_each_within(const Vec3& point, double limit, Visit&& visit) const noexcept {
    return walk(point, limit, visit_of(visit));
  }

 private:
  using Node = body_tree::Node;
  using Ref = body_tree::Ref;
  static constexpr Ref none = body_tree::none;
  static constexpr std::uint32_t width = body_tree::width, fewest = body_tree::fewest;
  /// When a node is split, each half gets so many at least.
  static constexpr std::uint32_t min_of_split = 3;

  struct Box {
    std::array<float, 3> min, max;

    friend bool operator==(const Box&, const Box&) = default;
  };
  /// A node and which of its children.
  struct Place {
    Ref packed = 0;

    Ref node() const noexcept { return packed / width; }
    std::uint32_t slot() const noexcept { return packed % width; }
  };
  struct Entry {
    Box box;
    Ref ref;
  };

  /// What for_each_within does: compiled here, so that no program's flags change what it computes.
  std::uint64_t walk(const Aabb& region, double limit, const body_tree::Visit& visit) const noexcept;
  std::uint64_t walk(const Vec3& point, double limit, const body_tree::Visit& visit) const noexcept;
  template <class Visit>
  static body_tree::Visit visit_of(Visit& visit) noexcept {
    return {&visit,
            [](void* object, std::uint32_t body) noexcept { return (*static_cast<Visit*>(object))(body); }};
  }
  static Box united(const Box& a, const Box& b) noexcept;
  static float half_area(const Box& box) noexcept;
  static Box box_of(const Node& node, std::uint32_t slot) noexcept;
  Box box_of(std::uint32_t body) const noexcept {
    return box_of(nodes_[places_[body].node()], places_[body].slot());
  }
  /// Returns the box of all children.
  static Box box_of_all(const Node& node) noexcept;
  static void set_box(Node& node, std::uint32_t slot, const Box& box) noexcept;
  Box rounded_outward(const Aabb& bounds) const noexcept;

  void make_room_for(std::uint32_t body);
  Ref take_node(std::uint8_t level) noexcept;
  void give_back(Ref node) noexcept;
  /// Puts a body in, in this box.
  void link(std::uint32_t body, const Box& box);
  /// Returns the node above bodies whose boxes this one lets grow least.
  Ref node_for(const Box& box) const noexcept;
  /// Makes the entry this child of the node, and tells the child.
  void put(Ref node, std::uint32_t slot, const Entry& entry) noexcept;
  void append(Ref node, const Entry& entry) noexcept { put(node, nodes_[node].count++, entry); }
  /// Takes a child out; the last one takes its slot.
  void take_out(Ref node, std::uint32_t slot) noexcept;
  /// Adds a child, splitting nodes up to the root where they are full.
  void add(Ref node, Entry entry) noexcept;
  /// Leaves some of the node's children and this one in the node; the others are those of a new node, which
  /// is returned.
  Ref split(Ref node, const Entry& added) noexcept;
  /// Brings the boxes above the node up to date.
  void update_above(Ref node) noexcept;
  /// Gives the only child of a node to a sibling, or the node a sibling's.
  void join(Ref node) noexcept;

  std::vector<Place> places_;  ///< by body
  std::vector<Node> nodes_;
  Ref free_ = none;  ///< the first unused node; each names the next as its parent
  std::size_t free_count_ = 0;
  Ref root_ = none;
  std::optional<Vec3> origin_;  ///< the middle of the first body that was put in
  bool is_wide_ = widest_simd() != Simd::portable;
};

}  // namespace touchmark
