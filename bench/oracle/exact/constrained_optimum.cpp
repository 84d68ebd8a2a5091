#include "bench/oracle/exact/constrained_optimum.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <gmpxx.h>

namespace touchmark::bench::oracle {
namespace {

constexpr mp_bitcnt_t bits = 256;

using Number = mpf_class;
using Point = std::array<Number, 3>;

Number number(double x) { return {x, bits}; }
Point point(const Vec3& v) { return {number(v.x()), number(v.y()), number(v.z())}; }
Number dot(const Point& a, const Point& b) { return Number(a[0] * b[0] + a[1] * b[1] + a[2] * b[2], bits); }
Point difference(const Point& a, const Point& b) {
  return {Number(a[0] - b[0], bits), Number(a[1] - b[1], bits), Number(a[2] - b[2], bits)};
}
Point cross(const Point& a, const Point& b) {
  return {Number(a[1] * b[2] - a[2] * b[1], bits), Number(a[2] * b[0] - a[0] * b[2], bits),
          Number(a[0] * b[1] - a[1] * b[0], bits)};
}

/// normal . x >= offset; the normal is a unit vector to 256 bits.
struct HalfSpace {
  Point normal;
  Number offset;

  Number height(const Point& x) const { return Number(dot(normal, x) - offset, bits); }
};

Number determinant(const std::array<std::array<Number, 3>, 3>& m) {
  return Number(m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                    m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                    m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]),
                bits);
}

}  // namespace

struct ConvexFreeSpace::Planes {
  std::vector<HalfSpace> all;
  Number slack{0, bits};

  bool is_free(const Point& x) const {
    return std::ranges::all_of(all, [&](const HalfSpace& plane) { return plane.height(x) >= -slack; });
  }
  /// The goal's nearest point on these planes, if it is free and each plane pushes. Cramer's rule on the
  /// products of the normals; sets of fewer than three are filled up with rows of the identity.
  std::optional<Point> on(const Point& goal, std::span<const std::size_t> chosen) const;
};

std::optional<Point> ConvexFreeSpace::Planes::on(const Point& goal,
                                                 std::span<const std::size_t> chosen) const {
  std::array<std::array<Number, 3>, 3> gram;
  std::array<Number, 3> lack;
  for (std::size_t i = 0; i < 3; ++i) {
    lack[i] = i < chosen.size() ? Number(-all[chosen[i]].height(goal), bits) : number(0);
    for (std::size_t j = 0; j < 3; ++j)
      gram[i][j] = i < chosen.size() && j < chosen.size() ? dot(all[chosen[i]].normal, all[chosen[j]].normal)
                                                          : number(i == j ? 1 : 0);
  }
  const Number whole = determinant(gram);
  if (whole < 1e-20) return std::nullopt;  // the same plane twice, or three through one line
  Point x = goal;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    auto replaced = gram;
    for (std::size_t j = 0; j < 3; ++j) replaced[j][i] = lack[j];
    const Number multiplier(determinant(replaced) / whole, bits);
    if (multiplier < 0) return std::nullopt;
    for (std::size_t k = 0; k < 3; ++k) x[k] += multiplier * all[chosen[i]].normal[k];
  }
  if (!is_free(x)) return std::nullopt;
  return x;
}

ConvexFreeSpace::ConvexFreeSpace(std::span<const Triangle> triangles, const Vec3& inside, double radius) {
  auto planes = std::make_unique<Planes>();
  double largest = inside.cwiseAbs().maxCoeff();
  for (const Triangle& t : triangles) {
    const Point a = point(t[0]);
    Point normal = cross(difference(point(t[1]), a), difference(point(t[2]), a));
    const Number length(sqrt(dot(normal, normal)), bits);
    if (length == 0) continue;
    const bool flip = dot(normal, difference(point(inside), a)) < 0;
    for (Number& x : normal) x /= flip ? Number(-length) : length;
    planes->all.push_back({normal, Number(dot(normal, a) + radius, bits)});
    for (const Vec3& v : t) largest = std::max(largest, v.cwiseAbs().maxCoeff());
  }
  planes->slack = number(0x1p-48 * largest);
  planes_ = std::move(planes);
}
ConvexFreeSpace::~ConvexFreeSpace() = default;
ConvexFreeSpace::ConvexFreeSpace(ConvexFreeSpace&&) noexcept = default;
ConvexFreeSpace& ConvexFreeSpace::operator=(ConvexFreeSpace&&) noexcept = default;

std::optional<Vec3> ConvexFreeSpace::nearest(const Vec3& goal) const {
  const Point from = point(goal);
  const auto rounded = [](const Point& x) { return Vec3(x[0].get_d(), x[1].get_d(), x[2].get_d()); };
  if (planes_->is_free(from)) return goal;
  const std::size_t count = planes_->all.size();
  for (std::size_t i = 0; i < count; ++i)
    if (const auto x = planes_->on(from, std::array{i})) return rounded(*x);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 1; j < count; ++j)
      if (const auto x = planes_->on(from, std::array{i, j})) return rounded(*x);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 1; j < count; ++j)
      for (std::size_t k = j + 1; k < count; ++k)
        if (const auto x = planes_->on(from, std::array{i, j, k})) return rounded(*x);
  return std::nullopt;
}

}  // namespace touchmark::bench::oracle
