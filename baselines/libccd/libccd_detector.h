/// The rival libccd 2.1: GJK with EPA, or MPR, between a ball and one triangle. It has no broad phase, so the
/// triangles come from this project's AabbTree: hence libccd+aabb. README.md states the decisions made for
/// it.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>

#include "baselines/rival.h"

namespace touchmark::baselines {

class LibccdDetector {
 public:
  enum class Algorithm { gjk, mpr };
  /// fitted: the ball as the unit ball about the origin, whatever the mesh's unit; the results are brought
  /// back. mesh: coordinates as they are.
  enum class Frame { fitted, mesh };

  struct Options {
    Algorithm algorithm = Algorithm::gjk;
    Frame frame = Frame::fitted;
    double tolerance = 1e-4;       ///< for EPA and MPR, libccd's own default; in radii when fitted
    std::size_t iterations = 500;  ///< at most, in GJK; libccd's own default is ULONG_MAX
    Asking query = Asking::checked;
  };
  /// work.boxes: our tree's; work.triangles: those libccd is asked about. `last` is the last contact's.
  struct Session : RivalSession {
    std::size_t given_up = 0;  ///< pairs that were stopped for taking too long
  };

  /// Throws std::invalid_argument for a tolerance that is not positive, or no iterations.
  static LibccdDetector build(const TriangleMesh& mesh, const Options& options);
  static LibccdDetector build(const TriangleMesh& mesh) { return build(mesh, Options()); }

  bool touches(const Probe& probe, Session& session) const noexcept;
  std::optional<Contact> nearest(const Probe& probe, double reach, Session& session) const noexcept;

  /// The tree: libccd itself keeps nothing.
  std::size_t bytes() const noexcept;
  Accuracy accuracy() const noexcept;

 private:
  struct Model;
  explicit LibccdDetector(Hidden<const Model> model) noexcept : model_(std::move(model)) {}

  Hidden<const Model> model_;
};

}  // namespace touchmark::baselines
