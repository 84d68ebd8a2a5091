// Prints what Touchmark answers about one triangle, and the errors that its libraries throw.
#include <touchmark/contestant.h>
#include <touchmark/nearest_many.h>
#include <touchmark/proxy.h>
#include <touchmark/scene.h>
#include <touchmark/signed_detector.h>
#include <touchmark/sphere_cluster.h>
#if HAS_MESH_IO
#include <touchmark/mesh_io.h>
#endif

#include <iostream>

namespace {

using Detector = touchmark::Signed<touchmark::SphereCluster>;

template <class F>
void print_error(const F& function) {
  try {
    function();
  } catch (const touchmark::MeshError& error) {
    std::cout << "MeshError: " << error.what() << '\n';
  }
}

}  // namespace

int main() {
  const touchmark::TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const auto detector = Detector::build(mesh);
  Detector::Session session;
  const touchmark::Probe probe{{0.25, 0.25, 0.125}, 0.5};
  if (const auto contact = detector.nearest(probe, probe.radius, session))
    std::cout << "triangle " << contact->triangle << " at " << contact->distance << '\n';

  touchmark::Proxy proxy(detector, {.radius = 0.125, .stiffness = 1}, &mesh);
  proxy.place({0.25, 0.25, 1});
  std::cout << "pushed up: " << (proxy.step({0.25, 0.25, -1}, session).force.z() > 0 ? "yes" : "no") << '\n';

  touchmark::Scene<Detector> scene;
  const auto shape = scene.add_shape(touchmark::Shape<Detector>::build(mesh));
  scene.add(shape, touchmark::pose_of({0, 0, 1}, 1, 0, 0, 0));
  touchmark::Scene<Detector>::Session sessions;
  if (const auto contact = scene.nearest_body(probe, 1, sessions))
    std::cout << "body " << contact->body.index << " at " << contact->contact.distance << '\n';

  print_error([] { touchmark::TriangleMesh({}, {}); });
#if HAS_MESH_IO
  print_error([] { touchmark::load_mesh("nothing.stl"); });
#endif
}
