#include "core/subdivision/subdivision.h"

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/subdivision/butterfly.h"
#include "core/subdivision/catmull_clark.h"
#include "core/subdivision/edge_map.h"
#include "core/subdivision/edge_split.h"
#include "core/subdivision/indexed_faces.h"
#include "core/subdivision/loop.h"
#include "core/subdivision/ls3.h"
#include "core/subdivision/oriented_surface.h"

namespace touchmark {
namespace {

struct Named {
  SubdivisionMethod method;
  std::string_view name;
};
constexpr std::array<Named, 6> names = {{{SubdivisionMethod::butterfly, "butterfly"},
                                         {SubdivisionMethod::catmull_clark, "catmull-clark"},
                                         {SubdivisionMethod::catmull_clark_linear, "catmull-clark-linear"},
                                         {SubdivisionMethod::mid_point, "mid-point"},
                                         {SubdivisionMethod::loop, "loop"},
                                         {SubdivisionMethod::ls3, "ls3"}}};

void check(const SubdivisionOptions& options) {
  if (options.levels < 0)
    throw std::invalid_argument("levels is " + std::to_string(options.levels) + ", must be 0 or more");
  if (!(options.threshold >= 0))
    throw std::invalid_argument("threshold is " + std::to_string(options.threshold) + ", must be 0 or more");
}

/// Sides of faces and edges are counted in 32 bits.
constexpr std::size_t triangle_limit = 1'000'000'000;

bool splits_faces(SubdivisionMethod method) noexcept {
  return method == SubdivisionMethod::catmull_clark || method == SubdivisionMethod::catmull_clark_linear;
}

/// Throws MeshError when the level's triangles are too many.
void require_few_enough(std::size_t triangles, int level, const SubdivisionOptions& options) {
  const std::size_t limit = std::min(options.max_triangles, triangle_limit);
  if (triangles <= limit) return;
  throw MeshError("level " + std::to_string(level) + " of " + std::string(name_of(options.method)) +
                  " would have " + std::to_string(triangles) + " triangles, more than " +
                  std::to_string(limit));
}

/// Throws where the triangles would be too many. If every triangle splits, the counts of all levels are known
/// before the first.
void require_few_enough(std::size_t triangles, const SubdivisionOptions& options) {
  require_few_enough(triangles, 0, options);
  if (!splits_faces(options.method) && options.threshold > 0) return;
  for (int level = 1; level <= options.levels; ++level) {
    triangles *= level == 1 && splits_faces(options.method) ? 6U : 4U;
    require_few_enough(triangles, level, options);
  }
}

/// The tool keeps single-precision positions between levels.
void store(std::vector<Vec3>& positions, SubdivisionForm form) {
  if (form == SubdivisionForm::published) return;
  for (Vec3& p : positions) {
    if (!(p.cwiseAbs().maxCoeff() <= std::numeric_limits<float>::max()))
      throw MeshError("a coordinate of " + std::to_string(p.cwiseAbs().maxCoeff()) + " does not fit a float");
    p = p.cast<float>().cast<double>();
  }
}

std::vector<Vec3> with_middles(std::vector<Vec3> positions, const EdgeMap<3>& edges, const EdgeSplit& split) {
  positions.reserve(positions.size() + split.edges.size());
  for (const std::uint32_t e : split.edges) {
    const auto [a, b] = edges.ends(e);
    positions.push_back((positions[a] + positions[b]) / 2);
  }
  return positions;
}

std::vector<Vec3> with_butterfly_points(std::vector<Vec3> positions, const TriangleSurface& surface,
                                        const EdgeSplit& split, SubdivisionForm form) {
  const std::vector<Vec3> points = butterfly_points(surface, positions, split.edges, form);
  positions.insert(positions.end(), points.begin(), points.end());
  return positions;
}

/// One triangle mesh on its way through the levels of a scheme that splits edges.
class EdgeSplitting {
 public:
  EdgeSplitting(IndexedTriangles mesh, const SubdivisionOptions& options)
      : mesh_(std::move(mesh)), options_(options) {}

  void refine(int level) {
    const EdgeMap<3> edges(mesh_.faces, mesh_.positions.size());
    const EdgeSplit split = long_edges(mesh_.positions, edges, options_.threshold, options_.form);
    require_few_enough(count_after(mesh_.faces.size(), edges, split), level, options_);
    std::vector<Vec3> positions = refined_positions(edges, split);
    store(positions, options_.form);
    mesh_.faces = split_faces(mesh_.faces, edges, split, judged_by(positions));
    mesh_.positions = std::move(positions);
  }

  IndexedTriangles take() { return std::move(mesh_); }

 private:
  std::vector<Vec3> refined_positions(const EdgeMap<3>& edges, const EdgeSplit& split) {
    if (options_.method == SubdivisionMethod::mid_point) return with_middles(mesh_.positions, edges, split);
    const TriangleSurface surface(mesh_.faces, edges, mesh_.positions.size());
    if (options_.method == SubdivisionMethod::butterfly)
      return with_butterfly_points(mesh_.positions, surface, split, options_.form);
    if (options_.method == SubdivisionMethod::loop) return loop_points(surface, mesh_.positions, split.edges);
    return by_spheres(surface, split);
  }

  std::vector<Vec3> by_spheres(const TriangleSurface& surface, const EdgeSplit& split) {
    if (options_.form == SubdivisionForm::meshlab) {
      normals_ = angle_weighted_normals(mesh_);
    } else if (normals_.empty()) {
      normals_ = angle_weighted_normals(mesh_);
      normalize(normals_);
    }
    PointsAndNormals refined = ls3_points(surface, mesh_.positions, normals_, split.edges);
    normals_ = std::move(refined.normals);
    return std::move(refined.points);
  }

  /// Returns the positions by which a trapezoid's diagonals are compared: in the tool the old vertices have
  /// not moved yet.
  std::vector<Vec3> judged_by(const std::vector<Vec3>& refined) const {
    std::vector<Vec3> positions = refined;
    if (options_.form == SubdivisionForm::meshlab)
      std::copy(mesh_.positions.begin(), mesh_.positions.end(), positions.begin());
    return positions;
  }

  IndexedTriangles mesh_;
  std::vector<Vec3> normals_;  ///< for ls3
  const SubdivisionOptions& options_;
};

IndexedTriangles refine_by_edges(IndexedTriangles mesh, const SubdivisionOptions& options) {
  EdgeSplitting splitting(std::move(mesh), options);
  for (int level = 1; level <= options.levels; ++level) splitting.refine(level);
  return splitting.take();
}

IndexedTriangles refine_by_faces(IndexedTriangles mesh, const SubdivisionOptions& options) {
  if (options.levels == 0) return mesh;
  const bool smooth = options.method == SubdivisionMethod::catmull_clark;
  const auto positions = smooth ? CatmullClarkPositions::smooth : CatmullClarkPositions::linear;
  IndexedQuads quads = catmull_clark(mesh, positions);
  store(quads.positions, options.form);
  for (int level = 2; level <= options.levels; ++level) {
    quads = catmull_clark(quads, positions);
    store(quads.positions, options.form);
  }
  std::vector<TriangleMesh::Corners> triangles = triangulated(quads);
  return {std::move(quads.positions), std::move(triangles)};
}

}  // namespace

TriangleMesh subdivide(const TriangleMesh& mesh, const SubdivisionOptions& options) {
  check(options);
  IndexedTriangles welded = weld(mesh);
  if (welded.faces.empty())
    throw MeshError("none of the " + std::to_string(mesh.size()) +
                    " triangles has three corners in different places");
  require_few_enough(welded.faces.size(), options);
  store(welded.positions, options.form);
  IndexedTriangles result = splits_faces(options.method) ? refine_by_faces(std::move(welded), options)
                                                         : refine_by_edges(std::move(welded), options);
  return {std::move(result.positions), std::move(result.faces)};
}

std::string_view name_of(SubdivisionMethod method) noexcept {
  for (const Named& named : names)
    if (named.method == method) return named.name;
  return {};
}

std::optional<SubdivisionMethod> subdivision_method(std::string_view name) noexcept {
  for (const Named& named : names)
    if (named.name == name) return named.method;
  return std::nullopt;
}

}  // namespace touchmark
