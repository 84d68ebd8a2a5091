#include "core/exact/moving_triangle.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/exact/integer_lattice.h"
#include "core/float_limits.h"

namespace touchmark::exact {
namespace {

/// c[0] s^2 + c[1] s t + c[2] t^2: at the part t / (s + t) of the way, times a positive number.
using Quadratic = std::array<BigInteger<2>, 3>;
/// Likewise of the third degree, on a part of the way.
using Cubic = std::array<BigInteger<7>, 4>;

constexpr int max_halvings = 4096, cubic_bits = 15'200;
/// So many halvings make a fraction as fine as it is told.
constexpr int told_halvings = 54;

/// The number at / 2^depth, 0 <= at < 2^depth; as a part of the way, the one from there to (at + 1) /
/// 2^depth.
struct Dyadic {
  BigInteger<2> at;
  int depth = 0;

  Dyadic halved(int which) const noexcept {
    return {which == 0 ? at.times(2) : at.times(2) + BigInteger<2>::one(), depth + 1};
  }
  double rounded_down() const noexcept {
    return std::ldexp(at.scaled().rounded(), -depth) * (1 - 4 * unit_roundoff);
  }
};

/// Part of a way in the coordinates of a Quadratic.
struct Place {
  BigInteger<2> s, t;

  static Place of(const Dyadic& number, int ends) noexcept {
    const BigInteger<2> one = BigInteger<2>::one();
    const BigInteger<2> whole = BigInteger<2>::of(1, static_cast<unsigned>(number.depth), false);
    const BigInteger<2> t = ends == 0 ? number.at : number.at + one;
    return {whole - t, t};
  }
};

/// Half of the quadratic's polar form, times 2: at equal places it is twice the value.
BigInteger<6> polar(const Quadratic& q, const Place& a, const Place& b) noexcept {
  return (q[0] * (a.s * b.s)).times(2) + q[1] * (a.s * b.t + b.s * a.t) + (q[2] * (a.t * b.t)).times(2);
}

/// The sign inside a part of the way; nothing where the coefficients on it leave it open.
std::optional<int> sign_inside(const Quadratic& q, const Place& begin, const Place& end) noexcept {
  const std::array<int, 3> signs{polar(q, begin, begin).sign(), polar(q, begin, end).sign(),
                                 polar(q, end, end).sign()};
  const auto [least, most] = std::ranges::minmax(signs);
  if (least * most < 0) return std::nullopt;
  return least + most > 0 ? 1 : least + most < 0 ? -1 : 0;
}

/// How often the signs of the coefficients change: at least as often as the form is 0 inside (Descartes).
int sign_changes(const Cubic& form) noexcept {
  int changes = 0, last = 0;
  for (const BigInteger<7>& c : form) {
    const int sign = c.sign();
    if (sign * last < 0) ++changes;
    if (sign != 0) last = sign;
  }
  return changes;
}

/// The form on half of its part of the way, times 8.
Cubic half_of(const Cubic& form, int which) noexcept {
  Cubic half = form;
  if (which == 1) std::ranges::reverse(half);
  for (std::size_t round = 3; round > 0; --round)
    for (std::size_t j = 1; j <= round; ++j) half[j] = half[j] + half[j - 1];
  for (std::size_t j = 0; j < 3; ++j) half[j] = half[j].times(Limb{8} >> j);
  if (which == 1) std::ranges::reverse(half);
  return half;
}

/// A triangle as a point sees it. Corner i is at s a[i] + t b[i].
class Meeting {
 public:
  using Seen = std::array<Vector<1>, 3>;

  Meeting(const Seen& a, const Seen& b) noexcept {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
      const Vector<2> at_start = cross(a[i], a[j]), at_end = cross(b[i], b[j]);
      const Vector<2> one = cross(a[i], b[j]), other = cross(b[i], a[j]);
      for (std::size_t axis = 0; axis < 3; ++axis)
        moment_[k][axis] = {at_start[axis], one[axis] + other[axis], at_end[axis]};
      product_[k] = {dot(a[i], a[j]), dot(a[i], b[j]) + dot(b[i], a[j]), dot(b[i], b[j])};
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Quadratic& moment = moment_[0][axis];
      for (std::size_t n = 0; n < 3; ++n) {
        volume_[n] = volume_[n] + a[0][axis] * moment[n];
        volume_[n + 1] = volume_[n + 1] + b[0][axis] * moment[n];
      }
      for (std::size_t k = 0; k < 3; ++k)
        for (const Seen* seen : {&a, &b}) bits_ = std::max(bits_, (*seen)[k][axis].scaled().exponent);
    }
    // E34: no two different zeros are as near as a part of this depth is long.
    enough_ = std::min({25 * bits_ + 72, max_halvings, cubic_bits / 3 - bits_});
  }

  std::optional<double> first() const noexcept {
    const Place start{BigInteger<2>::one(), {}}, end{{}, BigInteger<2>::one()};
    if (volume_[0].sign() == 0 && holds_at(start)) return 0;
    std::optional<double> first;
    if (std::ranges::any_of(volume_, [](const auto& c) { return c.sign() != 0; })) {
      first = search(volume_, {});
    } else {
      for (std::size_t k = 0; k < 3; ++k) {
        const std::optional<double> found = search(raised(edge_event(k)), {});
        if (found && !(first && *first <= *found)) first = found;
      }
    }
    if (!first && volume_[3].sign() == 0 && holds_at(end)) first = 1;
    return first;
  }

 private:
  /// True if the triangle holds the point, which is in its plane; nothing where the signs leave that open.
  template <class SignOf>
  std::optional<bool> holds(const SignOf& sign_of) const noexcept {
    bool is_open = false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      bool above = false, below = false, open = false;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::optional<int> sign = sign_of(moment_[k][axis]);
        open = open || !sign;
        above = above || sign > 0;
        below = below || (sign && *sign < 0);
      }
      if (above && below) return false;
      if (!open && (above || below)) return true;
      is_open = is_open || open;
    }
    if (is_open) return std::nullopt;
    // All corners are on a line through the point.
    for (const Quadratic& product : product_) {
      const std::optional<int> sign = sign_of(product);
      if (sign && *sign <= 0) return true;
      is_open = is_open || !sign;
    }
    return is_open ? std::nullopt : std::optional(false);
  }
  bool holds_at(const Place& place) const noexcept {
    return *holds([&](const Quadratic& q) { return std::optional(polar(q, place, place).sign()); });
  }

  /// A form that is 0 when an edge of a triangle that always has the point in its plane first holds the
  /// point.
  const Quadratic& edge_event(std::size_t k) const noexcept {
    for (const Quadratic& moment : moment_[k])
      if (std::ranges::any_of(moment, [](const auto& c) { return c.sign() != 0; })) return moment;
    return product_[k];
  }
  /// Times s + t, which is nowhere 0.
  static Cubic raised(const Quadratic& q) noexcept {
    return {q[0], BigInteger<7>(q[0]) + BigInteger<7>(q[1]), BigInteger<7>(q[1]) + BigInteger<7>(q[2]), q[2]};
  }

  /// The first zero of the form inside the part at which the triangle holds the point.
  std::optional<double> search(Cubic form, Dyadic part) const noexcept {
    for (;;) {
      const int changes = sign_changes(form);
      if (changes == 0) return std::nullopt;
      const bool is_last = part.depth >= enough_, is_fine = part.depth >= told_halvings;
      if (is_last || part.depth == told_halvings || (part.depth & (part.depth - 1)) == 0) {
        const Place begin = Place::of(part, 0), end = Place::of(part, 1);
        const std::optional<bool> held = holds([&](const Quadratic& q) {
          const std::optional<int> sign = sign_inside(q, begin, end);
          return sign || !is_last ? sign : std::optional(0);
        });
        if (held == false) return std::nullopt;
        if (held && (is_last || (is_fine && changes % 2 == 1))) return part.rounded_down();
      }
      const Cubic left = half_of(form, 0);
      const int on_left = sign_changes(left);
      if (on_left == changes) {  // the other half has none, and the middle is no zero
        form = left;
        part = part.halved(0);
        continue;
      }
      if (on_left > 0)
        if (const std::optional<double> found = search(left, part.halved(0))) return found;
      part = part.halved(1);
      if (left[3].sign() == 0 && holds_at(Place::of(part, 0))) return part.rounded_down();
      form = half_of(form, 1);
    }
  }

  /// For edge k, between the other two corners: the point's moments about it, and the product of the corners.
  std::array<std::array<Quadratic, 3>, 3> moment_;
  std::array<Quadratic, 3> product_;
  Cubic volume_;  ///< 0 where the point is in the triangle's plane
  int bits_ = 0;
  int enough_ = 0;
};

}  // namespace
}  // namespace touchmark::exact

namespace touchmark {

std::optional<double> first_meeting(const TriangleCorners& start, const TriangleCorners& end,
                                    const Vec3& from, const Vec3& to) noexcept {
  exact::Lattice lattice(start, from);
  lattice.add(end);
  lattice.add(to);
  exact::Meeting::Seen a, b;
  for (std::size_t i = 0; i < 3; ++i) {
    a[i] = lattice(start[i]) - lattice(from);
    b[i] = lattice(end[i]) - lattice(to);
  }
  return exact::Meeting(a, b).first();
}

}  // namespace touchmark
