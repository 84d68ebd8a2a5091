/// All queries along a path over a wavy sheet, and away from it: for tests of what queries do besides
/// answering.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "bench/contestants/contestant.h"
#include "bench/workload/answer.h"
#include "bench/workload/steps.h"
#include "core/float_limits.h"
#include "core/triangle_mesh.h"

namespace touchmark::test {

/// A wavy sheet of 2 * n * n triangles over the unit square.
inline TriangleMesh sheet(std::uint32_t n) {
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Corners> triangles;
  for (std::uint32_t i = 0; i <= n; ++i) {
    for (std::uint32_t j = 0; j <= n; ++j) {
      const double x = double(i) / n, y = double(j) / n;
      vertices.emplace_back(x, y,
                            0.1 * std::sin(2 * std::numbers::pi * x) * std::cos(2 * std::numbers::pi * y));
      if (i == n || j == n) continue;
      const std::uint32_t a = i * (n + 1) + j, b = a + n + 1;
      triangles.push_back({a, b, a + 1});
      triangles.push_back({b, b + 1, a + 1});
    }
  }
  return {std::move(vertices), std::move(triangles)};
}

/// Holds all the memory that asking takes.
class QueryPass {
 public:
  QueryPass() {
    for (int i = 0; i < 200; ++i) {
      // Along the sheet, away from it, far outside, and back.
      const Vec3 position(i / 200.0, 0.4, 0.05 + (i % 20 == 0 ? 30 : 0.001 * (i % 7)));
      near_.push_back({{position, 0.01}, 0.01});
      any_.push_back({{position, 0.01}, infinity});
    }
  }

  /// Asks every query that it answers. Returns how many answers found something: on `sheet` at least 200.
  std::size_t ask(bench::contestants::Contestant& detector) noexcept {
    using bench::workload::Query;
    using bench::workload::QueryTrace;
    std::size_t answered = 0;
    for (std::size_t i = 1; i < near_.size(); ++i) {
      for (const QueryTrace& trace : {QueryTrace{Query::touches, near_}, QueryTrace{Query::nearest, near_},
                                      QueryTrace{Query::nearest, any_}, QueryTrace{Query::sweep, near_}}) {
        if (!detector.answers(trace.query)) continue;
        detector.answer(trace, {i, i + 1}, {&answer_, 1}, {&work_, 1});
        answered += answer_.found;
      }
    }
    return answered;
  }

 private:
  std::vector<bench::workload::Step> near_, any_;
  bench::workload::Answer answer_;
  std::uint64_t work_ = 0;
};

}  // namespace touchmark::test
