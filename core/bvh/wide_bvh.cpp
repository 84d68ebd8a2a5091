#include "core/bvh/wide_bvh.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "core/bvh/build/builder.h"
#include "core/bvh/build/lazy_builder.h"
#include "core/bvh/build/refit.h"
#include "core/bvh/sampler.h"
#include "core/search/distance_field/distance_field_filling.h"  // IWYU pragma: keep

namespace touchmark {
namespace {

/// See Parts::far.
constexpr double far_in_leaf_radii = 1;

/// Returns the radius of a leaf in the frame. A box's is half its diagonal: about the radius of the coin that
/// it holds.
double radius_of_leaf(const bvh::Node& node, std::size_t child, bool boxes) noexcept {
  if (!boxes) return double{node.radius()[child]};
  return Vec3(double{node.half_x()[child]}, double{node.half_y()[child]}, double{node.half_z()[child]})
      .norm();
}

double mean_leaf_radius_of(const bvh::Parts& whole) noexcept {
  double sum = 0;
  for (const bvh::Node& node : whole.nodes)
    for (std::size_t i = 0; i < bvh::width; ++i)
      if (node.child[i].is_block()) sum += radius_of_leaf(node, i, whole.boxes);
  return sum / static_cast<double>(whole.blocks.size());
}

/// Returns a factory of samplers. Each starts at the triangle in slot 0 and may use `share` of the total
/// work.
auto samplers_of(const WideBvh& bvh) noexcept {
  const auto all = static_cast<double>(DistanceField::max_work(bvh.parts().triangles.size()));
  return [&bvh, all](double share) { return bvh::Sampler(bvh, static_cast<std::uint64_t>(share * all), 0); };
}

}  // namespace

WideBvh::WideBvh(const TriangleMesh& mesh, const bvh::Clusters* clusters, const Options& options)
    : simd_(std::min({options.widest, Simd::avx2, widest_simd()})),
      searchable_(FilterFrame::fits(mesh.bounds())),
      bounds_(mesh.bounds()),
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

bvh::Parts WideBvh::build_parts(const TriangleMesh& mesh, const bvh::Clusters* clusters) const {
  if (!lazy_ || clusters != nullptr) return bvh::build_tree(mesh, clusters, frame_, threads_);
  std::optional<bvh::Parts> top = bvh::build_top(mesh, frame_, threads_);
  if (!top) return bvh::build_tree(mesh, nullptr, frame_, threads_);
  // A search that knows of nothing near starts there.
  Work unreported;
  bvh::built_part(*top, 0, unreported);
  return *std::move(top);
}

void WideBvh::measure_box() noexcept {
  constexpr double margin = 0x1p-20, max_length = 0x1p20;
  radius_ = frame_.radius() * frame_.unit();
  box_margin_ = margin * radius_;
  max_squared_beyond_box_ = (max_length * radius_) * (max_length * radius_);
}

void WideBvh::measure_leaves() noexcept {
  const double mean = parts_.unbuilt.empty() ? mean_leaf_radius_of(parts_) : parts_.unbuilt.mean_leaf_radius;
  mean_leaf_radius_ = mean / frame_.scale();
  parts_.far = static_cast<float>(far_in_leaf_radii * far_in_leaf_radii * mean * mean);
}

void WideBvh::fill_distances() {
  distances_ = DistanceField::around(frame_, bounds_, parts_.triangles.size());
  if (lazy_) return distances_.fill_lazily();
  distances_.fill(samplers_of(*this), threads_);
}

void WideBvh::refill_distances(std::size_t moved, const std::vector<Aabb>& boxes) {
  if (distances_.empty()) return;
  if (2 * moved > parts_.triangles.size() || !distances_.holds(frame_, bounds_)) return fill_distances();
  distances_.refill(samplers_of(*this), boxes, threads_);
}

std::optional<std::vector<Aabb>> WideBvh::update(const TriangleMesh& mesh) {
  if (!parts_.unbuilt.empty()) return std::nullopt;  // it is built anew in less time than all of it moves
  if (!searchable_ || !FilterFrame::fits(mesh.bounds()) || !frame_.widen(mesh.bounds())) return std::nullopt;
  epoch_ = Epoch::next();
  bounds_ = mesh.bounds();
  measure_box();
  const bvh::MovedTriangles moved = bvh::refit_tree(parts_, mesh, frame_);
  std::vector<Aabb> boxes;
  for (const Aabb& one : moved.boxes) boxes.push_back(frame_.to_frame(one));
  if (moved.count == 0) return boxes;
  measure_leaves();
  refill_distances(moved.count, boxes);
  return boxes;
}

std::size_t WideBvh::bytes() const noexcept {
  return parts_.nodes.capacity() * sizeof(bvh::Node) + parts_.blocks.capacity() * sizeof(bvh::TriangleBlock) +
         parts_.triangles.capacity() * sizeof(PreparedTriangle) + parts_.unbuilt.bytes() +
         distances_.bytes() + ids_.bytes();
}

}  // namespace touchmark
