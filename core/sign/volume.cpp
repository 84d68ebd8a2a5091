#include "core/sign/volume.h"

#include <cmath>
#include <cstdint>

#include <Eigen/Geometry>

#include "core/exact/big_integer.h"
#include "core/exact/integer_lattice.h"
#include "core/float_limits.h"

namespace touchmark::sign {
namespace {

/// In units of the box, so that no power leaves the range. 0 where rounding hides it.
int sign_by_doubles(const TriangleMesh& mesh) noexcept {
  const Vec3 center = mesh.bounds().center();
  const double size = mesh.bounds().extent().maxCoeff();
  double six_volumes = 0, magnitude = 0;
  for (std::uint32_t t = 0; t < mesh.size(); ++t) {
    const Vec3 a = (mesh.corner(t, 0) - center) / size, b = (mesh.corner(t, 1) - center) / size,
               c = (mesh.corner(t, 2) - center) / size;
    six_volumes += a.dot(b.cross(c));
    magnitude += a.norm() * b.norm() * c.norm() + std::abs(six_volumes);
  }
  // The centre's own rounding moves nothing: a closed mesh has its volume about any point.
  if (!(std::abs(six_volumes) > 16 * unit_roundoff * magnitude)) return 0;
  return six_volumes > 0 ? 1 : -1;
}

/// About the frame's origin: six products of coordinates a triangle. Those of 2^32 triangles come to 35 bits
/// more than a product has, for which an integer of three coordinates has room.
int sign_exactly(const TriangleMesh& mesh) noexcept {
  exact::Lattice lattice;
  for (std::uint32_t t = 0; t < mesh.size(); ++t)
    for (int k = 0; k < 3; ++k) lattice.add(mesh.corner(t, k));
  exact::BigInteger<3> six_volumes;
  for (std::uint32_t t = 0; t < mesh.size(); ++t) {
    const exact::Vector<1> a = lattice(mesh.corner(t, 0)), b = lattice(mesh.corner(t, 1)),
                           c = lattice(mesh.corner(t, 2));
    six_volumes = six_volumes + exact::dot(a, exact::cross(b, c));
  }
  return six_volumes.sign();
}

}  // namespace

int volume_sign(const TriangleMesh& mesh) noexcept {
  const int sure = sign_by_doubles(mesh);
  return sure != 0 ? sure : sign_exactly(mesh);
}

}  // namespace touchmark::sign
