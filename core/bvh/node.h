/// How the hierarchy lies in memory: nodes of eight children and blocks of eight triangles, in single
/// precision and as plain arrays, so that one instruction tests several children or triangles.
///
/// Everything is in the tree's frame: the mesh's box centre at 0, its extent near 1 (FilterFrame of
/// core/search/plane_filter/plane_filter.h), so that nothing overflows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/bvh/build/unbuilt_parts.h"
#include "core/geometry/point_triangle.h"
#include "core/search/plane_filter/plane_filter.h"

namespace touchmark::bvh {

inline constexpr std::uint32_t width = 8;

/// A child: a node, or block b of the triangles, those from 8 b on, or a part of the tree that may not be
/// built yet (lazy_builder.h). All blocks are full but the last.
struct ChildRef {
  static constexpr std::uint32_t block_bit = 0x80000000U, part_bit = 0x40000000U;
  std::uint32_t bits;

  bool is_block() const noexcept { return (bits & block_bit) != 0; }
  bool is_part() const noexcept { return (bits & part_bit) != 0; }
  std::uint32_t index() const noexcept { return bits & ~(block_bit | part_bit); }
};

/// The bounding volumes of children, and the children. In a tree of boxes (Parts::boxes) a volume is a box
/// along the axes. Else it is a cylinder: the points within `radius` of the axis through the centre along
/// `normal`, and within `half_height` of the centre along it. A patch of a surface is as flat as a coin or as
/// long as a rod, and fills such a cylinder better than a sphere.
template <std::uint32_t Count>
class alignas(64) Children {
 public:
  /// The numbers of a volume, each in a row of its own.
  static constexpr std::size_t rows = 8;
  float* row(std::size_t k) noexcept { return numbers_[k]; }
  const float* row(std::size_t k) const noexcept { return numbers_[k]; }

  // These are the centres.
  const float* x() const noexcept { return numbers_[0]; }
  const float* y() const noexcept { return numbers_[1]; }
  const float* z() const noexcept { return numbers_[2]; }
  // Only cylinders have these.
  const float* radius() const noexcept { return numbers_[3]; }
  const float* normal_x() const noexcept { return numbers_[4]; }
  const float* normal_y() const noexcept { return numbers_[5]; }
  const float* normal_z() const noexcept { return numbers_[6]; }
  const float* half_height() const noexcept { return numbers_[last]; }
  // Only boxes have these, half of their extents.
  const float* half_x() const noexcept { return numbers_[last]; }
  const float* half_y() const noexcept { return numbers_[3]; }
  const float* half_z() const noexcept { return numbers_[4]; }

  bool is_empty(std::size_t i) const noexcept { return !(numbers_[last][i] >= 0); }
  void set_cylinder(std::size_t i, const Eigen::Vector3f& center, float radius, const Eigen::Vector3f& normal,
                    float half_height) noexcept {
    set(i, {center.x(), center.y(), center.z(), radius, normal.x(), normal.y(), normal.z(), half_height});
  }
  void set_box(std::size_t i, const Eigen::Vector3f& center, const Eigen::Vector3f& half) noexcept {
    set(i, {center.x(), center.y(), center.z(), half.y(), half.z(), 0, 0, half.x()});
  }
  /// Puts nothing there, infinitely far away.
  void clear(std::size_t i) noexcept {
    set(i, {0, 0, 0, 0, 0, 0, 0, -std::numeric_limits<float>::infinity()});
    child[i] = {0};
  }
  /// Puts a child there whose volume is still to be set.
  void set_child(std::size_t i, ChildRef ref) noexcept {
    child[i] = ref;
    numbers_[last][i] = 0;
  }

 private:
  static constexpr std::size_t last = rows - 1;

  void set(std::size_t i, const std::array<float, rows>& numbers) noexcept {
    for (std::size_t k = 0; k < rows; ++k) numbers_[k][i] = numbers[k];
  }

  float numbers_[rows][Count];

 public:
  ChildRef child[Count];
};
using Node = Children<width>;

/// Eight triangles as planes (TrianglePlanes): plane k of triangle i has the value
/// x[k][i] px + y[k][i] py + z[k][i] pz + offset[k][i] at p. What fills up the last block is infinitely far.
struct alignas(64) TriangleBlock {
  float x[4][width], y[4][width], z[4][width], offset[4][width];

  /// Takes the planes of triangle i out of the eight lines that they are spread over.
  TrianglePlanes planes(std::uint32_t i) const noexcept {
    TrianglePlanes planes;
    for (int k = 0; k < 4; ++k) {
      planes.x[k] = x[k][i];
      planes.y[k] = y[k][i];
      planes.z[k] = z[k][i];
      planes.offset[k] = offset[k][i];
    }
    return planes;
  }
};

/// Leaves elements as they are until they are set: most memory of a tree that is built lazily is not touched
/// before a query is there.
template <class T>
struct UnsetAllocator : std::allocator<T> {
  template <class Other>
  struct rebind {
    using other = UnsetAllocator<Other>;
  };
  /// Does nothing: a type without a destructor, all of whose members are set before they are read, needs
  /// nothing.
  template <class U>
  void construct(U*) noexcept {
    static_assert(std::is_trivially_destructible_v<U>);
  }
  template <class U, class... Arguments>
  void construct(U* at, Arguments&&... arguments) {
    ::new (static_cast<void*>(at)) U(std::forward<Arguments>(arguments)...);
  }
};
template <class T>
using UnsetVector = std::vector<T, UnsetAllocator<T>>;

struct Parts {
  UnbuiltParts unbuilt;     ///< comes first: a copy has what was built when it began
  UnsetVector<Node> nodes;  ///< the root comes first
  UnsetVector<TriangleBlock> blocks;
  UnsetVector<PreparedTriangle> triangles;  ///< in the order of the blocks
  bool boxes = false;                       ///< true: children are bounded by boxes instead of cylinders
  /// From so far on, squared, a closer look at corners pays: many triangles are nearly as near.
  float far = std::numeric_limits<float>::infinity();
};

}  // namespace touchmark::bvh
