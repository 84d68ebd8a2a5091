#include "core/search/ties/shared_corner.h"

#include <cstddef>

namespace touchmark {

void SharedCorner::look_at(const PreparedTriangle& triangle, const Vec3& point, const Vec3& offset,
                           double margin) noexcept {
  offset_ = &offset;
  margin_ = margin;
  for (std::size_t i = 0; i < 3; ++i)
    if (point - triangle.corner[i] == offset && is_behind(triangle, i)) corner_ = &triangle.corner[i];
}

/// Are the other two corners behind the plane through this one across the offset?
bool SharedCorner::is_behind(const PreparedTriangle& triangle, std::size_t corner) const noexcept {
  const Vec3& at = triangle.corner[corner];
  const Vec3 &next = triangle.corner[corner == 2 ? 0 : corner + 1],
             &last = triangle.corner[corner == 0 ? 2 : corner - 1];
  return offset_->dot(next - at) < -margin_ && offset_->dot(last - at) < -margin_;
}

bool SharedCorner::is_nearest_of(const PreparedTriangle& triangle) const noexcept {
  if (corner_ == nullptr) return false;
  for (std::size_t i = 0; i < 3; ++i)
    if (triangle.corner[i] == *corner_) return is_behind(triangle, i);
  return false;
}

}  // namespace touchmark
