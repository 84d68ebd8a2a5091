#include "baselines/fcl/fcl_ccd.h"

#include <algorithm>
#include <limits>
#include <vector>

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/continuous_collision.h>

#include "baselines/rival.h"

namespace touchmark::baselines {
namespace {

using Volume = fcl::OBBRSSd;

/// What FCL's default request has: the error of the time of contact.
constexpr double default_error = 1e-4;

fcl::Transform3d moved_to(const Vec3& center) {
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.translation() = center;
  return pose;
}

void fill(fcl::BVHModel<Volume>& model, const TriangleMesh& mesh) {
  std::vector<fcl::Vector3d> vertices(mesh.vertices().begin(), mesh.vertices().end());
  std::vector<fcl::Triangle> triangles;
  triangles.reserve(mesh.size());
  for (const TriangleMesh::Corners& corners : mesh.triangles())
    triangles.emplace_back(corners[0], corners[1], corners[2]);
  model.beginModel(static_cast<int>(triangles.size()), static_cast<int>(vertices.size()));
  model.addSubModel(vertices, triangles);
  model.endModel();
}

}  // namespace

struct FclCcd::Model {
  Options options;
  TriangleIds ids;
  std::unique_ptr<fcl::BVHModel<Volume>> mesh;

  /// FCL's deepest contact of the ball there.
  std::optional<Contact> contact(const Vec3& center, const fcl::Sphered& ball, Work& work) const {
    fcl::CollisionRequestd request(std::numeric_limits<std::size_t>::max(), true);
    fcl::CollisionResultd result;
    const fcl::Transform3d fixed = fcl::Transform3d::Identity();
    fcl::collide(mesh.get(), fixed, &ball, moved_to(center), request, result);
    work.triangles += result.numContacts();
    const fcl::Contactd* deepest = nullptr;
    for (std::size_t i = 0; i < result.numContacts(); ++i) {
      const fcl::Contactd& one = result.getContact(i);
      if (deepest == nullptr || one.penetration_depth < deepest->penetration_depth) deepest = &one;
    }
    if (deepest == nullptr) return std::nullopt;
    // FCL's normal points from the first object to the second, from the mesh to the ball; depth is negative.
    const double distance = std::max(ball.radius + deepest->penetration_depth, 0.0);
    return Contact{center - distance * deepest->normal, deepest->normal, distance,
                   ids[static_cast<std::size_t>(deepest->b1)]};
  }
};

FclCcd FclCcd::build(const TriangleMesh& mesh, const Options& options) {
  require_int_counts("FCL", mesh);
  auto model = make_hidden<Model>();
  model->options = options;
  model->ids = mesh.triangle_ids();
  FclCcd built(std::move(model));
  built.update(mesh);
  return built;
}

void FclCcd::update(const TriangleMesh& mesh) {
  model_->mesh = std::make_unique<fcl::BVHModel<Volume>>();
  fill(*model_->mesh, mesh);
}

std::optional<Impact> FclCcd::first_hit(const Sweep& sweep, Session& session) const noexcept {
  const fcl::Sphered ball(sweep.radius);
  const std::size_t samples = std::max<std::size_t>(model_->options.samples, 2);
  const fcl::ContinuousCollisionRequestd request(samples, default_error, fcl::CCDM_TRANS, fcl::GST_LIBCCD,
                                                 fcl::CCDC_NAIVE);
  fcl::ContinuousCollisionResultd result;
  const fcl::Transform3d fixed = fcl::Transform3d::Identity();
  fcl::continuousCollide(model_->mesh.get(), fixed, fixed, &ball, moved_to(sweep.from), moved_to(sweep.to),
                         request, result);
  if (!result.is_collide) return std::nullopt;
  const double step = 1 / static_cast<double>(samples - 1), time = result.time_of_contact;
  const std::optional<Contact> contact =
      model_->contact(sweep.from + time * (sweep.to - sweep.from), ball, session.work);
  if (!contact) return std::nullopt;
  return Impact{std::max(time - step, 0.0), *contact};
}

std::size_t FclCcd::bytes() const noexcept {
  const fcl::BVHModel<Volume>& mesh = *model_->mesh;
  return static_cast<std::size_t>(mesh.num_vertices) * sizeof(fcl::Vector3d) +
         static_cast<std::size_t>(mesh.num_tris) * sizeof(fcl::Triangle) +
         static_cast<std::size_t>(mesh.getNumBVs()) * sizeof(fcl::BVNode<Volume>);
}

Accuracy FclCcd::accuracy() const noexcept {
  return {Guarantee::approximate, std::numeric_limits<double>::infinity(), 0, false};
}

}  // namespace touchmark::baselines
