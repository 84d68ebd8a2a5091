#include <algorithm>
#include <cmath>
#include <limits>

#include "core/grid_group/direct/build/group_builder.h"
#include "core/grid_group/direct/direct_grid.h"
#include "core/grid_group/direct/rough_search.h"
#include "core/search/distance_field/distance_field_filling.h"  // IWYU pragma: keep

namespace touchmark::grid {
namespace {

std::size_t bytes_for(const TriangleMesh& mesh, double bytes_per_triangle) {
  const double bytes = bytes_per_triangle * static_cast<double>(mesh.size());
  constexpr double limit = 0x1p62;
  return static_cast<std::size_t>(std::min(bytes, limit));
}

/// Returns by how much a triangle must lose to be left out of a group, in the frame: the kernel's error
/// twice, and for sweeps the rounding of the position on the path, which goes with the coordinates. Sixteen
/// times that.
double exclusion_margin_for(const TriangleMesh& mesh, const FilterFrame& frame) {
  const Aabb& box = mesh.bounds();
  const double coordinates = std::max(box.min.cwiseAbs().maxCoeff(), box.max.cwiseAbs().maxCoeff());
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  return 16 * (culling_pad(4) + 4 * epsilon * frame.scale() * coordinates);
}

}  // namespace

DirectGrid DirectGrid::build(const TriangleMesh& mesh, const DirectOptions& options) {
  DirectGrid grid;
  grid.epoch_ = Epoch::next();
  grid.certified_ = options.certified;
  grid.bounds_ = mesh.bounds();
  grid.threads_ = options.threads;
  grid.store_ = TriangleStore::build(mesh, options.threads);
  grid.tree_ = BoxTree(grid.store_, options.threads);
  const FilterFrame& frame = grid.store_.frame;
  grid.max_bytes_ = bytes_for(mesh, options.bytes_per_triangle);
  const auto left = [&] { return grid.max_bytes_ - std::min(grid.max_bytes_, grid.bytes()); };

  // Groups tell where cells are of use, but cells and samples have the first call on the bytes.
  const std::size_t for_cells = left() / 4;
  grid.exclusion_margin_ = exclusion_margin_for(mesh, frame);
  GroupBuilder builder(grid.store_, grid.tree_, grid.exclusion_margin_, left(), options.threads);
  Groups groups = options.lazy ? Groups() : builder.build();
  grid.cells_ = CellTree::build(grid.store_, grid.tree_,
                                {options.cell * frame.scale(), for_cells, options.lazy, options.threads,
                                 options.lazy ? nullptr : &groups});
  if (!options.lazy && left() >= DistanceField::max_bytes(mesh.size())) grid.fill_distances();
  const bool dropped = groups.fit(left());
  grid.groups_ = options.lazy ? builder.unbuilt(left()) : std::move(groups);
  grid.coarsened_ = grid.cells_.coarsened() || builder.ran_out() || dropped;
  return grid;
}

bool DirectGrid::update(const TriangleMesh& mesh) {
  if (!FilterFrame::fits(mesh.bounds()) || !store_.frame.widen(mesh.bounds())) return false;
  epoch_ = Epoch::next();
  bounds_ = mesh.bounds();
  const std::vector<Aabb> moved = store_.move(mesh);
  if (moved.empty()) return true;
  tree_ = BoxTree(store_, threads_);
  cells_.update(store_, tree_, moved, threads_);
  refill_distances(moved);
  // The old groups make room for the new ones.
  const std::size_t taken = bytes() - groups_.bytes();
  exclusion_margin_ = exclusion_margin_for(mesh, store_.frame);
  GroupBuilder builder(store_, tree_, exclusion_margin_, max_bytes_ - std::min(max_bytes_, taken), threads_);
  groups_ = builder.rebuild(groups_, moved);
  coarsened_ = coarsened_ || builder.ran_out();
  return true;
}

/// What the cell knows, where that is good enough; else by a search for what is nearer, of which `left`
/// bounds the work of all.
DistanceField::Interval DirectGrid::sample(const Vec3& in_frame, double max_distance,
                                           std::uint64_t& left) const noexcept {
  constexpr double enough = 0.35;  // of the distance
  if (cells_.holds(in_frame)) {
    const Cell cell = cells_.at(in_frame);
    const double to_middle = (in_frame - cell.middle).norm();
    max_distance = std::min(max_distance, cells_.upper_bound(cell.distance) + to_middle);
    if (to_middle <= std::max(enough * cell.distance, cells_.smallest_edge()))
      return {std::max(cell.distance - to_middle, 0.0), max_distance};
  }
  const double scale = store_.frame.scale(), reach = (1 - enough) * max_distance;
  const Vec3 center = store_.frame.from_frame(in_frame);
  RoughSearch search(store_, center, 1, reach / scale);
  const bool exhausted = !search.consider_tree(tree_, left);
  const RoughNearest& nearest = search.nearest();
  left -= std::min(left, nearest.triangles + nearest.boxes);
  if (exhausted || left == 0) return {-1, -1};
  if (nearest.squared == std::numeric_limits<double>::infinity()) return {reach, max_distance};
  const double distance = scale * std::sqrt(nearest.squared);
  // One that the filter let through may be beyond the reach, and another between them.
  return {std::min(distance, reach), std::min(distance, max_distance)};
}

/// Returns what makes a function that takes samples with its share of the work that all may be.
auto DirectGrid::sampler() const noexcept {
  return [this](double share) {
    const auto all = static_cast<double>(DistanceField::max_work(store_.size()));
    return [this, left = static_cast<std::uint64_t>(share * all)](const Vec3& position,
                                                                  double max_distance) mutable {
      return sample(position, max_distance, left);
    };
  };
}

void DirectGrid::fill_distances() {
  distances_ = DistanceField::around(store_.frame, bounds_, store_.size());
  distances_.fill(sampler(), threads_, 1);  // a cell costs more to ask than a sample
}

void DirectGrid::refill_distances(const std::vector<Aabb>& moved) {
  if (distances_.empty()) return;
  if (!distances_.holds(store_.frame, bounds_)) return fill_distances();
  distances_.refill(sampler(), moved, threads_);
}

void DirectGrid::build_missing(std::uint32_t near, std::uint32_t start, const Vec3& center,
                               std::uint64_t spent, Work& work) const noexcept {
  // With what answered the query it is to be no more than two looks at every triangle. What has taken more
  // than one is no place to grow at.
  const std::uint64_t budget = remaining(2 * std::uint64_t{store_.size()}, spent);
  if (budget < store_.size()) return;
  if (groups_.is_unbuilt(near)) return make_group(near, budget, work);
  if (groups_.is_unbuilt(start)) return make_group(start, budget, work);
  const Vec3 in_frame = store_.frame.to_frame(center);
  if (cells_.holds(in_frame))
    cells_.build_lazily(in_frame, store_, tree_, std::min(budget, max_lazy_looks), work);
}

void DirectGrid::make_group(std::uint32_t slot, std::uint64_t budget, Work& work) const noexcept {
  // What lies among so many boxes or triangles has no group.
  if (!groups_.claim(slot)) return;
  const std::uint64_t share = budget / (1 + GroupFinder::max_looks);
  GroupFinder finder(store_, tree_, exclusion_margin_,
                     {.shares = false, .max_boxes = std::min(share, max_lazy_looks), .max_near = share});
  const GroupFinder::Found found = finder.find(slot);
  groups_.put(slot, found.members, found.height, found.margin);
  work += finder.take_work();
}

std::size_t DirectGrid::bytes() const noexcept {
  return store_.bytes() + tree_.bytes() + groups_.bytes() + cells_.bytes() + distances_.bytes();
}

}  // namespace touchmark::grid
