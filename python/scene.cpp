#include "python/scene.h"

#include <limits>
#include <mutex>
#include <optional>
#include <shared_mutex>
#include <string>
#include <utility>

namespace touchmark::python {
namespace {

using Cluster = Shape<SphereCluster>;

Cluster shape_of(std::shared_ptr<const TriangleMesh> mesh) {
  auto detector = std::make_shared<const SphereCluster>(SphereCluster::build(*mesh));
  return {std::move(detector), std::move(mesh)};
}

}  // namespace

BatchScene::BatchScene(const Recipe& recipe) {
  for (const auto& [mesh, radius] : recipe.shapes)
    add_shape(radius == 0 ? shape_of(mesh) : Cluster{nullptr, mesh, radius});
  // A place without a body had one that was removed.
  for (const Place& place : recipe.places) add(place.shape == Place::no_shape ? 0 : place.shape, place.pose);
  for (std::size_t i = 0; i < recipe.places.size(); ++i) {
    if (recipe.places[i].shape == Place::no_shape) remove(static_cast<std::int64_t>(i));
    places_[i].before = recipe.places[i].before;
  }
}

BatchScene::Recipe BatchScene::recipe() const {
  const std::shared_lock shared(lock_);
  Recipe recipe{shapes_, {}};
  for (const Entry& place : places_) {
    const bool has_body = place.shape != Place::no_shape;
    recipe.places.push_back({place.shape, place.before, has_body ? scene_.pose(place.body) : Pose()});
  }
  return recipe;
}

std::int64_t BatchScene::number_of(BodyId body) const noexcept {
  return static_cast<std::int64_t>(places_[body.index].before) << 32 | body.index;
}

std::size_t BatchScene::place_of(std::int64_t body) const {
  const auto place = static_cast<std::uint32_t>(body);
  if (body < 0 || place >= places_.size() || places_[place].shape == Place::no_shape ||
      places_[place].before != body >> 32)
    throw SceneError("there is no body " + std::to_string(body));
  return place;
}

std::size_t BatchScene::add_mesh(std::shared_ptr<const TriangleMesh> mesh) {
  return add_shape(shape_of(std::move(mesh)));  // no batch waits for the build
}

std::size_t BatchScene::add_plane(double size_x, double size_y) {
  return add_shape(Cluster::plane(size_x, size_y));
}

std::size_t BatchScene::add_box(double size_x, double size_y, double size_z) {
  return add_shape(Cluster::box({size_x, size_y, size_z}));
}

std::size_t BatchScene::add_sphere(double radius) { return add_shape(Cluster::sphere(radius)); }

std::size_t BatchScene::add_capsule(double radius, double length) {
  return add_shape(Cluster::capsule(radius, length));
}

std::size_t BatchScene::add_shape(Cluster shape) {
  const std::unique_lock alone(lock_);
  Parts parts{shape.mesh, shape.radius};
  scene_.add_shape(std::move(shape));
  shapes_.push_back(std::move(parts));
  return shapes_.size() - 1;
}

std::int64_t BatchScene::add(std::size_t shape, const Pose& pose) {
  const std::unique_lock alone(lock_);
  if (shape >= shapes_.size()) throw SceneError("there is no shape " + std::to_string(shape));
  const auto index = static_cast<std::uint32_t>(shape);
  const BodyId body = scene_.add({index}, pose);
  if (body.index == places_.size()) places_.emplace_back();
  places_[body.index].shape = index;
  places_[body.index].body = body;
  return number_of(body);
}

void BatchScene::move(std::int64_t body, const Pose& pose) {
  const std::unique_lock alone(lock_);
  scene_.move(places_[place_of(body)].body, pose);
}

void BatchScene::remove(std::int64_t body) {
  const std::unique_lock alone(lock_);
  Entry& place = places_[place_of(body)];
  scene_.remove(place.body);
  place.shape = Place::no_shape;
  ++place.before;
}

Pose BatchScene::pose(std::int64_t body) const {
  const std::shared_lock shared(lock_);
  return scene_.pose(places_[place_of(body)].body);
}

std::size_t BatchScene::size() const {
  const std::shared_lock shared(lock_);
  return scene_.size();
}

std::size_t BatchScene::bytes() const {
  const std::shared_lock shared(lock_);
  return scene_.bytes() + places_.capacity() * sizeof(Entry);
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
