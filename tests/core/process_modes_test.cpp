// Modes of the processor that a library may switch for a whole thread: denormal numbers flushed to zero, and
// other directions of rounding.
#include <cfenv>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include "core/aabb_tree/aabb_tree.h"
#include "core/aabb_tree/float_tree.h"
#include "core/brute_force/brute_force.h"
#include "core/float_limits.h"
#include "core/grid_group/grid_group.h"
#include "core/sphere_cluster/sphere_cluster.h"

namespace touchmark {
namespace {

class Lattice {
 public:
  explicit Lattice(double scale) : scale_(scale) {}
  Vec3 point() { return scale_ * Vec3(number_(random_), number_(random_), number_(random_)); }
  /// Many of them meet, cross and coincide, so that ties are many.
  TriangleMesh mesh() {
    std::vector<Vec3> vertices;
    std::vector<TriangleMesh::Corners> triangles;
    for (std::uint32_t i = 0; i < 90; ++i) vertices.push_back(point());
    for (std::uint32_t i = 0; i < 90; i += 3) triangles.push_back({i, i + 1, i + 2});
    return {vertices, triangles};
  }

 private:
  double scale_;
  std::mt19937_64 random_{1};
  std::uniform_int_distribution<int> number_{-4, 4};
};

/// Balls that just touch and just do not, and their ways.
std::vector<Sweep> questions(const TriangleMesh& mesh, double scale) {
  const BruteForce detector = BruteForce::build(mesh);
  BruteForce::Session session;
  Lattice lattice(scale);
  std::vector<Sweep> asked;
  for (int i = 0; i < 150; ++i) {
    const Vec3 from = 2 * lattice.point(), to = lattice.point();
    const double distance = detector.nearest({from, 0}, infinity, session)->distance;
    for (const double radius :
         {distance, std::nextafter(distance, 0.0), std::nextafter(distance, infinity), 0.0})
      asked.push_back({from, to, radius});
  }
  return asked;
}

struct Answer {
  bool touches = false;
  std::optional<Contact> nearest;
  std::optional<Impact> hit;
};

template <class D>
std::vector<Answer> answers_of(const TriangleMesh& mesh, const std::vector<Sweep>& asked) {
  const D detector = D::build(mesh);
  typename D::Session session;
  std::vector<Answer> answers;
  for (const Sweep& one : asked) {
    answers.push_back({detector.touches({one.from, one.radius}, session),
                       detector.nearest({one.from, 0}, one.radius, session),
                       detector.first_hit(one, session)});
  }
  return answers;
}

void expect_same_bits(const std::vector<Answer>& usual, const std::vector<Answer>& found) {
  ASSERT_EQ(usual.size(), found.size());
  for (std::size_t i = 0; i < usual.size(); ++i) {
    ASSERT_EQ(usual[i].touches, found[i].touches) << i;
    ASSERT_EQ(usual[i].nearest.has_value(), found[i].nearest.has_value()) << i;
    ASSERT_EQ(usual[i].hit.has_value(), found[i].hit.has_value()) << i;
    if (usual[i].nearest) {
      ASSERT_EQ(usual[i].nearest->triangle, found[i].nearest->triangle) << i;
      ASSERT_EQ(usual[i].nearest->distance, found[i].nearest->distance) << i;
    }
    if (usual[i].hit) {
      ASSERT_EQ(usual[i].hit->contact.triangle, found[i].hit->contact.triangle) << i;
      // The smallest number above 0 says that the hit comes right after the start.
      ASSERT_NEAR(usual[i].hit->fraction, found[i].hit->fraction, std::numeric_limits<double>::min()) << i;
    }
  }
}

#if defined(__SSE2__)
constexpr unsigned flush_to_zero = 0x8000, denormals_are_zero = 0x0040;

template <class Action>
auto with_mode(unsigned bits, const Action& action) {
  struct Restored {
    unsigned state = _mm_getcsr();
    ~Restored() { _mm_setcsr(state); }
  } const before;
  _mm_setcsr(before.state | bits);
  return action();
}

std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const MeshError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(FlushedDenormals, AMeshThatNeedsThemIsRefusedByNameWhoeverBuilds) {
  std::vector<Vec3> vertices{{0, 0, 0}, {0x1p-1060, 0, 0}, {0, 0x1p-1060, 0}};
  const TriangleMesh mesh(vertices, {{0, 1, 2}});
  for (const unsigned mode : {flush_to_zero, denormals_are_zero, flush_to_zero | denormals_are_zero}) {
    const auto refused = [&](const std::function<void()>& action) {
      const std::string text = with_mode(mode, [&] { return refusal(action); });
      EXPECT_EQ(text.find("vertex 1 has the coordinate 8.0947"), 0U) << text;
      EXPECT_NE(text.find("flushes denormal numbers to zero"), std::string::npos) << text;
      EXPECT_EQ(refusal(action), "accepted") << "in the usual mode";
    };
    refused([&] { TriangleMesh(vertices, {{0, 1, 2}}); });
    refused([&] { BruteForce::build(mesh); });
    refused([&] { AabbTree::build(mesh); });
    refused([&] { FloatTree::build(mesh); });
    refused([&] { GridGroup::build(mesh); });
    refused([&] { SphereCluster::build(mesh); });
  }
}

TEST(FlushedDenormals, TheLineIsAt2ToTheMinus900AndZerosAreFine) {
  const auto refusal_of = [](double x) {
    return with_mode(flush_to_zero | denormals_are_zero, [&] {
      return refusal([&] { TriangleMesh({{-0.0, 0, 0}, {1, 0, 0}, {0, 1, x}}, {{0, 1, 2}}); });
    });
  };
  EXPECT_EQ(refusal_of(-0x1p-900), "accepted");
  EXPECT_EQ(refusal_of(-0.0), "accepted");
  EXPECT_NE(refusal_of(-std::nextafter(0x1p-900, 0.0)), "accepted");
  EXPECT_NE(refusal_of(std::numeric_limits<double>::denorm_min()), "accepted");
}

TEST(FlushedDenormals, AnyOtherMeshIsAnsweredAsEver) {
  for (const double scale : {1.0, 0x1p-100, 0x1p-133, 0x1p-270, 0x1p-500, 0x1p-900, 0x1p900}) {
    SCOPED_TRACE(std::log2(scale));
    const TriangleMesh mesh = Lattice(scale).mesh();
    const std::vector<Sweep> asked = questions(mesh, scale);
    const auto compare = [&](auto ask) {
      const std::vector<Answer> usual = ask();
      expect_same_bits(usual, with_mode(flush_to_zero | denormals_are_zero, ask));
    };
    compare([&] { return answers_of<BruteForce>(mesh, asked); });
    compare([&] { return answers_of<AabbTree>(mesh, asked); });
    compare([&] { return answers_of<GridGroup>(mesh, asked); });
    compare([&] { return answers_of<SphereCluster>(mesh, asked); });
  }
}
#endif

/// Which of two decisions at the very distance is right is not known in other modes, but what is reported is
/// off by roundings alone.
TEST(RoundingModes, ChangeAReportedDistanceByRoundingsAlone) {
  const TriangleMesh mesh = Lattice(0.1).mesh();
  const std::vector<Sweep> asked = questions(mesh, 0.1);
  const SphereCluster detector = SphereCluster::build(mesh);
  const auto distances = [&] {
    SphereCluster::Session session;
    std::vector<double> found;
    for (const Sweep& one : asked)
      found.push_back(detector.nearest({one.from, 0}, infinity, session)->distance);
    return found;
  };
  const std::vector<double> usual = distances();
  for (const int direction : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    std::fesetround(direction);
    const std::vector<double> found = distances();
    std::fesetround(FE_TONEAREST);
    for (std::size_t i = 0; i < asked.size(); ++i) EXPECT_NEAR(found[i], usual[i], 0x1p-53 * 48 * 2) << i;
  }
}

}  // namespace
}  // namespace touchmark
