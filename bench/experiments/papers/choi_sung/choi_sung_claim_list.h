/// How the claims of Choi & Sung are gathered: by choi_sung_claims.cpp, of each kind by a file of its own.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/experiments/papers/choi_sung/choi_sung.h"
#include "bench/experiments/papers/claims.h"

namespace touchmark::bench::experiments::papers {

/// The value of a row by which methods are compared.
using RowValue = std::function<double(const ChoiSungRow&)>;
/// Why a number may differ, where something is known besides the mesh.
using Reason = std::optional<std::string>;

class ChoiSungClaimList {
 public:
  ChoiSungClaimList(const ChoiSungResult& result, bool own_mesh) : result_(result), own_mesh_(own_mesh) {}

  const ChoiSungResult& result() const noexcept { return result_; }
  /// True if all methods have all three levels of the paper.
  bool complete() const;
  bool is_timed() const;

  const ChoiSungRow* find(SubdivisionMethod method, int level, bool clustered) const {
    return find_row(result_, method, level, clustered);
  }
  /// The row must be there.
  double value(SubdivisionMethod method, int level, bool clustered, const RowValue& of) const {
    return of(*find(method, level, clustered));
  }
  /// The methods at a level, the one with the least value first.
  std::vector<SubdivisionMethod> sorted(int level, bool clustered, const RowValue& of) const;

  std::string why(const Reason& reason) const;
  void add(Claim claim) { claims_.push_back(std::move(claim)); }
  void add(const char* where, std::string statement, bool holds, std::string reproduced,
           const Reason& reason = std::nullopt);
  /// "X has the least" at each level from this one on.
  void add_best(const char* where, const char* statement, SubdivisionMethod expected, int from_level,
                bool clustered, const RowValue& of, const Reason& reason = std::nullopt);

  std::vector<Claim> take() { return std::move(claims_); }

 private:
  const ChoiSungResult& result_;
  bool own_mesh_;
  std::vector<Claim> claims_;
};

/// Returns value(level) from this level to the third.
inline std::vector<double> over_levels(int from, const std::function<double(int level)>& value) {
  std::vector<double> values;
  for (int level = from; level <= 3; ++level) values.push_back(value(level));
  return values;
}
inline bool rises(const std::vector<double>& values) {
  return std::ranges::adjacent_find(values, std::greater_equal()) == values.end();
}
inline bool falls(const std::vector<double>& values) {
  return std::ranges::adjacent_find(values, std::less_equal()) == values.end();
}

/// Fig. 2, Fig. 3, Figs 7 and 8, the graphical test's words.
void add_surface_claims(ChoiSungClaimList& list);
/// Fig. 6, Fig. 9, the spheres about centroids, the distance of clustering.
void add_sphere_claims(ChoiSungClaimList& list);
/// Table 3's times and rates at a level.
void add_time_claims(ChoiSungClaimList& list, int level);
/// Figs 10 and 11 and what the text says of time.
void add_time_statements(ChoiSungClaimList& list);

inline const char* const visit_order_reason =
    "the paper states neither the order in which triangles are visited, nor a cluster's centre, nor the unit "
    "of its 0.02; ours is the greedy rule of core/sphere_cluster";

}  // namespace touchmark::bench::experiments::papers
