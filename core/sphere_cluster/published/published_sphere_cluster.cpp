#include "core/sphere_cluster/published/published_sphere_cluster.h"

#include <algorithm>
#include <cmath>

#include "core/flushed_denormals.h"
#include "core/geometry/sweep_box.h"
#include "core/search/contacts_within.h"
#include "core/search/first_touch.h"
#include "core/search/ties/certified_nearest.h"
#include "core/search/ties/closest_candidates.h"
#include "core/sphere_cluster/search_bounds.h"

namespace touchmark {

PublishedSphereCluster PublishedSphereCluster::build(const TriangleMesh& mesh, const Options& options) {
  check_flushed_denormals(mesh);
  PublishedSphereCluster detector;
  detector.options_ = options;
  detector.connectivity_ = Connectivity(mesh);
  detector.clusters_ = cluster_spheres(mesh, options.clustering, options.order);
  detector.tightness_ = average_tightness(mesh, detector.clusters_);
  if (!options.precise) {
    detector.fast_ = FastLevel(mesh, detector.clusters_);
    return detector;
  }
  detector.bounds_ = mesh.bounds();
  detector.spheres_ = SphereArrays(detector.clusters_.spheres);
  detector.ids_ = mesh.triangle_ids();
  detector.triangles_.reserve(mesh.size());
  for (const std::uint32_t triangle : detector.clusters_.members)
    detector.triangles_.push_back(prepare(mesh, triangle));
  return detector;
}

void PublishedSphereCluster::update(const TriangleMesh& mesh) {
  connectivity_.expect(mesh);
  *this = build(mesh, options_);
}

void PublishedSphereCluster::search(std::size_t sphere, const Vec3& center, ClosestCandidates& candidates,
                                    Work& work) const noexcept {
  for (std::uint32_t i = clusters_.first[sphere]; i < clusters_.first[sphere + 1]; ++i)
    candidates.update({squared_distance(triangles_[i], center), triangles_[i].index}, i);
  work.triangles += clusters_.first[sphere + 1] - clusters_.first[sphere];
}

template <class Found>
bool PublishedSphereCluster::for_each_met(const Vec3& center, double reach,
                                          const Found& found) const noexcept {
  const double px = center.x(), py = center.y(), pz = center.z();
  const auto outside = [&](std::size_t i) noexcept {
    const double dx = spheres_.x[i] - px, dy = spheres_.y[i] - py, dz = spheres_.z[i] - pz;
    const double grown = grown_radius(spheres_.radius[i], reach);
    return static_cast<std::uint8_t>(dx * dx + dy * dy + dz * dz > grown * grown);
  };
  return for_each_held(spheres_.size(), outside, found);
}

bool PublishedSphereCluster::touches(const Probe& probe, Session& session) const noexcept {
  if (!(probe.radius >= 0)) return false;
  Work& work = session.work;
  if (!options_.precise) return fast_.touches(probe, work);
  const Vec3& center = probe.center;
  const double error = distance_error(bounds_, center);
  if (std::isinf(error)) return fallback().touches(probe, work);
  std::size_t tested = 0;
  WithinRadius is_within(center, probe.radius, error);
  const bool touching = for_each_met(center, probe.radius + error, [&](std::size_t sphere) noexcept {
    tested = sphere;
    for (std::size_t i = clusters_.first[sphere]; i < clusters_.first[sphere + 1]; ++i) {
      ++work.triangles;
      const double distance = std::sqrt(squared_distance(triangles_[i], center));
      if (is_within(triangles_[i], distance, work.exact_decisions)) return true;
    }
    return false;
  });
  work.spheres += touching ? tested + 1 : spheres_.size();
  return touching;
}

std::optional<Contact> PublishedSphereCluster::nearest(const Probe& probe, double reach,
                                                       Session& session) const noexcept {
  if (!(reach >= 0)) return std::nullopt;
  const Vec3& center = probe.center;
  Work& work = session.work;
  if (!options_.precise) return fast_.nearest(center, reach, work);
  const double error = distance_error(bounds_, center);
  if (std::isinf(error)) return fallback().nearest(center, reach, work);
  ClosestCandidates candidates(triangles_.data(), center, error);
  for_each_met(center, reach + error, [&](std::size_t sphere) noexcept {
    search(sphere, center, candidates, work);
    return false;
  });
  work.spheres += spheres_.size();
  return contact_of(candidates, triangles_, center, reach, error, ids_, work);
}

/// The spheres that the path meets hold the triangles near its start, too: one look at the spheres is enough.
std::optional<Impact> PublishedSphereCluster::first_hit(const Sweep& sweep, Session& session) const noexcept {
  if (!(sweep.radius >= 0)) return std::nullopt;
  Work& work = session.work;
  if (!options_.precise) return fast_.first_hit(sweep, work);
  const double error = distance_error(bounds_, sweep.from);
  const double difference = largest_difference(bounds_, sweep);
  if (std::isinf(error) || !fourth_powers_fit(difference)) return fallback().first_hit(sweep, work);
  const double reach = std::max(padded_sweep_radius(sweep, difference), sweep.radius + error);
  const auto outside = [&](std::size_t i) noexcept {
    const double grown = grown_radius(spheres_.radius[i], reach);
    const double squared = squared_distance_to_path(sweep, spheres_.center(i));
    return static_cast<std::uint8_t>(squared > grown * grown);
  };
  FirstTouch first(sweep);
  ClosestCandidates at_start(triangles_.data(), sweep.from, error);
  for_each_held(spheres_.size(), outside, [&](std::size_t sphere) noexcept {
    search(sphere, sweep.from, at_start, work);
    for (std::uint32_t i = clusters_.first[sphere]; i < clusters_.first[sphere + 1]; ++i)
      first.consider(triangles_[i], work.exact_decisions);
    return false;
  });
  work.spheres += spheres_.size();
  // What is known of the start mostly is enough to say what is nearest there.
  return impact_of(first, ids_, true, [&](double within) {
    const double distance = std::sqrt(at_start.best().squared_distance);
    return is_certain_first(at_start, triangles_, distance, sweep.from, within, error)
               ? contact_on(triangles_[at_start.at()], sweep.from, ids_[at_start.best().index])
               : nearest({sweep.from, 0}, within, session);
  });
}

std::size_t PublishedSphereCluster::contacts(const Probe& probe, double reach, Session& session,
                                             std::span<Contact> into) const noexcept {
  const Vec3& center = probe.center;
  Work& work = session.work;
  if (!(reach >= 0)) return 0;
  if (!options_.precise) return fast_.contacts(center, reach, into, work);
  if (!center.allFinite()) return 0;
  ContactsWithin found({triangles_, bounds_, ids_, center, reach, into});
  if (std::isinf(found.error())) return fallback().contacts(center, reach, into, work);
  for_each_met(center, reach + found.error(), [&](std::size_t sphere) noexcept {
    for (std::uint32_t i = clusters_.first[sphere]; i < clusters_.first[sphere + 1]; ++i)
      found.consider(i, work);
    work.triangles += clusters_.first[sphere + 1] - clusters_.first[sphere];
    return false;
  });
  work.spheres += spheres_.size();
  return found.finish(work);
}

Accuracy PublishedSphereCluster::accuracy() const noexcept {
  if (options_.precise) return certified;
  return {Guarantee::conservative, kernel_relative_error, fast_.error_bound()};
}

std::size_t PublishedSphereCluster::bytes() const noexcept {
  return clusters_.bytes() + fast_.bytes() + spheres_.bytes() +
         triangles_.capacity() * sizeof(PreparedTriangle) + ids_.bytes();
}

}  // namespace touchmark
