/// Queries take no memory: every allocation of the process is counted here, and a query must not add to them.
#include <array>
#include <cstddef>
#include <cstdlib>
#include <new>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "core/aabb_tree/aabb_tree.h"
#include "core/brute_force/brute_force.h"
#include "core/grid_group/grid_group.h"
#include "core/search/many/nearest_many.h"
#include "core/sphere_cluster/sphere_cluster.h"
#include "tests/core/query_pass.h"
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

void expect_no_allocation(const bench::contestants::ContestantSpec& spec) {
  const auto detector = own_roster().build(spec, test::sheet(20));
  test::QueryPass pass;
  const std::size_t before = allocations;
  const std::size_t answered = pass.ask(*detector);
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

TEST(NoAllocation, InLaterCallsForAsManyPoints) {
  const auto detector = SphereCluster::build(test::sheet(20));
  std::vector<Vec3> points;
  for (std::uint32_t i = 0; i < 1000; ++i) points.emplace_back(i * 149 % 1000 / 1e3, i % 31 / 31.0, 0.05);
  std::vector<std::optional<Contact>> answers(points.size());
  ManySessions<SphereCluster> sessions;
  const auto ask = [&] {
    nearest_many(detector, points, 0.2, answers, sessions, {2, AskOrder::automatic});
    for (Vec3& point : points) point.x() += 1e-4;
  };
  ask();
  const std::size_t before = allocations;
  for (int tick = 0; tick < 10; ++tick) ask();
  for (Vec3& point : points) point = Vec3(point.y(), point.x(), point.z() / 2);  // an order of its own
  ask();
  EXPECT_EQ(allocations, before);
  EXPECT_TRUE(answers[0]);
}

template <class D>
void expect_contacts_take_nothing() {
  const D detector = D::build(test::sheet(20));
  typename D::Session session;
  std::array<Contact, 8> room;
  const std::size_t before = allocations;
  std::size_t contacts = 0;
  for (int i = 0; i < 200; ++i)
    contacts += detector.contacts({{i / 200.0, 0.4, 0.05}, 0}, 0.1, session, room);
  EXPECT_EQ(allocations, before);
  EXPECT_GT(contacts, 400u);
}

TEST(NoAllocation, WhereAllContactsAreAsked) {
  expect_contacts_take_nothing<BruteForce>();
  expect_contacts_take_nothing<AabbTree>();
  expect_contacts_take_nothing<GridGroup>();
  expect_contacts_take_nothing<SphereCluster>();
}

TEST(NoAllocation, WhereTheSideIsAsked) {
  for (const bench::contestants::ContestantSpec& spec : own_forms_with_side()) expect_no_allocation(spec);
}

}  // namespace
}  // namespace touchmark
