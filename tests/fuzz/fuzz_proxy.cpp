// A proxy over each exact detector, on a mesh and goals out of the bytes, and updates of the mesh between
// them: by the exact oracle no piece of its way comes as near as its radius, and a goal that is free is
// reached.
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/oracle/oracle.h"
#include "core/aabb_tree/aabb_tree.h"
#include "core/brute_force/brute_force.h"
#include "core/grid_group/grid_group.h"
#include "core/haptics/proxy.h"
#include "core/sphere_cluster/sphere_cluster.h"
#include "tests/fuzz/script.h"
#include "tests/fuzz/target.h"

namespace touchmark::fuzz {
namespace {

/// Goals, and where `moved` is there the mesh is that one from this goal on.
struct Tick {
  Vec3 goal;
  std::optional<TriangleMesh> moved;
};

struct Course {
  TriangleMesh mesh;
  Coupling coupling;
  Vec3 start;
  std::vector<Tick> ticks;
};

double largest_coordinate(const TriangleMesh& mesh) {
  return mesh.bounds().min.cwiseAbs().cwiseMax(mesh.bounds().max.cwiseAbs()).maxCoeff();
}

/// Returns the same triangles with one of their vertices elsewhere.
TriangleMesh moved(const TriangleMesh& mesh, Script& script) {
  std::vector<Vec3> vertices(mesh.vertices().begin(), mesh.vertices().end());
  vertices[script.below(vertices.size())] += 0.25 * mesh.bounds().extent().maxCoeff() * script.vector();
  return {std::move(vertices), {mesh.triangles().begin(), mesh.triangles().end()}};
}

Course read_course(Script& script) {
  Course course{read_mesh(script), {}, Vec3::Zero(), {}};
  const double size = course.mesh.bounds().extent().maxCoeff();
  if (script.flag()) course.coupling.radius = 0.25 * size * std::abs(script.number());
  if (script.below(4) == 0) course.coupling.static_friction = course.coupling.dynamic_friction = 0.5;
  course.start = read_center(script, course.mesh);
  TriangleMesh now = course.mesh;
  for (std::size_t left = 2 + script.below(16); left > 0; --left) {
    Tick tick;
    if (script.below(8) == 0) tick.moved = now = moved(now, script);
    tick.goal =
        script.below(4) == 0 && !course.ticks.empty() ? course.ticks.back().goal : read_center(script, now);
    course.ticks.push_back(std::move(tick));
  }
  return course;
}

/// What the proxy asks about in ordinary numbers, whose squares neither vanish nor overflow.
bool is_ordinary(const Course& course, const Vec3& goal) {
  const double most = std::max(largest_coordinate(course.mesh), goal.cwiseAbs().maxCoeff());
  return most < 0x1p200 && course.mesh.bounds().extent().maxCoeff() > 0x1p-200;
}

void judge(const ProxyState& state, const Vec3& before, const Vec3& goal, const bench::oracle::Oracle& oracle,
           const Course& course, const std::string& where) {
  const double radius = course.coupling.radius;
  require(state.way[0] == before && state.way[state.pieces] == state.position, "the way has a gap");
  for (std::size_t i = 0; i < state.pieces; ++i)
    if (oracle.segment_within(state.way[i], state.way[i + 1], radius))
      fail(where + ": piece " + std::to_string(i) + " comes within the radius");
  if (!is_ordinary(course, goal)) return;
  if (state.position != goal && !course.coupling.has_friction() &&
      !oracle.segment_within(before, goal, radius))
    fail(where + ": its goal was free");
  const double rounding = 0x1p-40 * (largest_coordinate(course.mesh) + before.norm() + goal.norm() + radius);
  if (!((state.position - goal).norm() <= (before - goal).norm() + rounding))
    fail(where + ": it ends farther from its goal than it began");
}

template <class D>
void follow(const Course& course, const std::string& name) {
  D detector = D::build(course.mesh);
  typename D::Session session;
  Proxy<D> proxy(detector, course.coupling, &course.mesh);
  const TriangleMesh* mesh = &course.mesh;
  auto oracle = std::make_unique<const bench::oracle::Oracle>(*mesh, 1);
  const double radius = course.coupling.radius;
  proxy.place(course.start);
  bool is_free = !oracle->segment_within(course.start, course.start, radius);
  for (std::size_t i = 0; i < course.ticks.size(); ++i) {
    const Tick& tick = course.ticks[i];
    const Vec3 before = proxy.state().position;
    if (tick.moved) {
      mesh = &*tick.moved;
      detector.update(*mesh);
      proxy.surface_moved(mesh);
      oracle = std::make_unique<const bench::oracle::Oracle>(*mesh, 1);
      is_free = !oracle->segment_within(before, before, radius);
    }
    const ProxyState& state = proxy.step(tick.goal, session);
    if (is_free)
      judge(state, before, tick.goal, *oracle, course, name + ", tick " + std::to_string(i));
    else
      is_free = !oracle->segment_within(state.position, state.position, radius);
  }
}

}  // namespace
}  // namespace touchmark::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace touchmark;
  fuzz::Script script({data, size});
  std::optional<fuzz::Course> course;
  try {
    course = fuzz::read_course(script);
  } catch (const MeshError&) {
    return 0;
  }
  fuzz::follow<BruteForce>(*course, "brute force");
  fuzz::follow<AabbTree>(*course, "aabb tree");
  fuzz::follow<GridGroup>(*course, "grid group");
  fuzz::follow<SphereCluster>(*course, "sphere cluster");
  return 0;
}
