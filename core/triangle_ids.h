/// The ids by which a mesh's file calls its triangles.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "core/probe.h"

namespace touchmark {

/// By the triangle's index in the mesh. Nothing is stored where triangle i has id i.
class TriangleIds {
 public:
  TriangleIds() = default;
  explicit TriangleIds(std::vector<TriangleId> ids) noexcept : ids_(std::move(ids)) {}

  TriangleId operator[](std::size_t index) const noexcept {
    return ids_.empty() ? static_cast<TriangleId>(index) : ids_[index];
  }
  /// Returns all ids, or nothing where triangle i has id i.
  std::span<const TriangleId> stored() const noexcept { return ids_; }
  std::size_t bytes() const noexcept { return ids_.capacity() * sizeof(TriangleId); }

 private:
  std::vector<TriangleId> ids_;
};

}  // namespace touchmark
