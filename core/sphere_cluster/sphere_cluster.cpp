#include "core/sphere_cluster/sphere_cluster.h"

#include "core/flushed_denormals.h"
#include "core/search/threads/parallel.h"
#include "core/sphere_cluster/clustering.h"

namespace touchmark {

SphereCluster SphereCluster::build(const TriangleMesh& mesh, const Options& options) {
  const unsigned threads = threads_to_use(options.threads, "sphere-cluster");
  check_flushed_denormals(mesh);
  SphereCluster detector;
  detector.options_ = options;
  detector.connectivity_ = Connectivity(mesh);
  const bool clusters = options.clustering != 0;
  SphereClusters made;
  if (clusters) made = cluster_spheres(mesh, options.clustering, VisitOrder::breadth_first, threads);
  const bvh::Clusters kept{made.spheres, made.first, made.members};
  detector.surface_ = {WideBvh(mesh, clusters ? &kept : nullptr,
                               {options.widest, options.construction == Construction::lazy, threads}),
                       options.certified};
  return detector;
}

void SphereCluster::update(const TriangleMesh& mesh) {
  connectivity_.expect(mesh);
  if (!surface_.bvh.update(mesh)) *this = build(mesh, options_);
}

}  // namespace touchmark
