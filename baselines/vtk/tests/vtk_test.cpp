#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkGenericCell.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStaticCellLocator.h>

#include "baselines/vtk/vtk_detector.h"
#include "core/brute_force/brute_force.h"
#include "core/float_limits.h"
#include "tests/baselines/asking.h"
#include "tests/baselines/meshes.h"
#include "tests/baselines/threads.h"

namespace touchmark::baselines {
namespace {

using Locator = VtkDetector::Locator;

static_assert(AnswersTouches<VtkDetector> && AnswersNearest<VtkDetector> && !AnswersSweep<VtkDetector>);

void expect_what_brute_force_finds(const TriangleMesh& mesh, const VtkDetector::Options& options, double size,
                                   const Vec3& middle) {
  const VtkDetector vtk = VtkDetector::build(mesh, options);
  const BruteForce reference = BruteForce::build(mesh);
  VtkDetector::Session session;
  BruteForce::Session other;
  Random random(7);
  int found = 0;
  for (int i = 0; i < 300; ++i) {
    const Probe probe{1.3 * size * random.point() + middle, 0.1 * size};
    const auto closest = reference.nearest(probe, infinity, other);
    const double allowed = vtk.accuracy().relative * 4 * size + vtk.accuracy().absolute;
    for (const double reach : {0.2 * size, infinity}) {
      const auto contact = vtk.nearest(probe, reach, session);
      ASSERT_EQ(contact.has_value(), closest->distance <= reach) << i;
      if (!contact) continue;
      ++found;
      EXPECT_NEAR(contact->distance, closest->distance, allowed) << i;
      EXPECT_NEAR((contact->point - closest->point).norm(), 0, 1e-6 * size) << i;
      EXPECT_NEAR(contact->normal.norm(), 1, 1e-12);
    }
    EXPECT_EQ(vtk.touches(probe, session), reference.touches(probe, other)) << i;
  }
  EXPECT_GT(found, 300);
}

TEST(Vtk, FindsWhatBruteForceFinds) {
  const Vec3 origin = Vec3::Zero(), far(1e6, -1e6, 1e6);
  for (const Locator locator : {Locator::fixed, Locator::implicit}) {
    SCOPED_TRACE(locator == Locator::fixed ? "static" : "implicit");
    expect_what_brute_force_finds(bumps(12), {.locator = locator}, 1, origin);
    expect_what_brute_force_finds(bumps(12).transformed(1e-6, origin), {.locator = locator}, 1e-6, origin);
    expect_what_brute_force_finds(bumps(12).transformed(1e6, origin), {.locator = locator}, 1e6, origin);
    expect_what_brute_force_finds(bumps(12).transformed(1, far), {.locator = locator}, 1, far);
  }
  expect_what_brute_force_finds(bumps(12), {.cells = 1}, 1, origin);
  expect_what_brute_force_finds(soup(200, 5), {}, 1, origin);
}

TEST(Vtk, TellsTheFacesNormalOnAFace) {
  VtkDetector::Session session;
  for (const Locator locator : {Locator::fixed, Locator::implicit}) {
    const VtkDetector vtk = VtkDetector::build(square(), {.locator = locator});
    const auto contact = vtk.nearest({{0.25, 0.125, 0}, 0}, 0, session);
    ASSERT_TRUE(contact);
    EXPECT_EQ(contact->distance, 0);
    EXPECT_EQ(contact->point, Vec3(0.25, 0.125, 0));
    EXPECT_NEAR((contact->normal - Vec3(0, 0, 1)).norm(), 0, 1e-12);
  }
}

TEST(Vtk, NamesTheFilesTriangleByItsLocatorAndNoneByItsDistance) {
  const TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}}, {7, 90});
  VtkDetector::Session session;
  const Probe probe{{0.75, 0.75, 0.5}, 0};
  const auto named = VtkDetector::build(mesh, {}).nearest(probe, 1, session),
             unnamed = VtkDetector::build(mesh, {.locator = Locator::implicit}).nearest(probe, 1, session);
  ASSERT_TRUE(named && unnamed);
  EXPECT_EQ(named->triangle, 90u);
  EXPECT_EQ(unnamed->triangle, std::numeric_limits<TriangleId>::max());
}

TEST(Vtk, GivesTheSameAnswerWhateverItIsAskedFirst) {
  expect_asking_changes_no_answer<VtkDetector>(bumps(20), {}, true);
  expect_asking_changes_no_answer<VtkDetector>(bumps(20), {.locator = Locator::implicit}, true);
}

TEST(Vtk, AsksTheLastTriangleFirst) { expect_asking_to_save_work<VtkDetector>({}); }

TEST(Vtk, ItsLocatorAnswersThreadsWithASessionEach) {
  expect_threads_to_get_the_same_bits(VtkDetector::build(bumps(20)));
}

TEST(Vtk, RefusesWhatItCannotCompute) {
  EXPECT_THROW(VtkDetector::build(TriangleMesh({{0, 0, 0}}, {})), MeshError);
  const VtkDetector vtk = VtkDetector::build(square());
  VtkDetector::Session session;
  EXPECT_FALSE(vtk.touches({{1e200, 0, 0}, 1}, session));
  EXPECT_FALSE(vtk.touches({{0, 0, 0}, -1}, session));
  EXPECT_FALSE(vtk.nearest({{std::nan(""), 0, 0}, 1}, 1, session));
}

/// Traps of the library itself, which README.md names.
TEST(VtkTraps, ATriangleWithoutAreaIsNotThere) {
  const TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {6, 0, 0}},
                          {{0, 1, 2}, {3, 4, 3}, {4, 4, 4}});
  for (const Locator locator : {Locator::fixed, Locator::implicit}) {
    const VtkDetector vtk = VtkDetector::build(mesh, {.locator = locator});
    VtkDetector::Session session;
    EXPECT_FALSE(vtk.touches({{5.5, 0, 0.125}, 0.25}, session));
    EXPECT_TRUE(vtk.touches({{0.25, 0.25, 0.125}, 0.25}, session));
    const auto contact = vtk.nearest({{5.5, 0, 0.125}, 0}, infinity, session);
    ASSERT_TRUE(contact);
    EXPECT_EQ(contact->point, Vec3(1, 0, 0));
  }
}

TEST(VtkTraps, WithinARadiusOfNothingThereIsNothing) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vec3& vertex : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)})
    points->InsertNextPoint(vertex.data());
  vtkNew<vtkCellArray> triangles;
  triangles->InsertNextCell({0, 1, 2});
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(triangles);
  vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(data);
  locator->BuildLocator();
  vtkNew<vtkGenericCell> cell;
  double on[3] = {0.25, 0.25, 0}, closest[3], squared = 0;
  vtkIdType triangle = 0;
  int part = 0, inside = 0;
  for (const double radius : {0.0, 1e-9}) {
    EXPECT_EQ(
        locator->FindClosestPointWithinRadius(on, radius, closest, cell, triangle, part, squared, inside),
        radius > 0 ? 1 : 0);
  }
}

TEST(VtkTraps, PointsAreInSinglePrecisionUnlessItIsSaid) {
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(1.0 / 3, 0, 0);
  EXPECT_NE(points->GetPoint(0)[0], 1.0 / 3);
  EXPECT_EQ(points->GetPoint(0)[0], static_cast<double>(static_cast<float>(1.0 / 3)));
}

}  // namespace
}  // namespace touchmark::baselines
