/// Two detectors, tried out on the same way along the surface.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "core/auto/built_form.h"

namespace touchmark {
namespace {

using Clock = std::chrono::steady_clock;
constexpr double infinity = std::numeric_limits<double>::infinity();

double ms_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// A few stretches of contact all over the mesh: the point glides at half the reach.
class Course {
 public:
  Course(const TriangleMesh& mesh, const Wish& wish)
      : query_(wish.query),
        reach_(wish.reach.value_or(usual_reach * mesh.diagonal())),
        radius_(std::min(reach_, usual_reach * mesh.diagonal())) {
    const double speed = wish.speed.value_or(usual_speed * mesh.diagonal());
    for (std::size_t k = 0; k < stretches; ++k) {
      const std::size_t at = k * mesh.size() / stretches;
      const Vec3 a = mesh.corner(at, 0), b = mesh.corner(at, 1), c = mesh.corner(at, 2);
      const Vec3 along = b - a, normal = along.cross(c - a);
      const Vec3 step = along.norm() > 0 ? Vec3(speed / along.norm() * along) : Vec3(speed, 0, 0);
      const Vec3 off = normal.norm() > 0 ? Vec3(0.5 * radius_ / normal.norm() * normal) : Vec3(Vec3::Zero());
      for (std::size_t i = 0; i < ticks; ++i)
        centers_.push_back(a / 3 + b / 3 + c / 3 + off + static_cast<double>(i) * step);
    }
  }

  /// The time of all questions, ms.
  template <class D>
  double time_of(const D& detector) const {
    typename D::Session session;
    const Clock::time_point start = Clock::now();
    for (std::size_t i = 1; i < centers_.size(); ++i) {
      const Probe probe{centers_[i], radius_};
      if (query_ == Wish::Query::touches || query_ == Wish::Query::any) detector.touches(probe, session);
      if (query_ == Wish::Query::nearest || query_ == Wish::Query::any)
        detector.nearest(probe, reach_, session);
      if (query_ == Wish::Query::sweep || query_ == Wish::Query::any)
        detector.first_hit({centers_[i - 1], centers_[i], radius_}, session);
    }
    return ms_since(start);
  }

 private:
  static constexpr double usual_reach = 0.005, usual_speed = 0.001;  // of the diagonal
  static constexpr std::size_t stretches = 16, ticks = 32;

  Wish::Query query_;
  double reach_, radius_;
  std::vector<Vec3> centers_;
};

}  // namespace

std::optional<BuiltForm> faster_of(const TriangleMesh& mesh, const FormOptions& spheres,
                                   const FormOptions& grid, const Wish& wish) {
  if (!(wish.trial_ms > 0)) return std::nullopt;
  // So many times as long the grid-group was seen to build at most, but for wires.
  constexpr double ratio_of_builds = 20;
  constexpr int passes = 4;      // of which the first one fills caches
  constexpr double clear = 0.9;  // less may be chance
  const Clock::time_point start = Clock::now();
  BuiltForm first = build_form(mesh, spheres);
  if (ms_since(start) * (1 + ratio_of_builds) > wish.trial_ms) return std::nullopt;
  BuiltForm second = build_form(mesh, grid);
  const Course course(mesh, wish);
  const auto time_of = [&](const auto& form) { return course.time_of(form); };
  double first_ms = infinity, second_ms = infinity;
  for (int pass = 0; pass < passes && (pass == 0 || ms_since(start) < wish.trial_ms); ++pass) {
    first_ms = std::min(first_ms, std::visit(time_of, first));
    second_ms = std::min(second_ms, std::visit(time_of, second));
  }
  return second_ms < clear * first_ms ? std::move(second) : std::move(first);
}

}  // namespace touchmark
