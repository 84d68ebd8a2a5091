// Prints what detectors of Touchmark answer about one triangle, and an error that one of its functions has thrown.
#include <touchmark/aabb_tree.h>
#include <touchmark/auto_detector.h>
#include <touchmark/force_shading.h>
#include <touchmark/grid_group.h>
#include <touchmark/nearest_many.h>
#include <touchmark/proxy.h>
#include <touchmark/scene.h>
#include <touchmark/shared_scene.h>
#include <touchmark/signed_detector.h>
#include <touchmark/sphere_cluster.h>
#include <touchmark/subdivision.h>
#if HAS_MESH_IO
#include <touchmark/mesh_io.h>
#endif

#include <iostream>

namespace {

template <class D>
void ask(const touchmark::TriangleMesh& mesh) {
  const auto detector = D::build(mesh);
  typename D::Session session;
  const touchmark::Probe probe{{0.25, 0.25, 0.125}, 0.5};
  if (const auto contact = detector.nearest(probe, probe.radius, session))
    std::cout << "triangle " << contact->triangle << " at " << contact->distance << '\n';
}

}  // namespace

int main() {
  const touchmark::TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  ask<touchmark::GridGroup>(mesh);
  ask<touchmark::Signed<touchmark::SphereCluster>>(mesh);
  try {
    touchmark::TriangleMesh({}, {});
  } catch (const touchmark::MeshError& error) {
    std::cout << "MeshError: " << error.what() << '\n';
  }
#if HAS_MESH_IO
  try {
    touchmark::load_mesh("nothing.stl");
  } catch (const touchmark::MeshError& error) {
    std::cout << "MeshError: " << error.what() << '\n';
  }
#endif
}
