/// Mesh grouping: cells, memberships, and the smallest shape around each cell's triangles.
#include <algorithm>
#include <cmath>

#include "core/flushed_denormals.h"
#include "core/grid_group/build_input.h"
#include "core/grid_group/published/published_grid_group.h"
#include "core/grid_group/published/uniform_cells.h"
#include "core/search/plane_filter/plane_filter.h"

namespace touchmark {
namespace {

using grid::Membership;
using grid::UniformCells;

/// Returns as many memberships as memory should see: a triangle that lies in more than a few cells lies in
/// many.
std::uint64_t max_memberships(std::size_t triangles) {
  return std::max<std::uint64_t>(16 * static_cast<std::uint64_t>(triangles), 1u << 18);
}

/// A bound on the memberships, counted before any memory is taken; stops counting past `limit`.
std::uint64_t covered_cells(const TriangleMesh& mesh, const UniformCells& cells, std::uint64_t limit) {
  std::uint64_t covered = 0;
  for (std::uint32_t i = 0; i < mesh.size() && covered <= limit; ++i)
    covered += cells.covered_by_box_of(mesh, i);
  return covered;
}

struct Grouping {
  double cell;
  bool coarsened;
  std::vector<Membership> memberships;  ///< sorted

  std::size_t groups() const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < memberships.size(); ++i)
      count += i == 0 || memberships[i].cell != memberships[i - 1].cell ? 1u : 0u;
    return count;
  }
};

/// Cells of this edge, or larger ones if they would be too many.
Grouping grouping_of(const TriangleMesh& mesh, double edge) {
  const std::uint64_t limit = max_memberships(mesh.size());
  UniformCells cells(mesh.bounds(), edge);
  bool coarsened = cells.edge() > edge;
  while (covered_cells(mesh, cells, limit) > limit) {
    cells = UniformCells(mesh.bounds(), 1.25 * cells.edge());
    coarsened = true;
  }
  Grouping grouping{cells.edge(), coarsened, {}};
  for (std::uint32_t i = 0; i < mesh.size(); ++i) cells.append_cells_of(mesh, i, grouping.memberships);
  std::sort(grouping.memberships.begin(), grouping.memberships.end());
  return grouping;
}

/// A surface meets cells in proportion to 1 / edge^2, so a few corrections come close to the number wanted.
Grouping grouping_into(const TriangleMesh& mesh, std::size_t wanted) {
  const auto target = static_cast<double>(wanted);
  double edge = mesh.diagonal() / std::sqrt(target);
  Grouping best = grouping_of(mesh, edge);
  const auto miss = [&](const Grouping& g) {
    return std::abs(std::log(static_cast<double>(g.groups()) / target));
  };
  double count = static_cast<double>(best.groups());
  for (int correction = 0; correction < 4 && miss(best) > 0.05; ++correction) {
    edge *= std::sqrt(count / target);
    Grouping next = grouping_of(mesh, edge);
    count = static_cast<double>(next.groups());
    if (miss(next) < miss(best)) best = std::move(next);
  }
  best.coarsened = false;  // nobody asked for a particular size
  return best;
}

/// Group tests grow with the groups, triangle tests shrink with them: the sum is least near sqrt(triangles),
/// times the ratio of what the two cost.
std::size_t groups_for(std::size_t triangles) {
  return static_cast<std::size_t>(std::ceil(4 * std::sqrt(static_cast<double>(triangles))));
}

}  // namespace

PublishedGridGroup PublishedGridGroup::build(const TriangleMesh& mesh, const Options& options) {
  grid::check_cell(options.cell);
  check_flushed_denormals(mesh);
  PublishedGridGroup detector;
  detector.options_ = options;
  detector.connectivity_ = Connectivity(mesh);
  const bool is_point = mesh.bounds().extent().isZero(0);
  const TriangleMesh first = grid::first_triangle(mesh);
  const TriangleMesh& looked_at = is_point ? first : mesh;
  detector.bounds_ = looked_at.bounds();
  detector.triangles_ = prepare(looked_at);
  detector.ids_ = looked_at.triangle_ids();
  if (!is_point && FilterFrame::fits(mesh.bounds())) detector.group(mesh);
  return detector;
}

void PublishedGridGroup::update(const TriangleMesh& mesh) {
  connectivity_.expect(mesh);
  *this = build(mesh, options_);
}

void PublishedGridGroup::group(const TriangleMesh& mesh) {
  const std::size_t wanted = options_.groups > 0 ? options_.groups : groups_for(mesh.size());
  const Grouping grouping =
      options_.cell > 0 ? grouping_of(mesh, options_.cell) : grouping_into(mesh, wanted);
  cell_ = grouping.cell;
  coarsened_ = grouping.coarsened;
  first_member_.reserve(grouping.groups() + 1);
  members_.reserve(grouping.memberships.size());
  const std::vector<Membership>& memberships = grouping.memberships;
  for (std::size_t i = 0; i < memberships.size(); ++i) {
    if (i == 0 || memberships[i].cell != memberships[i - 1].cell) first_member_.push_back(i);
    members_.push_back(memberships[i].triangle);
  }
  first_member_.push_back(memberships.size());
  enclose(mesh);
}

void PublishedGridGroup::enclose(const TriangleMesh& mesh) {
  (options_.shape == Shape::cube ? boxes_.reserve(groups()) : spheres_.reserve(groups()));
  std::vector<Vec3> corners;
  for (std::size_t group = 0; group < groups(); ++group) {
    corners.clear();
    for (const std::uint32_t triangle : members(group))
      for (int i = 0; i < 3; ++i) corners.push_back(mesh.corner(triangle, i));
    if (options_.shape == Shape::sphere) {
      spheres_.push_back(smallest_sphere(corners));
      continue;
    }
    Aabb box;
    for (const Vec3& corner : corners) box.extend(corner);
    if (options_.shape == Shape::cube)
      boxes_.push_back(box);
    else
      spheres_.push_back(sphere_about(box.center(), corners));
  }
}

std::size_t PublishedGridGroup::bytes() const noexcept {
  return boxes_.capacity() * sizeof(Aabb) + spheres_.capacity() * sizeof(Sphere) +
         first_member_.capacity() * sizeof(std::size_t) + members_.capacity() * sizeof(std::uint32_t) +
         triangles_.capacity() * sizeof(PreparedTriangle) + ids_.bytes();
}

}  // namespace touchmark
