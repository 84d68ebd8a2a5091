#include "core/aabb_tree/float_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Geometry>

#include "core/aabb_tree/aabb_tree.h"
#include "core/flushed_denormals.h"
#include "core/geometry/point_triangle_kernel.h"

namespace touchmark {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float unit_roundoff = std::numeric_limits<float>::epsilon() / 2;

}  // namespace

FloatFrame FloatFrame::around(const Aabb& bounds) noexcept {
  const Vec3 middle = 0.5 * bounds.min + 0.5 * bounds.max;
  return {unit_for(largest_difference(bounds, middle)), middle};
}

FloatTree FloatTree::build(const TriangleMesh& mesh, const Options& options) {
  check_flushed_denormals(mesh);
  FloatTree tree;
  tree.frame_ = FloatFrame::around(mesh.bounds());
  tree.extent_ = 2 * largest_difference(mesh.bounds(), tree.frame_.origin);
  tree.ids_ = mesh.triangle_ids();
  std::vector<Vec3> stored;
  for (const Vec3& vertex : mesh.vertices()) stored.push_back(tree.frame_.into(vertex).cast<double>());
  // Boxes of floats are floats.
  const AabbTree exact =
      AabbTree::build({std::move(stored), {mesh.triangles().begin(), mesh.triangles().end()}},
                      {.leaf_size = options.leaf_size, .threads = options.threads});
  for (const AabbTree::Node& node : exact.nodes_)
    tree.nodes_.push_back({node.box.min.cast<float>(), node.box.max.cast<float>(), node.first, node.count});
  for (const PreparedTriangle& t : exact.triangles_)
    tree.triangles_.push_back(
        {{t.corner[0].cast<float>(), t.corner[1].cast<float>(), t.corner[2].cast<float>()},
         t.normal.cast<float>(),
         t.index});
  tree.nodes_.shrink_to_fit();
  tree.triangles_.shrink_to_fit();
  return tree;
}

bool FloatTree::surely_over_face(const Triangle& t, const std::array<Point, 3>& to,
                                 const std::array<float, 3>& squared) noexcept {
  constexpr float relative_error = 8 * unit_roundoff;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = i == 2 ? 0 : i + 1;
    const Point edge = t.corner[j] - t.corner[i];
    const std::size_t near = squared[i] < squared[j] ? i : j;
    const float inside = edge.cross(to[near]).dot(t.normal);
    if (!(inside > relative_error * std::sqrt(squared[near]) * edge.norm())) return false;
  }
  return true;
}

FloatTree::Offset FloatTree::offset_from(const Triangle& t, const Point& point) noexcept {
  return kernel::offset_from(t, point, surely_over_face);
}

/// Returns what touchmark::culling_pad does for doubles, for floats.
float FloatTree::culling_pad(const Point& center) const noexcept {
  const Node& all = nodes_.front();
  return 128 * unit_roundoff *
         (center - all.min).cwiseAbs().cwiseMax((center - all.max).cwiseAbs()).maxCoeff();
}

template <class Limit, class Consider>
void FloatTree::search(const Point& center, Work& work, const Limit& limit,
                       const Consider& consider) const noexcept {
  const float pad = culling_pad(center);
  const auto below = [&](std::uint32_t node) {
    const Node& n = nodes_[node];
    return (n.min - center).cwiseMax(center - n.max).cwiseMax(0).norm() - pad;
  };
  struct StackEntry {
    float bound;
    std::uint32_t node;
  };
  std::array<StackEntry, AabbTree::max_levels> stack;
  std::size_t count = 0;
  stack[count++] = {below(0), 0};
  while (count > 0) {
    const StackEntry next = stack[--count];
    if (!(next.bound <= limit())) continue;
    const Node& node = nodes_[next.node];
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      ++work.triangles;
      if (consider(i)) return;
    }
    if (node.count > 0) continue;
    work.boxes += 2;
    StackEntry near{below(node.first), node.first}, far{below(node.first + 1), node.first + 1};
    if (far.bound < near.bound) std::swap(near, far);
    stack[count++] = far;
    stack[count++] = near;
  }
}

bool FloatTree::touches(const Probe& probe, Session& session) const noexcept {
  if (!(probe.radius >= 0)) return false;
  const Point center = frame_.into(probe.center);
  const auto radius = static_cast<float>(frame_.scale * probe.radius);
  bool touching = false;
  search(
      center, session.work, [&] { return radius; },
      [&](std::uint32_t i) {
        const float distance = std::sqrt(offset_from(triangles_[i], center).squared);
        touching = distance <= radius && distance < infinity;
        return touching;
      });
  return touching;
}

std::optional<Contact> FloatTree::nearest(const Probe& probe, double reach, Session& session) const noexcept {
  if (!(reach >= 0)) return std::nullopt;
  const Point center = frame_.into(probe.center);
  const auto within = static_cast<float>(frame_.scale * reach);
  Offset best{Point::Zero(), infinity};
  std::uint32_t kept_at = 0;
  const auto consider = [&](std::uint32_t i) {
    const Offset offset = offset_from(triangles_[i], center);
    if (offset.squared < best.squared ||
        (offset.squared == best.squared && triangles_[i].index < triangles_[kept_at].index)) {
      best = offset;
      kept_at = i;
    }
    return false;
  };
  if (session.last < triangles_.size()) {
    ++session.work.triangles;
    consider(session.last);
  }
  search(
      center, session.work, [&] { return std::min(within, std::sqrt(best.squared)); }, consider);
  if (!(best.squared < infinity) || !(std::sqrt(best.squared) <= within)) return std::nullopt;
  session.last = kept_at;
  return contact(triangles_[kept_at], probe.center, best);
}

Contact FloatTree::contact(const Triangle& t, const Vec3& center, const Offset& offset) const noexcept {
  const float distance = std::sqrt(offset.squared);
  const Vec3 from_mesh = offset.vector.cast<double>();
  const auto corner = [&](std::size_t i) -> Vec3 { return t.corner[i].cast<double>(); };
  const Vec3 normal = distance > 0
                          ? from_mesh.normalized()
                          : face_normal({{corner(0), corner(1), corner(2)}, t.normal.cast<double>(), 0});
  return {center - from_mesh / frame_.scale, normal, static_cast<double>(distance) / frame_.scale,
          ids_[t.index]};
}

std::size_t FloatTree::bytes() const noexcept {
  return nodes_.capacity() * sizeof(Node) + triangles_.capacity() * sizeof(Triangle) + ids_.bytes();
}

Accuracy FloatTree::accuracy() const noexcept {
  constexpr double u = 0x1p-24;
  return {Guarantee::approximate, 54 * u, 2 * u * extent_, false};
}

}  // namespace touchmark
