/// A second way to the exact distance, sharing no algebra with the first: the least squared length in the
/// convex hull of some vectors, by trying every set of at most four of them for the optimality conditions
/// (Lagrange's multipliers), solved by elimination in rationals. No cross product, no projection, no case for
/// face, edge or corner. A segment's distance to a triangle is the same question about six differences.
#pragma once

#include <array>
#include <bit>
#include <optional>
#include <utility>
#include <vector>

#include <gmpxx.h>

#include "bench/oracle/triangle.h"

namespace touchmark::bench::oracle {

using RationalVector = std::array<mpq_class, 3>;

inline RationalVector difference(const Vec3& a, const Vec3& b) {
  return {mpq_class(a.x()) - mpq_class(b.x()), mpq_class(a.y()) - mpq_class(b.y()),
          mpq_class(a.z()) - mpq_class(b.z())};
}

inline mpq_class inner(const RationalVector& a, const RationalVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The solution of a square system given with its right-hand side as last column; nothing if singular.
inline std::optional<std::vector<mpq_class>> solve_linear(std::vector<std::vector<mpq_class>> rows) {
  const std::size_t n = rows.size();
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    while (pivot < n && rows[pivot][k] == 0) ++pivot;
    if (pivot == n) return std::nullopt;
    std::swap(rows[k], rows[pivot]);
    for (std::size_t i = 0; i < n; ++i) {
      if (i == k || rows[i][k] == 0) continue;
      const mpq_class factor = rows[i][k] / rows[k][k];
      for (std::size_t j = k; j <= n; ++j) rows[i][j] -= factor * rows[k][j];
    }
  }
  std::vector<mpq_class> x(n);
  for (std::size_t k = 0; k < n; ++k) x[k] = rows[k][n] / rows[k][k];
  return x;
}

inline mpq_class min_squared_length(const std::vector<RationalVector>& corners) {
  std::optional<mpq_class> least;
  for (unsigned set = 1; set < 1U << corners.size(); ++set) {
    if (std::popcount(set) > 4) continue;
    std::vector<RationalVector> w;
    for (std::size_t i = 0; i < corners.size(); ++i)
      if ((set >> i & 1) != 0) w.push_back(corners[i]);
    const std::size_t n = w.size();
    // sum_j (w_i . w_j) l_j + m = 0 and sum_j l_j = 1.
    std::vector<std::vector<mpq_class>> rows(n + 1, std::vector<mpq_class>(n + 2));
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) rows[i][j] = inner(w[i], w[j]);
      rows[i][n] = rows[n][i] = 1;
    }
    rows[n][n + 1] = 1;
    const auto weights = solve_linear(rows);
    if (!weights) continue;  // affinely dependent: a smaller set does as well
    bool inside = true;
    RationalVector x;
    for (std::size_t i = 0; i < n; ++i) {
      inside = inside && (*weights)[i] >= 0;
      for (std::size_t k = 0; k < 3; ++k) x[k] += (*weights)[i] * w[i][k];
    }
    if (!inside) continue;
    const mpq_class squared = inner(x, x);
    if (!least || squared < *least) least = squared;
  }
  return *least;
}

inline mpq_class squared_distance_by_multipliers(const Vec3& point, const Triangle& t) {
  return min_squared_length({difference(t[0], point), difference(t[1], point), difference(t[2], point)});
}

inline mpq_class squared_segment_distance_by_multipliers(const Vec3& from, const Vec3& to,
                                                         const Triangle& t) {
  std::vector<RationalVector> corners;
  for (const Vec3& end : {from, to})
    for (const Vec3& v : t) corners.push_back(difference(v, end));
  return min_squared_length(corners);
}

}  // namespace touchmark::bench::oracle
