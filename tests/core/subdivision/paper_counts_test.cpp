/// The counts, volumes and tightnesses of Choi & Sung 2017 on their own mesh.
#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/mesh_io/mesh_io.h"
#include "core/sphere_cluster/published/triangle_spheres.h"
#include "core/subdivision/mesh_measures.h"
#include "core/subdivision/subdivision.h"

namespace touchmark {
namespace {

struct Row {
  SubdivisionMethod method;
  std::array<std::size_t, 3> triangles;
  std::array<double, 3> volume;     ///< over level 0's
  std::array<double, 3> tightness;  ///< over level 0's
};

const Row rows[] = {
    {SubdivisionMethod::butterfly, {3580, 13620, 41768}, {1.035, 1.049, 1.052}, {.488, .253, .144}},
    {SubdivisionMethod::catmull_clark_linear, {5412, 21648, 86592}, {1, 1, 1}, {.507, .251, .125}},
    {SubdivisionMethod::mid_point, {3580, 13590, 41120}, {1, 1, 1}, {.492, .251, .143}},
    {SubdivisionMethod::loop, {3580, 13600, 38444}, {.917, .903, .898}, {.434, .215, .130}},
    {SubdivisionMethod::ls3, {3580, 13668, 40730}, {1.021, 1.032, 1.035}, {.456, .228, .134}}};

double tightness_of(const TriangleMesh& mesh) {
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (const Sphere& sphere : triangle_spheres(mesh)) {
    centers.push_back(sphere.center);
    radii.push_back(sphere.radius);
  }
  return tightness(centers, radii, centers).value();
}

/// Beside the test's name in ctest's list.
std::string label(const testing::TestParamInfo<Row>& row) {
  std::string name(name_of(row.param.method));
  for (char& c : name)
    if (c == '-') c = '_';
  return name;
}

class PaperBunny : public testing::TestWithParam<Row> {
 protected:
  void SetUp() override {
    const std::filesystem::path file = std::filesystem::path(TOUCHMARK_SHARED_MODELS) / "bunny-902.ply";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
    mesh_ = load_mesh(file);
    ASSERT_EQ(mesh_->size(), 902u);
    ASSERT_NEAR(mesh_->diagonal(), 2.61541, 5e-6);
  }
  TriangleMesh level(int levels) const {
    return subdivide(*mesh_, {.method = GetParam().method,
                              .levels = levels,
                              .threshold = 0.01 * mesh_->diagonal(),
                              .form = SubdivisionForm::meshlab});
  }
  std::optional<TriangleMesh> mesh_;
};

TEST_P(PaperBunny, HasThePapersTriangles) {
  for (int l = 1; l <= 3; ++l)
    EXPECT_EQ(level(l).size(), GetParam().triangles[static_cast<std::size_t>(l - 1)]) << "level " << l;
}

TEST_P(PaperBunny, HasThePapersTrianglesAtTheRoundedThreshold) {
  const TriangleMesh mesh = subdivide(
      *mesh_,
      {.method = GetParam().method, .levels = 3, .threshold = 0.0261541, .form = SubdivisionForm::meshlab});
  EXPECT_EQ(mesh.size(), GetParam().triangles[2]);
}

TEST_P(PaperBunny, HasTheKnownVolumes) {
  const double coarse = absolute_volume(*mesh_, Vec3::Zero());
  for (int l = 1; l <= 3; ++l) {
    EXPECT_NEAR(absolute_volume(level(l), Vec3::Zero()) / coarse,
                GetParam().volume[static_cast<std::size_t>(l - 1)], 0.001)
        << "level " << l;
  }
}

TEST_P(PaperBunny, HasTheKnownTightness) {
  const double coarse = tightness_of(*mesh_);
  for (int l = 1; l <= 3; ++l) {
    const double known = GetParam().tightness[static_cast<std::size_t>(l - 1)];
    EXPECT_NEAR(tightness_of(level(l)) / coarse, known, 0.01 * known) << "level " << l;
  }
}

TEST_P(PaperBunny, StaysClosed) {
  EXPECT_TRUE(edge_statistics(*mesh_).closed());
  EXPECT_TRUE(edge_statistics(level(3)).closed());
}

INSTANTIATE_TEST_SUITE_P(, PaperBunny, testing::ValuesIn(rows), label);

/// All but Catmull-Clark, whose next level needs the quadrilaterals.
class PaperBunnyByEdges : public PaperBunny {};

TEST_P(PaperBunnyByEdges, ComesOutTheSameLevelByLevel) {
  // Nothing but the positions passes from one level of the tool to the next.
  TriangleMesh mesh = *mesh_;
  for (int l = 0; l < 3; ++l) {
    mesh = subdivide(mesh, {.method = GetParam().method,
                            .levels = 1,
                            .threshold = 0.01 * mesh_->diagonal(),
                            .form = SubdivisionForm::meshlab});
  }
  const TriangleMesh at_once = level(3);
  ASSERT_EQ(mesh.size(), at_once.size());
  for (std::size_t v = 0; v < mesh.vertices().size(); ++v)
    ASSERT_EQ(mesh.vertices()[v], at_once.vertices()[v]) << "vertex " << v;
}

INSTANTIATE_TEST_SUITE_P(, PaperBunnyByEdges, testing::Values(rows[0], rows[2], rows[3], rows[4]), label);

}  // namespace
}  // namespace touchmark
