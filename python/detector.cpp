#include "python/detector.h"

#include <algorithm>
#include <limits>
#include <mutex>
#include <shared_mutex>
#include <stdexcept>
#include <utility>

namespace touchmark::python {
namespace {

void store(const Vec3& from, double* to) noexcept { std::copy_n(from.data(), 3, to); }

}  // namespace

void ContactArrays::store(std::size_t i, const std::optional<Contact>& contact) const noexcept {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  found[i] = contact.has_value();
  distance[i] = contact ? contact->distance : std::numeric_limits<double>::infinity();
  triangle[i] = contact ? std::int64_t{contact->triangle} : -1;
  python::store(contact ? contact->point : Vec3(nan, nan, nan), point + 3 * i);
  python::store(contact ? contact->normal : Vec3(nan, nan, nan), normal + 3 * i);
}

template <class Ask>
bool BatchDetector::ask_all(std::size_t count, const Effort& effort, const Ask& ask) const {
  const std::shared_lock shared(lock_);
  expect_usable();
  return for_all(
      count, [&] { return detector_->begin_session(); }, effort, ask);
}

BatchDetector::BatchDetector(std::shared_ptr<const TriangleMesh> mesh, std::string text)
    : text_(std::move(text)), mesh_(std::move(mesh)), detector_(NamedDetector::build(*mesh_, text_)) {}

bool BatchDetector::touches(Points centers, Sizes radii, bool* touching, const Effort& effort) const {
  return ask_all(centers.count, effort, [&](std::size_t i, NamedDetector::Session& session) {
    touching[i] = detector_->touches({centers.at(i), radii.at(i)}, session);
  });
}

bool BatchDetector::nearest(Points centers, Sizes reaches, ContactArrays contacts,
                            const Effort& effort) const {
  return ask_all(centers.count, effort, [&](std::size_t i, NamedDetector::Session& session) {
    contacts.store(i, detector_->nearest({centers.at(i), 0}, reaches.at(i), session));
  });
}

bool BatchDetector::first_hit(Points from, Points to, Sizes radii, double* fraction, ContactArrays contacts,
                              const Effort& effort) const {
  return ask_all(from.count, effort, [&](std::size_t i, NamedDetector::Session& session) {
    const std::optional<Impact> impact = detector_->first_hit({from.at(i), to.at(i), radii.at(i)}, session);
    fraction[i] = impact ? impact->fraction : std::numeric_limits<double>::infinity();
    contacts.store(i, impact ? std::optional(impact->contact) : std::nullopt);
  });
}

bool BatchDetector::sides(Points centers, std::int8_t* side, const Effort& effort) const {
  const std::shared_lock shared(lock_);
  expect_usable();
  const SideFinder& finder = side_finder();
  const auto begin_session = [&] { return detector_->begin_session(); };
  return for_all(centers.count, begin_session, effort, [&](std::size_t i, NamedDetector::Session& session) {
    constexpr double anywhere = std::numeric_limits<double>::infinity();
    std::uint64_t counted = 0;
    const Vec3 center = centers.at(i);
    const std::optional<Contact> contact = detector_->nearest({center, 0}, anywhere, session);
    const Side found =
        contact ? finder.side(center, *contact, detector_->accuracy(), counted) : Side::undecided;
    side[i] = static_cast<std::int8_t>(found);
  });
}

bool BatchDetector::contacts(Points centers, Sizes reaches, ContactLists& lists, const Effort& effort) const {
  std::vector<std::vector<Contact>> found(centers.count);
  const bool complete = ask_all(centers.count, effort, [&](std::size_t i, NamedDetector::Session& session) {
    const Probe probe{centers.at(i), 0};
    std::vector<Contact>& into = found[i];
    into.resize(16);
    std::size_t count = detector_->contacts(probe, reaches.at(i), session, into);
    if (count > into.size()) {
      into.resize(count);
      count = detector_->contacts(probe, reaches.at(i), session, into);
    }
    into.resize(count);
    into.shrink_to_fit();
  });
  for (std::vector<Contact>& of_point : found) {
    lists.contacts.insert(lists.contacts.end(), of_point.begin(), of_point.end());
    lists.ends.push_back(static_cast<std::int64_t>(lists.contacts.size()));
    of_point = {};
  }
  return complete;
}

void BatchDetector::expect_usable() const {
  if (!usable_) throw std::invalid_argument("the detector's last update failed half-way: build it anew");
}

std::shared_ptr<const TriangleMesh> BatchDetector::moved(std::vector<Vec3> vertices) const {
  if (vertices.size() != mesh_->vertices().size())
    throw std::invalid_argument("vertices has " + std::to_string(vertices.size()) + " rows; the mesh has " +
                                std::to_string(mesh_->vertices().size()) + " vertices");
  return std::make_shared<const TriangleMesh>(
      std::move(vertices),
      std::vector<TriangleMesh::Corners>(mesh_->triangles().begin(), mesh_->triangles().end()));
}

void BatchDetector::update(std::vector<Vec3> vertices) {
  const std::unique_lock alone(lock_);
  expect_usable();
  std::shared_ptr<const TriangleMesh> next = moved(std::move(vertices));
  usable_ = false;
  try {
    detector_->update(*next);
  } catch (const std::invalid_argument&) {
    usable_ = true;
    throw;
  }
  mesh_ = std::move(next);
  sides_.reset();
  ++updates_;
  usable_ = true;
}

std::shared_ptr<const TriangleMesh> BatchDetector::mesh() const {
  const std::shared_lock shared(lock_);
  return mesh_;
}

std::pair<std::shared_ptr<const TriangleMesh>, std::string> BatchDetector::recipe() const {
  const std::shared_lock shared(lock_);
  expect_usable();
  return {mesh_, text_};
}

std::size_t BatchDetector::bytes() const {
  const std::shared_lock shared(lock_);
  return usable_ ? detector_->bytes() : 0;
}

const SideFinder& BatchDetector::side_finder() const {
  const std::lock_guard locked(making_sides_);
  if (!sides_) sides_ = SideFinder::build(*mesh_);
  return *sides_;
}

}  // namespace touchmark::python
