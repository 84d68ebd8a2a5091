/// The vocabulary of every query. All lengths are in the mesh's own units, all coordinates in its frame.
#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace touchmark {

using Vec3 = Eigen::Vector3d;

/// The number that the mesh's file gave a face, from 0. The triangles cut from one polygon share it.
using TriangleId = std::uint32_t;

/// A haptic interface point (HIP) as a ball: `radius` >= 0, and 0 is the bare point.
/// Contact is closed: the probe touches the mesh when the distance is at most the radius.
struct Probe {
  Vec3 center = Vec3::Zero();
  double radius = 0;
};

/// The probe's straight path during one servo tick.
struct Sweep {
  Vec3 from = Vec3::Zero();
  Vec3 to = Vec3::Zero();
  double radius = 0;
};

/// On which side of the surface a probe's centre is. Inside is behind the faces, which are counter-clockwise
/// seen from outside: core/sign/side_finder.h. `undecided` where the mesh does not say, never a guess.
enum class Side : std::uint8_t { unasked, outside, inside, on_surface, undecided };

/// The point of the mesh nearest to a probe's centre.
struct Contact {
  Vec3 point = Vec3::Zero();   ///< on the mesh, nearest to the centre
  Vec3 normal = Vec3::Zero();  ///< unit, from `point` towards the centre; the face normal where they coincide
  double distance = 0;         ///< |center - point|, >= 0
  TriangleId triangle = 0;  ///< one of the nearest triangles; of several at the same distance the lowest id
  Side side =
      Side::unasked;  ///< side of the centre; detectors leave it, core/sign/signed_detector.h fills it in
};

/// The first touch along a sweep: `fraction` in [0, 1] of the path, 0 where and only where the probe touches
/// at the start; rounded down, so that no touch is earlier. `contact` is the contact of the probe standing
/// there.
struct Impact {
  double fraction = 0;
  Contact contact;
};

}  // namespace touchmark
