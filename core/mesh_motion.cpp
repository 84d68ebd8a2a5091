#include "core/mesh_motion.h"

#include <algorithm>
#include <limits>

#include <Eigen/LU>

#include "core/mesh_update.h"

namespace touchmark {

MeshMotion::MeshMotion(const TriangleMesh& before, const TriangleMesh& after)
    : before_(&before), after_(&after) {
  Connectivity(before).expect(after);
  for (std::size_t i = 0; i < before.vertices().size(); ++i)
    max_shift_ = std::max(max_shift_, (after.vertices()[i] - before.vertices()[i]).cwiseAbs().maxCoeff());
  max_shift_ *= 1.75;  // more than the root of 3
}

std::array<Vec3, 3> MeshMotion::corners_at(std::uint32_t triangle, double time) const noexcept {
  std::array<Vec3, 3> corners;
  for (int i = 0; i < 3; ++i) {
    const Vec3 &from = before_->corner(triangle, i), &to = after_->corner(triangle, i);
    corners[static_cast<std::size_t>(i)] = time < 1 ? Vec3(from + time * (to - from)) : to;
  }
  return corners;
}

namespace {

/// Two sides and the unit normal; nothing but the normal is 0 where there is no area.
Eigen::Matrix3d frame_of(const std::array<Vec3, 3>& corner) noexcept {
  Eigen::Matrix3d frame;
  frame << corner[1] - corner[0], corner[2] - corner[0], Vec3::Zero();
  frame.col(2) = frame.col(0).cross(frame.col(1)).stableNormalized();
  return frame;
}

}  // namespace

Contact MeshMotion::carried(const Contact& contact, double time) const noexcept {
  Contact best = contact;
  double least = std::numeric_limits<double>::infinity();
  // The contact names a polygon: its triangle that is nearest to the contact's point counts.
  std::uint32_t index = before_->ids().empty() ? contact.triangle : 0;
  if (!before_->ids().empty())
    index = static_cast<std::uint32_t>(std::ranges::lower_bound(before_->ids(), contact.triangle) -
                                       before_->ids().begin());
  for (; index < before_->size() && before_->id(index) == contact.triangle; ++index) {
    const std::array<Vec3, 3> then = corners_at(index, time), after = corners_at(index, 1);
    const Eigen::Matrix3d frame = frame_of(then), next = frame_of(after);
    const Eigen::FullPivLU<Eigen::Matrix3d> in_frame(frame);
    if (!in_frame.isInvertible()) continue;
    const Vec3 at = in_frame.solve(Vec3(contact.point - then[0]));
    const double beyond = std::max({0.0, -at[0], -at[1], at[0] + at[1] - 1});
    if (!(beyond < least)) continue;
    least = beyond;
    best.point = after[0] + next * Vec3(at[0], at[1], 0);
    best.normal = (next * in_frame.solve(contact.normal)).stableNormalized();
    best.distance = (best.point - contact.point).norm();
  }
  return best;
}

}  // namespace touchmark
