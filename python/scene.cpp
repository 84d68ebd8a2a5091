#include "python/scene.h"

#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

namespace touchmark::python {
namespace {

std::int64_t number_of(BodyId body) noexcept {
  return static_cast<std::int64_t>(body.generation) << 32 | body.index;
}

BodyId body_of(std::int64_t number) {
  if (number < 0) throw SceneError("there is no body " + std::to_string(number));
  return {static_cast<std::uint32_t>(number), static_cast<std::uint32_t>(number >> 32)};
}

}  // namespace

std::size_t BatchScene::add_mesh(const TriangleMesh& mesh) {
  return add_shape(Shape<SphereCluster>::build(mesh));  // no batch waits for the build
}

std::size_t BatchScene::add_plane(double size_x, double size_y) {
  return add_shape(Shape<SphereCluster>::plane(size_x, size_y));
}

std::size_t BatchScene::add_box(double size_x, double size_y, double size_z) {
  return add_shape(Shape<SphereCluster>::box({size_x, size_y, size_z}));
}

std::size_t BatchScene::add_sphere(double radius) { return add_shape(Shape<SphereCluster>::sphere(radius)); }

std::size_t BatchScene::add_capsule(double radius, double length) {
  return add_shape(Shape<SphereCluster>::capsule(radius, length));
}

std::size_t BatchScene::add_shape(Shape<SphereCluster> shape) {
  const std::unique_lock alone(lock_);
  scene_.add_shape(std::move(shape));
  return shapes_++;
}

std::int64_t BatchScene::add(std::size_t shape, const Pose& pose) {
  const std::unique_lock alone(lock_);
  if (shape >= shapes_) throw SceneError("there is no shape " + std::to_string(shape));
  return number_of(scene_.add({static_cast<std::uint32_t>(shape)}, pose));
}

void BatchScene::move(std::int64_t body, const Pose& pose) {
  const std::unique_lock alone(lock_);
  scene_.move(body_of(body), pose);
}

void BatchScene::remove(std::int64_t body) {
  const std::unique_lock alone(lock_);
  scene_.remove(body_of(body));
}

Pose BatchScene::pose(std::int64_t body) const {
  const std::shared_lock shared(lock_);
  return scene_.pose(body_of(body));
}

std::size_t BatchScene::size() const {
  const std::shared_lock shared(lock_);
  return scene_.size();
}

std::size_t BatchScene::bytes() const {
  const std::shared_lock shared(lock_);
  return scene_.bytes();
}

template <class Ask>
bool BatchScene::ask_all(std::size_t count, const Effort& effort, const Ask& ask) const {
  const std::shared_lock shared(lock_);
  return for_all(
      count, [] { return std::make_unique<Bodies::Session>(); }, effort, ask);
}

bool BatchScene::touches(Points centers, Sizes radii, bool* touching, const Effort& effort) const {
  return ask_all(centers.count, effort, [&](std::size_t i, Bodies::Session& session) {
    touching[i] = scene_.touches({centers.at(i), radii.at(i)}, session);
  });
}

bool BatchScene::nearest(Points centers, Sizes reaches, ContactArrays contacts, std::int64_t* body,
                         const Effort& effort) const {
  return ask_all(centers.count, effort, [&](std::size_t i, Bodies::Session& session) {
    const std::optional<BodyContact> found = scene_.nearest_body({centers.at(i), 0}, reaches.at(i), session);
    contacts.store(i, found ? std::optional(found->contact) : std::nullopt);
    body[i] = found ? number_of(found->body) : -1;
  });
}

bool BatchScene::first_hit(Points from, Points to, Sizes radii, double* fraction, ContactArrays contacts,
                           std::int64_t* body, const Effort& effort) const {
  return ask_all(from.count, effort, [&](std::size_t i, Bodies::Session& session) {
    const std::optional<BodyImpact> found =
        scene_.first_hit_body({from.at(i), to.at(i), radii.at(i)}, session);
    fraction[i] = found ? found->impact.fraction : std::numeric_limits<double>::infinity();
    contacts.store(i, found ? std::optional(found->impact.contact) : std::nullopt);
    body[i] = found ? number_of(found->body) : -1;
  });
}

}  // namespace touchmark::python
