// What a step looks at is counted, and in the worst case at most twice what brute force looks at, and a
// little: by our forms and the plain reference. The published scans look at what the papers let them look at
// (tests/core/grid_group/published/scan_work_test.cpp).
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bench/experiments/stress/shared_features.h"
#include "bench/oracle/oracle.h"
#include "core/float_limits.h"
#include "core/grid_group/grid_group.h"
#include "tests/bench/oracle/corner_case_meshes.h"
#include "tests/own_forms.h"

namespace touchmark {
namespace {

using bench::workload::Answer;
using bench::workload::Query;
using bench::workload::Step;

constexpr Query all_queries[] = {Query::touches, Query::nearest, Query::sweep};

/// All triangles in one place, but for a few that make the box large.
TriangleMesh clump() {
  CornerCases cases(31);
  std::vector<CornerCases::Corners> triangles;
  for (int i = 0; i < 300; ++i)
    triangles.push_back({1e-6 * cases.vector(), 1e-6 * cases.vector(), 1e-6 * cases.vector()});
  for (int i = 0; i < 4; ++i) triangles.push_back(cases.plain());
  return mesh_of(triangles);
}

/// One triangle spans whatever cells the small ones are sorted into.
TriangleMesh under_a_blanket() {
  CornerCases cases(32);
  std::vector<CornerCases::Corners> triangles = {{Vec3(-9, -9, 0), Vec3(9, -9, 0), Vec3(0, 9, 0)}};
  for (int i = 0; i < 300; ++i) {
    const Vec3 at = cases.vector();
    triangles.push_back({at, at + 0.01 * cases.vector(), at + 0.01 * cases.vector()});
  }
  return mesh_of(triangles);
}

/// Large triangles through one point: no two have boxes apart.
TriangleMesh star() {
  CornerCases cases(33);
  std::vector<CornerCases::Corners> triangles;
  for (int i = 0; i < 300; ++i) {
    const CornerCases::Corners t = cases.plain();
    triangles.push_back({t[0], t[1], -0.5 * (t[0] + t[1])});
  }
  return mesh_of(triangles);
}

std::vector<NamedMesh> hostile_meshes() {
  std::vector<NamedMesh> meshes = corner_case_meshes();
  meshes.push_back({"larger octasphere", octasphere(8)});
  meshes.push_back({"clump", clump()});
  meshes.push_back({"under a blanket", under_a_blanket()});
  meshes.push_back({"star", star()});
  const CornerCases::Corners one = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  meshes.push_back({"one triangle", mesh_of({one})});
  meshes.push_back({"one triangle, again and again", mesh_of(std::vector<CornerCases::Corners>(300, one))});
  return meshes;
}

std::vector<Step> hostile_steps(const TriangleMesh& mesh) {
  CornerCases cases(34);
  std::vector<Step> steps;
  for (const Vec3& center : corner_case_points(mesh, cases, 40))
    for (const double length : {0.0, 0.01 * mesh.diagonal(), mesh.diagonal(), infinity})
      steps.push_back({{center, length}, length});
  return steps;
}

const char* name_of(Query query) {
  return query == Query::touches ? "touches" : query == Query::nearest ? "nearest" : "sweep";
}

struct Asked {
  std::vector<Answer> answers;
  std::vector<std::uint64_t> work;  ///< of each step
};

Asked ask(bench::contestants::Contestant& detector, Query query, const std::vector<Step>& steps) {
  Asked asked{std::vector<Answer>(steps.size()), std::vector<std::uint64_t>(steps.size())};
  detector.forget();
  detector.answer({query, steps}, {0, steps.size()}, asked.answers, asked.work);
  return asked;
}

/// By how much a form looks at more than twice what brute force does, at most, and where.
struct Worst {
  std::int64_t beyond = std::numeric_limits<std::int64_t>::min();
  std::string where;
};

/// Also that giving a search up changes no answer.
std::map<std::string, Worst> worst_of_all() {
  std::map<std::string, Worst> worst;
  for (const NamedMesh& named : hostile_meshes()) {
    const std::vector<Step> steps = hostile_steps(named.mesh);
    const std::vector<ExactForm> forms = exact_forms(named.mesh);
    for (const Query query : all_queries) {
      const Asked brute_force = ask(*forms.front().detector, query, steps);
      for (const ExactForm& form : forms) {
        const Asked asked = ask(*form.detector, query, steps);
        for (std::size_t i = 0; i < steps.size(); ++i) {
          const std::string where = named.name + ", step " + std::to_string(i);
          EXPECT_EQ(std::memcmp(&asked.answers[i], &brute_force.answers[i], sizeof(Answer)), 0)
              << form.name << ", " << name_of(query) << ": " << where;
          if (form.as_published) continue;
          // It looks at all triangles, unless one that touches comes first; again at the start of a sweep
          // that touches something; and once more where rounding could tell the nearest.
          const std::uint64_t least = std::max<std::uint64_t>(brute_force.work[i], named.mesh.size());
          // What prepares lists what is near, which looks at each triangle at most once more, and asks the
          // question again.
          const std::uint64_t times = form.detector->prepares() ? 5 : 2;
          const auto beyond =
              static_cast<std::int64_t>(asked.work[i]) - static_cast<std::int64_t>(times * least);
          Worst& so_far = worst[form.name + ", " + name_of(query)];
          if (beyond > so_far.beyond)
            so_far = {beyond,
                      where + ": " + std::to_string(asked.work[i]) + " against " + std::to_string(least)};
        }
      }
    }
  }
  return worst;
}

TEST(WorstCaseWork, IsAtMostTwiceBruteForceAndALittle) {
  // Nodes and blocks hold eight, lists of blocks and groups 64: so much may be looked at before anything else
  // is thought of, by the search and, in a sweep, by that at its start.
  constexpr std::int64_t little = 256;
  for (const auto& [form, found] : worst_of_all()) {
    if (found.beyond > 0) std::printf("%-48s %6ld  %s\n", form.c_str(), found.beyond, found.where.c_str());
    EXPECT_LE(found.beyond, little) << form << ": " << found.where;
  }
}

// Brute force ends at the first triangle that touches. A search may look at some boxes and blocks before, and
// at no more of the triangles that are all as near but for rounding than it keeps open at once.
TEST(WorstCaseWork, OfATouchAmongTangentTrianglesEndsAtTheFirstThatTouches) {
  constexpr std::uint64_t few_looks = 256, few_decisions = 16;
  for (const bench::experiments::stress::SharedFeature& shared :
       bench::experiments::stress::shared_feature_meshes(6630)) {
    if (!shared.name.starts_with("tangent") && !shared.name.starts_with("spikes")) continue;
    const bench::oracle::Oracle oracle(shared.mesh);
    const Vec3& center = shared.centers.front();
    // What is not farther than the nearest but for rounding touches.
    const Probe probe{center, oracle.solve(center).high * (1 + 0x1p-50)};
    for (const bool lazy : {false, true}) {
      const GridGroup grid = GridGroup::build(
          shared.mesh,
          {.construction = lazy ? GridGroup::Construction::lazy : GridGroup::Construction::whole});
      GridGroup::Session session;
      EXPECT_TRUE(grid.touches(probe, session)) << shared.name;
      EXPECT_LE(session.work.exact_decisions, few_decisions) << shared.name;
      if (lazy) continue;  // what it makes counts as well
      EXPECT_LE(session.work.total(), few_looks) << shared.name;
    }
  }
}

}  // namespace
}  // namespace touchmark
