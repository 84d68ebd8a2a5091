#include "bench/experiments/papers/park_jang/park_jang_pictures.h"

#include <array>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "bench/experiments/papers/paper_trace.h"
#include "bench/experiments/papers/picture_files.h"
#include "core/grid_group/published/published_grid_group.h"
#include "core/grid_group/published/uniform_cells.h"

namespace touchmark::bench::experiments::papers {
namespace {

using Shape = PublishedGridGroup::Shape;

constexpr std::size_t step_by_step_groups = 40;  // large enough to be seen one by one

/// Cells come in steps, so a few sizes about the right one are tried for exactly as many groups.
PublishedGridGroup groups_of(const TriangleMesh& mesh, Shape shape, std::size_t count) {
  const auto miss = [count](const PublishedGridGroup& grid) {
    return grid.groups() > count ? grid.groups() - count : count - grid.groups();
  };
  PublishedGridGroup best = PublishedGridGroup::build(mesh, {.shape = shape, .groups = count});
  const double cell = best.cell();
  for (int i = 1; i <= 60 && miss(best) > 0; ++i) {
    const double part = (i % 2 == 0 ? 0.002 : -0.002) * ((i + 1) / 2);
    PublishedGridGroup next = PublishedGridGroup::build(mesh, {.shape = shape, .cell = cell * (1 + part)});
    if (miss(next) < miss(best)) best = std::move(next);
  }
  return best;
}

/// The cells that hold triangles, in the order of their groups.
std::vector<Aabb> cells_of(const TriangleMesh& mesh, double edge) {
  const grid::UniformCells cells(mesh.bounds(), edge);
  std::vector<grid::Membership> memberships;
  for (std::uint32_t i = 0; i < mesh.size(); ++i) cells.append_cells_of(mesh, i, memberships);
  std::set<std::uint64_t> held;
  for (const grid::Membership& membership : memberships) held.insert(membership.cell);
  const auto last = [&](int axis) { return cells.along(axis, mesh.bounds().max[axis]); };
  std::vector<Aabb> boxes;
  std::array<std::uint32_t, 3> cell{};
  for (cell[2] = 0; cell[2] <= last(2); ++cell[2])
    for (cell[1] = 0; cell[1] <= last(1); ++cell[1])
      for (cell[0] = 0; cell[0] <= last(0); ++cell[0])
        if (held.count(cells.number(cell)) > 0) boxes.push_back(cells.box(cell));
  return boxes;
}

double gap(const PublishedGridGroup& grid, std::size_t group, const Vec3& point) {
  if (!grid.boxes().empty()) return grid.boxes()[group].squared_distance(point);
  const Sphere& sphere = grid.spheres()[group];
  return (sphere.center - point).norm() - sphere.radius;
}

/// The group that the point is deepest in.
std::size_t active_group(const PublishedGridGroup& grid, const Vec3& point) {
  std::size_t active = 0;
  for (std::size_t group = 1; group < grid.groups(); ++group)
    if (gap(grid, group, point) < gap(grid, active, point)) active = group;
  return active;
}

class GroupPictures {
 public:
  GroupPictures(const TriangleMesh& mesh, const Vec3& hip, const results::ResultsFolder& folder)
      : mesh_(mesh), hip_(hip), folder_(folder) {}

  PicturedGroups write() const {
    write_file("original-mesh", triangles_csv(mesh_));
    const auto cubes = groups_of(mesh_, Shape::cube, park_jang_cubes);
    const auto spheres = groups_of(mesh_, Shape::centered_sphere, park_jang_spheres);
    write_groups("cube", cubes);
    write_groups("sphere", spheres);
    write_file("hip", fmt::format("x,y,z\n{},{},{}\n", hip_.x(), hip_.y(), hip_.z()));
    write_step_by_step();
    return {cubes.groups(), spheres.groups()};
  }

 private:
  void write_file(const std::string& name, const std::string& text) const {
    folder_.write_file("pictures/" + name + ".csv", text);
  }

  /// Figs 5 and 6: the groups, the active one, and the triangles that are looked at for it.
  void write_groups(const std::string& shape, const PublishedGridGroup& grid) const {
    const std::size_t active = active_group(grid, hip_);
    const bool boxes = !grid.boxes().empty();
    write_file(shape + "-groups", boxes ? boxes_csv(grid.boxes()) : spheres_csv(grid.spheres()));
    write_file(shape + "-active", triangles_csv(mesh_, grid.members(active)));
    write_file(shape + "-active-shape", boxes ? boxes_csv(grid.boxes().subspan(active, 1))
                                              : spheres_csv(grid.spheres().subspan(active, 1)));
  }

  /// Figs 1 to 3: cells, the triangles of one of them, the shapes around those, all shapes.
  void write_step_by_step() const {
    const auto cubes = groups_of(mesh_, Shape::cube, step_by_step_groups);
    const auto of_shape = [&](Shape shape) {
      return PublishedGridGroup::build(mesh_, {.shape = shape, .cell = cubes.cell()});
    };
    const auto centered = of_shape(Shape::centered_sphere), smallest = of_shape(Shape::sphere);
    const std::vector<Aabb> cells = cells_of(mesh_, cubes.cell());
    const std::size_t active = active_group(cubes, hip_);
    write_file("grouping-cells", boxes_csv(cells));
    write_file("grouping-cell", boxes_csv(std::span(cells).subspan(active, 1)));
    write_file("grouping-triangles", triangles_csv(mesh_, cubes.members(active)));
    write_file("grouping-cuboid", boxes_csv(cubes.boxes().subspan(active, 1)));
    write_file("grouping-cuboids", boxes_csv(cubes.boxes()));
    write_file("grouping-centered", spheres_csv(centered.spheres().subspan(active, 1)));
    write_file("grouping-smallest", spheres_csv(smallest.spheres().subspan(active, 1)));
    write_file("grouping-spheres", spheres_csv(centered.spheres()));
  }

  const TriangleMesh& mesh_;
  Vec3 hip_;
  const results::ResultsFolder& folder_;
};

}  // namespace

PicturedGroups write_group_pictures(const TriangleMesh& mesh, const ParkJangSettings& settings,
                                    const results::ResultsFolder& folder) {
  const double radius = settings.radius.in_mesh_units(mesh);
  const Vec3 hip = paper_trace("slide", mesh, 1, settings.seed, radius).front().probe.center;
  return GroupPictures(mesh, hip, folder).write();
}

}  // namespace touchmark::bench::experiments::papers
