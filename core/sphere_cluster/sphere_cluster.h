/// The fast exact form of the sphere-cluster detector, after A. R. Choi and M. Y. Sung (2017): a hierarchy
/// over the triangles, searched nearest first. The form as published is
/// core/sphere_cluster/published/published_sphere_cluster.h.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>

#include "core/detector.h"
#include "core/mesh_update.h"
#include "core/point_queries/queries.h"

namespace touchmark {

/// The sphere-cluster detector; satisfies Detector, Updates, Prepares and every query. May be built lazily.
class SphereCluster {
 public:
  /// When the hierarchy is built and distances around the mesh are sampled. Answers are the same.
  enum class Construction {
    whole,  ///< all in build()
    lazy    ///< by the first query that comes there: parts of 512 triangles, and two rough searches at most
  };
  /// What `build` may be told.
  struct Options {
    double clustering = 0;     ///< distance between centroids of triangles that stay together; 0: one by one
    bool certified = true;     ///< false: as doubles have it, to measure what certainty costs
    Simd widest = Simd::avx2;  ///< forgo wider instructions than these; avx512 is avx2; the same bits
    Construction construction = Construction::whole;
    unsigned threads = 1;  ///< build it, at most 256; 0: as many as there are processors; the same bits
  };
  /// What one haptic point remembers between ticks.
  using Session = queries::Session;
  static constexpr bool keeps_to_limit = true;

  /// What is remembered of one of many points, in six cache lines.
  using FollowedPoint = bvh::FollowedPoint;

  /// Throws std::invalid_argument for a clustering distance that is negative, infinite or not a number, or
  /// for too many threads.
  static SphereCluster build(const TriangleMesh& mesh, const Options& options);
  static SphereCluster build(const TriangleMesh& mesh) { return build(mesh, Options()); }

  /// See the concept Updates. The hierarchy follows its triangles, and is built anew where the mesh has
  /// become of another size or place.
  void update(const TriangleMesh& mesh);

  [[gnu::always_inline]] bool touches(const Probe& probe, Session& session) const noexcept {
    return queries::touches(surface_, probe, session);
  }
  std::optional<Contact> nearest(const Probe& probe, double reach, Session& session) const noexcept {
    return queries::nearest(surface_, probe, reach, session);
  }
  /// See the concept AnswersWithinBudget.
  Bracket nearest(const Probe& probe, double reach, Session& session, std::uint64_t budget) const noexcept {
    return queries::nearest_bracket(surface_, probe, reach, budget, session);
  }
  /// Answers likewise for one of many points that are asked again and again. See the concept FollowsPoints.
  std::optional<Contact> nearest(const Probe& probe, double reach, FollowedPoint& followed,
                                 Work& work) const noexcept {
    if (queries::is_clear(surface_.bvh, probe.center, reach, followed) || !(reach >= 0)) return std::nullopt;
    return queries::nearest(surface_, probe.center, reach, followed, work);
  }
  /// See the concept TellsCloseTriangles: true unless there are too many or the slack is too much.
  bool close_triangles(const Vec3& center, double reach, double slack, Session& session,
                       CloseTriangles& into) const noexcept {
    into.count = 0;
    if (queries::is_clear(surface_.bvh, center, reach, session.memory) || !(reach >= 0)) return true;
    session.question = {LastQuestion::Query::nearest, reach};
    return queries::close_triangles(surface_, center, reach, slack, session.memory, into, session.work);
  }
  /// See the concept ListsTriangles.
  bool list_triangles(const Vec3& center, double radius, Session& session,
                      ListedTriangles& into) const noexcept {
    return queries::list_triangles(surface_, center, radius, into, session.work);
  }
  /// See the concept TellsClearance.
  double clearance(const Vec3& center, const Session& session) const noexcept {
    return queries::clearance(surface_.bvh, center, session.memory);
  }
  std::optional<Impact> first_hit(const Sweep& sweep, Session& session) const noexcept {
    return queries::first_hit(surface_, sweep, session);
  }
  /// See the concept AnswersMovingSweep.
  std::optional<Impact> first_hit_moving(const Sweep& sweep, const MeshMotion& motion,
                                         Session& session) const noexcept {
    if (!(motion.max_shift() > 0)) return first_hit(sweep, session);
    return queries::first_hit_moving(surface_, sweep, motion, session.work);
  }

  std::size_t contacts(const Probe& probe, double reach, Session& session,
                       std::span<Contact> into) const noexcept {
    return queries::contacts(surface_, probe, reach, session, into);
  }
  /// See the concept AnswersNearestContacts.
  std::size_t nearest_contacts(const Probe& probe, double reach, Session& session,
                               std::span<Contact> into) const noexcept {
    return std::min(queries::contacts(surface_, probe, reach, session, into, false), into.size());
  }

  /// Lists, after `nearest`, the leaves near the point for a next tick that moves no farther
  /// than twice as far as this one, and asks the last question again, where the point will be if it goes on
  /// as it moved. The next query then finds its data and its code in the caches, best when this is called
  /// just before the device is read. Work is bounded as that of three queries is.
  void prepare(Session& session) const noexcept { queries::prepare(surface_, session); }

  std::size_t bytes() const noexcept { return surface_.bvh.bytes(); }
  bool builds_lazily() const noexcept { return options_.construction == Construction::lazy; }
  Accuracy accuracy() const noexcept { return options_.certified ? certified : uncertified; }

 private:
  Options options_;
  Connectivity connectivity_;
  queries::Surface surface_;
};

}  // namespace touchmark
