/// Queries take no memory: every allocation of the process is counted here, and a query must not add to them.
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <new>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "core/aabb_tree/aabb_tree.h"
#include "core/brute_force/brute_force.h"
#include "core/grid_group/grid_group.h"
#include "core/sign/signed_detector.h"
#include "core/sphere_cluster/sphere_cluster.h"

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

template <Detector D>
void expect_no_allocation(const typename D::Options& options) {
  const D detector = D::build(sheet(20), options);
  const std::vector<Vec3> positions = path();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  typename D::Session session;
  std::size_t answered = 0;
  const std::size_t before = allocations;
  for (std::size_t i = 1; i < positions.size(); ++i) {
    const Probe probe{positions[i], 0.01};
    if constexpr (AnswersTouches<D>) answered += detector.touches(probe, session);
    if constexpr (AnswersNearest<D>) {
      answered += detector.nearest(probe, 0.01, session).has_value();
      answered += detector.nearest(probe, infinity, session).has_value();
      if constexpr (Prepares<D>) detector.prepare(session);
    }
    if constexpr (AnswersSweep<D>) {
      answered += detector.first_hit({positions[i - 1], positions[i], 0.01}, session).has_value();
    }
  }
  EXPECT_EQ(allocations, before);
  EXPECT_GT(answered, 199u);
}

TEST(NoAllocation, CountsAllocations) {
  const std::size_t before = allocations;
  const std::vector<int> one(1);
  EXPECT_EQ(allocations, before + one.size());
}

TEST(NoAllocation, BruteForce) { expect_no_allocation<BruteForce>({}); }

TEST(NoAllocation, AabbTree) { expect_no_allocation<AabbTree>({}); }

TEST(NoAllocation, Signed) { expect_no_allocation<Signed<AabbTree>>({}); }

TEST(NoAllocation, GridGroup) {
  for (const GridGroup::Shape shape : {GridGroup::Shape::cube, GridGroup::Shape::sphere}) {
    for (const GridGroup::Lookup lookup : {GridGroup::Lookup::scan, GridGroup::Lookup::direct}) {
      GridGroup::Options options;
      options.shape = shape;
      options.lookup = lookup;
      expect_no_allocation<GridGroup>(options);
    }
  }
  expect_no_allocation<GridGroup>({.construction = GridGroup::Construction::lazy});
}

TEST(NoAllocation, SphereCluster) {
  using Lookup = SphereCluster::Lookup;
  expect_no_allocation<SphereCluster>({.construction = SphereCluster::Construction::lazy});
  for (const double clustering : {0.0, 0.1}) {
    expect_no_allocation<SphereCluster>({clustering, Lookup::scan, true});
    expect_no_allocation<SphereCluster>({clustering, Lookup::scan, false});
    expect_no_allocation<SphereCluster>({clustering, Lookup::tree, true});
  }
}

}  // namespace
}  // namespace touchmark
