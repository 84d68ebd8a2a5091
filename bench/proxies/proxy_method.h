/// The one face of all proxy algorithms that the suite compares: a ball follows a goal, tick by tick, and is
/// to stay outside the surface. Lengths are in mesh units, which the suite takes for metres; forces are in N.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/haptics/coupling.h"
#include "core/probe.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::proxies {

enum class Status : std::uint8_t {
  free,        ///< nothing holds the proxy
  in_contact,  ///< one or more constraints hold it
  stuck,       ///< it started inside or is squeezed, and says so
  no_answer,   ///< it gave up, or its answer is not a number
};

/// What one tick came to. Reused from tick to tick, so that its memory is kept.
struct Step {
  std::vector<Vec3>
      way;  ///< the proxy's positions, the one before the tick first; a straight piece between two
  std::size_t contacts = 0;
  Vec3 force = Vec3::Zero();  ///< N, on the device
  Status status = Status::free;
  bool unfinished = false;  ///< the method's limit of work ended it
  bool squeezed = false;    ///< the method says that the surface may have passed the proxy as it moved

  void begin(const Vec3& from) {
    way.assign(1, from);
    contacts = 0;
    force.setZero();
    status = Status::free;
  }
  const Vec3& position() const { return way.back(); }
  void go(const Vec3& to) {
    if (to != way.back()) way.push_back(to);
  }
};

class ProxyMethod {
 public:
  ProxyMethod() = default;
  ProxyMethod(const ProxyMethod&) = delete;
  ProxyMethod& operator=(const ProxyMethod&) = delete;
  virtual ~ProxyMethod() = default;

  /// Puts the proxy at a free position and forgets all contacts.
  virtual void place(const Vec3& position) = 0;
  /// Lets the proxy follow the goal for one tick; `step.way` begins with the position before.
  virtual void step(const Vec3& goal, Step& step) = 0;
  /// Follows a mesh whose vertices have moved; the proxy stays where it is.
  virtual void update(const TriangleMesh& mesh) = 0;
  /// Follows bodies that have moved, of which the mesh is made; the proxy stays where it is.
  virtual void move(std::span<const Vec3> places, const TriangleMesh& mesh) {
    static_cast<void>(places);
    update(mesh);
  }
  /// Asks a second detector of its kind for the nearest contact at the goal, however far: the bare query that
  /// its tick is compared with. Returns false where it has no detector.
  virtual bool ask_nearest(const Vec3& goal) { return static_cast<void>(goal), false; }
  /// Lets the next steps look at no more than so much; 0: at all they want. Returns false where it cannot.
  virtual bool limit_work(std::uint64_t max_work) { return static_cast<void>(max_work), false; }
  /// Returns how far it is, after the step to this goal, from where it would be without a limit of work.
  virtual double lag(const Vec3& goal) { return static_cast<void>(goal), 0; }
  /// Triangles, boxes and what else was looked at since it was made.
  virtual std::uint64_t work() const = 0;
};

}  // namespace touchmark::bench::proxies
