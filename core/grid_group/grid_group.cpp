#include "core/grid_group/grid_group.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/flushed_denormals.h"
#include "core/grid_group/build_input.h"
#include "core/grid_group/direct/group_builder.h"
#include "core/grid_group/direct/group_finder.h"
#include "core/point_queries/nearest_search.h"
#include "core/search/threads/parallel.h"

namespace touchmark {

void GridGroup::check(const Options& options) {
  constexpr double min_bytes_per_triangle = 200;
  grid::check_cell(options.cell);
  if (!(options.bytes_per_triangle >= min_bytes_per_triangle))
    throw std::invalid_argument("grid-group: bytes_per_triangle is " +
                                std::to_string(options.bytes_per_triangle) + ", less than " +
                                std::to_string(min_bytes_per_triangle));
  threads_to_use(options.threads, "grid-group");
}

GridGroup GridGroup::build(const TriangleMesh& mesh, const Options& options) {
  check(options);
  check_flushed_denormals(mesh);
  const unsigned threads = threads_to_use(options.threads, "grid-group");
  GridGroup detector;
  detector.options_ = options;
  detector.connectivity_ = Connectivity(mesh);
  grid::GroupedSurface& surface = detector.surface_;
  surface.bvh = WideBvh(mesh, nullptr, {.threads = threads});
  surface.certified = options.certified;
  if (!FilterFrame::fits(mesh.bounds())) return detector;
  surface.cells =
      grid::Cells(mesh.bounds(), options.cell, mesh.size(), detector.bytes_left(surface.bvh.bytes()) / 4);
  if (!detector.builds_lazily()) surface.cells.fill(surface.bvh, threads);
  surface.groups = grid::build_groups(
      surface.bvh, {detector.bytes_left(surface.bytes()), detector.builds_lazily(), threads});
  return detector;
}

void GridGroup::update(const TriangleMesh& mesh) {
  connectivity_.expect(mesh);
  const std::optional<std::vector<Aabb>> moved = surface_.bvh.update(mesh);
  if (!moved) {
    *this = build(mesh, options_);
    return;
  }
  if (moved->empty()) return;
  const unsigned threads = threads_to_use(options_.threads, "grid-group");
  builds_lazily() ? surface_.cells.clear() : surface_.cells.fill(surface_.bvh, threads);
  // The old groups make room for the new ones.
  const std::size_t left = bytes_left(surface_.bytes() - surface_.groups.bytes());
  surface_.groups =
      grid::rebuild_groups(surface_.bvh, surface_.groups, *moved, {left, builds_lazily(), threads});
}

std::size_t GridGroup::bytes_left(std::size_t taken) const noexcept {
  constexpr double limit = 0x1p62;
  const double bytes =
      options_.bytes_per_triangle * static_cast<double>(surface_.bvh.parts().triangles.size());
  const auto most = static_cast<std::size_t>(std::min(bytes, limit));
  return most - std::min(most, taken);
}

std::optional<Contact> GridGroup::look_for_nearest(const Vec3& center, double reach,
                                                   Session& session) const noexcept {
  const std::uint64_t before = session.work.total();
  std::optional<Contact> contact =
      queries::nearest_over(surface_, center, reach, session.memory, session.work);
  if (builds_lazily()) make_missing(session.work.total() - before, session);
  return contact;
}

void GridGroup::make_missing(std::uint64_t spent, Session& session) const noexcept {
  const std::uint32_t slot = session.memory.slot;
  const grid::Groups& groups = surface_.groups;
  if (groups.empty() || session.memory.epoch != surface_.bvh.epoch() || !session.memory.is_near()) return;
  if (session.memory.upper <= surface_.cells.edge()) surface_.cells.name(session.memory.center, slot);
  // With what answered the query it is to be no more than two looks at every triangle.
  const std::uint64_t budget =
      std::min(remaining(2 * std::uint64_t{surface_.bvh.parts().triangles.size()}, spent), max_lazy_work / 2);
  if (budget < grid::GroupFinder::min_budget || !groups.is_unbuilt(slot) || !groups.claim(slot)) return;
  grid::GroupFinder finder(surface_.bvh, grid::exclusion_margin_for(surface_.bvh), budget);
  groups.put(slot, finder.find(slot));
  session.work += finder.work();
}

}  // namespace touchmark
