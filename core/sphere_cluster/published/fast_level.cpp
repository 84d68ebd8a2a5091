#include "core/sphere_cluster/published/fast_level.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/float_limits.h"
#include "core/geometry/sphere_triangle_sweep.h"
#include "core/search/contacts_within.h"
#include "core/sphere_cluster/search_bounds.h"

namespace touchmark {
namespace {

/// When a point on the path first comes within `radius` of `center`; infinity when it does not. For a path
/// that starts outside.
double first_within(const Sweep& sweep, const Vec3& center, double radius) noexcept {
  const Vec3 path = sweep.to - sweep.from, to = center - sweep.from;
  const double along = to.dot(path);
  if (!(along > 0)) return infinity;
  const double outside = to.squaredNorm() - radius * radius;
  const double discriminant = along * along - path.squaredNorm() * outside;
  if (!(discriminant >= 0)) return infinity;
  const double fraction = std::max(outside, 0.0) / (along + std::sqrt(discriminant));
  return fraction <= 1 ? fraction : infinity;
}

}  // namespace

FastLevel::FastLevel(const TriangleMesh& mesh, const SphereClusters& clusters) : spheres_(clusters.spheres) {
  ids_.reserve(clusters.size());
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    ids_.push_back(mesh.id(clusters.triangles_of(i).front()));
    error_bound_ = std::max(error_bound_, spheres_.radius[i]);
  }
  const Vec3 farthest = mesh.bounds().min.cwiseAbs().cwiseMax(mesh.bounds().max.cwiseAbs());
  error_bound_ += 4 * std::numeric_limits<double>::epsilon() * farthest.maxCoeff();
}

double FastLevel::gap(std::size_t sphere, const Vec3& center) const noexcept {
  return (center - spheres_.center(sphere)).norm() - spheres_.radius[sphere];
}

Contact FastLevel::contact_with(std::size_t sphere, const Vec3& center) const noexcept {
  const Vec3 out = center - spheres_.center(sphere);
  const double length = out.norm();
  const Vec3 normal = length > 0 ? Vec3(out / length) : Vec3(Vec3::UnitZ());
  const double distance = std::max(length - spheres_.radius[sphere], 0.0);
  return {center - distance * normal, normal, distance, ids_[sphere]};
}

/// Squares leave out the roots of what is far; grown_radius has room for what the two ways round differently.
template <class Found>
void FastLevel::for_each_within(const double& limit, const Vec3& center, const Found& found) const noexcept {
  const double px = center.x(), py = center.y(), pz = center.z();
  const auto outside = [&](std::size_t i) noexcept {
    const double dx = spheres_.x[i] - px, dy = spheres_.y[i] - py, dz = spheres_.z[i] - pz;
    const double grown = grown_radius(spheres_.radius[i], limit);
    return static_cast<std::uint8_t>(dx * dx + dy * dy + dz * dz > grown * grown);
  };
  for_each_held(spheres_.size(), outside, found);
}

bool FastLevel::touches(const Probe& probe, Work& work) const noexcept {
  std::size_t tested = spheres_.size();
  bool touching = false;
  for_each_within(probe.radius, probe.center, [&](std::size_t sphere) noexcept {
    if (!(gap(sphere, probe.center) <= probe.radius)) return false;
    tested = sphere + 1;
    return touching = true;
  });
  work.spheres += tested;
  return touching;
}

std::optional<Contact> FastLevel::nearest(const Vec3& center, double reach, Work& work) const noexcept {
  double least = infinity, limit = reach;
  std::size_t nearest = spheres_.size();
  for_each_within(limit, center, [&](std::size_t sphere) noexcept {
    const double gap_here = gap(sphere, center);
    if (!(gap_here < least)) return false;
    least = gap_here;
    limit = std::min(limit, least);
    nearest = sphere;
    return false;
  });
  work.spheres += spheres_.size();
  if (nearest == spheres_.size() || !(std::max(least, 0.0) <= reach)) return std::nullopt;
  return contact_with(nearest, center);
}

std::optional<Impact> FastLevel::first_hit(const Sweep& sweep, Work& work) const noexcept {
  if (const auto start = nearest(sweep.from, sweep.radius, work)) return Impact{0, *start};
  const double reach = sweep.radius + sweep_pad(sweep);
  double first = infinity;
  std::size_t hit = spheres_.size();
  for (std::size_t i = 0; i < spheres_.size(); ++i) {
    const double fraction = first_within(sweep, spheres_.center(i), grown_radius(spheres_.radius[i], reach));
    if (!(fraction < first)) continue;
    first = fraction;
    hit = i;
  }
  work.spheres += spheres_.size();
  if (hit == spheres_.size()) return std::nullopt;
  return Impact{first, contact_with(hit, position_at(sweep, first))};
}

/// Meanwhile a contact has the gap for its distance, and the sphere for its triangle.
std::size_t FastLevel::contacts(const Vec3& center, double reach, std::span<Contact> into,
                                Work& work) const noexcept {
  if (!center.allFinite()) return 0;
  const auto is_before = [](const Contact& a, const Contact& b) {
    return a.distance < b.distance || (a.distance == b.distance && a.triangle < b.triangle);
  };
  std::size_t count = 0;
  for_each_within(reach, center, [&](std::size_t sphere) noexcept {
    const double gap_here = gap(sphere, center);
    if (!(gap_here <= reach)) return false;
    const Contact contact{.distance = gap_here, .triangle = static_cast<TriangleId>(sphere)};
    keep_first(into, count++, contact, is_before);
    return false;
  });
  work.spheres += spheres_.size();
  const std::span<Contact> kept = into.first(std::min(count, into.size()));
  std::sort(kept.begin(), kept.end(), is_before);
  for (Contact& contact : kept) contact = contact_with(contact.triangle, center);
  return count;
}

std::size_t FastLevel::bytes() const noexcept {
  return spheres_.bytes() + ids_.capacity() * sizeof(TriangleId);
}

}  // namespace touchmark
