/// A scene of two plates: one thread lowers the upper one onto a haptic point, which another thread asks
/// about.
#include <atomic>
#include <cstdio>
#include <optional>
#include <thread>

#include <touchmark/shared_scene.h>
#include <touchmark/sphere_cluster.h>

using touchmark::SphereCluster;

int main() {
  touchmark::SharedScene<SphereCluster> scene;
  const auto plate = scene.add_shape(touchmark::Shape<SphereCluster>::build(
      touchmark::TriangleMesh({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}})));
  scene.add(plate, touchmark::pose_of({0, 0, -2}, 1, 0, 0, 0));
  const touchmark::BodyId upper = scene.add(plate, touchmark::pose_of({0, 0, 2}, 1, 0, 0, 0));
  scene.publish();

  std::atomic<bool> touched = false;
  std::thread haptics([&] {
    touchmark::Scene<SphereCluster>::Session session;  // one for each haptic point, kept from tick to tick
    const touchmark::Probe probe{{0.25, 0.5, 0}, 0.125};
    while (!touched) {
      const auto frame = scene.read();  // the bodies stand still as long as this lives
      const std::optional<touchmark::BodyContact> contact = frame->nearest_body(probe, probe.radius, session);
      if (!contact) continue;
      std::printf("body %u, triangle %u, from above: %s\n", contact->body.index, contact->contact.triangle,
                  contact->contact.normal.z() < 0 ? "yes" : "no");
      touched = true;
    }
  });
  for (double z = 2; !touched; z = z > 0.125 ? z - 0.0625 : z) {
    scene.move(upper, touchmark::pose_of({0, 0, z}, 1, 0, 0, 0));
    scene.publish();
  }
  haptics.join();
}
