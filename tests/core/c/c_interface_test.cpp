#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "core/brute_force/brute_force.h"
#include "core/c/touchmark.h"
#include "core/haptics/proxy.h"

namespace {

using touchmark::BruteForce;
using touchmark::TriangleMesh;
using touchmark::Vec3;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

struct Arrays {
  std::vector<double> vertices;
  std::vector<std::uint32_t> triangles;
};

/// A bumpy sheet of 2 * cells^2 triangles over the unit square.
Arrays sheet(std::uint32_t cells) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> height(0, 0.5 / cells);
  Arrays arrays;
  for (std::uint32_t i = 0; i <= cells; ++i) {
    for (std::uint32_t j = 0; j <= cells; ++j)
      for (const double x : {1.0 * i / cells, 1.0 * j / cells, height(random)}) arrays.vertices.push_back(x);
  }
  for (std::uint32_t i = 0; i < cells; ++i) {
    for (std::uint32_t j = 0; j < cells; ++j) {
      const std::uint32_t corner = i * (cells + 1) + j, next = corner + cells + 1;
      for (const std::uint32_t vertex : {corner, next, next + 1, corner, next + 1, corner + 1})
        arrays.triangles.push_back(vertex);
    }
  }
  return arrays;
}

const Arrays unit_triangle{{0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}};

touchmark_mesh* mesh_of(const Arrays& arrays) {
  return touchmark_mesh_create(arrays.vertices.data(), arrays.vertices.size() / 3, arrays.triangles.data(),
                               arrays.triangles.size() / 3);
}

TriangleMesh cpp_mesh_of(const Arrays& arrays) {
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Corners> triangles;
  for (std::size_t i = 0; i < arrays.vertices.size(); i += 3)
    vertices.emplace_back(arrays.vertices[i], arrays.vertices[i + 1], arrays.vertices[i + 2]);
  for (std::size_t i = 0; i < arrays.triangles.size(); i += 3)
    triangles.push_back({arrays.triangles[i], arrays.triangles[i + 1], arrays.triangles[i + 2]});
  return {vertices, triangles};
}

/// Everything that a query needs, freed at the end.
class Asked {
 public:
  explicit Asked(const Arrays& arrays, const char* text = nullptr)
      : mesh_(mesh_of(arrays)),
        detector_(touchmark_detector_build(mesh_, text)),
        session_(touchmark_session_create(detector_)) {}
  Asked(const Asked&) = delete;
  Asked& operator=(const Asked&) = delete;
  ~Asked() {
    touchmark_session_free(session_);
    touchmark_detector_free(detector_);
    touchmark_mesh_free(mesh_);
  }
  touchmark_session* session() const { return session_; }
  touchmark_detector* detector() const { return detector_; }

 private:
  touchmark_mesh* mesh_;
  touchmark_detector* detector_;
  touchmark_session* session_;
};

void expect_error(const std::string& text) { EXPECT_EQ(touchmark_last_error(), text); }

void expect_equal(const std::optional<touchmark::Contact>& expected, int found,
                  const touchmark_contact& contact) {
  ASSERT_EQ(found, expected ? TOUCHMARK_YES : TOUCHMARK_NO) << touchmark_last_error();
  if (!expected) return;
  EXPECT_EQ(contact.distance, expected->distance);
  EXPECT_EQ(contact.triangle, expected->triangle);
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(contact.point[k], expected->point[k]);
    EXPECT_EQ(contact.normal[k], expected->normal[k]);
  }
}

TEST(CInterface, LaysItsStructsOutAsThePageSays) {
  static_assert(sizeof(touchmark_contact) == 64 && offsetof(touchmark_contact, normal) == 24 &&
                offsetof(touchmark_contact, distance) == 48 && offsetof(touchmark_contact, triangle) == 56 &&
                offsetof(touchmark_contact, side) == 60);
  static_assert(sizeof(touchmark_impact) == 72 && offsetof(touchmark_impact, contact) == 8);
  static_assert(sizeof(touchmark_coupling) == 56 && offsetof(touchmark_coupling, tick_s) == 40 &&
                offsetof(touchmark_coupling, max_work) == 48);
  static_assert(
      sizeof(touchmark_proxy_state) == 136 && offsetof(touchmark_proxy_state, force) == 24 &&
      offsetof(touchmark_proxy_state, normals) == 48 && offsetof(touchmark_proxy_state, status) == 120 &&
      offsetof(touchmark_proxy_state, contacts) == 124 && offsetof(touchmark_proxy_state, flags) == 128);
  static_assert(sizeof(touchmark_force_planes) == 176);
}

TEST(CInterface, AnswersTheBitsOfBruteForceWhateverTheDetector) {
  const Arrays arrays = sheet(12);
  const BruteForce truth = BruteForce::build(cpp_mesh_of(arrays));
  for (const char* text : {"brute-force", "aabb-tree:leaf_size=2", "grid-group", "grid-group:lookup=scan",
                           "sphere-cluster:clustering=2%", "sphere-cluster:build=lazy"}) {
    SCOPED_TRACE(text);
    const Asked asked(arrays, text);
    BruteForce::Session session;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> anywhere(-0.3, 1.3), size(0, 0.4);
    for (int i = 0; i < 300; ++i) {
      const Vec3 from(anywhere(random), anywhere(random), anywhere(random));
      const Vec3 to(anywhere(random), anywhere(random), anywhere(random));
      const double reach = i % 3 == 0 ? infinity : size(random), radius = size(random) / 4;
      touchmark_contact contact{};
      const int found = touchmark_nearest(asked.session(), from.data(), reach, &contact);
      expect_equal(truth.nearest({from, 0}, reach, session), found, contact);
      EXPECT_EQ(touchmark_touches(asked.session(), from.data(), radius),
                truth.touches({from, radius}, session) ? TOUCHMARK_YES : TOUCHMARK_NO);
      touchmark_impact impact{};
      const int hit = touchmark_first_hit(asked.session(), from.data(), to.data(), radius, &impact);
      const std::optional<touchmark::Impact> expected = truth.first_hit({from, to, radius}, session);
      ASSERT_EQ(hit, expected ? TOUCHMARK_YES : TOUCHMARK_NO);
      if (expected) {
        EXPECT_EQ(impact.fraction, expected->fraction);
        expect_equal(expected->contact, hit, impact.contact);
      }
      EXPECT_EQ(touchmark_prepare(asked.session()), TOUCHMARK_YES);
    }
  }
}

TEST(CInterface, TellsTheSideOnlyWhereItIsAskedFor) {
  const Arrays tetrahedron{{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}};
  const Asked with(tetrahedron, "grid-group:side=on"), without(tetrahedron, "grid-group");
  const double inside[3] = {0.1, 0.1, 0.1}, outside[3] = {1, 1, 1}, on[3] = {0.25, 0.25, 0};
  touchmark_contact contact{};
  ASSERT_EQ(touchmark_nearest(with.session(), inside, infinity, &contact), TOUCHMARK_YES);
  EXPECT_EQ(contact.side, TOUCHMARK_SIDE_INSIDE);
  ASSERT_EQ(touchmark_nearest(with.session(), outside, infinity, &contact), TOUCHMARK_YES);
  EXPECT_EQ(contact.side, TOUCHMARK_SIDE_OUTSIDE);
  ASSERT_EQ(touchmark_nearest(with.session(), on, infinity, &contact), TOUCHMARK_YES);
  EXPECT_EQ(contact.side, TOUCHMARK_SIDE_ON_SURFACE);
  ASSERT_EQ(touchmark_nearest(without.session(), inside, infinity, &contact), TOUCHMARK_YES);
  EXPECT_EQ(contact.side, TOUCHMARK_SIDE_UNASKED);
}

TEST(CInterface, StoresAContactForEachTriangleWithinReachAndSaysHowManyThereAre) {
  const Arrays arrays = sheet(6);
  const BruteForce truth = BruteForce::build(cpp_mesh_of(arrays));
  BruteForce::Session session;
  const Asked asked(arrays, "grid-group");
  const Vec3 center(0.4, 0.55, 0.1);
  std::vector<touchmark::Contact> expected(72);
  expected.resize(truth.contacts({center, 0}, 0.25, session, expected));
  ASSERT_GT(expected.size(), 5u);
  for (const std::size_t capacity : {std::size_t{0}, std::size_t{3}, std::size_t{72}}) {
    std::vector<touchmark_contact> contacts(capacity);
    std::size_t count = 0;
    EXPECT_EQ(touchmark_contacts(asked.session(), center.data(), 0.25,
                                 capacity == 0 ? nullptr : contacts.data(), capacity, &count),
              TOUCHMARK_YES);
    EXPECT_EQ(count, expected.size());
    for (std::size_t i = 0; i < std::min(count, capacity); ++i)
      expect_equal(expected[i], TOUCHMARK_YES, contacts[i]);
  }
  std::size_t count = 9;
  const double far_off[3] = {9, 9, 9};
  EXPECT_EQ(touchmark_contacts(asked.session(), far_off, 0.25, nullptr, 0, &count), TOUCHMARK_NO);
  EXPECT_EQ(count, 0u);
  touchmark_contact contact;
  EXPECT_EQ(touchmark_contacts(asked.session(), far_off, 0.25, nullptr, 1, &count), TOUCHMARK_ERROR);
  expect_error("touchmark_contacts: contacts is NULL");
  EXPECT_EQ(touchmark_contacts(asked.session(), far_off, 0.25, &contact, 1, nullptr), TOUCHMARK_ERROR);
  // More than any memory holds is an error, not a crash.
  EXPECT_EQ(touchmark_contacts(asked.session(), far_off, 0.25, &contact,
                               std::numeric_limits<std::size_t>::max(), &count),
            TOUCHMARK_ERROR);
  expect_error("out of memory");
}

TEST(CInterface, FollowsAMeshThatMovesAndRefusesAnother) {
  const Asked asked(unit_triangle);
  const double center[3] = {0.25, 0.25, 2};
  EXPECT_EQ(touchmark_touches(asked.session(), center, 0.5), TOUCHMARK_NO);
  Arrays raised = unit_triangle;
  for (const std::size_t z : {2, 5, 8}) raised.vertices[z] = 1.75;
  touchmark_mesh* mesh = mesh_of(raised);
  EXPECT_EQ(touchmark_detector_update(asked.detector(), mesh), TOUCHMARK_YES);
  EXPECT_EQ(touchmark_touches(asked.session(), center, 0.5), TOUCHMARK_YES);
  touchmark_mesh_free(mesh);
  mesh = mesh_of(sheet(1));
  EXPECT_EQ(touchmark_detector_update(asked.detector(), mesh), TOUCHMARK_ERROR);
  EXPECT_NE(std::string(touchmark_last_error()), "");
  EXPECT_EQ(touchmark_touches(asked.session(), center, 0.5), TOUCHMARK_YES);
  touchmark_mesh_free(mesh);
}

TEST(CInterface, ASessionKeepsItsDetectorAlive) {
  touchmark_mesh* mesh = mesh_of(unit_triangle);
  touchmark_detector* detector = touchmark_detector_build(mesh, "grid-group");
  touchmark_session* session = touchmark_session_create(detector);
  touchmark_detector_free(detector);
  touchmark_mesh_free(mesh);
  const double center[3] = {0.25, 0.25, 0.5};
  EXPECT_EQ(touchmark_touches(session, center, 0.5), TOUCHMARK_YES);
  touchmark_session_free(session);
}

TEST(CInterface, StoresTheBoxOfAMesh) {
  touchmark_mesh* mesh = mesh_of(unit_triangle);
  double min[3], max[3];
  EXPECT_EQ(touchmark_mesh_bounds(mesh, min, max), TOUCHMARK_YES);
  EXPECT_EQ(Vec3(min[0], min[1], min[2]), Vec3(0, 0, 0));
  EXPECT_EQ(Vec3(max[0], max[1], max[2]), Vec3(1, 1, 0));
  touchmark_mesh_free(mesh);
}

TEST(CInterface, FailsForNullAndSaysWhichArgument) {
  const Asked asked(unit_triangle);
  const double center[3] = {0, 0, 0};
  double corner[3];
  EXPECT_EQ(touchmark_mesh_create(nullptr, 3, unit_triangle.triangles.data(), 1), nullptr);
  expect_error("touchmark_mesh_create: vertices is NULL");
  EXPECT_EQ(touchmark_mesh_create(center, 1, nullptr, 1), nullptr);
  expect_error("touchmark_mesh_create: triangles is NULL");
  EXPECT_EQ(touchmark_mesh_bounds(nullptr, corner, corner), TOUCHMARK_ERROR);
  EXPECT_EQ(touchmark_detector_build(nullptr, "grid-group"), nullptr);
  expect_error("touchmark_detector_build: mesh is NULL");
  EXPECT_EQ(touchmark_detector_bytes(nullptr), 0u);
  EXPECT_EQ(touchmark_detector_update(nullptr, nullptr), TOUCHMARK_ERROR);
  EXPECT_EQ(touchmark_detector_update(asked.detector(), nullptr), TOUCHMARK_ERROR);
  expect_error("touchmark_detector_update: mesh is NULL");
  EXPECT_EQ(touchmark_session_create(nullptr), nullptr);
  expect_error("touchmark_session_create: detector is NULL");
  EXPECT_EQ(touchmark_touches(nullptr, center, 0), TOUCHMARK_ERROR);
  expect_error("touchmark_touches: session is NULL");
  EXPECT_EQ(touchmark_nearest(asked.session(), nullptr, 1, nullptr), TOUCHMARK_ERROR);
  expect_error("touchmark_nearest: center is NULL");
  EXPECT_EQ(touchmark_first_hit(asked.session(), nullptr, center, 1, nullptr), TOUCHMARK_ERROR);
  expect_error("touchmark_first_hit: from is NULL");
  EXPECT_EQ(touchmark_first_hit(asked.session(), center, nullptr, 1, nullptr), TOUCHMARK_ERROR);
  expect_error("touchmark_first_hit: to is NULL");
  EXPECT_EQ(touchmark_prepare(nullptr), TOUCHMARK_ERROR);
  expect_error("touchmark_prepare: session is NULL");
  touchmark_mesh_free(nullptr);
  touchmark_detector_free(nullptr);
  touchmark_session_free(nullptr);
}

TEST(CInterface, FailsForMeshesAndOptionsAndNamesTheOffender) {
  const double vertices[] = {0, 0, 0, 1, 0, 0, nan, 1, 0};
  const std::uint32_t triangles[] = {0, 1, 3};
  const std::size_t too_many = std::numeric_limits<std::size_t>::max() / 2;
  EXPECT_EQ(touchmark_mesh_create(vertices, 3, triangles, 1), nullptr);
  expect_error("touchmark_mesh_create: vertex 2 is not finite: (nan, 1, 0)");
  EXPECT_EQ(touchmark_mesh_create(unit_triangle.vertices.data(), 3, triangles, 1), nullptr);
  expect_error("touchmark_mesh_create: triangle 0 names vertex 3 of 3");
  EXPECT_EQ(touchmark_mesh_create(vertices, 3, triangles, 0), nullptr);
  EXPECT_EQ(touchmark_mesh_create(vertices, too_many, triangles, 1), nullptr);
  EXPECT_NE(std::string(touchmark_last_error()).find("vertices"), std::string::npos);
  EXPECT_EQ(touchmark_mesh_create(vertices, 3, triangles, too_many), nullptr);
  touchmark_mesh* mesh = mesh_of(unit_triangle);
  const auto refused = [&](const std::string& text) {
    EXPECT_EQ(touchmark_detector_build(mesh, text.c_str()), nullptr) << text;
    return std::string(touchmark_last_error());
  };
  EXPECT_EQ(refused("octree"),
            "touchmark_detector_build: unknown detector \"octree\"; there are brute-force, aabb-tree, "
            "grid-group, sphere-cluster");
  EXPECT_EQ(refused("brute-force:cell=1"),
            "touchmark_detector_build: brute-force has no option \"cell\"; its options: side");
  EXPECT_EQ(
      refused("grid-group:cell=-1"),
      "touchmark_detector_build: grid-group: cell=\"-1\" is not a length of 0 or more, as 0.01 or 0.5%");
  EXPECT_EQ(refused("grid-group:lookup=scan,lookup=scan"),
            "touchmark_detector_build: grid-group: lookup is given twice");
  EXPECT_NE(refused(std::string(100'000, 'x')), "");  // cut off, not overrun
  for (const char* text :
       {"", ":", "grid-group:,", "grid-group:cell", "grid-group:cell=", "grid-group:cell=nan",
        "grid-group:cell=1e999", "grid-group:groups=1.5", "grid-group:cell=1%%", "grid-group:cell=1,",
        "aabb-tree:leaf_size=0", "sphere-cluster:clustering=inf"})
    EXPECT_NE(refused(text), "") << text;
  touchmark_mesh_free(mesh);
}

TEST(CInterface, FailsForSizesBelowZeroAndAnswersNoForCentersThatAreNoPlace) {
  for (const char* text : {"brute-force", "aabb-tree", "grid-group", "sphere-cluster", "grid-group:side=on",
                           "grid-group:lookup=scan", "sphere-cluster:lookup=scan"}) {
    SCOPED_TRACE(text);
    const Asked asked(unit_triangle, text);
    const double center[3] = {0.25, 0.25, 0.5};
    EXPECT_EQ(touchmark_touches(asked.session(), center, -1), TOUCHMARK_ERROR);
    expect_error("touchmark_touches: radius is -1; it must be 0 or more");
    EXPECT_EQ(touchmark_touches(asked.session(), center, nan), TOUCHMARK_ERROR);
    EXPECT_EQ(touchmark_nearest(asked.session(), center, -infinity, nullptr), TOUCHMARK_ERROR);
    EXPECT_EQ(touchmark_first_hit(asked.session(), center, center, -1e-300, nullptr), TOUCHMARK_ERROR);
    for (const double bad : {nan, infinity, -infinity}) {
      const double nowhere[3] = {0, bad, 0};
      EXPECT_EQ(touchmark_touches(asked.session(), nowhere, 1), TOUCHMARK_NO);
      EXPECT_EQ(touchmark_nearest(asked.session(), nowhere, 1, nullptr), TOUCHMARK_NO);
      EXPECT_EQ(touchmark_first_hit(asked.session(), nowhere, nowhere, 1, nullptr), TOUCHMARK_NO);
    }
    EXPECT_EQ(touchmark_touches(asked.session(), center, infinity), TOUCHMARK_YES);
  }
}

TEST(CInterface, KeepsErrorsOfThreadsApart) {
  touchmark_mesh_create(nullptr, 0, nullptr, 0);
  std::thread([] {
    EXPECT_STREQ(touchmark_last_error(), "");
    touchmark_session_create(nullptr);
    expect_error("touchmark_session_create: detector is NULL");
  }).join();
  expect_error("touchmark_mesh_create: vertices is NULL");
}

TEST(CInterface, AProxyTakesTheWayAndTheForcesOfTheOneInCpp) {
  std::uint64_t bits = 0;
  const Arrays arrays = sheet(12);
  const TriangleMesh mesh = cpp_mesh_of(arrays);
  const BruteForce truth = BruteForce::build(mesh);
  for (const double radius : {0.0, 0.02}) {
    BruteForce::Session session;
    const touchmark::Coupling coupling{
        .radius = radius, .stiffness = 700, .static_friction = 0.3, .dynamic_friction = 0.2, .damping = 1};
    touchmark::Proxy expected(truth, coupling, &mesh);
    touchmark_coupling same{};
    ASSERT_EQ(touchmark_coupling_default(&same), TOUCHMARK_YES);
    same.radius = radius, same.stiffness = 700, same.static_friction = 0.3, same.dynamic_friction = 0.2;
    same.damping = 1;
    const Asked asked(arrays, "grid-group");
    touchmark_proxy* proxy = touchmark_proxy_create(asked.detector(), &same);
    ASSERT_NE(proxy, nullptr) << touchmark_last_error();
    const Vec3 start(0.5, 0.5, 0.3);
    expected.place(start);
    EXPECT_EQ(touchmark_proxy_place(proxy, start.data()), TOUCHMARK_YES);
    int held = 0;
    for (int tick = 0; tick < 400; ++tick) {
      const double t = tick / 400.0;
      const Vec3 goal(0.5 + 0.4 * t, 0.5 - 0.3 * t, 0.3 - 0.4 * t);
      touchmark_proxy_state state{};
      const int found = touchmark_proxy_step(proxy, goal.data(), &state);
      const touchmark::ProxyState& now = expected.step(goal, session);
      ASSERT_EQ(found, now.contacts > 0 ? TOUCHMARK_YES : TOUCHMARK_NO) << touchmark_last_error();
      ASSERT_EQ(state.contacts, now.contacts);
      ASSERT_EQ(state.status, static_cast<int>(now.status));
      for (int k = 0; k < 3; ++k) {
        ASSERT_EQ(state.position[k], now.position[k]);
        ASSERT_EQ(state.force[k], now.force[k]);
        for (const double x : {state.position[k], state.force[k]})
          bits = (std::rotl(bits, 7) ^ std::bit_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15ULL;
        for (std::size_t i = 0; i < now.contacts; ++i) ASSERT_EQ(state.normals[i][k], now.normals[i][k]);
      }
      held += found;
      touchmark_force_planes planes{};
      ASSERT_EQ(touchmark_proxy_planes(proxy, &planes), TOUCHMARK_YES);
      for (const Vec3& on : {goal, Vec3(goal - Vec3(0, 0.01, 0.02))}) {
        Vec3 force;
        ASSERT_EQ(touchmark_force_now(&planes, on.data(), force.data()), TOUCHMARK_YES);
        ASSERT_EQ(force, expected.force_now(on));
      }
    }
    EXPECT_GT(held, 100);
    touchmark_proxy_free(proxy);
  }
  EXPECT_EQ(bits, 0xa4dee5d635655007ULL) << "not as on x86-64 Linux, with GCC's random numbers";
}

/// A square plate in the plane of that height, and a ball of radius 0.1 above it.
struct BallOverAPlate {
  BallOverAPlate() : asked(plate(0)) {
    touchmark_coupling coupling;
    touchmark_coupling_default(&coupling);
    coupling.radius = 0.1;
    coupling.stiffness = 100;
    proxy = touchmark_proxy_create(asked.detector(), &coupling);
  }
  BallOverAPlate(const BallOverAPlate&) = delete;
  BallOverAPlate& operator=(const BallOverAPlate&) = delete;
  ~BallOverAPlate() { touchmark_proxy_free(proxy); }

  static Arrays plate(double z) { return {{-1, -1, z, 1, -1, z, 1, 1, z, -1, 1, z}, {0, 1, 2, 0, 2, 3}}; }
  int step(double z, touchmark_proxy_state* state) const {
    const double goal[3] = {0, 0, z};
    return touchmark_proxy_step(proxy, goal, state);
  }

  Asked asked;
  touchmark_proxy* proxy;
};

TEST(CInterface, AProxyIsPushedBackByTheDepthOfTheDevice) {
  const BallOverAPlate ball;
  const double above[3] = {0, 0, 1};
  ASSERT_EQ(touchmark_proxy_place(ball.proxy, above), TOUCHMARK_YES);
  touchmark_proxy_state state{};
  EXPECT_EQ(ball.step(0.5, &state), TOUCHMARK_NO);
  EXPECT_EQ(state.status, TOUCHMARK_PROXY_FREE);
  EXPECT_EQ(state.force[2], 0);
  EXPECT_EQ(ball.step(0.05, &state), TOUCHMARK_YES);
  EXPECT_EQ(state.status, TOUCHMARK_PROXY_IN_CONTACT);
  EXPECT_NEAR(state.position[2], 0.1, 1e-9);
  EXPECT_NEAR(state.force[2], 100 * 0.05, 1e-6);
  EXPECT_EQ(state.contacts, 1u);
  EXPECT_NEAR(state.normals[0][2], 1, 1e-12);
  EXPECT_EQ(ball.step(nan, &state), TOUCHMARK_NO);
  EXPECT_EQ(state.status, TOUCHMARK_PROXY_UNANSWERED);
  EXPECT_EQ(state.force[2], 0);
  EXPECT_EQ(ball.step(0.05, nullptr), TOUCHMARK_YES);
}

TEST(CInterface, AProxyNoticesThatTheSurfaceHasMoved) {
  const BallOverAPlate ball;
  const double above[3] = {0, 0, 1};
  touchmark_proxy_place(ball.proxy, above);
  touchmark_proxy_state state{};
  ASSERT_EQ(ball.step(0.05, &state), TOUCHMARK_YES);
  touchmark_mesh* lowered = mesh_of(BallOverAPlate::plate(-1));
  ASSERT_EQ(touchmark_detector_update(ball.asked.detector(), lowered), TOUCHMARK_YES);
  touchmark_mesh_free(lowered);
  EXPECT_EQ(ball.step(0.05, &state), TOUCHMARK_NO);
  EXPECT_EQ(state.position[2], 0.05);
  EXPECT_EQ(ball.step(-1.05, &state), TOUCHMARK_YES);
  EXPECT_NEAR(state.position[2], -0.9, 1e-9);
}

TEST(CInterface, ASurfaceThatAnUpdateMovesOverAProxyPushesIt) {
  touchmark_mesh* const mesh = mesh_of(unit_triangle);
  touchmark_mesh* const raised = mesh_of({{0, 0, 2, 1, 0, 2, 0, 1, 2}, {0, 1, 2}});
  touchmark_detector* const detector = touchmark_detector_build(mesh, "aabb-tree:side=on");
  touchmark_proxy* const proxy = touchmark_proxy_create(detector, nullptr);
  const double above[3] = {0.2, 0.2, 1}, below[3] = {0.2, 0.2, -1};
  EXPECT_EQ(touchmark_proxy_surface_moving(proxy, raised), TOUCHMARK_ERROR);
  expect_error("touchmark_proxy_surface_moving: the proxy was never placed: call touchmark_proxy_place");
  touchmark_proxy_place(proxy, above);
  EXPECT_EQ(touchmark_proxy_surface_moving(proxy, raised), TOUCHMARK_YES);
  EXPECT_EQ(touchmark_detector_update(detector, raised), TOUCHMARK_YES);
  touchmark_proxy_state state{};
  EXPECT_EQ(touchmark_proxy_step(proxy, below, &state), TOUCHMARK_YES);
  EXPECT_GT(state.position[2], 2);
  EXPECT_NEAR(state.position[2], 2, 1e-6);
  EXPECT_EQ(touchmark_proxy_surface_moving(proxy, nullptr), TOUCHMARK_ERROR);
  EXPECT_EQ(touchmark_proxy_surface_moving(nullptr, mesh), TOUCHMARK_ERROR);
  const Asked blind(unit_triangle, "grid-group");
  touchmark_proxy* const unpushed = touchmark_proxy_create(blind.detector(), nullptr);
  touchmark_proxy_place(unpushed, above);
  EXPECT_EQ(touchmark_proxy_surface_moving(unpushed, raised), TOUCHMARK_ERROR);
  expect_error(
      "touchmark_proxy_surface_moving: this detector does not see how a mesh moves; sphere-cluster, "
      "aabb-tree and brute-force do");
  touchmark_proxy_free(unpushed);
  touchmark_proxy_free(proxy);
  touchmark_detector_free(detector);
  touchmark_mesh_free(raised);
  touchmark_mesh_free(mesh);
}

TEST(CInterface, AProxyOutlivesTheHandlesItWasMadeOf) {
  touchmark_mesh* mesh = mesh_of(unit_triangle);
  touchmark_detector* detector = touchmark_detector_build(mesh, "aabb-tree");
  touchmark_proxy* proxy = touchmark_proxy_create(detector, nullptr);
  touchmark_mesh_free(mesh);
  touchmark_detector_free(detector);
  const double above[3] = {0.2, 0.2, 1}, below[3] = {0.2, 0.2, -1};
  EXPECT_EQ(touchmark_proxy_place(proxy, above), TOUCHMARK_YES);
  touchmark_proxy_state state{};
  EXPECT_EQ(touchmark_proxy_step(proxy, below, &state), TOUCHMARK_YES);
  EXPECT_GT(state.position[2], 0);
  touchmark_proxy_free(proxy);
  touchmark_proxy_free(nullptr);
}

TEST(CInterface, AProxySaysWhatItCannotBeMadeOf) {
  const Asked asked(unit_triangle), inexact(unit_triangle, "sphere-cluster:precise=false");
  EXPECT_EQ(touchmark_proxy_create(nullptr, nullptr), nullptr);
  expect_error("touchmark_proxy_create: detector is NULL");
  EXPECT_EQ(touchmark_proxy_create(inexact.detector(), nullptr), nullptr);
  expect_error("touchmark_proxy_create: the detector does not decide exactly, so the proxy could cross");
  const auto expect_refused = [&](double touchmark_coupling::*member, double value, const std::string& text) {
    touchmark_coupling coupling;
    touchmark_coupling_default(&coupling);
    coupling.*member = value;
    EXPECT_EQ(touchmark_proxy_create(asked.detector(), &coupling), nullptr);
    expect_error("touchmark_proxy_create: " + text);
  };
  expect_refused(&touchmark_coupling::radius, -1, "radius is -1.000000; it must be finite, and 0 or more");
  expect_refused(&touchmark_coupling::stiffness, nan, "stiffness is nan; it must be finite, and 0 or more");
  expect_refused(&touchmark_coupling::damping, infinity, "damping is inf; it must be finite, and 0 or more");
  expect_refused(&touchmark_coupling::tick_s, 0, "tick_s is 0; a tick takes time");
  expect_refused(&touchmark_coupling::dynamic_friction, 0.5,
                 "dynamic_friction is 0.500000, more than static_friction, 0.000000");
  const Asked unlimited(unit_triangle, "aabb-tree");
  touchmark_coupling coupling;
  touchmark_coupling_default(&coupling);
  coupling.max_work = 100;
  EXPECT_EQ(touchmark_proxy_create(unlimited.detector(), &coupling), nullptr);
  expect_error(
      "touchmark_proxy_create: max_work is 100, but this detector keeps to no limit; sphere-cluster and "
      "grid-group do");
  EXPECT_EQ(touchmark_coupling_default(nullptr), TOUCHMARK_ERROR);
}

TEST(CInterface, AProxyRefusesWhatIsNullOrNowhere) {
  const Asked asked(unit_triangle);
  touchmark_proxy* proxy = touchmark_proxy_create(asked.detector(), nullptr);
  const double here[3] = {0, 0, 1}, nowhere[3] = {0, infinity, 0};
  EXPECT_EQ(touchmark_proxy_step(proxy, here, nullptr), TOUCHMARK_ERROR);
  expect_error("touchmark_proxy_step: the proxy was never placed: call touchmark_proxy_place");
  EXPECT_EQ(touchmark_proxy_place(proxy, nowhere), TOUCHMARK_ERROR);
  expect_error("touchmark_proxy_place: position is not finite");
  EXPECT_EQ(touchmark_proxy_place(proxy, nullptr), TOUCHMARK_ERROR);
  EXPECT_EQ(touchmark_proxy_place(nullptr, here), TOUCHMARK_ERROR);
  EXPECT_EQ(touchmark_proxy_step(nullptr, here, nullptr), TOUCHMARK_ERROR);
  EXPECT_EQ(touchmark_proxy_step(proxy, nullptr, nullptr), TOUCHMARK_ERROR);
  touchmark_proxy_free(proxy);
}

TEST(CInterface, TellsTheVersionOfTheProject) { EXPECT_STREQ(touchmark_version(), TOUCHMARK_VERSION); }

}  // namespace
