#include "bench/experiments/proxy/motion.h"

#include "bench/meshes/portable_sincos.h"

namespace touchmark::bench::experiments::proxy {

void Motion::jump(const Vec3& to) {
  at_ = to;
  if (!done()) goals_.push_back(to);
}

void Motion::line(const Vec3& to, std::size_t ticks) {
  const Vec3 from = at_;
  for (std::size_t i = 1; i < ticks; ++i)
    jump(from + (static_cast<double>(i) / static_cast<double>(ticks)) * (to - from));
  jump(to);
}

void Motion::rest(std::size_t ticks) {
  for (std::size_t i = 0; i < ticks; ++i) jump(at_);
}

void Motion::circle(const Vec3& center, const Vec3& u, const Vec3& v, std::size_t ticks) {
  for (std::size_t i = 1; i <= ticks; ++i) {
    const meshes::SinCos turn =
        meshes::portable_sincos(static_cast<double>(i % ticks) / static_cast<double>(ticks));
    jump(center + turn.cos * u + turn.sin * v);
  }
}

void Motion::tremor(support::Random& random, double amplitude, std::size_t ticks) {
  const Vec3 about = at_;
  for (std::size_t i = 0; i < ticks; ++i) {
    const Vec3 to = at_ + 0.2 * amplitude * random.direction();
    jump((to - about).norm() > amplitude ? about : to);
  }
}

namespace {

struct Spot {
  Vec3 point, normal;
};

Spot spot_on(const TriangleMesh& mesh, support::Random& random) {
  const std::size_t index = random.below(mesh.size());
  const Vec3 &a = mesh.corner(index, 0), &b = mesh.corner(index, 1), &c = mesh.corner(index, 2);
  const Vec3 normal = (b - a).cross(c - a);
  const double area = normal.norm();
  const double u = random.unit(), v = random.unit();
  const Vec3 any = random.direction();
  return {support::point_in_triangle(a, b, c, u, v), area > 0 ? Vec3(normal / area) : any};
}

}  // namespace

void explore(const TriangleMesh& mesh, support::Random& random, Motion& motion) {
  const double diagonal = mesh.diagonal();
  while (!motion.done()) {
    const Spot spot = spot_on(mesh, random);
    const Vec3 above = spot.point + random.between(0.05, 0.2) * diagonal * spot.normal;
    motion.line(above, 20 + random.below(30));
    const double depth = random.between(0, 0.15) * diagonal;
    const Vec3 pressed = spot.point - depth * spot.normal;
    switch (random.below(5)) {
      case 0:  // 100 diagonals a second: a tenth of one a tick
        motion.line(spot.point - diagonal * spot.normal, 10);
        motion.rest(12);
        motion.line(above, 10);
        break;
      case 1:
        motion.line(pressed, 25);
        motion.rest(20);
        break;
      case 2:
        motion.line(pressed, 25);
        motion.tremor(random, 0.01 * diagonal, 60);
        break;
      default:
        motion.line(pressed, 25);
        for (std::size_t i = 1 + random.below(4); i > 0; --i) {
          const Vec3 aside = random.direction().cross(spot.normal);
          motion.line(pressed + random.between(0, 0.3) * diagonal * aside, 20 + random.below(60));
        }
        motion.rest(15);
    }
    motion.line(above, 15);
  }
}

}  // namespace touchmark::bench::experiments::proxy
