#include "baselines/ode/ode_detector.h"

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <ode/ode.h>

#include "core/geometry/point_triangle.h"
#include "core/triangle_ids.h"
#include "core/triangle_mesh.h"

namespace touchmark::baselines {
namespace {

static_assert(sizeof(dReal) == sizeof(double), "Debian builds ODE in double precision");

/// What one question may bring back. dCollide takes the number in sixteen bits.
constexpr int max_contacts = 4096;

/// ODE's own state, which a program sets up once.
void start_ode() { [[maybe_unused]] static const int started = dInitODE2(0); }

Vec3 vec3(const dVector3& v) { return {v[0], v[1], v[2]}; }

}  // namespace

struct OdeDetector::Model : RivalModel<OdeDetector::Options> {
  Model(const TriangleMesh& mesh, const Options& chosen)
      : RivalModel(mesh, chosen), vertices(mesh.vertices().begin(), mesh.vertices().end()) {
    triangles = prepare(mesh);
    ids = mesh.triangle_ids();
    for (const TriangleMesh::Corners& c : mesh.triangles()) corners.push_back({c[0], c[1], c[2]});
    if (options.sides == Sides::both)
      for (const TriangleMesh::Corners& c : mesh.triangles()) corners.push_back({c[0], c[2], c[1]});
    data = dGeomTriMeshDataCreate();
    dGeomTriMeshDataBuildDouble(data, vertices.data(), sizeof(Vec3), static_cast<int>(vertices.size()),
                                corners.data(), static_cast<int>(3 * corners.size()), sizeof(corners[0]));
    geometry = dCreateTriMesh(nullptr, data, nullptr, nullptr, nullptr);
  }
  ~Model() {
    dGeomDestroy(geometry);
    dGeomTriMeshDataDestroy(data);
  }

  std::vector<Vec3> vertices;
  std::vector<std::array<dTriIndex, 3>> corners;
  dTriMeshDataID data;
  dGeomID geometry;
};

struct OdeDetector::State {
  State() {
    start_ode();
    ball = dCreateSphere(nullptr, 1);
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() { dGeomDestroy(ball); }

  /// Returns what ODE reports of the ball and the mesh, at most so much, and perhaps less where `flags` say
  /// that any will do.
  std::span<const dContactGeom> collide(dGeomID mesh, const Vec3& center, double radius, int flags) {
    dGeomSphereSetRadius(ball, radius);
    dGeomSetPosition(ball, center.x(), center.y(), center.z());
    const int found = dCollide(ball, mesh, flags, contacts.data(), sizeof(dContactGeom));
    return {contacts.data(), static_cast<std::size_t>(found)};
  }

  dGeomID ball;
  std::vector<dContactGeom> contacts{max_contacts};
};

OdeDetector OdeDetector::build(const TriangleMesh& mesh, const Options& options) {
  if (mesh.size() > std::size_t{1} << 30 || mesh.vertices().size() > std::numeric_limits<int>::max())
    throw MeshError("ode: a mesh of " + std::to_string(mesh.size()) + " triangles and " +
                    std::to_string(mesh.vertices().size()) + " vertices has more of them than ODE can count");
  start_ode();
  return OdeDetector(make_hidden<Model>(mesh, options));
}

bool OdeDetector::touches(const Probe& probe, Session& session) const noexcept {
  const Model& model = *model_;
  std::uint32_t last = session.last;  // stays as it is
  const std::optional<double> radius = model.reach_to_ask(probe.center, probe.radius, last);
  if (!radius) return false;
  const auto found = session.ready().collide(model.geometry, probe.center, *radius, 1 | CONTACTS_UNIMPORTANT);
  session.work.triangles += found.size();
  return !found.empty();
}

/// A ball that has brought back as much as it may is asked again as small as the nearest of it.
std::optional<Contact> OdeDetector::nearest_in_ball(const Vec3& center, double radius,
                                                    Session& session) const noexcept {
  const Model& model = *model_;
  State& state = session.ready();
  for (;;) {
    const auto found = state.collide(model.geometry, center, radius, max_contacts);
    session.work.triangles += found.size();
    std::optional<Contact> best;
    for (const dContactGeom& contact : found) {
      const Vec3 point = vec3(contact.pos);
      const double distance = (center - point).norm();
      const std::size_t triangle = static_cast<std::size_t>(contact.side2) % model.triangles.size();
      const TriangleId id = model.ids[triangle];
      if (!(distance <= radius)) continue;
      if (best && !(std::pair(distance, id) < std::pair(best->distance, best->triangle))) continue;
      session.last = static_cast<std::uint32_t>(triangle);
      best = {point, distance > 0 ? Vec3((center - point) / distance) : vec3(contact.normal), distance, id};
    }
    if (found.size() < max_contacts || !best || !(best->distance < radius)) return best;
    radius = best->distance;
  }
}

std::optional<Contact> OdeDetector::nearest(const Probe& probe, double reach,
                                            Session& session) const noexcept {
  const Model& model = *model_;
  const Vec3& center = probe.center;
  const std::optional<double> finite = model.reach_to_ask(center, reach, session.last);
  if (!finite) return std::nullopt;
  // From behind, ODE does not know the last triangle, and what it knows may be farther.
  return model.nearest_from_last(center, *finite, session,
                                 [&](double radius) { return nearest_in_ball(center, radius, session); });
}

std::size_t OdeDetector::bytes() const noexcept {
  const Model& model = *model_;
  return model.vertices.capacity() * sizeof(Vec3) + model.corners.capacity() * sizeof(model.corners[0]) +
         model.own_bytes();
}

Accuracy OdeDetector::accuracy() const noexcept {
  // Boxes are compared in single precision: a triangle at the very reach may be lost by some of its
  // roundings.
  constexpr double roundoff = std::numeric_limits<float>::epsilon() / 2;
  return {Guarantee::approximate, 8 * roundoff, 8 * roundoff * largest_coordinate(model_->bounds)};
}

}  // namespace touchmark::baselines
