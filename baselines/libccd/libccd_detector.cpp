#include "baselines/libccd/libccd_detector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <ccd/ccd.h>

#include "core/aabb_tree/aabb_tree.h"

namespace touchmark::baselines {
namespace {

using Algorithm = LibccdDetector::Algorithm;

/// libccd bounds GJK's iterations (by ULONG_MAX unless told) but neither EPA's nor MPR's. All of them ask for
/// support points, so that is where they are stopped: from then on the support is the origin, which each of
/// the loops takes for convergence.
struct Budget {
  int left = 2000;
  bool spent() const { return left < 0; }
};

/// A ball about the origin.
struct Ball {
  double radius;
  Budget* budget;
};

/// Corners relative to the ball's centre.
struct Triangle {
  std::array<Vec3, 3> corner;
  const Budget* budget;
};

Vec3 vec3(const ccd_vec3_t& v) { return Vec3(v.v[0], v.v[1], v.v[2]); }
void set(ccd_vec3_t* out, const Vec3& v) { ccdVec3Set(out, v.x(), v.y(), v.z()); }

void support_of_ball(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* out) {
  const Ball& ball = *static_cast<const Ball*>(object);
  --ball.budget->left;
  const Vec3 towards = vec3(*direction);
  const double length = towards.norm();
  set(out, ball.budget->spent() || !(length > 0) ? Vec3::Zero() : Vec3(ball.radius / length * towards));
}

void support_of_triangle(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* out) {
  const Triangle& triangle = *static_cast<const Triangle*>(object);
  const Vec3 towards = vec3(*direction);
  std::size_t farthest = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (triangle.corner[i].dot(towards) > triangle.corner[farthest].dot(towards)) farthest = i;
  set(out, triangle.budget->spent() ? Vec3::Zero() : triangle.corner[farthest]);
}

void center_of_ball(const void*, ccd_vec3_t* out) { ccdVec3Set(out, 0, 0, 0); }
void center_of_triangle(const void* object, ccd_vec3_t* out) {
  const Triangle& triangle = *static_cast<const Triangle*>(object);
  set(out, (triangle.corner[0] + triangle.corner[1] + triangle.corner[2]) / 3);
}

struct Penetration {
  double depth;
  Vec3 direction;  ///< unit: moving the triangle this way by the depth separates the two
};

/// One ball and one triangle at a time, as libccd sees them.
class Pair {
 public:
  explicit Pair(const LibccdDetector::Options& options) : algorithm_(options.algorithm) {
    CCD_INIT(&ccd_);
    ccd_.support1 = support_of_ball;
    ccd_.support2 = support_of_triangle;
    ccd_.center1 = center_of_ball;
    ccd_.center2 = center_of_triangle;
    ccd_.max_iterations = options.iterations;
    ccd_.epa_tolerance = ccd_.mpr_tolerance = options.tolerance;
  }

  bool intersect(double radius, std::array<Vec3, 3> corners) {
    const auto [ball, triangle] = shapes(radius, std::move(corners));
    return algorithm_ == Algorithm::gjk ? ccdGJKIntersect(&ball, &triangle, &ccd_) != 0
                                        : ccdMPRIntersect(&ball, &triangle, &ccd_) != 0;
  }

  std::optional<Penetration> penetration(double radius, std::array<Vec3, 3> corners) {
    const auto [ball, triangle] = shapes(radius, std::move(corners));
    double depth = 0;
    ccd_vec3_t direction, position;
    const auto find = algorithm_ == Algorithm::gjk ? ccdGJKPenetration : ccdMPRPenetration;
    // -1: apart. -2: no memory.
    if (find(&ball, &triangle, &ccd_, &depth, &direction, &position) != 0) return std::nullopt;
    return Penetration{depth, vec3(direction)};
  }

  bool gave_up() const { return budget_.spent(); }

 private:
  std::pair<Ball, Triangle> shapes(double radius, std::array<Vec3, 3> corners) {
    budget_ = Budget();
    return {Ball{radius, &budget_}, Triangle{std::move(corners), &budget_}};
  }

  Algorithm algorithm_;
  ccd_t ccd_;
  Budget budget_;
};

}  // namespace

struct LibccdDetector::Model : RivalModel<LibccdDetector::Options> {
  Model(const TriangleMesh& mesh, const Options& chosen)
      : RivalModel(mesh, chosen),
        surface(mesh),
        // A pair costs a hundred boxes: one triangle a leaf.
        tree(AabbTree::build(mesh, {.leaf_size = 1})) {}

  /// The scale that makes the radius 1, or the triangle when it is very much larger than the ball.
  double scale_for(double radius, const std::array<Vec3, 3>& corners) const {
    if (options.frame == Frame::mesh) return 1;
    double size = 0;
    for (const Vec3& corner : corners) size = std::max(size, corner.cwiseAbs().maxCoeff());
    constexpr double largest_triangle = 1e8;  // radii: keeps squares of scaled lengths finite
    const double unit = radius > 0 ? std::max(radius, size / largest_triangle) : size;
    return unit > 0 ? 1 / unit : 1;
  }

  static std::array<Vec3, 3> relative(const PreparedTriangle& triangle, const Vec3& center) {
    return {triangle.corner[0] - center, triangle.corner[1] - center, triangle.corner[2] - center};
  }
  std::array<Vec3, 3> relative(std::uint32_t triangle, const Vec3& center) const {
    return {surface.corner(triangle, 0) - center, surface.corner(triangle, 1) - center,
            surface.corner(triangle, 2) - center};
  }
  static std::array<Vec3, 3> scaled(std::array<Vec3, 3> corners, double scale) {
    for (Vec3& corner : corners) corner *= scale;
    return corners;
  }

  /// The nearest so far, from libccd's depths.
  struct Nearest {
    double distance;
    Vec3 direction = Vec3::Zero();  ///< unit, from the centre
    std::uint32_t index = 0;
    bool found = false;
  };

  void consider(Pair& pair, const PreparedTriangle& triangle, const Vec3& center, double reach,
                Nearest& nearest, Session& session) const {
    // MPR is the better the nearer the ball's surface is to the triangle, and cheaper for what stays outside
    // it. EPA is the worse: its tolerance is one of the squared depth.
    const double radius = options.algorithm == Algorithm::mpr ? nearest.distance : reach;
    const std::array<Vec3, 3> corners = relative(triangle, center);
    if (!near_box(corners, radius)) return;
    ++session.work.triangles;
    const double scale = scale_for(radius, corners);
    const std::optional<Penetration> hit = pair.penetration(radius * scale, scaled(corners, scale));
    session.given_up += pair.gave_up();
    if (!hit) return;
    const double distance = std::clamp(radius - hit->depth / scale, 0.0, radius);
    if (nearest.found && std::pair(distance, triangle.index) >= std::pair(nearest.distance, nearest.index))
      return;
    nearest = {distance, hit->direction, triangle.index, true};
  }

  /// Returns true if the triangle's box is within the radius of the origin, to rounding.
  static bool near_box(const std::array<Vec3, 3>& corners, double radius) {
    Aabb box;
    for (const Vec3& corner : corners) box.extend(corner);
    return box.squared_distance(Vec3::Zero()) <= radius * radius * (1 + 1e-12);
  }

  std::optional<Contact> nearest_within(const Vec3& center, double reach, Session& session) const {
    Pair pair(options);
    Nearest nearest{reach};
    Work tree_work;
    tree.for_each_near(center, reach, tree_work, [&](const PreparedTriangle& triangle) {
      consider(pair, triangle, center, reach, nearest, session);
    });
    session.work.boxes += tree_work.boxes;
    session.last = nearest.found ? nearest.index : no_triangle;
    if (!nearest.found) return std::nullopt;
    return Contact{center + nearest.distance * nearest.direction, -nearest.direction, nearest.distance,
                   surface.id(nearest.index)};
  }

  bool touches(const Vec3& center, double radius, Session& session) const {
    Pair pair(options);
    const auto meets = [&](const std::array<Vec3, 3>& corners) {
      if (!near_box(corners, radius)) return false;
      ++session.work.triangles;
      const double scale = scale_for(radius, corners);
      const bool touching = pair.intersect(radius * scale, scaled(corners, scale));
      session.given_up += pair.gave_up();
      return touching;
    };
    const bool first = checked() && session.last < surface.size();
    if (first && meets(relative(session.last, center))) return true;
    session.last = no_triangle;
    Work tree_work;
    tree.for_each_near(center, radius, tree_work, [&](const PreparedTriangle& triangle) {
      if (!meets(relative(triangle, center))) return false;
      session.last = triangle.index;
      return true;
    });
    session.work.boxes += tree_work.boxes;
    return session.last != no_triangle;
  }

  TriangleMesh surface;
  AabbTree tree;
};

LibccdDetector LibccdDetector::build(const TriangleMesh& mesh, const Options& options) {
  if (!(options.tolerance > 0))
    throw std::invalid_argument("libccd+aabb: tolerance=" + std::to_string(options.tolerance) +
                                " is not positive");
  if (options.iterations == 0) throw std::invalid_argument("libccd+aabb: iterations=0 lets GJK do nothing");
  return LibccdDetector(make_hidden<const Model>(mesh, options));
}

bool LibccdDetector::touches(const Probe& probe, Session& session) const noexcept {
  const std::optional<double> radius = model_->reach_to_ask(probe.center, probe.radius, session.last);
  return radius && model_->touches(probe.center, *radius, session);
}

std::optional<Contact> LibccdDetector::nearest(const Probe& probe, double reach,
                                               Session& session) const noexcept {
  const std::optional<double> finite = model_->reach_to_ask(probe.center, reach, session.last);
  if (!finite) return std::nullopt;
  return nearest_by_growing(model_->bounds, probe.center, *finite, [&](double within) {
    return model_->nearest_within(probe.center, within, session);
  });
}

std::size_t LibccdDetector::bytes() const noexcept {
  return model_->tree.bytes() + model_->surface.vertices().size() * sizeof(Vec3) +
         model_->surface.size() * sizeof(TriangleMesh::Corners) +
         model_->surface.ids().size() * sizeof(TriangleId);
}

Accuracy LibccdDetector::accuracy() const noexcept {
  // What its tolerance promises; nothing bounds what it does.
  return {Guarantee::approximate, model_->options.tolerance, 0};
}

}  // namespace touchmark::baselines
