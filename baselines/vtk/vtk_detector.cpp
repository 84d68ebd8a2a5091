#include "baselines/vtk/vtk_detector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <tbb/task_arena.h>
#include <vtkCellArray.h>
#include <vtkGenericCell.h>
#include <vtkImplicitPolyDataDistance.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStaticCellLocator.h>

#include "core/geometry/point_triangle.h"
#include "core/triangle_ids.h"
#include "core/triangle_mesh.h"

namespace touchmark::baselines {
namespace {

vtkNew<vtkPolyData> poly_data(const TriangleMesh& mesh) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();  // VTK's default is single precision.
  for (const Vec3& vertex : mesh.vertices()) points->InsertNextPoint(vertex.data());
  vtkNew<vtkCellArray> triangles;
  for (const TriangleMesh::Corners& corners : mesh.triangles())
    triangles->InsertNextCell({vtkIdType{corners[0]}, vtkIdType{corners[1]}, vtkIdType{corners[2]}});
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(triangles);
  return data;
}

}  // namespace

struct VtkDetector::Model : RivalModel<VtkDetector::Options> {
  Model(const TriangleMesh& mesh, const Options& chosen) : RivalModel(mesh, chosen), data(poly_data(mesh)) {
    if (options.locator == Locator::implicit) {
      distance->SetInput(data);
      return;
    }
    triangles = prepare(mesh);  // none of `implicit`, which names none
    ids = mesh.triangle_ids();
    if (options.cells > 0) locator->SetNumberOfCellsPerNode(static_cast<int>(options.cells));
    locator->SetDataSet(data);
    // One thread, as everybody else builds with: Debian's VTK takes those of TBB, and the header that would
    // say so is no C++20.
    tbb::task_arena alone(1);
    alone.execute([&] { locator->BuildLocator(); });
    // Made at the first look otherwise, which is too late for threads that share it.
    data->BuildCells();
  }

  vtkNew<vtkPolyData> data;
  vtkNew<vtkStaticCellLocator> locator;
  vtkNew<vtkImplicitPolyDataDistance> distance;
};

struct VtkDetector::State {
  vtkNew<vtkGenericCell> cell;
};

VtkDetector VtkDetector::build(const TriangleMesh& mesh, const Options& options) {
  if (mesh.size() == 0) throw MeshError("vtk: the mesh has no triangles, and VTK's locators want some");
  return VtkDetector(make_hidden<Model>(mesh, options));
}

/// The closest point of all triangles that VTK finds in the ball. It finds nothing within a radius of 0.
std::optional<Contact> VtkDetector::nearest_in_ball(const Vec3& center, double radius,
                                                    Session& session) const noexcept {
  const Model& model = *model_;
  std::array<double, 3> from{center.x(), center.y(), center.z()}, point;
  vtkIdType triangle = -1;
  int part = 0, inside = 0;
  double squared = 0;
  const double within = std::max(a_little_more * radius, 0x1p-40 * model.bounds.diagonal());
  if (model.locator->FindClosestPointWithinRadius(from.data(), within, point.data(), session.ready().cell,
                                                  triangle, part, squared, inside) == 0)
    return std::nullopt;
  const Vec3 at(point[0], point[1], point[2]);
  const double distance = (center - at).norm();
  if (!(distance <= radius)) return std::nullopt;
  session.last = static_cast<std::uint32_t>(triangle);
  const Vec3 normal =
      distance > 0 ? Vec3((center - at) / distance) : face_normal(model.triangles[session.last]);
  return Contact{at, normal, distance, model.ids[session.last]};
}

/// The closest point of all triangles, as the signed distance has it.
std::optional<Contact> VtkDetector::nearest_of_all(const Vec3& center, double reach) const noexcept {
  std::array<double, 3> from{center.x(), center.y(), center.z()}, point;
  model_->distance->EvaluateFunctionAndGetClosestPoint(from.data(), point.data());
  const Vec3 at(point[0], point[1], point[2]);
  const double distance = (center - at).norm();
  if (!(distance <= reach)) return std::nullopt;
  if (distance > 0) return Contact{at, (center - at) / distance, distance, no_triangle};
  std::array<double, 3> normal;
  model_->distance->EvaluateGradient(from.data(), normal.data());
  return Contact{at, Vec3(normal[0], normal[1], normal[2]).normalized(), distance, no_triangle};
}

bool VtkDetector::touches(const Probe& probe, Session& session) const noexcept {
  const Model& model = *model_;
  std::uint32_t last = session.last;  // stays as it is
  const std::optional<double> radius = model.reach_to_ask(probe.center, probe.radius, last);
  if (!radius) return false;
  if (model.options.locator == Locator::implicit) return nearest_of_all(probe.center, *radius).has_value();
  if (model.checked() && session.last < model.triangles.size()) {
    ++session.work.triangles;
    const double distance = std::sqrt(squared_distance(model.triangles[session.last], probe.center));
    if (a_little_more * distance <= *radius) return true;
  }
  return nearest_in_ball(probe.center, *radius, session).has_value();
}

std::optional<Contact> VtkDetector::nearest(const Probe& probe, double reach,
                                            Session& session) const noexcept {
  const Model& model = *model_;
  const std::optional<double> finite = model.reach_to_ask(probe.center, reach, session.last);
  if (model.options.locator == Locator::implicit)
    return finite ? nearest_of_all(probe.center, *finite) : std::nullopt;
  if (!finite) {
    session.last = no_triangle;
    return std::nullopt;
  }
  // What VTK thinks of the last triangle may be more than what it is.
  return model.nearest_from_last(probe.center, *finite, session, [&](double radius) {
    return nearest_in_ball(probe.center, radius, session);
  });
}

std::size_t VtkDetector::bytes() const noexcept {
  const Model& model = *model_;
  return std::size_t{1024} * model.data->GetActualMemorySize() + model.own_bytes();
}

Accuracy VtkDetector::accuracy() const noexcept {
  // The closest point is a place, rounded to its coordinates, after some arithmetic with differences of such.
  constexpr double roundoff = std::numeric_limits<double>::epsilon() / 2;
  return {Guarantee::approximate, 4 * kernel_relative_error,
          8 * roundoff * largest_coordinate(model_->bounds)};
}

}  // namespace touchmark::baselines
