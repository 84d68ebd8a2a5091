/// The sphere-cluster detector, after A. R. Choi and M. Y. Sung, "Performance improvement of haptic collision
/// detection using subdivision surface and sphere clustering", PLoS ONE 12(9), 2017: bounding spheres of
/// triangles, clustered by distance, tested before the triangles are.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>

#include "core/detector.h"
#include "core/mesh_update.h"
#include "core/sphere_cluster/clustering.h"
#include "core/sphere_cluster/published/fast_level.h"
#include "core/sphere_cluster/published/sphere_scan.h"
#include "core/sphere_cluster/queries/queries.h"

namespace touchmark {

/// The sphere-cluster detector; satisfies Detector, Updates, Prepares and every query. May be built lazily.
class SphereCluster {
 public:
  enum class Lookup {
    scan,  ///< as published: every sphere, then the triangles of those that the probe meets
    tree   ///< a hierarchy over them, nearest first
  };
  /// When the hierarchy is built and distances around the mesh are sampled, tree only. Answers are the same.
  enum class Construction {
    whole,  ///< all in build()
    lazy    ///< by the first query that comes there: parts of 512 triangles, and two rough searches at most
  };
  /// What `build` may be told; the defaults are the fast exact form.
  struct Options {
    double clustering = 0;  ///< distance between centroids that share a sphere, mesh units; 0: a sphere each
    Lookup lookup = Lookup::tree;
    bool precise = true;  ///< false: the fast level alone; spheres answer in place of their triangles
    VisitOrder order = VisitOrder::breadth_first;  ///< in which triangles are clustered
    bool certified = true;     ///< false, tree only: as doubles have it, to measure what certainty costs
    Simd widest = Simd::avx2;  ///< tree: forgo wider instructions than these; avx512 is avx2; the same bits
    Construction construction = Construction::whole;
    unsigned threads = 1;  ///< tree: build it, at most 256; 0: as many as there are processors; the same bits
  };
  /// What one haptic point remembers between ticks.
  struct Session {
    Work work;
    LastQuestion question;
    spheres::PointMemory memory;

    /// Forgets all but the counters.
    void forget() noexcept {
      question = {};
      memory.start_anew();
    }
  };

  /// What is remembered of one of many points, in two cache lines.
  using FollowedPoint = spheres::FollowedPoint;

  /// Throws std::invalid_argument for a clustering distance that is negative, infinite or not a number; and
  /// with a scan or the fast level for certified = false, where nothing is certified, and for lazy making.
  /// Throws it for too many threads, too.
  static SphereCluster build(const TriangleMesh& mesh, const Options& options);
  static SphereCluster build(const TriangleMesh& mesh) { return build(mesh, Options()); }

  /// See the concept Updates. The hierarchy follows its triangles, and is built anew where the mesh has
  /// become of another size or place; the scan and the fast level always are.
  void update(const TriangleMesh& mesh);

  // Inline as far as what is known without a look: there a query is a few comparisons, less than a call.
  [[gnu::always_inline]] bool touches(const Probe& probe, Session& session) const noexcept {
    if (is_clear(probe.center, probe.radius, session)) return false;
    return spheres::is_touching(surface_.bvh, probe.center, probe.radius, session.memory) ||
           look_for_touch(probe, session);
  }
  std::optional<Contact> nearest(const Probe& probe, double reach, Session& session) const noexcept {
    if (is_clear(probe.center, reach, session)) return std::nullopt;
    return look_for_nearest(probe, reach, session);
  }
  /// Answers likewise for one of many points that are asked again and again. See the concept FollowsPoints.
  std::optional<Contact> nearest(const Probe& probe, double reach, FollowedPoint& followed,
                                 Work& work) const noexcept {
    if (spheres::is_clear(surface_.bvh, probe.center, reach, followed)) return std::nullopt;
    return look_for_nearest(probe, reach, followed, work);
  }
  /// See the concept TellsCloseTriangles: true with a tree, unless there are too many or the slack is too
  /// much.
  bool close_triangles(const Vec3& center, double reach, double slack, Session& session,
                       CloseTriangles& into) const noexcept {
    into.count = 0;
    if (spheres::is_clear(surface_.bvh, center, reach, session.memory)) return true;
    return look_for_close_triangles(center, reach, slack, session, into);
  }
  /// See the concept ListsTriangles: with a tree alone.
  bool list_triangles(const Vec3& center, double radius, Session& session,
                      ListedTriangles& into) const noexcept {
    return options_.precise && options_.lookup == Lookup::tree &&
           spheres::list_triangles(surface_, center, radius, into, session.work);
  }
  /// See the concept TellsClearance.
  double clearance(const Vec3& center, const Session& session) const noexcept {
    return spheres::clearance(surface_.bvh, center, session.memory);
  }
  std::optional<Impact> first_hit(const Sweep& sweep, Session& session) const noexcept {
    if (is_clear(sweep, session)) return std::nullopt;
    return look_for_impact(sweep, session);
  }

  std::size_t contacts(const Probe& probe, double reach, Session& session,
                       std::span<Contact> into) const noexcept {
    if (is_clear(probe.center, reach, session)) return 0;
    return look_for_contacts(probe, reach, session, into, true);
  }
  /// See the concept AnswersNearestContacts.
  std::size_t nearest_contacts(const Probe& probe, double reach, Session& session,
                               std::span<Contact> into) const noexcept {
    if (is_clear(probe.center, reach, session)) return 0;
    return std::min(look_for_contacts(probe, reach, session, into, false), into.size());
  }

  /// With a tree: lists, after `nearest`, the leaves near the point for a next tick that moves no farther
  /// than twice as far as this one, and asks the last question again, where the point will be if it goes on
  /// as it moved. The next query then finds its data and its code in the caches, best when this is called
  /// just before the device is read. Work is bounded as that of two queries is.
  void prepare(Session& session) const noexcept {
    spheres::prepare(surface_, session.question, session.memory, session.work);
  }

  std::size_t bytes() const noexcept;
  bool builds_lazily() const noexcept { return options_.construction == Construction::lazy; }
  /// precise: exact. Else conservative: contacts come early, by at most `absolute`.
  Accuracy accuracy() const noexcept;

  /// The clustered spheres, for drawing and for the paper's tables; of the mesh that was built, not of
  /// updates where the hierarchy followed. Lazy construction without clustering makes none, and no tightness.
  const SphereClusters& clusters() const noexcept { return clusters_; }
  /// The paper's measure of how closely they fit; see average_tightness.
  double tightness() const noexcept { return tightness_; }

 private:
  /// With a tree: true if nothing is within reach, as far as that is known without looking into it. By what
  /// was near last, or by the mesh's box, first where that answered last.
  [[gnu::always_inline]] bool is_clear(const Vec3& center, double reach, Session& session) const noexcept {
    spheres::PointMemory& memory = session.memory;
    const WideBvh& bvh = surface_.bvh;
    if (memory.for_box == 0)
      return spheres::is_clear(bvh, center, reach, memory) ||
             spheres::turns_out_beyond_box(bvh, center, reach, memory);
    return goes_on_with_box(bvh.is_beyond_box(center, reach), memory);
  }
  /// True if that is known of a whole path.
  [[gnu::always_inline]] bool is_clear(const Sweep& sweep, Session& session) const noexcept {
    spheres::PointMemory& memory = session.memory;
    const WideBvh& bvh = surface_.bvh;
    if (memory.for_box == 0)
      return spheres::is_clear(bvh, sweep, memory) || spheres::turns_out_beyond_box(bvh, sweep, memory);
    return goes_on_with_box(bvh.is_beyond_box(sweep), memory);
  }
  /// Goes on with the box if that has answered; returns whether it has.
  static bool goes_on_with_box(bool is_beyond, spheres::PointMemory& memory) noexcept {
    memory.for_box = is_beyond ? memory.for_box - 1 : 0;
    return is_beyond;
  }
  bool look_for_touch(const Probe& probe, Session& session) const noexcept;
  std::optional<Contact> look_for_nearest(const Probe& probe, double reach, Session& session) const noexcept;
  std::optional<Contact> look_for_nearest(const Probe& probe, double reach, FollowedPoint& followed,
                                          Work& work) const noexcept;
  bool look_for_close_triangles(const Vec3& center, double reach, double slack, Session& session,
                                CloseTriangles& into) const noexcept;
  std::optional<Impact> look_for_impact(const Sweep& sweep, Session& session) const noexcept;
  std::size_t look_for_contacts(const Probe& probe, double reach, Session& session, std::span<Contact> into,
                                bool counts_all) const noexcept;

  Options options_;
  Connectivity connectivity_;
  SphereClusters clusters_;
  double tightness_ = 0;
  // Only the one that the options ask for is filled.
  SphereScan scan_;
  spheres::Surface surface_;
  FastLevel fast_;
};

}  // namespace touchmark
