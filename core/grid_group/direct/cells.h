/// Uniform cells over the mesh's box, each naming a triangle near its middle.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/bvh/wide_bvh.h"
#include "core/search/memory/lazy_construction.h"

namespace touchmark::grid {

class Cells {
 public:
  static constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();

  Cells() = default;
  /// Cells of this edge, 0: as many as triangles; larger ones where they would take more bytes than that.
  Cells(const Aabb& bounds, double edge, std::size_t triangles, std::size_t max_bytes);

  /// Looks for what is near each of them.
  void fill(const WideBvh& bvh, unsigned threads);
  /// Forgets all that they name.
  void clear() noexcept;
  /// Names this slot where nothing is named yet. Any thread may.
  void name(const Vec3& center, std::uint32_t slot) const noexcept;

  /// Returns the slot of a triangle near the middle of the cell that a point lies in; nowhere where there is
  /// none. The point must be finite.
  std::uint32_t at(const Vec3& center) const noexcept {
    const std::size_t number = number_of(center);
    return number < slots_.size() ? slots_[number].load() : nowhere;
  }
  double edge() const noexcept { return edge_; }  ///< mesh units
  bool coarsened() const noexcept { return coarsened_; }
  std::size_t bytes() const noexcept { return slots_.capacity() * sizeof(std::uint32_t); }
  Aabb box_of(const Vec3& center) const noexcept;

 private:
  /// Numbers of cells along the axes.
  using Numbers = std::array<std::size_t, 3>;
  /// Returns how many there are where the point is in none.
  std::size_t number_of(const Vec3& center) const noexcept;
  Vec3 middle_of(std::size_t number) const noexcept;

  Vec3 origin_ = Vec3::Zero();  ///< one cell beyond the box
  double edge_ = 0;
  Numbers counts_{};
  std::vector<SharedValue<std::uint32_t>> slots_;
  bool coarsened_ = false;
};

}  // namespace touchmark::grid
