#include "python/detector.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <limits>
#include <system_error>
#include <thread>

namespace touchmark::python {
namespace {

/// More threads than this are of no use to so few points: to start one takes some tens of microseconds.
constexpr std::size_t least_points_a_thread = 256;

std::size_t thread_count(std::size_t asked, std::size_t points) {
  if (asked == 0) asked = std::max(1u, std::thread::hardware_concurrency());
  return std::clamp(asked, std::size_t{1}, std::max(std::size_t{1}, points / least_points_a_thread));
}

/// Calls ask(i, session) for every i below `count`; false where it was interrupted.
template <class Ask>
bool for_all(std::size_t count, const NamedDetector& detector, const Effort& effort, const Ask& ask) {
  constexpr std::size_t looked_at = 64;  // points between two looks at the clock or at `ended`
  constexpr auto pause = std::chrono::milliseconds(100);
  const std::size_t threads = thread_count(effort.threads, count);
  std::atomic<bool> ended = false;
  const auto part = [&](std::size_t thread, NamedDetector::Session& session, bool may_ask) {
    const std::size_t begin = count / threads * thread + std::min(thread, count % threads);
    const std::size_t end = begin + count / threads + (thread < count % threads ? 1 : 0);
    auto asked_at = std::chrono::steady_clock::now();
    for (std::size_t i = begin; i < end; ++i) {
      ask(i, session);
      if ((i - begin) % looked_at != looked_at - 1) continue;
      if (may_ask && std::chrono::steady_clock::now() - asked_at > pause) {
        if (effort.is_interrupted()) ended = true;
        asked_at = std::chrono::steady_clock::now();
      }
      if (ended.load(std::memory_order_relaxed)) return;
    }
  };
  std::vector<std::unique_ptr<NamedDetector::Session>> sessions;
  for (std::size_t thread = 0; thread < threads; ++thread) sessions.push_back(detector.begin_session());
  {
    std::vector<std::jthread> others;
    std::size_t started = 1;
    try {
      for (; started < threads; ++started)
        others.emplace_back(part, started, std::ref(*sessions[started]), false);
    } catch (
        const std::system_error&) {  // no more threads to be had: this one does what they would have done
    }
    part(0, *sessions[0], true);
    for (; started < threads; ++started) part(started, *sessions[started], true);
  }
  return !ended;
}

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

BatchDetector::BatchDetector(std::shared_ptr<const TriangleMesh> mesh, const std::string& text)
    : mesh_(std::move(mesh)), detector_(NamedDetector::build(*mesh_, text)) {}

bool BatchDetector::touches(Points centers, Sizes radii, bool* touching, const Effort& effort) const {
  return for_all(centers.count, *detector_, effort, [&](std::size_t i, NamedDetector::Session& session) {
    touching[i] = detector_->touches({centers.at(i), radii.at(i)}, session);
  });
}

bool BatchDetector::nearest(Points centers, Sizes reaches, ContactArrays contacts,
                            const Effort& effort) const {
  return for_all(centers.count, *detector_, effort, [&](std::size_t i, NamedDetector::Session& session) {
    contacts.store(i, detector_->nearest({centers.at(i), 0}, reaches.at(i), session));
  });
}

bool BatchDetector::first_hit(Points from, Points to, Sizes radii, double* fraction, ContactArrays contacts,
                              const Effort& effort) const {
  return for_all(from.count, *detector_, effort, [&](std::size_t i, NamedDetector::Session& session) {
    const std::optional<Impact> impact = detector_->first_hit({from.at(i), to.at(i), radii.at(i)}, session);
    fraction[i] = impact ? impact->fraction : std::numeric_limits<double>::infinity();
    contacts.store(i, impact ? std::optional(impact->contact) : std::nullopt);
  });
}

bool BatchDetector::sides(Points centers, std::int8_t* side, const Effort& effort) const {
  std::call_once(sides_made_, [&] { sides_ = SideFinder::build(*mesh_); });
  return for_all(centers.count, *detector_, effort, [&](std::size_t i, NamedDetector::Session& session) {
    constexpr double anywhere = std::numeric_limits<double>::infinity();
    std::uint64_t counted = 0;
    const Vec3 center = centers.at(i);
    const std::optional<Contact> contact = detector_->nearest({center, 0}, anywhere, session);
    const Side found =
        contact ? sides_->side(center, *contact, detector_->accuracy(), counted) : Side::undecided;
    side[i] = static_cast<std::int8_t>(found);
  });
}

}  // namespace touchmark::python
