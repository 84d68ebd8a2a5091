/// A mesh that moves: one corner of a plate is pulled up, and the same session goes on.
#include <cstdio>
#include <vector>

#include <touchmark/grid_group.h>

int main() {
  std::vector<touchmark::Vec3> vertices{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const std::vector<touchmark::TriangleMesh::Corners> triangles{{0, 1, 2}, {0, 2, 3}};

  auto detector = touchmark::GridGroup::build(touchmark::TriangleMesh(vertices, triangles));
  touchmark::GridGroup::Session session;

  const touchmark::Probe probe{{0.75, 0.25, 0.25}, 0.2};
  std::printf("flat: %s\n", detector.touches(probe, session) ? "touching" : "free");

  // The same triangles with vertices elsewhere. No query may run meanwhile.
  vertices[1].z() = 0.5;
  detector.update(touchmark::TriangleMesh(vertices, triangles));
  std::printf("pulled up: %s\n", detector.touches(probe, session) ? "touching" : "free");
}
