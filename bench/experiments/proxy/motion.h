/// A goal's motion while it is written, tick by tick.
#pragma once

#include <cstddef>
#include <vector>

#include "bench/support/random.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::experiments::proxy {

class Motion {
 public:
  Motion(const Vec3& start, std::size_t ticks) : at_(start), ticks_(ticks) { goals_.reserve(ticks); }

  bool done() const { return goals_.size() >= ticks_; }
  const Vec3& at() const { return at_; }

  /// All add at most as many ticks as are left.
  void jump(const Vec3& to);
  void line(const Vec3& to, std::size_t ticks);
  void rest(std::size_t ticks);
  /// One turn about `center`, which begins and ends at center + u.
  void circle(const Vec3& center, const Vec3& u, const Vec3& v, std::size_t ticks);
  /// A hand's tremor about where it is: so many random steps within `amplitude`, each a fifth of it.
  void tremor(support::Random& random, double amplitude, std::size_t ticks);

  std::vector<Vec3> take() && { return std::move(goals_); }

 private:
  Vec3 at_;
  std::size_t ticks_;
  std::vector<Vec3> goals_;
};

/// Goes about a surface as a hand would: comes near, presses, slides under the surface to places nearby,
/// rests, trembles, stabs through at 100 diagonals a second, and leaves again, until the motion is done.
void explore(const TriangleMesh& mesh, support::Random& random, Motion& motion);

}  // namespace touchmark::bench::experiments::proxy
