/// What a haptic loop asks: a ball is lowered onto a plate, and a spring pushes it back out.
#include <cstdio>
#include <optional>

#include <touchmark/sphere_cluster.h>

namespace {

/// A square plate in the plane z = 0, in metres.
touchmark::TriangleMesh plate() {
  return touchmark::TriangleMesh({{0, 0, 0}, {0.1, 0, 0}, {0.1, 0.1, 0}, {0, 0.1, 0}},
                                 {{0, 1, 2}, {0, 2, 3}});
}

/// The force of a spring of 500 N/m, as long as the ball is nearer to the surface than its radius.
touchmark::Vec3 force(const touchmark::Contact& contact, double radius) {
  return 500 * (radius - contact.distance) * contact.normal;
}

}  // namespace

int main() {
  const touchmark::TriangleMesh mesh = plate();
  const auto detector = touchmark::SphereCluster::build(mesh);
  touchmark::SphereCluster::Session session;  // one for each haptic point, kept from tick to tick

  touchmark::Probe probe{{0.04, 0.03, 0.0058}, 0.005};
  for (int tick = 0; tick < 4; ++tick) {
    // A device would say here where the point is.
    const std::optional<touchmark::Contact> contact = detector.nearest(probe, probe.radius, session);
    if (contact) {
      std::printf("tick %d: %.2f N, triangle %u\n", tick, force(*contact, probe.radius).z(),
                  contact->triangle);
    } else {
      std::printf("tick %d: free\n", tick);
    }
    // A real loop sleeps here. After waking, before the device is read, what the next query needs comes back
    // into the caches. It changes no answer.
    detector.prepare(session);
    probe.center.z() -= 0.0005;
  }
}
