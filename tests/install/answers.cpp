/// Prints, bit by bit, what every detector and every inline function that rounds answers on a fixed scene, so
/// that builds of this file with different flags can be compared. Its own arithmetic is exact.
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <optional>
#include <vector>

#include <touchmark/aabb_tree.h>
#include <touchmark/auto_detector.h>
#include <touchmark/brute_force.h>
#include <touchmark/certified_field.h>
#include <touchmark/clustering.h>
#include <touchmark/float_tree.h>
#include <touchmark/grid_group.h>
#include <touchmark/mesh_measures.h>
#include <touchmark/nearest_many.h>
#include <touchmark/published_grid_group.h>
#include <touchmark/published_sphere_cluster.h>
#include <touchmark/signed_detector.h>
#include <touchmark/sphere_cluster.h>
#include <touchmark/subdivision.h>

namespace {

using touchmark::Contact, touchmark::Impact, touchmark::Probe, touchmark::Sweep, touchmark::Vec3;

class Numbers {
 public:
  /// A multiple of 2^-20 in [-1, 1).
  double next() {
    state_ = state_ * 6364136223846793005U + 1442695040888963407U;
    return static_cast<double>(static_cast<std::int64_t>(state_ >> 43) - (1 << 20)) * 0x1p-20;
  }
  Vec3 vector() {
    const double x = next(), y = next(), z = next();
    return {x, y, z};
  }

 private:
  std::uint64_t state_ = 20;
};

class Hash {
 public:
  void add(std::uint64_t bits) { value_ = (value_ ^ bits) * 0x100000001b3U; }
  void add(double x) { add(std::bit_cast<std::uint64_t>(x)); }
  void add(const Vec3& v) {
    for (const double x : {v.x(), v.y(), v.z()}) add(x);
  }
  void add(const std::optional<Contact>& contact) {
    add(std::uint64_t{contact.has_value()});
    if (!contact) return;
    add(contact->point);
    add(contact->normal);
    add(contact->distance);
    add(std::uint64_t{contact->triangle});
    add(static_cast<std::uint64_t>(contact->side));
  }
  void add(const std::optional<Impact>& impact) {
    add(std::uint64_t{impact.has_value()});
    if (!impact) return;
    add(impact->fraction);
    add(std::optional(impact->contact));
  }
  void print(const char* name) const {
    std::printf("%s %016llx\n", name, static_cast<unsigned long long>(value_));
  }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

/// A closed, uneven surface: an octahedron split three times, every vertex moved a little.
touchmark::TriangleMesh uneven_surface() {
  const touchmark::TriangleMesh octahedron(
      {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
      {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}});
  touchmark::SubdivisionOptions options;
  options.method = touchmark::SubdivisionMethod::loop;
  options.levels = 3;
  const touchmark::TriangleMesh smooth = subdivide(octahedron, options);
  Numbers numbers;
  std::vector<Vec3> vertices(smooth.vertices().begin(), smooth.vertices().end());
  for (Vec3& vertex : vertices) vertex += 0x1p-6 * numbers.vector();
  return {vertices, {smooth.triangles().begin(), smooth.triangles().end()}};
}

/// Centres that creep, as a hand does, and centres that jump.
std::vector<Vec3> centers() {
  Numbers numbers;
  std::vector<Vec3> result;
  Vec3 at(1, 0.5, 0.25);
  for (int i = 0; i < 3000; ++i) {
    at = i % 100 == 0 ? numbers.vector() : Vec3(at + 0x1p-8 * numbers.vector());
    result.push_back(at);
  }
  return result;
}

template <class D>
void ask(const char* name, const D& detector) {
  Hash hash;
  typename D::Session session;
  const std::vector<Vec3> way = centers();
  for (std::size_t i = 0; i < way.size(); ++i) {
    const Probe probe{way[i], 0.0625};
    hash.add(std::uint64_t{detector.touches(probe, session)});
    hash.add(detector.nearest(probe, i % 3 == 0 ? std::numeric_limits<double>::infinity() : 0.125, session));
    if constexpr (touchmark::AnswersSweep<D>) {
      if (i % 10 == 9) hash.add(detector.first_hit(Sweep{way[i - 9], way[i], 0.03125}, session));
    }
  }
  std::vector<std::optional<Contact>> answers(way.size());
  touchmark::nearest_many(detector, way, 0.125, answers, {2, touchmark::AskOrder::curve});
  for (const std::optional<Contact>& answer : answers) hash.add(answer);
  hash.print(name);
}

void measure(const touchmark::TriangleMesh& mesh) {
  Hash hash;
  hash.add(mesh.diagonal());
  hash.add(mesh.normalized().vertices()[7]);
  hash.add(mesh.transformed(3, Vec3(0.1, 0.2, 0.3)).bounds().center());
  for (const Vec3& center : centers()) hash.add(mesh.bounds().squared_distance(center));
  hash.add(mean_triangle_area(mesh));
  const touchmark::SphereClusters clusters = touchmark::cluster_spheres(mesh, 0.125);
  for (const Vec3& center : centers()) hash.add(std::uint64_t{clusters.spheres.front().contains(center)});
  const auto tree = touchmark::AabbTree::build(mesh);
  touchmark::Work work;
  for (const Vec3& center : centers())
    tree.for_each_near(center, 0.0625, work,
                       [&](const auto& triangle) { hash.add(std::uint64_t{triangle.index}); });
  hash.print("measures");
}

}  // namespace

int main() {
  using namespace touchmark;
  const TriangleMesh mesh = uneven_surface();
  measure(mesh);
  ask("brute force", BruteForce::build(mesh));
  ask("aabb tree", AabbTree::build(mesh));
  ask("float tree", FloatTree::build(mesh));
  ask("grid group", GridGroup::build(mesh));
  ask("grid group, scan", PublishedGridGroup::build(mesh));
  ask("sphere cluster", SphereCluster::build(mesh));
  ask("sphere cluster, scan", PublishedSphereCluster::build(mesh));
  ask("auto", AutoDetector::build(mesh));
  CertifiedField<SphereCluster>::Options coarse;
  coarse.error = 0.015625;
  ask("field", CertifiedField<SphereCluster>::build(mesh, coarse));
  ask("signed grid group", Signed<GridGroup>::build(mesh));
  ask("signed sphere cluster", Signed<SphereCluster>::build(mesh));
  try {
    TriangleMesh({}, {});
  } catch (const MeshError& error) {
    std::printf("%s\n", error.what());
  }
}
