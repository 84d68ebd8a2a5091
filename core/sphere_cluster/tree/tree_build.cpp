/// How a hierarchy comes to be, whole or in part.
#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "core/sphere_cluster/clustering.h"
#include "core/sphere_cluster/tree/builder.h"
#include "core/sphere_cluster/tree/cylinder_bvh.h"
#include "core/sphere_cluster/tree/lazy_builder.h"

namespace touchmark {
namespace {

/// See TreeParts::far.
constexpr double far_in_leaf_radii = 1;

/// Returns the radius of a leaf in the frame. A box's is half its diagonal: about the radius of the coin that
/// it holds.
double radius_of_leaf(const spheres::TreeNode& node, std::size_t child, bool boxes) noexcept {
  const Vec3 half(double{node.half[child]}, double{node.radius[child]}, double{node.normal_x[child]});
  return boxes ? half.norm() : half.y();
}

double mean_leaf_radius_of(const spheres::TreeParts& whole) noexcept {
  double sum = 0;
  for (const spheres::TreeNode& node : whole.nodes)
    for (std::size_t i = 0; i < spheres::tree_width; ++i)
      if (node.child[i].is_block()) sum += radius_of_leaf(node, i, whole.boxes);
  return sum / static_cast<double>(whole.blocks.size());
}

}  // namespace

SphereTree::SphereTree(const TriangleMesh& mesh, const SphereClusters* clusters, const Options& options)
    : epoch_(Epoch::next()),
      simd_(std::min({options.widest, Simd::avx2, widest_simd()})),
      searchable_(FilterFrame::fits(mesh.bounds())),
      bounds_(mesh.bounds()),
      certified_(options.certified),
      lazy_(options.lazy),
      threads_(options.threads),
      ids_(mesh.triangle_ids()) {
  if (!searchable_) {
    const std::vector<PreparedTriangle> prepared = touchmark::prepare(mesh);
    parts_.triangles.assign(prepared.begin(), prepared.end());
    return;
  }
  frame_ = FilterFrame::around(mesh.bounds());
  measure_box();
  parts_ = build_parts(mesh, clusters);
  measure_leaves();
  fill_distances();
}

spheres::TreeParts SphereTree::build_parts(const TriangleMesh& mesh, const SphereClusters* clusters) const {
  if (clusters != nullptr) return spheres::build_tree(mesh, *clusters, frame_, threads_);
  if (std::optional<spheres::TreeParts> top = spheres::build_top(mesh, frame_, threads_)) {
    // A search that knows of nothing near starts there.
    Work unreported;
    spheres::built_part(*top, 0, unreported);
    return *std::move(top);
  }
  return spheres::build_tree(mesh, cluster_spheres(mesh, 0, VisitOrder::mesh, threads_), frame_, threads_);
}

/// All triangles must be there, where all are looked at.
LinearScan SphereTree::fallback(Work& work) const noexcept {
  spheres::build_rest(parts_, work);
  return {parts_.triangles, bounds_, ids_, certified_};
}

void SphereTree::measure_box() noexcept {
  constexpr double margin = 0x1p-20, longest = 0x1p20;
  radius_ = frame_.radius() * frame_.unit();
  box_margin_ = margin * radius_;
  longest_beyond_box_ = (longest * radius_) * (longest * radius_);
}

void SphereTree::measure_leaves() noexcept {
  const double mean = parts_.unbuilt.empty() ? mean_leaf_radius_of(parts_) : parts_.unbuilt.mean_leaf_radius;
  mean_leaf_radius_ = mean / frame_.scale();
  parts_.far = static_cast<float>(far_in_leaf_radii * far_in_leaf_radii * mean * mean);
}

}  // namespace touchmark
