/// How Bullet sees the mesh's coordinates, without Bullet: for the detector, and for whoever asks what a
/// build in single precision has left of them.
#pragma once

#include "core/triangle_mesh.h"

namespace touchmark::baselines {

/// scale * (point - origin).
struct BulletView {
  double scale = 1;
  Vec3 origin = Vec3::Zero();

  /// Box centre at the origin, mean edge length 1: the size that Bullet is written for.
  static BulletView fitted(const TriangleMesh& mesh) {
    double sum = 0;
    for (std::size_t i = 0; i < mesh.size(); ++i)
      for (int k = 0; k < 3; ++k) sum += (mesh.corner(i, k) - mesh.corner(i, (k + 1) % 3)).norm();
    const double edge = sum / (3 * static_cast<double>(mesh.size()));
    return {edge > 0 ? 1 / edge : 1, mesh.bounds().center()};
  }

  Vec3 into(const Vec3& point) const { return scale * (point - origin); }
  Vec3 back(const Vec3& point) const { return point / scale + origin; }
};

}  // namespace touchmark::baselines
