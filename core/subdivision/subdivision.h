/// Subdivision surfaces: a finer mesh from a coarse one, level by level, in the published schemes and as the
/// tool of Choi & Sung 2017 (MeshLab) applies them.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "core/triangle_mesh.h"

namespace touchmark {

/// The schemes; SubdivisionForm says what each of them does.
enum class SubdivisionMethod { butterfly, catmull_clark, catmull_clark_linear, mid_point, loop, ls3 };

/// published: the scheme of its paper, in double.
///   butterfly             modified butterfly: Zorin, Schröder, Sweldens 1996
///   catmull_clark         Catmull & Clark 1978, on quadrilaterals
///   catmull_clark_linear  the same faces, positions interpolated linearly: the surface stays (what the
///   paper's
///                         tool calls Catmull-Clark)
///   mid_point             every edge halved where it lies: the surface stays
///   loop                  Loop 1987, boundary as a cubic B-spline
///   ls3                   least squares subdivision surfaces: Boye, Guennebaud, Schlick 2010; the normals of
///                         one level's spheres are the next level's normals
/// meshlab: as the paper's tool does it. Positions are rounded to float after each level (the input's too).
///   butterfly             the plain eight-point scheme at every valence
///   ls3                   vertex normals anew at each level: sums of unit face normals times angle
enum class SubdivisionForm { published, meshlab };

/// How `subdivide` refines a mesh.
struct SubdivisionOptions {
  SubdivisionMethod method = SubdivisionMethod::loop;
  int levels = 1;  ///< 0: the mesh as welded below
  /// Mesh units: edges longer than this split, the same length at every level; 0 splits every edge.
  /// Catmull-Clark has no threshold: each of its faces splits.
  double threshold = 0;
  SubdivisionForm form = SubdivisionForm::published;
  /// More triangles than this are refused before memory is taken for them: 50 million take about 4 GB.
  std::size_t max_triangles = 50'000'000;
};

/// The mesh after `levels` steps. A triangle splits by its long edges: one in 2, two in 3 (the shorter
/// diagonal closes the trapezoid), three in 4; the first part keeps its place, the others follow at the end.
/// Vertices of the coarse mesh keep their numbers; in loop and ls3 all of them move at every level, whether
/// or not their edges split. Triangles are numbered anew.
///
/// What the input may be:
/// - Vertices at equal coordinates are one vertex, unused ones go; numbers move up accordingly.
/// - Triangles with two corners in one place have no surface and are left out. Other triangles without area
///   stay: they have neighbours like any other, and no normal.
/// - Boundaries follow each scheme's boundary rule.
/// - A seam is an edge of more than two triangles, or of two of different orientations (they run along it in
///   the same direction): it splits in the middle. The vertices on it, and those where several fans of
///   triangles meet in a point, stay. To mid_point and catmull_clark_linear such places are nothing special.
///
/// Throws std::invalid_argument for negative levels or a threshold that is negative or NaN; MeshError for a
/// mesh without a triangle left, for too many triangles, and for coordinates that a float (form meshlab) or a
/// double cannot hold.
TriangleMesh subdivide(const TriangleMesh& mesh, const SubdivisionOptions& options);

/// "butterfly", "catmull-clark", "catmull-clark-linear", "mid-point", "loop", "ls3".
std::string_view name_of(SubdivisionMethod method) noexcept;
std::optional<SubdivisionMethod> subdivision_method(std::string_view name) noexcept;

}  // namespace touchmark
