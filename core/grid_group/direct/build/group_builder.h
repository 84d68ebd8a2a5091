/// Makes every triangle's group, at once or after some triangles moved.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/aabb.h"
#include "core/grid_group/direct/build/group_finder.h"
#include "core/grid_group/direct/groups.h"

namespace touchmark::grid {

class GroupBuilder {
 public:
  /// `exclusion_margin`: see GroupFinder. No more than `max_bytes` are taken; triangles that come too late
  /// get no members.
  GroupBuilder(const TriangleStore& store, const BoxTree& tree, double exclusion_margin,
               std::size_t max_bytes, unsigned threads)
      : store_(store),
        tree_(tree),
        exclusion_margin_(exclusion_margin),
        max_bytes_(max_bytes),
        threads_(threads) {}

  Groups build();
  /// None yet, and room for them in so many bytes.
  Groups unbuilt(std::size_t max_bytes) const;
  /// Returns the groups of the same triangles after some moved within these boxes of the frame. With lazy
  /// construction those that changed are unbuilt again.
  Groups rebuild(const Groups& groups, const std::vector<Aabb>& moved);
  /// Did the bytes run out?
  bool ran_out() const noexcept { return ran_out_; }

 private:
  /// Groups of slots that follow one another, found but not stored yet.
  struct Piece {
    struct Found {
      std::uint32_t slot;
      std::uint32_t first, count;  ///< members
      float height, margin;
    };
    std::vector<Found> groups;
    std::vector<std::uint32_t> members;  ///< with the copies behind each group's

    void add(std::uint32_t slot, const GroupFinder::Found& found);
  };

  template <class FindOrKeep>
  Groups make(const FindOrKeep& find_or_keep);
  void store(const Piece& piece);
  bool changes(std::uint32_t slot, const std::vector<Aabb>& moved) const noexcept;

  const TriangleStore& store_;
  const BoxTree& tree_;
  double exclusion_margin_;
  std::size_t max_bytes_;
  unsigned threads_;
  Groups groups_;
  bool ran_out_ = false;
};

}  // namespace touchmark::grid
