// Hundreds of bodies that stand, drift, teleport, come and go between the questions of points that slide and
// jump, against every triangle in rational arithmetic.
#include <algorithm>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "core/aabb_tree/aabb_tree.h"
#include "core/grid_group/grid_group.h"
#include "core/scene/shared_scene.h"
#include "core/sphere_cluster/sphere_cluster.h"
#include "tests/core/scene/exact_scene.h"
#include "tests/core/scene/random_pose.h"

namespace touchmark {
namespace {

using test::Random, test::random_pose;

TriangleMesh tetrahedron(const Vec3& size, const Vec3& center) {
  std::vector<Vec3> corners;
  for (const Vec3& corner : {Vec3(1, 1, 1), Vec3(1, -1, -1), Vec3(-1, 1, -1), Vec3(-1, -1, 1)})
    corners.push_back(center + size.cwiseProduct(corner));
  return {std::move(corners), {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}};
}

/// A scene, what is in it, and a point that asks.
template <class D>
class Crowd {
 public:
  Crowd(std::uint64_t seed, const Vec3& middle) : random_(seed), middle_(middle), at_(middle) {
    for (const Vec3& size : {Vec3(0.3, 0.3, 0.3), Vec3(1, 0.05, 0.1), Vec3(0.02, 0.02, 0.02)}) {
      for (const Vec3& center : {Vec3(0, 0, 0), Vec3(3, 0, 0)}) {
        Shape<D> shape = Shape<D>::build(tetrahedron(size, center));
        meshes_.push_back(shape.mesh);
        shapes_.push_back(scene_.add_shape(std::move(shape)));
      }
    }
    for (int i = 0; i < 200; ++i) come();
    scene_.publish();
  }

  /// As many changes of each kind at random, one of these ways.
  void change() {
    const std::size_t kind = random_.below(8);
    if (kind == 0) {
      for (int i = 0; i < 5; ++i) teleport();
    } else if (kind == 1) {
      for (int i = 0; i < 20; ++i) leave();
    } else if (kind == 2) {
      for (int i = 0; i < 20; ++i) come();
    } else if (kind == 3) {
      drift(0.2);
    } else if (kind == 4) {
      drift(1e-3);
    } else if (kind == 5) {
      come(at_);
    } else if (kind == 6) {
      move(any(), random_pose(random_, at_));
    }
    scene_.publish();
  }
  void slide() { at_ += random_.point(random_.below(4) == 0 ? 0.1 : 0.01); }
  void jump() { at_ = middle_ + random_.point(4); }

  void ask() {
    const auto frame = scene_.read();
    const auto nearest = exact_scene::nearest(those_that_can_be_nearest(), at_);
    const double reach = random_.below(2) == 0 ? random_.between(0, 0.5) : 100;
    const exact_scene::Number squared = exact_scene::Number(reach) * exact_scene::Number(reach);
    const bool is_within = nearest && nearest->squared <= squared;
    if (random_.below(3) == 0) {
      EXPECT_EQ(frame->touches({at_, reach}, session_), is_within);
      return;
    }
    const auto found = frame->nearest_body({at_, 0}, reach, session_);
    ASSERT_EQ(found.has_value(), is_within);
    if (!found) return;
    EXPECT_EQ(found->body, bodies_.at(nearest->body).id);
    EXPECT_EQ(found->contact.triangle, nearest->triangle);
  }

 private:
  struct Body {
    BodyId id;
    std::size_t shape;
    Pose pose;
  };

  /// Returns all but those that even generous bounds exclude, in the order of their indices.
  std::vector<exact_scene::Body> those_that_can_be_nearest() const {
    std::vector<exact_scene::Body> all;
    std::vector<long double> lower;
    long double upper = std::numeric_limits<long double>::infinity();
    for (const auto& [index, body] : bodies_) {
      all.push_back({index, meshes_[body.shape].get(), body.pose});
      lower.push_back(std::numeric_limits<long double>::infinity());
      for (std::size_t i = 0; i < all.back().mesh->size(); ++i)
        lower.back() = std::min(lower.back(), exact_scene::lower_bound(all.back(), i, at_));
      const Vec3 corner = image(body.pose, all.back().mesh->corner(0, 0));
      upper = std::min(upper, static_cast<long double>((corner - at_).norm()) * (1 + 1e-6L));
    }
    std::vector<exact_scene::Body> near;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (lower[i] <= upper) near.push_back(all[i]);
    return near;
  }
  std::uint32_t any() {
    auto it = bodies_.begin();
    std::advance(it, static_cast<std::ptrdiff_t>(random_.below(bodies_.size())));
    return it->first;
  }
  void come() { come(middle_ + random_.point(3)); }
  void come(const Vec3& place) {
    const std::size_t shape = random_.below(shapes_.size());
    const Pose pose = random_pose(random_, place);
    const BodyId id = scene_.add(shapes_[shape], pose);
    bodies_[id.index] = {id, shape, pose};
  }
  void leave() {
    if (bodies_.size() < 5) return;
    const std::uint32_t index = any();
    scene_.remove(bodies_.at(index).id);
    bodies_.erase(index);
  }
  void move(std::uint32_t index, const Pose& pose) {
    bodies_.at(index).pose = pose;
    scene_.move(bodies_.at(index).id, pose);
  }
  void teleport() { move(any(), random_pose(random_, middle_ + random_.point(3))); }
  void drift(double step) {
    for (auto& [index, body] : bodies_) {
      Pose pose = body.pose;
      pose.translation += random_.point(step);
      if (random_.below(4) == 0) pose = random_pose(random_, pose.translation);
      move(index, pose);
    }
  }

  Random random_;
  Vec3 middle_, at_;
  SharedScene<D> scene_;
  typename Scene<D>::Session session_;
  std::vector<std::shared_ptr<const TriangleMesh>> meshes_;
  std::vector<ShapeId> shapes_;
  std::map<std::uint32_t, Body> bodies_;
};

template <class D>
class ExactCrowd : public testing::Test {};
using CrowdDetectors = testing::Types<SphereCluster, GridGroup, AabbTree>;
TYPED_TEST_SUITE(ExactCrowd, CrowdDetectors);

template <class D>
void expect_right(std::uint64_t seed, const Vec3& middle) {
  Crowd<D> crowd(seed, middle);
  for (int round = 0; round < 18; ++round) {
    crowd.change();
    const bool jumps = round % 6 < 3;
    for (int i = 0; i < 10; ++i) {
      if (jumps || i == 0)
        crowd.jump();
      else
        crowd.slide();
      crowd.ask();
    }
  }
}

TYPED_TEST(ExactCrowd, IsRightWhateverBodiesDoBetweenQuestions) {
  for (std::uint64_t seed = 1; seed <= 2; ++seed) expect_right<TypeParam>(seed, Vec3::Zero());
}

TYPED_TEST(ExactCrowd, IsRightFarFromTheOrigin) { expect_right<TypeParam>(4, Vec3(1e5, -2e5, 3e5)); }

}  // namespace
}  // namespace touchmark
