/// The question that a proxy asks of a mesh, whoever answers it: what does a ball on a straight way meet
/// first?
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "bench/contestants/roster.h"
#include "core/probe.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::proxies {

struct SweepHit {
  double fraction = 0;         ///< how far along the way, in [0, 1]
  Vec3 normal = Vec3::Zero();  ///< unit, from the surface to the ball's centre where it stops
  std::uint32_t triangle = 0;
};

class Sweeper {
 public:
  Sweeper() = default;
  Sweeper(const Sweeper&) = delete;
  Sweeper& operator=(const Sweeper&) = delete;
  virtual ~Sweeper() = default;

  virtual std::optional<SweepHit> first_hit(const Vec3& from, const Vec3& to, double radius) = 0;
  virtual void update(const TriangleMesh& mesh) = 0;
  virtual std::uint64_t work() const = 0;
};

/// In plain doubles, as a haptic program of its time would have it: a tree of boxes, and for each triangle
/// its offset plane, the cylinders about its edges and the balls about its corners. What touches at the start
/// stops only a motion towards it.
/// A bare point passes triangles whose doubled area squared is below `smallest`, as some programs have it.
std::unique_ptr<Sweeper> plain_sweeper(const TriangleMesh& mesh, double smallest = 0);

/// A contestant that answers sweeps, in this process. Throws std::invalid_argument or MeshError.
std::unique_ptr<Sweeper> sweeper_of(const contestants::Roster& roster, const std::string& contestant,
                                    const TriangleMesh& mesh);

}  // namespace touchmark::bench::proxies
