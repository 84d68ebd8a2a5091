#include "bench/experiments/papers/choi_sung/choi_sung_models.h"

#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "bench/contestants/contestant.h"
#include "bench/experiments/papers/choi_sung/choi_sung_report.h"
#include "bench/experiments/papers/paper_trace.h"
#include "bench/meshes/meshes.h"
#include "core/sphere_cluster/published/published_sphere_cluster.h"

namespace touchmark::bench::experiments::papers {
namespace {

/// A sphere whose points are moved by `place`.
template <class Place>
TriangleMesh shaped(const Place& place) {
  const TriangleMesh sphere = meshes::load_mesh("icosphere:3");
  std::vector<Vec3> vertices;
  for (const Vec3& v : sphere.vertices()) vertices.push_back(place(v.normalized()));
  return {std::move(vertices), {sphere.triangles().begin(), sphere.triangles().end()}};
}

/// exp(-4 |a - b|^2): a bump in direction b. Of a series, so that it is the same everywhere.
double bump(const Vec3& a, const Vec3& b) {
  const double base = 1 + 4 * (a - b.normalized()).squaredNorm() / 8;
  return 1 / (base * base * base * base * base * base * base * base);
}

Vec3 tooth(const Vec3& d) {
  double radius = 1;
  for (const double x : {-1.0, 1.0}) {
    radius += 0.35 * bump(d, {x, 0.9, -1.6});  // roots
    radius += 0.55 * bump(d, {x, 0, -1.4});
    for (const double y : {-1.0, 1.0}) radius += 0.3 * bump(d, {x, y, 1.3});  // cusps
  }
  return radius * Vec3(0.8 * d.x(), 0.8 * d.y(), d.z());
}

/// Four leaves: cos(4 angle) of the direction in the plane, as a polynomial.
Vec3 clover(const Vec3& d) {
  const double across = d.x() * d.x() + d.y() * d.y();
  const double cos4 =
      across > 0 ? 1 - 8 * (d.x() * d.x() / across) * (d.y() * d.y() / across) : 1;  // 1 - 2 sin(2 angle)^2
  const double radius = 1 + 0.45 * across * cos4;
  return {radius * d.x(), radius * d.y(), 0.3 * d.z()};
}

/// A crown with a brim: the sphere's height names a place on the profile, from the top to the bottom.
Vec3 hat(const Vec3& d) {
  constexpr std::array<std::array<double, 2>, 7> profile{
      {{0, 1}, {0.5, 0.95}, {0.6, 0.7}, {0.65, 0.12}, {1.3, 0.05}, {1.3, -0.02}, {0, -0.02}}};
  constexpr std::array<double, 7> height{1, 0.55, 0.3, -0.15, -0.55, -0.65, -1};
  std::size_t i = 0;
  while (i + 2 < height.size() && d.z() < height[i + 1]) ++i;
  const double part = (height[i] - d.z()) / (height[i] - height[i + 1]);
  const double radius = profile[i][0] + part * (profile[i + 1][0] - profile[i][0]);
  const double z = profile[i][1] + part * (profile[i + 1][1] - profile[i][1]);
  const double across = std::sqrt(d.x() * d.x() + d.y() * d.y());
  return across > 1e-9 ? Vec3(radius * d.x() / across, radius * d.y() / across, z) : Vec3(0, 0, z);
}

/// Tests a query of the published two levels, without a clock.
double tests_per_query(const PublishedSphereCluster& detector, const std::vector<workload::Step>& path) {
  PublishedSphereCluster::Session session;
  for (const workload::Step& step : path) detector.nearest(step.probe, step.reach, session);
  return static_cast<double>(session.work.total()) / static_cast<double>(path.size());
}

void add_model_distances(const Model& model, const ChoiSungSettings& settings, ChoiSungResult& result) {
  const TriangleMesh mesh = choi_sung_surface(model.mesh, SubdivisionMethod::ls3, settings.levels);
  const auto path = paper_trace("slide", mesh, settings.steps, settings.seed, settings.radius);
  for (const double times : {0.0, 0.25, 0.5, 1.0, 2.0, 4.0}) {
    const auto scan = PublishedSphereCluster::build(mesh, {.clustering = times * settings.clustering});
    result.distances.push_back({model.name, "ls3", settings.levels, times * settings.clustering,
                                scan.clusters().size(), tests_per_query(scan, path)});
  }
}

}  // namespace

std::vector<Model> choi_sung_models() {
  return {{"tooth", shaped(tooth)}, {"clover", shaped(clover)}, {"hat", shaped(hat)}};
}

void add_models(std::span<const Model> models, const ChoiSungSettings& settings, double bunny_diagonal,
                ChoiSungResult& result, const PrintProgress& print_progress) {
  const SurfaceSink ignore = [](const auto&, const auto&, const auto&, const auto&) {};
  for (const Model& model : models) {
    ChoiSungSettings own = settings;
    own.timed = false;
    own.radius *= model.mesh.diagonal() / bunny_diagonal;
    own.clustering *= model.mesh.diagonal() / bunny_diagonal;
    const ChoiSungResult measured = run_choi_sung(model.mesh, own, ignore, [&](const std::string& what) {
      print_progress(fmt::format("{}: {}", model.name, what));
    });
    for (const Claim& claim : choi_sung_statements(measured))
      result.models.push_back({model.name, model.mesh.size(), claim.where, claim.what,
                               claim.agreement == Agreement::yes, claim.reproduced});
    if (!measured.finished) return;
    add_model_distances(model, own, result);
  }
}

void add_distances(const FrontierResult& frontier, ChoiSungResult& result) {
  for (const FrontierPoint& point : frontier.points)
    if (point.form == "scan")
      result.distances.push_back({"paper", point.method, point.level, point.clustering, point.spheres,
                                  point.tests_per_query, point.ns, point.error.mean});
}

}  // namespace touchmark::bench::experiments::papers
