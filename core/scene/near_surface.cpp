#include "core/scene/near_surface.h"

#include <algorithm>
#include <bit>

#include "core/float_limits.h"

namespace touchmark {
namespace {

/// Calls visit(place) for the bits that are set.
template <class Visit>
void for_each_place(SurfaceList::Bits bits, const Visit& visit) noexcept {
  for (std::uint32_t word = 0; word < bits.size(); ++word)
    for (; bits[word] != 0; bits[word] &= bits[word] - 1)
      visit(64 * word + static_cast<std::uint32_t>(std::countr_zero(bits[word])));
}

}  // namespace

NearSurface::Found NearSurface::nothing(const SurfaceList::Move& move) noexcept {
  clearance_ = list_.clearance(move);
  return Found::nothing;
}

std::span<NearSurface::Measured> NearSurface::closest(double limit) noexcept {
  const auto begin = measured_.begin(), end = begin + measured_count_;
  const auto last = std::remove_if(begin, end, [&](const Measured& m) { return !(m.distance <= limit); });
  return {begin, last};
}

NearSurface::Found NearSurface::nearest(const Vec3& point, double reach, const SceneBodies& bodies,
                                        BodyContact& contact, Work& work) noexcept {
  if (!is_about(bodies)) return Found::unknown;
  const SurfaceList::Move move = list_.move_to(point);
  if (!list_.covers(0, move)) return Found::unknown;
  SurfaceList::InFrames in_frames(point, bodies);
  measured_count_ = 0;
  double best = infinity;
  const auto look_at = [&](std::uint32_t place) {
    const double distance = list_.measure(place, std::min(reach, best), in_frames);
    measured_[measured_count_++] = {place, distance};
    if (distance < best) {
      best = distance;
      last_ = place;
    }
  };
  // What was nearest the last time is often nearer than the others can be.
  const std::uint32_t first = last_;
  if (first < list_.count()) look_at(first);
  for_each_place(list_.within(move, std::min(reach, best)), [&](std::uint32_t place) {
    if (place != first && list_.may_be_within(place, move, std::min(reach, best))) look_at(place);
  });
  work.triangles += measured_count_;
  if (!list_.covers(std::min(reach, best), move)) return Found::unknown;
  ++served_;
  const double error = list_.error();
  if (!(best <= reach + error)) return nothing(move);
  remember(point, best, bodies);
  const std::optional<BodyContact> found =
      contact_of(closest(best + 2 * error), in_frames, reach, bodies, work);
  if (!found) return nothing(move);
  contact = *found;
  return Found::contact;
}

NearSurface::Found NearSurface::touches(const Vec3& point, double radius, const SceneBodies& bodies,
                                        Work& work) noexcept {
  if (!is_about(bodies)) return Found::unknown;
  const SurfaceList::Move move = list_.move_to(point);
  if (!list_.covers(0, move)) return Found::unknown;
  SurfaceList::InFrames in_frames(point, bodies);
  const double error = list_.error();
  measured_count_ = 0;
  const auto is_sure = [&](std::uint32_t place) {
    const double distance = list_.measure(place, radius, in_frames);
    measured_[measured_count_++] = {place, distance};
    ++work.triangles;
    if (!(distance + error <= radius)) return false;
    last_ = place;
    return true;
  };
  const std::uint32_t first = last_;
  bool touching = first < list_.count() && is_sure(first);
  if (!touching)
    for_each_place(list_.within(move, radius),
                   [&](std::uint32_t place) { touching = touching || (place != first && is_sure(place)); });
  const std::span<Measured> close = touching ? std::span<Measured>() : closest(radius + error);
  if (touching || touches_exactly(close, in_frames, radius, work)) {
    ++served_;
    remember(point, radius, bodies);
    return Found::contact;
  }
  if (!list_.covers(radius, move)) return Found::unknown;
  ++served_;
  return nothing(move);
}

ImageCandidate NearSurface::candidate(const Measured& measured, const SeenCorners& corners,
                                      const Pose& pose) const noexcept {
  const SurfaceList::Body& body = list_.body_of(measured.place);
  const std::uint32_t triangle = list_.triangle(measured.place);
  ImageCandidate result;
  result.body = body.index;
  result.triangle = triangle;
  result.id = body.mesh->id(triangle);
  result.posed = {
      {body.mesh->corner(triangle, 0), body.mesh->corner(triangle, 1), body.mesh->corner(triangle, 2)},
      &pose};
  result.seen = corners(result.posed.corner);
  const double error = list_.error();
  result.distance = {measured.distance - error, measured.distance + error};
  return result;
}

bool NearSurface::touches_exactly(std::span<const Measured> close, SurfaceList::InFrames& point,
                                  double radius, Work& work) const noexcept {
  return std::ranges::any_of(close, [&](const Measured& measured) {
    const Pose& pose = point.pose(list_.body_of(measured.place));
    return is_within(candidate(measured, list_.corners(measured.place, point), pose), point.point(), radius,
                     work.exact_decisions);
  });
}

std::optional<BodyContact> NearSurface::contact_of(std::span<const Measured> close,
                                                   SurfaceList::InFrames& point, double reach,
                                                   const SceneBodies& bodies, Work& work) const noexcept {
  if (close.size() == 1) {
    const std::uint32_t place = close.front().place;
    const ImageCandidate only =
        candidate(close.front(), list_.corners(place, point), point.pose(list_.body_of(place)));
    if (!is_within(only, point.point(), reach, work.exact_decisions)) return std::nullopt;
    return BodyContact{bodies.id(only.body), contact_on_image(only, point.point(), work.exact_decisions)};
  }
  NearestImage nearest(point.point());
  std::optional<SeenCorners> corners;
  std::uint32_t seen_body = 0;
  for (const Measured& measured : close) {
    const SurfaceList::Body& body = list_.body_of(measured.place);
    if (!corners || body.index != seen_body) {
      corners.emplace(list_.corners(measured.place, point));
      seen_body = body.index;
    }
    nearest.consider(candidate(measured, *corners, point.pose(body)), work.exact_decisions);
  }
  const std::optional<Contact> contact = nearest.contact(reach, work.exact_decisions);
  if (!contact) return std::nullopt;
  return BodyContact{bodies.id(nearest.best()->body), *contact};
}

void NearSurface::remember(const Vec3& point, double distance, const SceneBodies& bodies) noexcept {
  point_ = point;
  upper_ = distance;
  remembered_ = SceneState::of(bodies);
}

std::optional<double> NearSurface::start(const Vec3& point, double reach,
                                         const SceneBodies& bodies) noexcept {
  constexpr std::uint32_t few_served = 4;
  if (!(remembered_ == SceneState::of(bodies))) return std::nullopt;
  if (backoff_.waits()) return std::nullopt;
  const Vec3 way = point - point_;
  const double step = way.norm();
  const double limit = std::min(reach, upper_ + step), margin = steps_ahead_ * step;
  const double covered = limit + 1.5 * margin;
  if (!(step > 0 && covered < infinity)) return std::nullopt;
  served_ < few_served ? backoff_.failed() : backoff_.paid();
  // Ahead, so that the point crosses most of what is listed.
  center_ = point + (0.5 * steps_ahead_) * way;
  needed_ = limit + 0.5 * margin;
  list_.start(center_, covered);
  served_ = 0;
  last_ = SurfaceList::capacity;
  return covered;
}

void NearSurface::finish(const SceneBodies& bodies) noexcept {
  constexpr std::uint32_t few = 16, many = 64;
  constexpr double least = 1, most = 64;
  if (list_.count() > many || !is_complete())
    steps_ahead_ = std::max(0.5 * steps_ahead_, least);
  else if (list_.count() < few)
    steps_ahead_ = std::min(1.25 * steps_ahead_, most);
  listed_ = SceneState::of(bodies);
}

}  // namespace touchmark
