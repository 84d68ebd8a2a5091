/// Queries take no memory: every allocation of the process is counted here, and a query must not add to them.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <new>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "bench/workload/answer.h"
#include "bench/workload/steps.h"
#include "tests/own_forms.h"

namespace {

std::size_t allocations = 0;

}  // namespace

// Not inlined, or the compiler sees malloc meet delete and warns.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  ++allocations;
  const auto align = static_cast<std::size_t>(alignment);
  if (void* memory = std::aligned_alloc(align, (size + align - 1) / align * align)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}

namespace touchmark {
namespace {

using bench::workload::Answer;
using bench::workload::Query;
using bench::workload::QueryTrace;
using bench::workload::Step;

/// A wavy sheet of 2 * n * n triangles over the unit square.
TriangleMesh sheet(std::uint32_t n) {
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

/// Along the sheet, away from it, far outside, and back.
std::vector<Vec3> path() {
  std::vector<Vec3> positions;
  for (int i = 0; i < 200; ++i)
    positions.emplace_back(i / 200.0, 0.4, 0.05 + (i % 20 == 0 ? 30 : 0.001 * (i % 7)));
  return positions;
}

void expect_no_allocation(const bench::contestants::ContestantSpec& spec) {
  const auto detector = own_roster().build(spec, sheet(20));
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<Step> near, any;
  for (const Vec3& position : path()) {
    near.push_back({{position, 0.01}, 0.01});
    any.push_back({{position, 0.01}, infinity});
  }
  std::size_t answered = 0;
  std::vector<Answer> answers(1);
  std::vector<std::uint64_t> work(1);
  const std::size_t before = allocations;
  for (std::size_t i = 1; i < near.size(); ++i) {
    for (const QueryTrace& trace : {QueryTrace{Query::touches, near}, QueryTrace{Query::nearest, near},
                                    QueryTrace{Query::nearest, any}, QueryTrace{Query::sweep, near}}) {
      if (!detector->answers(trace.query)) continue;
      detector->answer(trace, {i, i + 1}, answers, work);
      answered += answers[0].found;
    }
  }
  EXPECT_EQ(allocations, before) << spec.text();
  EXPECT_GT(answered, 199u) << spec.text();
}

TEST(NoAllocation, CountsAllocations) {
  const std::size_t before = allocations;
  const std::vector<int> one(1);
  EXPECT_EQ(allocations, before + one.size());
}

TEST(NoAllocation, InAnyFormOfOurDetectors) {
  for (const bench::contestants::ContestantSpec& spec : own_forms()) expect_no_allocation(spec);
}

TEST(NoAllocation, WhereTheSideIsAsked) {
  for (const bench::contestants::ContestantInfo& info : own_roster().contestants())
    expect_no_allocation(own_roster().parse(info.name + ":side=on"));
}

}  // namespace
}  // namespace touchmark
