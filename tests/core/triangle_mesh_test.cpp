#include "core/triangle_mesh.h"

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace touchmark {
namespace {

using Corners = TriangleMesh::Corners;

const std::vector<Vec3> four_corners = {{0, 0, 0}, {2, 0, 0}, {0, 2, 1}, {5, 5, 5}};

std::string refusal(const std::function<void()>& make) {
  try {
    make();
  } catch (const MeshError& error) {
    return error.what();
  }
  return "accepted";
}

std::string refusal(std::vector<Vec3> vertices, std::vector<Corners> triangles,
                    std::vector<TriangleId> ids = {}) {
  return refusal([&] { TriangleMesh(std::move(vertices), std::move(triangles), std::move(ids)); });
}

TEST(TriangleMesh, RefusesAMeshWithoutTriangles) {
  EXPECT_EQ(refusal(four_corners, {}), "the mesh has no triangle");
  EXPECT_EQ(refusal({}, {}), "the mesh has no triangle");
}

TEST(TriangleMesh, NamesTheTriangleWhoseVertexDoesNotExist) {
  EXPECT_EQ(refusal(four_corners, {{0, 1, 2}, {0, 4, 1}}), "triangle 1 names vertex 4 of 4");
  EXPECT_EQ(refusal({}, {{0, 0, 0}}), "triangle 0 names vertex 0 of 0");
  EXPECT_EQ(refusal(four_corners, {{0, 1, 4294967295u}}), "triangle 0 names vertex 4294967295 of 4");
}

TEST(TriangleMesh, NamesTheVertexThatIsNotFinite) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(),
                   inf = std::numeric_limits<double>::infinity();
  for (const Vec3& bad : {Vec3(nan, 0, 0), Vec3(0, inf, 0), Vec3(0, 0, -inf)}) {
    std::vector<Vec3> vertices = four_corners;
    vertices[3] = bad;  // even where no triangle uses it
    EXPECT_EQ(refusal(vertices, {{0, 1, 2}}).find("vertex 3 is not finite: ("), 0u)
        << refusal(vertices, {{0, 1, 2}});
  }
}

TEST(TriangleMesh, RefusesIdsOfAnotherNumberOrThatDecrease) {
  EXPECT_EQ(refusal(four_corners, {{0, 1, 2}, {1, 2, 3}}, {7}), "1 ids for 2 triangles");
  EXPECT_EQ(refusal(four_corners, {{0, 1, 2}, {1, 2, 3}}, {7, 6}),
            "triangle 1 has id 6 after id 7: ids must not decrease");
}

TEST(TriangleMesh, KeepsIdsThatRepeatAndSkip) {
  const TriangleMesh mesh(four_corners, {{0, 1, 2}, {1, 2, 3}, {0, 2, 3}}, {3, 3, 9});
  EXPECT_EQ(mesh.id(0), 3u);
  EXPECT_EQ(mesh.id(1), 3u);
  EXPECT_EQ(mesh.id(2), 9u);
}

TEST(TriangleMesh, WithoutIdsATrianglesPositionIsItsId) {
  const TriangleMesh mesh(four_corners, {{0, 1, 2}, {1, 2, 3}});
  EXPECT_TRUE(mesh.ids().empty());
  EXPECT_EQ(mesh.id(1), 1u);
}

TEST(TriangleMesh, KeepsDegenerateTriangles) {
  const TriangleMesh mesh(four_corners, {{0, 0, 0}, {0, 1, 0}, {0, 1, 2}});
  EXPECT_EQ(mesh.size(), 3u);
  EXPECT_EQ(mesh.corner(1, 1), four_corners[1]);
}

TEST(TriangleMesh, BoundsAreThoseOfTheVerticesThatTrianglesUse) {
  const TriangleMesh mesh(four_corners, {{0, 1, 2}});
  EXPECT_EQ(mesh.bounds().min, Vec3(0, 0, 0));
  EXPECT_EQ(mesh.bounds().max, Vec3(2, 2, 1));
  EXPECT_EQ(mesh.diagonal(), 3);
}

TEST(TriangleMesh, TransformedShiftsThenScalesAndKeepsIds) {
  const TriangleMesh mesh = TriangleMesh(four_corners, {{0, 1, 2}}, {4}).transformed(2, Vec3(1, 0, -1));
  EXPECT_EQ(mesh.corner(0, 1), Vec3(6, 0, -2));
  EXPECT_EQ(mesh.id(0), 4u);
}

TEST(TriangleMesh, TransformedRefusesToOverflow) {
  const TriangleMesh mesh(four_corners, {{0, 1, 2}});
  EXPECT_EQ(refusal([&] { mesh.transformed(1e308, Vec3::Zero()); }).find("vertex 1 is not finite: ("), 0u);
}

TEST(TriangleMesh, NormalizedHasDiagonalOneAboutTheOrigin) {
  for (const double scale : {1e-150, 1e-6, 1.0, 1e6, 1e150}) {
    const TriangleMesh mesh =
        TriangleMesh(four_corners, {{0, 1, 2}}).transformed(scale, Vec3::Constant(3)).normalized();
    EXPECT_NEAR(mesh.diagonal(), 1, 1e-15) << scale;
    EXPECT_LE(mesh.bounds().center().cwiseAbs().maxCoeff(), 1e-15) << scale;
  }
}

TEST(TriangleMesh, NormalizedRefusesAPointAndWhatOverflows) {
  EXPECT_EQ(refusal([] {
              TriangleMesh({{1, 2, 3}}, {{0, 0, 0}}).normalized();
            }),
            "the mesh cannot be normalised: all its vertices coincide");
  EXPECT_EQ(refusal([] {
              TriangleMesh({{-1e300, 0, 0}, {1e300, 0, 0}}, {{0, 1, 1}}).normalized();
            }),
            "the mesh cannot be normalised: its box from (-1e+300, 0, 0) to (1e+300, 0, 0) has a diagonal "
            "beyond double");
}

}  // namespace
}  // namespace touchmark
