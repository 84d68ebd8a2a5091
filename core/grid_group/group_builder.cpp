#include "core/grid_group/group_builder.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace touchmark::grid {
namespace {

/// Beyond the sides by this part of the inradius: more keeps a sliding probe longer with one group, and makes
/// the groups larger.
constexpr double growth = 0.3;
/// Over and under the triangle by this part of its size at first, and by less where the groups would be too
/// large.
constexpr double first_height = 1.0, least_height = 0.2, shrinking = 0.6;
/// More than this around one triangle: it is out of proportion to its neighbours, and the hierarchy serves
/// it.
constexpr std::size_t most_near = 1024;

/// About a triangle's ball. Its footprint grown is within 1.6 radii, its size below 1.65, so the highest
/// prism within 3.25; and no point of that is farther than 2.25 from the triangle. What is nearest there
/// comes into 5.5.
constexpr double reach_in_radii = 6;
static_assert(growth <= 0.3 && first_height <= 1);

Vec3 middle_of(const TriangleBall& ball) noexcept {
  return {static_cast<double>(ball.x), static_cast<double>(ball.y), static_cast<double>(ball.z)};
}

Lanes load(const std::vector<float>& numbers, std::size_t at) noexcept {
  Lanes lanes;
  std::memcpy(&lanes, &numbers[at], sizeof lanes);
  return lanes;
}

bool apart(const EightBoxes& boxes, std::size_t child, const Aabb& box) noexcept {
  for (std::size_t k = 0; k < 3; ++k) {
    const int axis = static_cast<int>(k);
    if (static_cast<double>(boxes.min[k][child / 4][child % 4]) > box.max[axis] ||
        static_cast<double>(boxes.max[k][child / 4][child % 4]) < box.min[axis])
      return true;
  }
  return false;
}

bool reaches(const TriangleBall& ball, const Aabb& box) noexcept {
  const double radius = static_cast<double>(ball.radius) * (1 + 0x1p-20) + 0x1p-20;
  return box.padded(radius).contains(middle_of(ball));
}

}  // namespace

void GroupBuilder::start() {
  groups_.groups_.resize(store_.size());
  groups_.members_.reserve(std::min(most_bytes_ / sizeof(std::uint32_t), std::size_t{24} * store_.size()));
}

Groups GroupBuilder::build() {
  start();
  for (std::uint32_t place = 0; place < store_.size() && !ran_out_; ++place) add_group(place);
  groups_.members_.shrink_to_fit();
  return std::move(groups_);
}

/// What can be nearest in a prism is within its farthest() of it: triangles whose prism what moved does not
/// come so near to keep their members.
Groups GroupBuilder::rebuild(const Groups& groups, const std::vector<Aabb>& moved) {
  start();
  for (std::uint32_t place = 0; place < store_.size() && !ran_out_; ++place) {
    const TriangleBall& ball = store_.balls[place];
    const double around = reach_in_radii * static_cast<double>(ball.radius) + 2 * lead_;
    const Aabb box = Aabb{middle_of(ball), middle_of(ball)}.padded(around);
    const bool changes = std::any_of(moved.begin(), moved.end(), [&](const Aabb& one) {
      return (one.min.array() <= box.max.array()).all() && (box.min.array() <= one.max.array()).all();
    });
    if (changes) {
      add_group(place);
    } else {
      keep_group(groups, place);
    }
  }
  groups_.members_.shrink_to_fit();
  return std::move(groups_);
}

void GroupBuilder::keep_group(const Groups& groups, std::uint32_t place) {
  Group kept = groups.of(place);
  if (kept.count == 0) return;
  const std::size_t stored = Groups::rounded_up(kept.count);
  const auto from = groups.members_.begin() + kept.first;
  kept.first = static_cast<std::uint32_t>(groups_.members_.size());
  groups_.members_.insert(groups_.members_.end(), from, from + static_cast<std::ptrdiff_t>(stored));
  groups_.groups_[place] = kept;
  ++groups_.count_;
}

void GroupBuilder::add_group(std::uint32_t place) {
  const Footprint footprint(store_.exact[place], store_.frame);
  // A margin that single precision does not see would serve no point.
  const bool visible =
      growth * footprint.inradius > static_cast<double>(store_.frame.tau(footprint.incenter));
  if (footprint.normal.isZero(0) || !visible) return;
  const double height = find_members(footprint);
  if (members_.empty() || members_.size() > Groups::most_members) return;
  const std::size_t count = members_.size();
  members_.resize(Groups::rounded_up(count), members_.back());

  const std::size_t bytes = groups_.groups_.size() * sizeof(Group) +
                            (groups_.members_.size() + members_.size()) * sizeof(std::uint32_t);
  if (bytes > most_bytes_) {
    ran_out_ = true;
    return;
  }
  // Rounded down, so that single precision serves no point outside.
  constexpr double down = 1 - 0x1p-22;
  groups_.groups_[place] = {static_cast<std::uint32_t>(groups_.members_.size()),
                            static_cast<std::uint32_t>(count), static_cast<float>(height * down),
                            static_cast<float>(growth * footprint.inradius * down)};
  groups_.members_.insert(groups_.members_.end(), members_.begin(), members_.end());
  ++groups_.count_;
}

double GroupBuilder::find_members(const Footprint& footprint) {
  double height = first_height * footprint.size;
  const Prism highest(footprint, growth, height, lead_, store_.frame);
  Aabb box;
  for (const Vec3& corner : footprint.grown(growth)) {
    box.extend(corner + height * footprint.normal);
    box.extend(corner - height * footprint.normal);
  }
  members_.clear();
  if (!gather(box.padded(highest.farthest() + lead_))) return 0;
  select_members(highest);
  while (members_.size() > Groups::many_members && shrinking * height >= least_height * footprint.size) {
    height *= shrinking;
    const Prism lower(footprint, growth, height, lead_, store_.frame);
    // What a higher prism can do without, a lower one can.
    std::erase_if(members_, [&](std::uint32_t place) {
      return lower.excludes(store_.planes[place], store_.balls[place]);
    });
  }
  return height;
}

void GroupBuilder::select_members(const Prism& prism) {
  for (std::size_t at = 0; at < near_.size(); at += 4) {
    unsigned left =
        prism.balls_left(load(near_x_, at), load(near_y_, at), load(near_z_, at), load(near_radius_, at));
    for (; left != 0; left &= left - 1) {
      const std::size_t i = at + static_cast<std::size_t>(std::countr_zero(left));
      if (i >= near_.size()) break;  // behind the last are its copies
      const std::uint32_t place = near_[i];
      if (!prism.excludes(store_.planes[place], store_.balls[place])) members_.push_back(place);
    }
  }
}

bool GroupBuilder::gather(const Aabb& box) {
  if (gathered_.contains(box.min) && gathered_.contains(box.max)) return true;
  gathered_ = box.padded(0.2 * box.extent().maxCoeff());
  if (!gather_blocks(gathered_)) {
    gathered_ = Aabb();
    return false;
  }
  const std::size_t whole = (near_.size() + 3) / 4 * 4;
  for (std::vector<float>* numbers : {&near_x_, &near_y_, &near_z_, &near_radius_}) numbers->assign(whole, 0);
  for (std::size_t i = 0; i < whole; ++i) {
    const TriangleBall& ball = store_.balls[near_[std::min(i, near_.size() - 1)]];
    near_x_[i] = ball.x;
    near_y_[i] = ball.y;
    near_z_[i] = ball.z;
    near_radius_[i] = ball.radius;
  }
  return true;
}

bool GroupBuilder::gather_blocks(const Aabb& box) {
  struct Node {
    std::size_t level;
    std::uint32_t index;
  };
  near_.clear();
  std::vector<Node> waiting = {{tree_.levels() - 1, 0}};
  while (!waiting.empty()) {
    const Node node = waiting.back();
    waiting.pop_back();
    const EightBoxes& boxes = tree_.node(node.level, node.index);
    for (std::uint32_t i = 0; i < BoxTree::arity; ++i) {
      if (apart(boxes, i, box)) continue;
      const std::uint32_t child = node.index * BoxTree::arity + i;
      if (node.level > 0) {
        waiting.push_back({node.level - 1, child});
        continue;
      }
      const std::uint32_t first = child * TriangleStore::block_size;
      for (std::uint32_t place = first; place < std::min(first + TriangleStore::block_size, store_.size());
           ++place)
        if (reaches(store_.balls[place], box)) near_.push_back(place);
      if (near_.size() > most_near) return false;
    }
  }
  return true;
}

}  // namespace touchmark::grid
