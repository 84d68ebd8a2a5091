// What must not depend on how a mesh is written down: its unit, its axes, the order of its triangles.
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "bench/oracle/oracle.h"
#include "core/aabb_tree/aabb_tree.h"
#include "core/brute_force/brute_force.h"
#include "core/float_limits.h"
#include "core/grid_group/grid_group.h"
#include "core/grid_group/published/published_grid_group.h"
#include "core/sphere_cluster/published/published_sphere_cluster.h"
#include "core/sphere_cluster/sphere_cluster.h"
#include "tests/bench/oracle/corner_case_meshes.h"

namespace touchmark {
namespace {

/// A mesh and probes whose radii are at the distance, beside it, and far from it.
struct AskedMesh {
  std::string name;
  TriangleMesh mesh;
  std::vector<Probe> probes;
  std::vector<double> scale;  ///< of a probe: the largest coordinate difference to the nearest triangle
};

std::vector<AskedMesh> asked_meshes() {
  std::vector<AskedMesh> all;
  for (const NamedMesh& named : corner_case_meshes()) {
    const bench::oracle::Oracle oracle(named.mesh);
    CornerCases cases(90);
    AskedMesh asked{named.name, named.mesh, {}, {}};
    for (const Vec3& point : corner_case_points(named.mesh, cases, 30)) {
      const bench::oracle::GroundTruth truth = oracle.solve(point);
      if (!truth.defined || std::isinf(truth.high)) continue;
      for (const double radius : {truth.high, std::nextafter(truth.high, 0.0),
                                  std::nextafter(truth.high, infinity), 2 * truth.high}) {
        asked.probes.push_back({point, radius});
        asked.scale.push_back(truth.largest_difference);
      }
    }
    all.push_back(std::move(asked));
  }
  return all;
}

template <class Map>
TriangleMesh mapped(const TriangleMesh& mesh, const Map& map) {
  std::vector<Vec3> vertices;
  for (const Vec3& v : mesh.vertices()) vertices.push_back(map(v));
  return {std::move(vertices),
          {mesh.triangles().begin(), mesh.triangles().end()},
          {mesh.ids().begin(), mesh.ids().end()}};
}

struct Answer {
  bool touches = false;
  std::optional<Contact> contact;
};

template <class D>
std::vector<Answer> answers(const D& detector, const std::vector<Probe>& probes) {
  typename D::Session session;
  std::vector<Answer> all;
  for (const Probe& probe : probes)
    all.push_back({detector.touches(probe, session), detector.nearest(probe, probe.radius, session)});
  return all;
}

std::uint64_t bits(double x) { return std::bit_cast<std::uint64_t>(x); }

template <class D>
struct Form {
  std::vector<Answer> ask(const TriangleMesh& mesh, const std::vector<Probe>& probes) const {
    return answers(D::build(mesh), probes);
  }
};

/// Calls check(name, form) for every exact form.
template <class Check>
void for_every_form(const Check& check) {
  check("brute-force", Form<BruteForce>());
  check("aabb-tree", Form<AabbTree>());
  check("grid-group", Form<GridGroup>());
  check("grid-group:lookup=scan", Form<PublishedGridGroup>());
  check("sphere-cluster", Form<SphereCluster>());
  check("sphere-cluster:lookup=scan", Form<PublishedSphereCluster>());
}

TEST(Symmetries, AnotherUnitByAPowerOfTwoChangesNoBit) {
  for (const AskedMesh& asked : asked_meshes()) {
    for (const int exponent : {-30, 1, 30}) {
      const double unit = std::ldexp(1.0, exponent);
      std::vector<Probe> probes;
      for (const Probe& p : asked.probes) probes.push_back({unit * p.center, unit * p.radius});
      const TriangleMesh mesh = mapped(asked.mesh, [&](const Vec3& v) -> Vec3 { return unit * v; });
      for_every_form([&](const char* name, const auto& form) {
        const auto plain = form.ask(asked.mesh, asked.probes), scaled = form.ask(mesh, probes);
        for (std::size_t i = 0; i < plain.size(); ++i) {
          const std::string where = asked.name + ", " + name + ", probe " + std::to_string(i);
          ASSERT_EQ(plain[i].touches, scaled[i].touches) << where;
          ASSERT_EQ(plain[i].contact.has_value(), scaled[i].contact.has_value()) << where;
          if (!plain[i].contact) continue;
          const Contact &a = *plain[i].contact, &b = *scaled[i].contact;
          ASSERT_EQ(a.triangle, b.triangle) << where;
          ASSERT_EQ(bits(unit * a.distance), bits(b.distance)) << where;
          for (int k = 0; k < 3; ++k) {
            ASSERT_EQ(unit * a.point[k], b.point[k]) << where;
            ASSERT_EQ(a.normal[k], b.normal[k]) << where;
          }
        }
      });
    }
  }
}

// The order in which squares are added changes, and with it the last bits of a distance, but no decision.
TEST(Symmetries, OtherAxesChangeNoDecision) {
  const auto turned = [](const Vec3& v) -> Vec3 { return {v.z(), -v.x(), v.y()}; };
  for (const AskedMesh& asked : asked_meshes()) {
    std::vector<Probe> probes;
    for (const Probe& p : asked.probes) probes.push_back({turned(p.center), p.radius});
    const TriangleMesh mesh = mapped(asked.mesh, turned);
    for_every_form([&](const char* name, const auto& form) {
      const auto plain = form.ask(asked.mesh, asked.probes), other = form.ask(mesh, probes);
      for (std::size_t i = 0; i < plain.size(); ++i) {
        const std::string where = asked.name + ", " + name + ", probe " + std::to_string(i);
        ASSERT_EQ(plain[i].touches, other[i].touches) << where;
        ASSERT_EQ(plain[i].contact.has_value(), other[i].contact.has_value()) << where;
        if (!plain[i].contact) continue;
        // Each within 16 roundings of the true distance.
        ASSERT_LE(std::abs(plain[i].contact->distance - other[i].contact->distance),
                  2 * 16 * unit_roundoff * asked.scale[i])
            << where;
      }
    });
  }
}

TEST(Symmetries, AnotherOrderOfTheTrianglesChangesNoBitOfADistance) {
  for (const AskedMesh& asked : asked_meshes()) {
    CornerCases cases(91);
    std::vector<TriangleMesh::Corners> triangles(asked.mesh.triangles().begin(),
                                                 asked.mesh.triangles().end());
    cases.shuffle(triangles);
    const TriangleMesh mesh({asked.mesh.vertices().begin(), asked.mesh.vertices().end()},
                            std::move(triangles));
    for_every_form([&](const char* name, const auto& form) {
      const auto plain = form.ask(asked.mesh, asked.probes), shuffled = form.ask(mesh, asked.probes);
      for (std::size_t i = 0; i < plain.size(); ++i) {
        const std::string where = asked.name + ", " + name + ", probe " + std::to_string(i);
        ASSERT_EQ(plain[i].touches, shuffled[i].touches) << where;
        ASSERT_EQ(plain[i].contact.has_value(), shuffled[i].contact.has_value()) << where;
        if (plain[i].contact) {
          ASSERT_EQ(bits(plain[i].contact->distance), bits(shuffled[i].contact->distance)) << where;
        }
      }
    });
  }
}

}  // namespace
}  // namespace touchmark
