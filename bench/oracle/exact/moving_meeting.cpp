#include "bench/oracle/exact/moving_meeting.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <gmpxx.h>

namespace touchmark::bench::oracle {
namespace {

/// Coefficients, the lowest first; the last one is not 0.
using Polynomial = std::vector<mpq_class>;
using Moving = std::array<Polynomial, 3>;

Polynomial trimmed(Polynomial p) {
  while (!p.empty() && p.back() == 0) p.pop_back();
  return p;
}

Polynomial operator+(Polynomial a, const Polynomial& b) {
  a.resize(std::max(a.size(), b.size()));
  for (std::size_t i = 0; i < b.size(); ++i) a[i] += b[i];
  return trimmed(std::move(a));
}

Polynomial operator*(const Polynomial& a, const Polynomial& b) {
  Polynomial product(a.size() + b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) product[i + j] += a[i] * b[j];
  return trimmed(std::move(product));
}

Polynomial operator-(const Polynomial& a, const Polynomial& b) { return a + Polynomial{-1} * b; }

/// The quotient and what is left.
std::pair<Polynomial, Polynomial> divided(Polynomial a, const Polynomial& b) {
  Polynomial quotient(a.size());
  while (a.size() >= b.size()) {
    const std::size_t shift = a.size() - b.size();
    quotient[shift] = a.back() / b.back();
    for (std::size_t i = 0; i < b.size(); ++i) a[shift + i] -= quotient[shift] * b[i];
    a = trimmed(std::move(a));
  }
  return {trimmed(std::move(quotient)), std::move(a)};
}

/// Times a positive number, so that coefficients stay short.
Polynomial normed(const Polynomial& p) { return p.empty() ? p : Polynomial{1 / abs(p.back())} * p; }

Polynomial common_divisor(Polynomial a, Polynomial b) {
  while (!b.empty()) a = std::exchange(b, normed(divided(a, b).second));
  return a;
}

Polynomial derivative(const Polynomial& p) {
  Polynomial result;
  for (std::size_t i = 1; i < p.size(); ++i) result.push_back(static_cast<unsigned long>(i) * p[i]);
  return result;
}

int sign_at(const Polynomial& p, const mpq_class& x) {
  mpq_class value;
  for (std::size_t i = p.size(); i-- > 0;) value = value * x + p[i];
  return sgn(value);
}

/// How many zeros p has in (low, high].
int zeros_between(const Polynomial& p, const mpq_class& low, const mpq_class& high) {
  std::vector<Polynomial> chain{p, derivative(p)};
  while (!chain.back().empty())
    chain.push_back(normed(Polynomial{-1} * divided(chain[chain.size() - 2], chain.back()).second));
  const auto changes = [&](const mpq_class& x) {
    int count = 0, last = 0;
    for (const Polynomial& of : chain) {
      const int sign = sign_at(of, x);
      if (sign * last < 0) ++count;
      if (sign != 0) last = sign;
    }
    return count;
  };
  return changes(low) - changes(high);
}

/// The only zero of a polynomial without double zeros in (low, high], or the number where both are the same.
struct Zero {
  Polynomial of;
  mpq_class low, high;

  void halve() {
    const mpq_class middle = (low + high) / 2;
    const int here = sign_at(of, middle), beyond = sign_at(of, high);
    if (beyond == 0) low = high;
    if (here == 0) low = high = middle;
    if (low < high) (here == beyond ? high : low) = middle;
  }
  int sign_of(const Polynomial& p) {
    if (p.size() < 2 || low == high) return sign_at(p, high);
    const Polynomial shared = common_divisor(of, p);
    if (shared.size() > 1 && zeros_between(shared, low, high) > 0) return 0;
    const Polynomial simple = divided(p, common_divisor(p, derivative(p))).first;
    while (zeros_between(simple, low, high) > 0)
      for (int i = 0; i < 8; ++i) halve();
    return sign_at(p, high);
  }
};

/// The zeros from 0 to 1.
std::vector<Zero> zeros_of(const Polynomial& p) {
  std::vector<Zero> found;
  if (p.size() < 2) return found;
  const Polynomial simple = divided(p, common_divisor(p, derivative(p))).first;
  if (sign_at(simple, 0) == 0) found.push_back({simple, 0, 0});
  std::vector<std::pair<mpq_class, mpq_class>> waiting{{0, 1}};
  while (!waiting.empty()) {
    const auto [low, high] = waiting.back();
    waiting.pop_back();
    const int count = zeros_between(simple, low, high);
    const mpq_class middle = (low + high) / 2;
    if (count == 1) {
      found.push_back({simple, low, high});
    } else if (count > 1) {
      waiting.emplace_back(low, middle);
      waiting.emplace_back(middle, high);
    }
  }
  return found;
}

Polynomial dot(const Moving& a, const Moving& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Moving cross(const Moving& a, const Moving& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Moving difference(const Moving& a, const Moving& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

/// True if the origin is in the triangle, by the areas that it makes with the sides, or else on a side.
bool holds_origin(const std::array<Moving, 3>& corner, Zero& when) {
  const Moving normal = cross(difference(corner[1], corner[0]), difference(corner[2], corner[0]));
  if (when.sign_of(dot(corner[0], normal)) != 0) return false;
  bool inside = when.sign_of(dot(normal, normal)) > 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Moving &a = corner[i], &b = corner[(i + 1) % 3], moment = cross(a, b);
    if (when.sign_of(dot(moment, moment)) == 0 && when.sign_of(dot(a, b)) <= 0) return true;
    inside = inside && when.sign_of(dot(moment, normal)) >= 0;
  }
  return inside;
}

}  // namespace

std::optional<MeetingTime> first_meeting(const Triangle& start, const Triangle& end, const Vec3& from,
                                         const Vec3& to) {
  std::array<Moving, 3> corner;
  for (std::size_t i = 0; i < 3; ++i) {
    for (Eigen::Index k = 0; k < 3; ++k) {
      const mpq_class a = mpq_class(start[i][k]) - mpq_class(from[k]),
                      b = mpq_class(end[i][k]) - mpq_class(to[k]);
      corner[i][static_cast<std::size_t>(k)] = trimmed({a, b - a});
    }
  }
  const Polynomial volume = dot(corner[0], cross(corner[1], corner[2]));
  std::vector<Zero> times{{{}, 0, 0}, {{}, 1, 1}};
  const auto add = [&](const Polynomial& p) {
    const std::vector<Zero> zeros = zeros_of(p);
    times.insert(times.end(), zeros.begin(), zeros.end());
  };
  // In a plane with the point all along, the triangle comes to hold it as one of its sides does.
  if (!volume.empty()) add(volume);
  for (std::size_t i = 0; volume.empty() && i < 3; ++i) {
    const Moving &a = corner[i], &b = corner[(i + 1) % 3];
    for (const Polynomial& p : cross(a, b)) add(p);
    add(dot(a, b));
  }
  std::optional<MeetingTime> first;
  for (Zero& time : times) {
    if (!holds_origin(corner, time)) continue;
    while (time.high - time.low > 0x1p-60) time.halve();
    const MeetingTime found{time.low.get_d(), time.high.get_d()};
    if (!first || found.high < first->high) first = found;
  }
  return first;
}

bool any_meets(const TriangleMesh& before, const TriangleMesh& after, const Vec3& from, const Vec3& to) {
  // All corners are on one side of the point along an axis, before and after, and so all the time.
  const auto stays_aside = [&](const Triangle& start, const Triangle& end) {
    for (Eigen::Index k = 0; k < 3; ++k)
      for (const double sign : {1.0, -1.0}) {
        const auto is_above = [&](const Vec3& at) {
          return [=, &at](const Vec3& corner) { return sign * corner[k] > sign * at[k]; };
        };
        if (std::ranges::all_of(start, is_above(from)) && std::ranges::all_of(end, is_above(to))) return true;
      }
    return false;
  };
  for (std::uint32_t i = 0; i < before.size(); ++i) {
    const Triangle start = triangle_of(before, i), end = triangle_of(after, i);
    if (!stays_aside(start, end) && first_meeting(start, end, from, to)) return true;
  }
  return false;
}

}  // namespace touchmark::bench::oracle
