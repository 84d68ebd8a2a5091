// What a session remembers changes the cost, never the answer: a fresh session for every probe, one used
// session, and several threads with a session each give the bits that brute force gives.
#include <cstring>
#include <future>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bench/workload/answer.h"
#include "core/aabb_tree/aabb_tree.h"
#include "core/brute_force/brute_force.h"
#include "core/grid_group/grid_group.h"
#include "core/sphere_cluster/sphere_cluster.h"
#include "tests/conformance_scenes.h"

namespace touchmark {
namespace {

using bench::workload::Answer;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Three queries of each centre in turn, so that a session sees them mixed.
struct Questions {
  std::vector<Vec3> centers;
  double radius = 0;
};

template <class D>
void answer(const D& detector, const Questions& questions, std::size_t i, typename D::Session& session,
            std::vector<Answer>& answers) {
  const Probe probe{questions.centers[i], questions.radius};
  for (const double reach : {questions.radius, infinity}) {
    const auto contact = detector.nearest(probe, reach, session);
    answers.push_back(contact ? Answer::of(*contact) : Answer{});
  }
  Answer touch;
  touch.found = detector.touches(probe, session) ? 1 : 0;
  answers.push_back(touch);
  const Sweep sweep{questions.centers[i > 0 ? i - 1 : 0], probe.center, probe.radius};
  const auto impact = detector.first_hit(sweep, session);
  answers.push_back(impact ? Answer::of(impact->contact, impact->fraction) : Answer{});
}

template <class D>
std::vector<Answer> answers_of_one_session(const D& detector, const Questions& questions) {
  typename D::Session session;
  std::vector<Answer> answers;
  for (std::size_t i = 0; i < questions.centers.size(); ++i) answer(detector, questions, i, session, answers);
  return answers;
}

template <class D>
std::vector<Answer> answers_of_fresh_sessions(const D& detector, const Questions& questions) {
  std::vector<Answer> answers;
  for (std::size_t i = 0; i < questions.centers.size(); ++i) {
    typename D::Session session;
    answer(detector, questions, i, session, answers);
  }
  return answers;
}

/// The first answer that differs in any bit; none: their number.
std::size_t first_difference(const std::vector<Answer>& a, const std::vector<Answer>& b) {
  std::size_t i = 0;
  while (i < a.size() && i < b.size() && std::memcmp(&a[i], &b[i], sizeof(Answer)) == 0) ++i;
  return i;
}

template <class D>
void expect_same_bits(const TriangleMesh& mesh, const typename D::Options& options,
                      const Questions& questions, const std::vector<Answer>& expected,
                      const std::string& name, int thread_count = 8) {
  const D detector = D::build(mesh, options);
  EXPECT_EQ(first_difference(answers_of_fresh_sessions(detector, questions), expected), expected.size())
      << name << ", fresh sessions";
  EXPECT_EQ(first_difference(answers_of_one_session(detector, questions), expected), expected.size())
      << name << ", one session";
  std::vector<std::future<std::vector<Answer>>> threads;
  for (int i = 0; i < thread_count; ++i) {
    threads.push_back(
        std::async(std::launch::async, [&] { return answers_of_one_session(detector, questions); }));
  }
  for (auto& thread : threads)
    EXPECT_EQ(first_difference(thread.get(), expected), expected.size()) << name << ", in threads";
}

class Sessions : public testing::TestWithParam<std::string> {};

TEST_P(Sessions, GiveTheBitsOfBruteForceFreshUsedAndInThreads) {
  const TriangleMesh mesh = bench::scenes::load_scene(GetParam());
  // A quarter, since each is asked up to ten times of eleven detectors.
  const Questions questions{adversarial_centers(mesh, affordable(mesh) / 4), 0.005 * mesh.diagonal()};
  const std::vector<Answer> expected = answers_of_one_session(BruteForce::build(mesh), questions);
  expect_same_bits<AabbTree>(mesh, {}, questions, expected, "aabb-tree");
  // Scans look at everything and remember nothing: two threads show what they share.
  constexpr int threads_of_scans = 2;
  for (const double clustering : {0.0, 0.05 * mesh.diagonal()}) {
    SphereCluster::Options options;
    options.clustering = clustering;
    expect_same_bits<SphereCluster>(mesh, options, questions, expected, "sphere-cluster, tree");
    options.lookup = SphereCluster::Lookup::scan;
    expect_same_bits<SphereCluster>(mesh, options, questions, expected, "sphere-cluster, scan",
                                    threads_of_scans);
  }
  for (const double cell : {0.0, 0.03 * mesh.diagonal()}) {
    GridGroup::Options options;
    options.cell = cell;
    expect_same_bits<GridGroup>(mesh, options, questions, expected, "grid-group, direct");
    options.lookup = GridGroup::Lookup::scan;
    for (const auto shape : {GridGroup::Shape::cube, GridGroup::Shape::sphere}) {
      options.shape = shape;
      expect_same_bits<GridGroup>(mesh, options, questions, expected, "grid-group, scan", threads_of_scans);
    }
  }
}

std::string test_name(const testing::TestParamInfo<std::string>& scene) {
  std::string name = scene.param;
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Scenes, Sessions, testing::ValuesIn(conformance_scenes()), test_name);

}  // namespace
}  // namespace touchmark
