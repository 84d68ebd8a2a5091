#include "bench/trajectories/trajectory_shapes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bench/trajectories/motion_path.h"
#include "bench/trajectories/surface.h"

namespace touchmark::bench::trajectories {
namespace {

/// Short runs move faster, so that they too come down on the surface several times.
double pace(std::size_t steps) { return std::clamp(static_cast<double>(steps) / 8000, 0.0, 1.0); }

std::size_t ticks(double count) { return static_cast<std::size_t>(std::max(1.0, std::ceil(count))); }

/// As far beyond the surface as half a ball reaches: in contact whatever the radius.
Vec3 pressed(const SurfacePoint& surface_point, double radius) {
  return surface_point.point - 0.5 * radius * surface_point.normal;
}

/// On the ray from the surface through the centre, no farther than `height`.
Vec3 held_to(const Contact& contact, const Vec3& center, double height) {
  return contact.distance <= height ? center : Vec3(contact.point + height * contact.normal);
}

/// Notices a motion that gets nowhere: caught in a corner, or on one of a soup's shreds with dead ends all
/// round.
class Progress {
 public:
  explicit Progress(double min_extent) : min_extent_(min_extent) {}

  void dead_end() { ++dead_ends_; }
  bool stalled(const Vec3& position) {
    visited_.extend(position);
    if (dead_ends_ >= max_dead_ends) return true;
    if (++ticks_ < ticks_watched) return false;
    const bool confined = !(visited_.diagonal() > min_extent_);
    visited_ = {};
    ticks_ = 0;
    return confined;
  }
  void restart() { *this = Progress(min_extent_); }

 private:
  static constexpr int ticks_watched = 1024, max_dead_ends = 32;
  double min_extent_;
  int ticks_ = 0, dead_ends_ = 0;
  Aabb visited_;
};

/// The thinnest few of many random places.
std::vector<SurfacePoint> find_thin_points(Surface& surface, Motion& motion) {
  struct Measured {
    double thickness;
    SurfacePoint surface_point;
  };
  std::vector<Measured> found;
  for (int i = 0; i < 256; ++i) {
    const SurfacePoint surface_point = surface.random_surface_point(motion.random);
    found.push_back({surface.thickness(surface_point, motion.diagonal), surface_point});
  }
  std::ranges::stable_sort(found,
                           [](const Measured& a, const Measured& b) { return a.thickness < b.thickness; });
  std::vector<SurfacePoint> thinnest;
  for (std::size_t i = 0; i < 64; ++i) thinnest.push_back(found[i].surface_point);
  return thinnest;
}

}  // namespace

// Every tick goes one step along the heading, and back towards the nearest point where that left the ball's
// reach. The way back is at most as long as the step, as the distance changes by no more than the centre
// moves: so no step is longer than two.
Positions slide(Motion motion) {
  Surface surface(motion.mesh);
  const double step = motion.speed.value_or(slide_speed) * motion.diagonal;
  const double highest = 0.9 * motion.radius;
  Positions path;
  path.reserve(motion.steps);
  Vec3 heading = Vec3::Zero();
  Progress progress(0.1 * motion.diagonal);
  const auto land = [&] {
    const SurfacePoint surface_point = surface.random_surface_point(motion.random);
    path.push_back(surface_point.point + 0.5 * highest * surface_point.normal);
    heading = motion.random.direction();
    progress.restart();
  };
  land();
  Contact contact = surface.nearest(path.back());
  double wanted = 0.5;  // height of the centre over the surface, in `highest`
  while (path.size() < motion.steps) {
    const Vec3 from = path.back();
    heading += 0.05 * motion.random.direction();
    heading -= heading.dot(contact.normal) * contact.normal;
    // On an edge of a bare point's way the next face may lie across the heading: any direction will do.
    heading = heading.norm() > 0.01 ? heading.normalized() : motion.random.direction();
    wanted = std::clamp(wanted + motion.random.between(-0.02, 0.02), 0.05, 0.95);
    const double rise = highest > 0 ? 0.5 * (wanted - contact.distance / highest) : 0;
    const Vec3 to = from + step * (heading + rise * contact.normal).normalized();
    contact = surface.nearest(to);
    path.push_back(held_to(contact, to, highest));
    if (!((path.back() - from).norm() > 0.25 * step)) {
      heading = motion.random.direction();
      progress.dead_end();
    }
    if (progress.stalled(path.back())) {
      path.pop_back();
      land();
      contact = surface.nearest(path.back());
    }
  }
  return path;
}

Positions approach(Motion motion) {
  Surface surface(motion.mesh);
  // At a given speed the ways keep it, however few steps there are.
  const double slowness = motion.speed ? slide_speed / *motion.speed : pace(motion.steps);
  const std::size_t way_in = ticks(600 * slowness), press = ticks(60 * slowness);
  Path path(motion.steps);
  while (!path.full()) {
    const SurfacePoint surface_point = surface.random_surface_point(motion.random);
    const Vec3 start = surface_point.point + 0.3 * motion.diagonal * surface_point.normal;
    const Vec3 light = surface_point.point + 0.5 * motion.radius * surface_point.normal;
    const Vec3 firm = pressed(surface_point, motion.radius);
    // To the next start in a straight line, through the object if need be.
    path.go(start, ticks(1000 * slowness * path.distance_to(start) / motion.diagonal));
    path.go(firm, way_in);
    for (int i = 0; i < 2; ++i) {
      path.go(light, press);
      path.go(firm, press);
    }
    path.go(start, way_in);
  }
  return std::move(path).positions();
}

// A step out of the band is taken again with another heading; the step back always exists.
Positions hover(Motion motion) {
  Surface surface(motion.mesh);
  const double step = motion.speed.value_or(hover_speed) * motion.diagonal;
  const double nearest = 0.02 * motion.diagonal, farthest = 0.3 * motion.diagonal;
  // The nearest point of a centre stays nearest all the way to it, so this starts in the band for certain.
  const Vec3 outside = motion.mesh.bounds().center() + 2 * motion.diagonal * motion.random.direction();
  const Contact first = surface.nearest(outside);
  Positions path = {first.point + motion.random.between(0.1, 0.2) * motion.diagonal * first.normal};
  path.reserve(motion.steps);
  Vec3 heading = motion.random.direction();
  constexpr int attempts = 16;
  while (path.size() < motion.steps) {
    const Vec3 from = path.back();
    heading = (heading + 0.05 * motion.random.direction()).normalized();
    Vec3 next = from;
    for (int i = 0; i < attempts; ++i) {
      const Vec3 to = from + step * heading;
      const Contact contact = surface.nearest(to);
      if (contact.distance >= nearest && contact.distance <= farthest) {
        next = to;
        break;
      }
      const bool too_near = contact.distance < nearest;
      const Vec3 away = too_near ? contact.normal : Vec3(-contact.normal);
      heading = (away + motion.random.direction()).normalized();
    }
    path.push_back(next);
  }
  return path;
}

Positions jump(Motion motion) {
  const Aabb& box = motion.mesh.bounds();
  // A flat mesh's box gets some height, or every point would lie in its plane.
  const Vec3 half = 0.6 * box.extent().cwiseMax(Vec3::Constant(0.1 * motion.diagonal));
  Positions path;
  path.reserve(motion.steps);
  for (std::size_t i = 0; i < motion.steps; ++i) {
    const double x = motion.random.between(-1, 1), y = motion.random.between(-1, 1),
                 z = motion.random.between(-1, 1);
    path.push_back(box.center() + half.cwiseProduct(Vec3(x, y, z)));
  }
  return path;
}

Positions tap(Motion motion) {
  Surface surface(motion.mesh);
  const double slowness = pace(motion.steps);
  const std::size_t stroke = ticks(20 * slowness);
  Path path(motion.steps);
  while (!path.full()) {
    const SurfacePoint surface_point = surface.random_surface_point(motion.random);
    const Vec3 lifted =
        surface_point.point + (2 * motion.radius + 0.01 * motion.diagonal) * surface_point.normal;
    path.go(lifted, ticks(200 * slowness * path.distance_to(lifted) / motion.diagonal));
    for (int i = 0; i < 3; ++i) {
      path.go(pressed(surface_point, motion.radius), stroke);
      path.go(lifted, stroke);
    }
  }
  return std::move(path).positions();
}

Positions cross(Motion motion) {
  Surface surface(motion.mesh);
  const double speed = std::clamp(4 * motion.radius, 0.01 * motion.diagonal, 0.5 * motion.diagonal);
  const double run_up = std::max(0.1 * motion.diagonal, 3 * speed);
  const std::vector<SurfacePoint> thin_points = find_thin_points(surface, motion);
  Path path(motion.steps);
  while (!path.full()) {
    const SurfacePoint& surface_point = thin_points[motion.random.below(thin_points.size())];
    // Not always square on: tilted by up to 45 degrees.
    const Vec3 aside =
        motion.random.direction();  // before its length: compilers choose an order of their own
    const Vec3 direction = (surface_point.normal + motion.random.unit() * aside).normalized();
    const Vec3 a = surface_point.point + run_up * direction, b = surface_point.point - run_up * direction;
    const bool outwards = motion.random.below(2) == 0;
    path.fly(outwards ? b : a, speed);
    path.fly(outwards ? a : b, speed);
  }
  return std::move(path).positions();
}

}  // namespace touchmark::bench::trajectories
