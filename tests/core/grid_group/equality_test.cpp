/// Every form of the grid against brute force, bit for bit.
#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/brute_force/brute_force.h"
#include "core/float_limits.h"
#include "core/grid_group/grid_group.h"
#include "core/grid_group/published/published_grid_group.h"
#include "tests/core/grid_group/meshes.h"

namespace touchmark {
namespace {

using testing::NamedMesh;
using testing::Random;

template <class D>
struct Contestant {
  std::string name;
  D detector;
  typename D::Session used;
};

std::vector<Contestant<PublishedGridGroup>> published_forms(const TriangleMesh& mesh) {
  using enum PublishedGridGroup::Shape;
  std::vector<Contestant<PublishedGridGroup>> forms;
  for (const double part : {0.0, 0.3, 0.05})
    for (const auto shape : {cube, sphere}) {
      const double cell = part * mesh.diagonal();
      forms.push_back({(shape == cube ? "scan cube " : "scan sphere ") + std::to_string(cell),
                       PublishedGridGroup::build(mesh, {.shape = shape, .cell = cell}),
                       {}});
    }
  return forms;
}

std::vector<Contestant<GridGroup>> direct_forms(const TriangleMesh& mesh) {
  const double size = mesh.diagonal();
  std::vector<Contestant<GridGroup>> forms;
  for (const GridGroup::Options& options :
       std::initializer_list<GridGroup::Options>{{},
                                                 {.cell = 0.3 * size},
                                                 {.cell = 0.05 * size},
                                                 {.cell = 1e-9 * size},
                                                 {.bytes_per_triangle = 200},
                                                 {.bytes_per_triangle = 4000}})
    forms.push_back(
        {"direct " + std::to_string(options.cell) + ' ' + std::to_string(options.bytes_per_triangle),
         GridGroup::build(mesh, options),
         {}});
  return forms;
}

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

bool same_bits(const Vec3& a, const Vec3& b) {
  return same_bits(a.x(), b.x()) && same_bits(a.y(), b.y()) && same_bits(a.z(), b.z());
}

bool same(const Contact& a, const Contact& b) {
  return a.triangle == b.triangle && same_bits(a.distance, b.distance) && same_bits(a.point, b.point) &&
         same_bits(a.normal, b.normal);
}

bool same(const std::optional<Contact>& a, const std::optional<Contact>& b) {
  return a.has_value() == b.has_value() && (!a || same(*a, *b));
}

bool same(const std::optional<Impact>& a, const std::optional<Impact>& b) {
  return a.has_value() == b.has_value() &&
         (!a || (same_bits(a->fraction, b->fraction) && same(a->contact, b->contact)));
}

/// On the surface, just off it, at a vertex, around the box, far away, and on the borders that cells like.
Vec3 some_center(const TriangleMesh& mesh, Random& random) {
  const double size = mesh.diagonal() > 0 ? mesh.diagonal() : 1;
  const std::uint32_t triangle = random.below(static_cast<std::uint32_t>(mesh.size()));
  const double a = random.unit(), b = random.unit() * (1 - a);
  const Vec3 on_surface = mesh.corner(triangle, 0) +
                          a * (mesh.corner(triangle, 1) - mesh.corner(triangle, 0)) +
                          b * (mesh.corner(triangle, 2) - mesh.corner(triangle, 0));
  switch (random.below(8)) {
    case 0:
      return on_surface;
    case 1:
      return mesh.corner(triangle, 0);
    case 2:
      return on_surface + random.point(1e-9 * size);
    case 3:
      return on_surface + random.point(0.003 * size);
    case 4:
      return on_surface + random.point(0.05 * size);
    case 5:
      return mesh.bounds().center() + random.point(0.7 * size);
    case 6:
      return mesh.bounds().center() + random.point(30 * size);
    default: {
      // Eighths of the box: where its halves, quarters and corners meet.
      const Vec3 steps(random.below(9), random.below(9), random.below(9));
      return mesh.bounds().min + 0.125 * mesh.bounds().extent().cwiseProduct(steps);
    }
  }
}

/// Often the very distance to the nearest triangle, or its neighbours.
double some_reach(double distance, double size, Random& random) {
  switch (random.below(8)) {
    case 0:
      return infinity;
    case 1:
      return 0;
    case 2:
      return distance;
    case 3:
      return std::nextafter(distance, 0);
    case 4:
      return std::nextafter(distance, infinity);
    case 5:
      return 0.005 * size;
    case 6:
      return random.unit() * size;
    default:
      return 2 * distance;
  }
}

class GridGroupEquality : public ::testing::TestWithParam<std::size_t> {};

TEST_P(GridGroupEquality, AnswersAsBruteForceDoes) {
  const NamedMesh named = testing::nasty_meshes()[GetParam()];
  const TriangleMesh& mesh = named.mesh;
  const double size = mesh.diagonal();
  const BruteForce brute = BruteForce::build(mesh);
  BruteForce::Session brute_session;
  auto published = published_forms(mesh);
  auto direct = direct_forms(mesh);

  Random random(11);
  Vec3 center = some_center(mesh, random);
  for (int step = 0; step < 300; ++step) {
    // Walks in small steps, with jumps between, so that what a session remembers is put to use.
    const Vec3 before = center;
    center = step % 5 == 0 ? some_center(mesh, random) : Vec3(center + random.point(0.002 * size));
    const double distance = brute.nearest({center, 0}, infinity, brute_session)->distance;
    const double reach = some_reach(distance, size, random);
    const Sweep sweep{before, center, reach == infinity ? 0.001 * size : 0.3 * reach};
    const auto contact = brute.nearest({center, 0}, reach, brute_session);
    const bool touching = brute.touches({center, reach}, brute_session);
    const auto impact = brute.first_hit(sweep, brute_session);
    const auto expect_the_same = [&]<class D>(Contestant<D>& c) {
      typename D::Session fresh;
      const std::string where = std::string(named.name) + ", " + c.name + ", step " + std::to_string(step);
      ASSERT_TRUE(same(c.detector.nearest({center, 0}, reach, fresh), contact)) << where;
      ASSERT_TRUE(same(c.detector.nearest({center, 0}, reach, c.used), contact)) << where;
      typename D::Session fresh_touch, fresh_sweep;
      ASSERT_EQ(c.detector.touches({center, reach}, fresh_touch), touching) << where;
      ASSERT_EQ(c.detector.touches({center, reach}, c.used), touching) << where;
      ASSERT_TRUE(same(c.detector.first_hit(sweep, fresh_sweep), impact)) << where;
      ASSERT_TRUE(same(c.detector.first_hit(sweep, c.used), impact)) << where;
    };
    for (auto& contestant : published) expect_the_same(contestant);
    for (auto& contestant : direct) expect_the_same(contestant);
    if (HasFatalFailure()) return;
  }
}

std::string test_name(const ::testing::TestParamInfo<std::size_t>& info) {
  std::string name = testing::nasty_meshes()[info.param].name;
  for (char& c : name)
    if (c == ' ') c = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(NastyMeshes, GridGroupEquality,
                         ::testing::Range(std::size_t{0}, testing::nasty_meshes().size()), test_name);

}  // namespace
}  // namespace touchmark
