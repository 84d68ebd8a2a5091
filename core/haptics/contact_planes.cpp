#include "core/haptics/contact_planes.h"

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <optional>

namespace touchmark {
namespace {

/// Below it the volume of two or three unit normals, squared, counts as none: a few roundings of it.
constexpr double parallel = 1e-15;

/// How hard each plane pushes: the multipliers m of the offset sum m_i n_i that makes up what all lack.
std::optional<Vec3> multipliers(std::span<const Vec3> n, const Vec3& lack) noexcept {
  if (n.size() == 1) return Vec3(lack[0], 0, 0);
  if (n.size() == 2) {
    const double c = n[0].dot(n[1]), determinant = n[0].cross(n[1]).squaredNorm();
    if (!(determinant > parallel)) return std::nullopt;
    return Vec3((lack[0] - c * lack[1]) / determinant, (lack[1] - c * lack[0]) / determinant, 0);
  }
  const Vec3 a = n[1].cross(n[2]), b = n[2].cross(n[0]), c = n[0].cross(n[1]);
  const double volume = n[0].dot(a);
  if (!(volume * volume > parallel)) return std::nullopt;
  const Vec3 offset = (lack[0] * a + lack[1] * b + lack[2] * c) / volume;
  return Vec3(offset.dot(a), offset.dot(b), offset.dot(c)) / volume;
}

}  // namespace

bool ContactPlanes::protrudes(const Vec3& point, double by) const noexcept {
  return std::ranges::all_of(all(), [&](const ContactPlane& plane) { return plane.height(point) > by; });
}

void ContactPlanes::meet(const ContactPlane& plane, double lift) noexcept {
  constexpr double same_direction = 1e-7;
  for (ContactPlane& known : std::span(planes_).first(count_)) {
    if ((known.normal - plane.normal).norm() > same_direction) continue;
    const double more = std::max(2 * known.lift, lift);
    known = plane;
    known.lift = more;
    return;
  }
  add(plane);
}

bool ContactPlanes::try_set(std::span<const std::uint8_t> chosen, std::span<const double> lack, double slack,
                            Vec3& offset) const noexcept {
  std::array<Vec3, max_active> normals;
  for (std::size_t i = 0; i < chosen.size(); ++i) normals[i] = planes_[chosen[i]].normal;
  Vec3 push = Vec3::Zero(), tried = Vec3::Zero();
  // The second pass solves for what the first has left by rounding.
  for (int pass = 0; pass < 2; ++pass) {
    Vec3 left = Vec3::Zero();
    for (std::size_t i = 0; i < chosen.size(); ++i)
      left[static_cast<int>(i)] = lack[chosen[i]] - normals[i].dot(tried);
    const std::optional<Vec3> more = multipliers(std::span(normals).first(chosen.size()), left);
    if (!more) return false;
    push += *more;
    for (std::size_t i = 0; i < chosen.size(); ++i) tried += (*more)[static_cast<int>(i)] * normals[i];
  }
  if (push.minCoeff() < 0) return false;
  // Planes that face one another push hard, and what is left of that is as rounded as they are hard.
  const double enough = slack + 8 * std::numeric_limits<double>::epsilon() * push.sum();
  for (std::size_t i = 0; i < count_; ++i)
    if (planes_[i].normal.dot(tried) < lack[i] - enough) return false;
  offset = tried;
  return true;
}

/// Chooses the planes that hold the solution, fewest first.
bool ContactPlanes::solve(std::span<const double> lack, double slack, Vec3& offset) noexcept {
  const auto solves = [&](std::initializer_list<std::uint8_t> chosen) {
    if (!try_set({chosen.begin(), chosen.size()}, lack, slack, offset)) return false;
    std::ranges::copy(chosen, active_.begin());
    active_count_ = chosen.size();
    return true;
  };
  const auto count = static_cast<std::uint8_t>(count_);
  for (std::uint8_t i = 0; i < count; ++i)
    if (solves({i})) return true;
  for (std::uint8_t i = 0; i < count; ++i)
    for (std::uint8_t j = i + 1; j < count; ++j)
      if (solves({i, j})) return true;
  for (std::uint8_t i = 0; i < count; ++i)
    for (std::uint8_t j = i + 1; j < count; ++j)
      for (std::uint8_t k = j + 1; k < count; ++k)
        if (solves({i, j, k})) return true;
  return false;
}

Vec3 ContactPlanes::nearest_to(const Vec3& goal, const Vec3& at, double distance, double slack) noexcept {
  active_count_ = 0;
  // By how much the goal is behind each plane, and behind what is no higher than where the proxy is.
  std::array<double, max_planes> lack, lack_from_here;
  bool is_behind = false, is_low = false;
  for (std::size_t i = 0; i < count_; ++i) {
    const ContactPlane& plane = planes_[i];
    const double here = plane.height(at), at_goal = plane.height(goal);
    const bool lifted = plane.lift > 0;
    lack[i] = (lifted ? here + plane.lift : distance) - at_goal;
    lack_from_here[i] = lifted ? lack[i] : std::min(distance, here) - at_goal;
    is_low = is_low || lack_from_here[i] < lack[i];
    is_behind = is_behind || lack_from_here[i] > slack;
  }
  if (!is_behind) return goal;
  Vec3 offset;
  if (solve(lack, slack, offset) || (is_low && solve(lack_from_here, slack, offset))) return goal + offset;
  return at;
}

}  // namespace touchmark
