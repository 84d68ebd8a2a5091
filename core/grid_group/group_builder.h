/// Finds every triangle's group.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/geometry/aabb.h"
#include "core/grid_group/box_tree.h"
#include "core/grid_group/groups.h"
#include "core/grid_group/prism.h"
#include "core/grid_group/triangle_store.h"

namespace touchmark::grid {

class GroupBuilder {
 public:
  /// `lead`: by how much, in the frame, a triangle must lose to be left out. No more than `most_bytes` are
  /// taken; triangles that come too late get no members.
  GroupBuilder(const TriangleStore& store, const BoxTree& tree, double lead, std::size_t most_bytes)
      : store_(store), tree_(tree), lead_(lead), most_bytes_(most_bytes) {}

  Groups build();
  /// Of the triangles of these groups, after some moved within these boxes of the frame.
  Groups rebuild(const Groups& groups, const std::vector<Aabb>& moved);
  /// Did the bytes run out?
  bool ran_out() const noexcept { return ran_out_; }

 private:
  void start();
  void add_group(std::uint32_t place);
  void keep_group(const Groups& groups, std::uint32_t place);
  /// Leaves the members of the highest prism with no more than many, or of the lowest; none when the mesh is
  /// too dense there. Returns the prism's height.
  double find_members(const Footprint& footprint);
  /// Makes near_ hold every triangle that reaches into the box, or says that they are too many.
  bool gather(const Aabb& box);
  bool gather_blocks(const Aabb& box);
  void select_members(const Prism& prism);

  const TriangleStore& store_;
  const BoxTree& tree_;
  double lead_;
  std::size_t most_bytes_;
  Groups groups_;
  bool ran_out_ = false;

  /// Neighbours in the order are neighbours in space, so what was gathered for one serves the next.
  Aabb gathered_;
  std::vector<std::uint32_t> near_;
  std::vector<float> near_x_, near_y_, near_z_, near_radius_;  ///< their balls
  std::vector<std::uint32_t> members_;
};

}  // namespace touchmark::grid
