// The scenes of core/c/touchmark.h.
#include "core/scene/scene.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "core/c/handles.h"
#include "core/c/touchmark.h"
#include "core/scene/body.h"
#include "core/scene/pose.h"
#include "core/scene/shape.h"
#include "core/sphere_cluster/sphere_cluster.h"

using namespace touchmark::c;
using touchmark::BodyId;
using touchmark::Pose;
using touchmark::SceneError;
using touchmark::Shape;
using touchmark::ShapeId;
using touchmark::SphereCluster;
using Bodies = touchmark::Scene<SphereCluster>;

struct touchmark_scene {
  std::shared_ptr<Bodies> bodies;
};

struct touchmark_scene_session {
  std::shared_ptr<const Bodies> bodies;
  Bodies::Session memory;
};

namespace {

std::uint64_t number_of(BodyId body) noexcept { return std::uint64_t{body.generation} << 32 | body.index; }
BodyId body_of(std::uint64_t number) noexcept {
  return {static_cast<std::uint32_t>(number), static_cast<std::uint32_t>(number >> 32)};
}

Pose pose_from(const double position[3], const double orientation[4]) {
  constexpr std::array<double, 4> as_it_is{1, 0, 0, 0};
  const double* q = orientation == nullptr ? as_it_is.data() : orientation;
  return touchmark::pose_of(point(position), q[0], q[1], q[2], q[3]);
}

/// Adds the shape that `make` returns.
template <class Make>
int add_shape(const char* function, touchmark_scene* scene, std::uint32_t* shape, const Make& make) noexcept {
  if (scene == nullptr) return fail_for_null(function, "scene");
  if (shape == nullptr) return fail_for_null(function, "shape");
  return guarded(function, int{TOUCHMARK_ERROR}, [&] {
    *shape = scene->bodies->add_shape(make()).index;
    return int{TOUCHMARK_YES};
  });
}

}  // namespace

touchmark_scene* touchmark_scene_create(void) {
  touchmark_scene* const none = nullptr;
  return guarded(__func__, none, [] { return new touchmark_scene{std::make_shared<Bodies>()}; });
}

void touchmark_scene_free(touchmark_scene* scene) { delete scene; }

size_t touchmark_scene_size(const touchmark_scene* scene) {
  return scene == nullptr ? 0 : scene->bodies->size();
}

size_t touchmark_scene_bytes(const touchmark_scene* scene) {
  return scene == nullptr ? 0 : scene->bodies->bytes();
}

int touchmark_scene_add_mesh(touchmark_scene* scene, const touchmark_mesh* mesh, uint32_t* shape) {
  if (scene != nullptr && mesh == nullptr) return fail_for_null(__func__, "mesh");
  return add_shape(__func__, scene, shape, [&] { return Shape<SphereCluster>::build(*mesh->mesh); });
}

int touchmark_scene_add_plane(touchmark_scene* scene, double size_x, double size_y, uint32_t* shape) {
  return add_shape(__func__, scene, shape, [&] { return Shape<SphereCluster>::plane(size_x, size_y); });
}

int touchmark_scene_add_box(touchmark_scene* scene, double size_x, double size_y, double size_z,
                            uint32_t* shape) {
  return add_shape(__func__, scene, shape, [&] {
    return Shape<SphereCluster>::box({size_x, size_y, size_z});
  });
}

int touchmark_scene_add_sphere(touchmark_scene* scene, double radius, uint32_t* shape) {
  return add_shape(__func__, scene, shape, [&] { return Shape<SphereCluster>::sphere(radius); });
}

int touchmark_scene_add_capsule(touchmark_scene* scene, double radius, double length, uint32_t* shape) {
  return add_shape(__func__, scene, shape, [&] { return Shape<SphereCluster>::capsule(radius, length); });
}

int touchmark_scene_add(touchmark_scene* scene, uint32_t shape, const double position[3],
                        const double orientation[4], uint64_t* body) {
  if (scene == nullptr) return fail_for_null(__func__, "scene");
  if (position == nullptr) return fail_for_null(__func__, "position");
  if (body == nullptr) return fail_for_null(__func__, "body");
  return guarded(__func__, int{TOUCHMARK_ERROR}, [&] {
    *body = number_of(scene->bodies->add(ShapeId{shape}, pose_from(position, orientation)));
    return int{TOUCHMARK_YES};
  });
}

int touchmark_scene_move(touchmark_scene* scene, uint64_t body, const double position[3],
                         const double orientation[4]) {
  if (scene == nullptr) return fail_for_null(__func__, "scene");
  if (position == nullptr) return fail_for_null(__func__, "position");
  return guarded(__func__, int{TOUCHMARK_ERROR}, [&] {
    scene->bodies->move(body_of(body), pose_from(position, orientation));
    return int{TOUCHMARK_YES};
  });
}

int touchmark_scene_remove(touchmark_scene* scene, uint64_t body) {
  if (scene == nullptr) return fail_for_null(__func__, "scene");
  return guarded(__func__, int{TOUCHMARK_ERROR}, [&] {
    scene->bodies->remove(body_of(body));
    return int{TOUCHMARK_YES};
  });
}

touchmark_scene_session* touchmark_scene_session_create(const touchmark_scene* scene) {
  touchmark_scene_session* const none = nullptr;
  if (scene == nullptr) return fail_for_null(__func__, "scene"), none;
  return guarded(__func__, none, [&] { return new touchmark_scene_session{scene->bodies, {}}; });
}

void touchmark_scene_session_free(touchmark_scene_session* session) { delete session; }

int touchmark_scene_touches(touchmark_scene_session* session, const double center[3], double radius) {
  if (refuses(__func__, session, center, "center", "radius", radius)) return TOUCHMARK_ERROR;
  return session->bodies->touches({point(center), radius}, session->memory) ? TOUCHMARK_YES : TOUCHMARK_NO;
}

int touchmark_scene_nearest(touchmark_scene_session* session, const double center[3], double reach,
                            touchmark_contact* contact, uint64_t* body) {
  if (refuses(__func__, session, center, "center", "reach", reach)) return TOUCHMARK_ERROR;
  const auto found = session->bodies->nearest_body({point(center), 0}, reach, session->memory);
  if (!found) return TOUCHMARK_NO;
  if (contact != nullptr) store_contact(found->contact, *contact);
  if (body != nullptr) *body = number_of(found->body);
  return TOUCHMARK_YES;
}

int touchmark_scene_first_hit(touchmark_scene_session* session, const double from[3], const double to[3],
                              double radius, touchmark_impact* impact, uint64_t* body) {
  if (refuses(__func__, session, from, "from", "radius", radius)) return TOUCHMARK_ERROR;
  if (to == nullptr) return fail_for_null(__func__, "to");
  const auto found = session->bodies->first_hit_body({point(from), point(to), radius}, session->memory);
  if (!found) return TOUCHMARK_NO;
  if (impact != nullptr) {
    impact->fraction = found->impact.fraction;
    store_contact(found->impact.contact, impact->contact);
  }
  if (body != nullptr) *body = number_of(found->body);
  return TOUCHMARK_YES;
}
