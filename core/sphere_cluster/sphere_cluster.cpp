#include "core/sphere_cluster/sphere_cluster.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "core/flushed_denormals.h"
#include "core/search/threads/parallel.h"

namespace touchmark {

SphereCluster SphereCluster::build(const TriangleMesh& mesh, const Options& options) {
  if (!(options.clustering >= 0) || std::isinf(options.clustering)) {
    throw std::invalid_argument("sphere-cluster: clustering is " + std::to_string(options.clustering) +
                                ", not a finite distance of at least 0");
  }
  const bool has_tree = options.lookup == Lookup::tree && options.precise;
  if (!has_tree && !options.certified)
    throw std::invalid_argument("sphere-cluster: certified=false is for lookup=tree with precise=true");
  if (!has_tree && options.construction == Construction::lazy)
    throw std::invalid_argument("sphere-cluster: build=lazy is for lookup=tree with precise=true");
  const unsigned threads = threads_to_use(options.threads, "sphere-cluster");
  check_flushed_denormals(mesh);
  SphereCluster detector;
  detector.options_ = options;
  detector.connectivity_ = Connectivity(mesh);
  const bool is_lazy = options.construction == Construction::lazy && options.clustering == 0;
  if (!is_lazy) {
    detector.clusters_ = cluster_spheres(mesh, options.clustering, options.order, threads);
    detector.tightness_ = average_tightness(mesh, detector.clusters_);
  }
  if (!options.precise) {
    detector.fast_ = FastLevel(mesh, detector.clusters_);
  } else if (options.lookup == Lookup::scan) {
    detector.scan_ = SphereScan(mesh, detector.clusters_);
  } else {
    const SphereClusters& made = detector.clusters_;
    const bvh::Clusters clusters{made.spheres, made.first, made.members};
    detector.surface_ = {WideBvh(mesh, options.clustering > 0 ? &clusters : nullptr,
                                 {options.widest, options.construction == Construction::lazy, threads}),
                         options.certified};
  }
  return detector;
}

void SphereCluster::update(const TriangleMesh& mesh) {
  connectivity_.expect(mesh);
  const bool has_tree = options_.precise && options_.lookup == Lookup::tree;
  if (!has_tree || !surface_.bvh.update(mesh)) *this = build(mesh, options_);
}

bool SphereCluster::look_for_touch(const Probe& probe, Session& session) const noexcept {
  if (!(probe.radius >= 0)) return false;
  if (!options_.precise) return fast_.touches(probe, session.work);
  if (options_.lookup == Lookup::scan) return scan_.touches(probe, session.work);
  session.question = {LastQuestion::Query::touches, probe.radius};
  return spheres::touches(surface_, probe, session.memory, session.work);
}

std::optional<Contact> SphereCluster::look_for_nearest(const Probe& probe, double reach,
                                                       Session& session) const noexcept {
  if (!(reach >= 0)) return std::nullopt;
  if (!options_.precise) return fast_.nearest(probe.center, reach, session.work);
  if (options_.lookup == Lookup::scan) return scan_.nearest(probe.center, reach, session.work);
  session.question = {LastQuestion::Query::nearest, reach};
  return spheres::nearest(surface_, probe.center, reach, session.memory, session.work);
}

std::optional<Contact> SphereCluster::look_for_nearest(const Probe& probe, double reach,
                                                       FollowedPoint& followed, Work& work) const noexcept {
  if (!(reach >= 0)) return std::nullopt;
  if (!options_.precise) return fast_.nearest(probe.center, reach, work);
  if (options_.lookup == Lookup::scan) return scan_.nearest(probe.center, reach, work);
  return spheres::nearest(surface_, probe.center, reach, followed, work);
}

bool SphereCluster::look_for_close_triangles(const Vec3& center, double reach, double slack, Session& session,
                                             CloseTriangles& into) const noexcept {
  if (!options_.precise || options_.lookup == Lookup::scan) return false;
  if (!(reach >= 0)) return true;
  session.question = {LastQuestion::Query::nearest, reach};
  return spheres::close_triangles(surface_, center, reach, slack, session.memory, into, session.work);
}

std::optional<Impact> SphereCluster::look_for_impact(const Sweep& sweep, Session& session) const noexcept {
  if (!(sweep.radius >= 0)) return std::nullopt;
  if (!options_.precise) return fast_.first_hit(sweep, session.work);
  if (options_.lookup == Lookup::scan) return scan_.first_hit(sweep, session.work);
  session.question = {LastQuestion::Query::sweep, sweep.radius};
  return spheres::first_hit(surface_, sweep, session.memory, session.work);
}

std::size_t SphereCluster::look_for_contacts(const Probe& probe, double reach, Session& session,
                                             std::span<Contact> into, bool counts_all) const noexcept {
  if (!(reach >= 0)) return 0;
  if (!options_.precise) return fast_.contacts(probe.center, reach, into, session.work);
  if (options_.lookup == Lookup::scan) return scan_.contacts(probe.center, reach, into, session.work);
  return spheres::contacts(surface_, probe.center, reach, session.memory, into, counts_all, session.work);
}

Accuracy SphereCluster::accuracy() const noexcept {
  if (options_.precise) return options_.certified ? certified : uncertified;
  return {Guarantee::conservative, kernel_relative_error, fast_.error_bound()};
}

std::size_t SphereCluster::bytes() const noexcept {
  return clusters_.spheres.capacity() * sizeof(Sphere) +
         (clusters_.first.capacity() + clusters_.members.capacity()) * sizeof(std::uint32_t) + scan_.bytes() +
         surface_.bvh.bytes() + fast_.bytes();
}

}  // namespace touchmark
