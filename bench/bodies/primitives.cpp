#include "bench/bodies/primitives.h"

#include <utility>

#include "bench/scenes/surface_builder.h"

namespace touchmark::bench::bodies {

TriangleMesh box_of(const Vec3& size) {
  scenes::Surface surface;
  scenes::add_box(surface, -0.5 * size, 0.5 * size);
  return std::move(surface).mesh();
}

TriangleMesh plane_of(double size_x, double size_y) {
  const double x = 0.5 * size_x, y = 0.5 * size_y;
  scenes::Surface surface;
  for (const Vec3& corner : {Vec3(-x, -y, 0), Vec3(x, -y, 0), Vec3(x, y, 0), Vec3(-x, y, 0)})
    surface.add(corner);
  surface.quad(0, 1, 2, 3);
  return std::move(surface).mesh();
}

}  // namespace touchmark::bench::bodies
