#include "core/exact/orientation.h"

#include <cmath>

#include "core/exact/integer_lattice.h"
#include "core/float_limits.h"

namespace touchmark {
namespace {

// Outside, products may have lost bits or all there is.
constexpr double min_safe = 0x1p-900, max_safe = 0x1p1000;

int sign(double x) noexcept { return x > 0 ? 1 : x < 0 ? -1 : 0; }

/// The sign of the rounded value, or 0 where its rounding, a multiple of the terms' magnitudes, hides it.
int sure_sign(double value, double magnitude, double roundings) noexcept {
  if (!(magnitude > min_safe && magnitude < max_safe)) return 0;
  return std::abs(value) > roundings * unit_roundoff * magnitude ? sign(value) : 0;
}

[[gnu::noinline, gnu::cold]] int side_of_plane_exactly(const Vec3& a, const Vec3& b, const Vec3& c,
                                                       const Vec3& p) noexcept {
  const exact::Lattice lattice({a, b, c}, p);
  const exact::Vector<1> origin = lattice(p);
  const exact::Vector<1> to_a = lattice(a) - origin, to_b = lattice(b) - origin, to_c = lattice(c) - origin;
  return -exact::dot(exact::cross(to_b, to_c), to_a).sign();
}

[[gnu::noinline, gnu::cold]] int side_of_line_exactly(const Vec3& a, const Vec3& b, const Vec3& p) noexcept {
  exact::Lattice lattice;
  for (const Vec3* v : {&a, &b, &p}) {
    lattice.add(v->x());
    lattice.add(v->y());
  }
  const exact::BigInteger<1> x = lattice(p.x()), y = lattice(p.y());
  const auto along = (lattice(a.x()) - x) * (lattice(b.y()) - y),
             against = (lattice(a.y()) - y) * (lattice(b.x()) - x);
  return (along - against).sign();
}

}  // namespace

int side_of_plane(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) noexcept {
  const Vec3 to_a = a - p, to_b = b - p, to_c = c - p;
  const double xy = to_a.x() * to_b.y(), yx = to_a.y() * to_b.x();
  const double yz = to_b.x() * to_c.y(), zy = to_b.y() * to_c.x();
  const double zx = to_c.x() * to_a.y(), xz = to_c.y() * to_a.x();
  const double value = (xy - yx) * to_c.z() + (yz - zy) * to_a.z() + (zx - xz) * to_b.z();
  const double magnitude = (std::abs(xy) + std::abs(yx)) * std::abs(to_c.z()) +
                           (std::abs(yz) + std::abs(zy)) * std::abs(to_a.z()) +
                           (std::abs(zx) + std::abs(xz)) * std::abs(to_b.z());
  // Four points of a plane that is normal to an axis.
  if (magnitude == 0 && (to_a.array() == 0 && to_b.array() == 0 && to_c.array() == 0).any()) return 0;
  // Shewchuk, "Adaptive precision floating-point arithmetic" (1997): (7 + 56 u) u.
  const int sure = sure_sign(value, magnitude, 8);
  return sure != 0 ? -sure : side_of_plane_exactly(a, b, c, p);
}

int side_of_line_xy(const Vec3& a, const Vec3& b, const Vec3& p) noexcept {
  const double along = (a.x() - p.x()) * (b.y() - p.y()), against = (a.y() - p.y()) * (b.x() - p.x());
  // The same: (3 + 16 u) u.
  const int sure = sure_sign(along - against, std::abs(along) + std::abs(against), 4);
  return sure != 0 ? sure : side_of_line_exactly(a, b, p);
}

}  // namespace touchmark
