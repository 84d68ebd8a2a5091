// Every exact form of core on meshes that detectors fail on: brute force is right by the oracle, the others
// give its bits. Small and quick, so that it can be run against every mutant of core.
#include <cmath>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bench/contestants/contestant_of.h"
#include "bench/experiments/stress/corner_case_sweeps.h"
#include "bench/experiments/stress/near_ties.h"
#include "bench/oracle/judge.h"
#include "bench/oracle/oracle.h"
#include "core/aabb_tree/aabb_tree.h"
#include "core/brute_force/brute_force.h"
#include "core/float_limits.h"
#include "core/grid_group/grid_group.h"
#include "core/sphere_cluster/sphere_cluster.h"
#include "tests/bench/oracle/corner_case_meshes.h"
#include "tests/own_forms.h"

namespace touchmark {
namespace {

using bench::oracle::GroundTruth;
using bench::oracle::Oracle;
using bench::workload::Answer;
using bench::workload::Query;
using bench::workload::Step;

std::vector<Answer> ask(bench::contestants::Contestant& detector, Query query,
                        const std::vector<Step>& steps) {
  std::vector<Answer> answers(steps.size());
  std::vector<std::uint64_t> work(steps.size());
  detector.answer({query, steps}, {0, steps.size()}, answers, work);
  return answers;
}

/// The first answer that differs in any bit; none: their number.
std::size_t first_difference(const std::vector<Answer>& a, const std::vector<Answer>& b) {
  std::size_t i = 0;
  while (i < a.size() && i < b.size() && std::memcmp(&a[i], &b[i], sizeof(Answer)) == 0) ++i;
  return i;
}

/// Asks all forms the same, and judges the bits that they agree on.
class Examination {
 public:
  explicit Examination(const TriangleMesh& mesh)
      : mesh_(mesh), oracle_(mesh_, 1), forms_(exact_forms(mesh_)) {}

  const Oracle& oracle() const { return oracle_; }

  void ask_all(const std::string& what, Query query, const std::vector<Step>& steps) {
    const std::vector<Answer> expected = ask(*forms_.front().detector, query, steps);
    judge(what, query, steps, expected);
    for (const ExactForm& form : forms_) {
      const std::size_t at = first_difference(ask(*form.detector, query, steps), expected);
      EXPECT_EQ(at, steps.size()) << form.name << " differs from brute force: " << what;
    }
  }

 private:
  void judge(const std::string& what, Query query, const std::vector<Step>& steps,
             const std::vector<Answer>& answers) const {
    const Accuracy accuracy = forms_.front().detector->accuracy();
    bench::oracle::ErrorCounts counts;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const Probe& probe = steps[i].probe;
      const std::span answer(&answers[i], 1);
      if (query == Query::sweep) {
        const std::vector<Sweep> sweep = {
            {steps[i > 0 ? i - 1 : 0].probe.center, probe.center, probe.radius}};
        counts += bench::oracle::judge(oracle_, oracle_.solve(sweep), sweep, answer, accuracy);
      } else {
        const std::vector<GroundTruth> truth = {oracle_.solve(probe.center)};
        counts += bench::oracle::judge(oracle_, truth, query, std::span(&probe, 1), steps[i].reach, answer,
                                       accuracy);
      }
    }
    EXPECT_TRUE(bench::oracle::meets_guarantee(counts, accuracy))
        << "brute force: " << what << ": " << counts.missed << " missed, " << counts.false_contacts
        << " false, " << counts.wrong_triangle << " wrong triangle, " << counts.beyond_bound << " beyond, "
        << counts.wrong_point << " point, " << counts.wrong_normal << " normal, " << counts.malformed
        << " malformed";
  }

  TriangleMesh mesh_;
  Oracle oracle_;
  std::vector<ExactForm> forms_;
};

class ExactForms : public testing::TestWithParam<std::size_t> {
 protected:
  static const std::vector<NamedMesh>& meshes() {
    static const std::vector<NamedMesh> all = corner_case_meshes();
    return all;
  }
};

/// As many steps as centres, each with the radius and the reach that belong to its distance.
template <class RadiusAt, class ReachAt>
std::vector<Step> steps_at(const std::vector<Vec3>& centers, const RadiusAt& radius, const ReachAt& reach) {
  std::vector<Step> steps;
  for (std::size_t i = 0; i < centers.size(); ++i) steps.push_back({{centers[i], radius(i)}, reach(i)});
  return steps;
}

TEST_P(ExactForms, AreRightAndAgreeOnHardMeshes) {
  const NamedMesh& named = meshes()[GetParam()];
  SCOPED_TRACE(named.name);
  Examination examination(named.mesh);
  CornerCases cases(7);
  const std::vector<Vec3> centers = corner_case_points(named.mesh, cases, 60);
  std::vector<double> distance;
  for (const Vec3& center : centers) distance.push_back(examination.oracle().solve(center).high);
  const double some = 0.01 * named.mesh.diagonal();
  const auto constant = [](double value) { return [value](std::size_t) { return value; }; };
  for (const double reach : {0.0, some, infinity}) {
    examination.ask_all("nearest within " + std::to_string(reach), Query::nearest,
                        steps_at(centers, constant(some), constant(reach)));
  }
  examination.ask_all("nearest at the very distance", Query::nearest,
                      steps_at(centers, constant(some), [&](std::size_t i) { return distance[i]; }));
  const auto ask_touches = [&](const char* what, auto radius) {
    examination.ask_all(what, Query::touches, steps_at(centers, radius, constant(0)));
  };
  ask_touches("touches", constant(some));
  ask_touches("touches at the very distance", [&](std::size_t i) { return distance[i]; });
  ask_touches("touches an ulp short of it", [&](std::size_t i) { return std::nextafter(distance[i], 0); });
  ask_touches("touches an ulp beyond", [&](std::size_t i) { return std::nextafter(distance[i], infinity); });
  // Where a bound from above that is not quite one shows.
  ask_touches("touches a little short of it", [&](std::size_t i) {
    return distance[i] * (1 - std::ldexp(1.0, -4 - static_cast<int>(i % 24)));
  });
  // A touch that was content with what is within a large radius says nothing of what is within a small one.
  std::vector<Step> ever_smaller;
  for (std::size_t i = 0; i < centers.size(); ++i) {
    for (const double radius : {3 * distance[i], std::nextafter(distance[i], infinity),
                                std::nextafter(distance[i], 0), 2 * distance[i] + some, distance[i]})
      ever_smaller.push_back({{centers[i], radius}, 0});
  }
  examination.ask_all("touches with ever smaller radii", Query::touches, ever_smaller);
  examination.ask_all("sweep", Query::sweep, steps_at(centers, constant(some), constant(0)));
}

INSTANTIATE_TEST_SUITE_P(Meshes, ExactForms, testing::Range(std::size_t{0}, corner_case_meshes().size()),
                         [](const testing::TestParamInfo<std::size_t>& mesh) {
                           std::string name = corner_case_meshes()[mesh.param].name;
                           for (char& c : name)
                             if (c == ' ') c = '_';
                           return name;
                         });

/// On vertices, edges and faces, where many triangles are equally near: the first of them is the answer, by
/// whatever boxes and cells the others would be left out.
TEST(ExactFormsInTies, GiveTheFirstOfTheNearest) {
  const TriangleMesh sphere = octasphere(6).transformed(1, Vec3(0.1, 0.2, 0.3));
  Examination examination(sphere);
  CornerCases cases(11);
  std::vector<Vec3> centers;
  for (std::uint32_t i = 0; i < sphere.size(); ++i) {
    const Vec3 &a = sphere.corner(i, 0), &b = sphere.corner(i, 1);
    const Vec3 middle(0.1, 0.2, 0.3);
    centers.push_back(a);
    centers.push_back(0.5 * (a + b));
    centers.push_back(a + cases.magnitude(-12, 0) * (a - middle));
    centers.push_back(0.5 * (a + b) + cases.magnitude(-12, 0) * (a - middle));
  }
  const auto reach = [](double value) { return [value](std::size_t) { return value; }; };
  examination.ask_all("nearest at any reach", Query::nearest, steps_at(centers, reach(0), reach(infinity)));
  examination.ask_all("nearest within 0.01", Query::nearest, steps_at(centers, reach(0), reach(0.01)));
  examination.ask_all("nearest within nothing", Query::nearest, steps_at(centers, reach(0), reach(0)));
}

/// Where rounding puts another triangle first: beside bisectors, over the borders between the corners, edges
/// and faces of a closed surface, and where exact ties round apart.
TEST(ExactFormsInNearTies, NameTheFirstOfTheExactlyNearest) {
  CornerCases cases(29);
  std::vector<CornerCases::Corners> soup;
  for (int i = 0; i < 40; ++i) soup.push_back(i % 4 == 0 ? cases.needle() : cases.plain());
  for (const TriangleMesh& mesh : {bench::experiments::stress::turned_images(cases, 12), mesh_of(soup),
                                   octasphere(4).transformed(1, Vec3(0.1, 0.2, 0.3))}) {
    Examination examination(mesh);
    std::vector<Vec3> centers;
    while (centers.size() < 400) {
      centers.push_back(bench::experiments::stress::on_the_diagonal(cases));
      const Vec3 from = cases.magnitude(-1, 0.5) * cases.vector(), to = from + 0.3 * cases.vector();
      const Vec3 place =
          bench::experiments::stress::where_the_nearest_changes(examination.oracle(), from, to);
      for (const Vec3& neighbour : bench::experiments::stress::with_neighbors(place, cases))
        centers.push_back(neighbour);
    }
    std::vector<double> distance;
    for (const Vec3& center : centers) distance.push_back(examination.oracle().solve(center).high);
    const auto constant = [](double value) { return [value](std::size_t) { return value; }; };
    examination.ask_all("nearest at any reach", Query::nearest,
                        steps_at(centers, constant(0), constant(infinity)));
    examination.ask_all("nearest well within reach", Query::nearest,
                        steps_at(centers, constant(0), [&](std::size_t i) { return 2 * distance[i]; }));
    examination.ask_all("sweeps", Query::sweep,
                        steps_at(
                            centers, [&](std::size_t i) { return 2 * distance[i]; }, constant(0)));
  }
}

/// Standing on the surface, going through it and going along it. A sweep of less than nothing was once taken
/// for one of nothing, where its gap drowned in rounding.
TEST(ExactFormsBelowZero, TouchNothing) {
  const TriangleMesh sphere = octasphere(6).transformed(1, Vec3(0.1, 0.2, 0.3));
  std::vector<Vec3> centers;
  for (std::uint32_t i = 0; i < sphere.size(); i += 7) {
    centers.push_back(sphere.corner(i, 0));
    centers.push_back(sphere.corner(i, 1));
    centers.push_back(3 * sphere.corner(i, 2));
    centers.push_back(-sphere.corner(i, 2));
  }
  for (const ExactForm& form : exact_forms(sphere)) {
    for (const double length : {-1e-300, -0x1p-60, -1.0, -infinity, std::nan("")}) {
      const auto constant = [&](std::size_t) { return length; };
      for (const Query query : {Query::touches, Query::nearest, Query::sweep})
        for (const Answer& answer : ask(*form.detector, query, steps_at(centers, constant, constant)))
          EXPECT_EQ(answer.found, 0) << form.name << ", " << length;
    }
  }
}

/// Bounds of the distance from above take sides for what their directions say, of which a short side has
/// little.
TEST(ExactFormsOnNeedles, TouchNothingALittleFartherThanTheRadius) {
  struct Case {
    CornerCases::Corners corners;
    Vec3 center;
  };
  const Case cases[] = {{{Vec3(0.96277979036287736, -0.42130004640573082, -0.4803880511554004),
                          Vec3(-0.19580607093100308, 0.77398841641366889, -0.44194093543785484),
                          Vec3(-0.19580607093100211, 0.77398841641366811, -0.44194093543785518)},
                         Vec3(-2.0964956311259102, 3.9336432422773036, 0.41131590918623545)},
                        {{Vec3(0.5885329697541779, -0.31224681824390799, 0.23695943493873806),
                          Vec3(-0.86592463221215077, -0.18690868540204142, -0.36329985500603978),
                          Vec3(0.5885329697541789, -0.31224681824390843, 0.23695943493873869)},
                         Vec3(-14505.668675317911, 16617.033499429657, -12533.356383146722)},
                        {{Vec3(-0.46699021822709286, -0.44853744387802408, -0.96018978951631562),
                          Vec3(-0.46699021822709252, -0.44853744387802569, -0.96018978951631651),
                          Vec3(0.66443035193545552, 0.61153190905154875, -0.24094348519444586)},
                         Vec3(-1.6141780966449399, -1.638629646414707, -2.5125177160940027)}};
  for (const auto& [corners, center] : cases) {
    Examination examination(mesh_of({corners}));
    std::vector<Step> steps;
    for (double short_of_it = 0x1p-40; short_of_it < 0.5; short_of_it *= 2) {
      steps.push_back({{corners[0], 0}, 0});  // to know of no free space
      steps.push_back({{center, examination.oracle().solve(center).high * (1 - short_of_it)}, 0});
    }
    examination.ask_all("touches", Query::touches, steps);
  }
}

/// Seen along the line from its middle through a corner, a triangle is as near as its bounding sphere, and
/// seen along an axis as its box: whether it is kept is up to the rounding of the bound.
/// Needles of all widths down to 1e-9 and of different lengths about one hub. A ball that meets the hub
/// touches all of them as early but for rounding, and one that slides is as near to most of them.
TEST(ExactFormsOverAFan, HitTheSameNeedleFirst) {
  constexpr int needles = 150;
  const double ratio = std::pow(1e-9, 1.0 / needles);
  CornerCases cases(31);
  std::vector<CornerCases::Corners> triangles;
  const Vec3 hub(0.1, 0.2, 0.5);
  double angle = 0, width = 6 * (1 - ratio);
  Vec3 rim = hub;
  for (int i = 0; i <= needles; ++i, angle += width, width *= ratio) {
    const Vec3 next(std::cos(angle) * (1 + 0.002 * i), std::sin(angle) * (1 + 0.002 * i), 0.3);
    if (i > 0) triangles.push_back({hub, rim, next});
    rim = next;
  }
  const TriangleMesh mesh = mesh_of(triangles);
  Examination examination(mesh);
  for (const double radius : {0.05, 0.0}) {
    std::vector<Vec3> way;
    while (way.size() < 240) {
      const Vec3 above = hub + Vec3(0, 0, 2 * radius) + cases.magnitude(-3, -1) * cases.vector();
      way.push_back(above);
      way.push_back(hub + (way.size() % 3 == 0 ? 0.01 : 0.0) * cases.vector());
      way.push_back(above);
      const CornerCases::Corners& needle = triangles[cases.below(needles)];
      const Vec3 up = (needle[1] - needle[0]).cross(needle[2] - needle[0]).normalized() * (radius + 1e-14);
      const Vec3 across = 0.001 * (needle[1] - needle[0]).cross(up).normalized();
      const Vec3 from = hub + 0.05 * (needle[1] - hub) + up;
      way.push_back(from - across);
      way.push_back(from + across);
    }
    const auto constant = [](double value) { return [value](std::size_t) { return value; }; };
    examination.ask_all("sweeps of " + std::to_string(radius), Query::sweep,
                        steps_at(way, constant(radius), constant(0)));
  }
}

TEST(ExactFormsInLine, LoseNothingToTheRoundingOfABound) {
  CornerCases cases(19);
  for (int triangle = 0; triangle < 30; ++triangle) {
    const CornerCases::Corners corners = cases.plain();
    Examination examination(mesh_of({corners}));
    const Vec3 middle = corners[0] + ((corners[1] - corners[0]) + (corners[2] - corners[0])) / 3;
    std::vector<Vec3> centers;
    std::vector<double> distance;
    for (int i = 0; i < 30; ++i) {
      const Vec3& corner = corners[cases.below(3)];
      centers.push_back(corner + cases.magnitude(-3, 6) * (corner - middle));
      distance.push_back(examination.oracle().solve(centers.back()).high);
    }
    const auto at = [&](std::size_t i) { return distance[i]; };
    const auto beyond = [&](std::size_t i) { return std::nextafter(distance[i], infinity); };
    examination.ask_all("nearest", Query::nearest, steps_at(centers, at, at));
    examination.ask_all("nearest, an ulp beyond", Query::nearest, steps_at(centers, at, beyond));
    examination.ask_all("touches", Query::touches, steps_at(centers, at, at));
    examination.ask_all("touches, an ulp beyond", Query::touches, steps_at(centers, beyond, at));
  }
}

/// Through triangles whose fourth powers leave the range of double, and whose squares do, up to numbers that
/// have lost digits: the fractions are those at scale 1, where it is a power of two that they are scaled by.
TEST(ExactFormsAtAnyScale, SweepAlike) {
  CornerCases cases(23);
  std::vector<CornerCases::Corners> triangles;
  for (int i = 0; i < 40; ++i) triangles.push_back(i % 4 == 0 ? cases.needle() : cases.plain());
  const TriangleMesh mesh = mesh_of(triangles);
  std::vector<Vec3> way;
  for (int i = 0; i < 60; ++i) way.push_back(i % 5 == 0 ? Vec3(1e3 * cases.vector()) : cases.vector());
  const auto asked_of = [&](double scale) {
    std::vector<Step> steps;
    for (std::size_t i = 0; i < way.size(); ++i) steps.push_back({{scale * way[i], 0.01 * scale}, 0});
    return steps;
  };
  const std::vector<Answer> plain = ask(*exact_forms(mesh).front().detector, Query::sweep, asked_of(1));
  std::size_t hits = 0;
  for (const Answer& answer : plain) hits += answer.found != 0 && answer.fraction > 0 ? 1 : 0;
  EXPECT_GT(hits, way.size() / 4);
  for (const double scale : {1e80, 1e100, 1e140, 1e200, 1e300, 1e-45, 1e-80, 1e-100, 1e-140, 1e-200, 1e-300,
                             0x1p-1040, 0x1p300, 0x1p500, 0x1p1000, 0x1p-300, 0x1p-500, 0x1p-900}) {
    SCOPED_TRACE(scale);
    Examination examination(mesh.transformed(scale, Vec3::Zero()));
    examination.ask_all("sweep", Query::sweep, asked_of(scale));
    int exponent = 0;
    if (std::frexp(scale, &exponent) != 0.5 || exponent < -1000) continue;
    const ExactForm reference = std::move(exact_forms(mesh.transformed(scale, Vec3::Zero())).front());
    const std::vector<Answer> scaled = ask(*reference.detector, Query::sweep, asked_of(scale));
    for (std::size_t i = 0; i < scaled.size(); ++i) {
      EXPECT_EQ(scaled[i].found, plain[i].found) << "step " << i;
      EXPECT_EQ(scaled[i].fraction, plain[i].fraction) << "step " << i;
      EXPECT_EQ(scaled[i].triangle, plain[i].triangle) << "step " << i;
      // At the start it is known better where doubles do not do.
      if (plain[i].fraction > 0) {
        EXPECT_EQ(scaled[i].distance, scale * plain[i].distance) << "step " << i;
      }
    }
  }
}

/// A probe that slides, hovers, presses and leaves in small steps: what a session remembers is put to use.
TEST(ExactFormsOnTheMove, AgreeAlongACoherentWay) {
  for (const TriangleMesh& mesh : {octasphere(10), plate(12).transformed(0.1, Vec3::Zero())}) {
    Examination examination(mesh);
    const double radius = 0.02;
    CornerCases cases(13);
    std::vector<Vec3> way;
    Vec3 at(0.7, 0.5, 0.6);
    for (int i = 0; i < 600; ++i) {
      const GroundTruth truth = examination.oracle().solve(at);
      const double wish = radius * (1 + 1.5 * std::sin(0.05 * i));  // in contact and out of it, slowly
      const Vec3 out = truth.direction.isZero(0) ? Vec3(Vec3::UnitZ()) : truth.direction;
      at += 0.2 * (wish - truth.high) * out + 0.004 * Vec3(std::cos(0.01 * i), std::sin(0.013 * i), 0.3) +
            1e-4 * cases.vector();
      way.push_back(at);
    }
    const auto constant = [](double value) { return [value](std::size_t) { return value; }; };
    for (const double reach : {radius, 4 * radius})
      examination.ask_all("nearest on the move", Query::nearest,
                          steps_at(way, constant(radius), constant(reach)));
    examination.ask_all("touches on the move", Query::touches, steps_at(way, constant(radius), constant(0)));
    examination.ask_all("sweeps on the move", Query::sweep, steps_at(way, constant(radius), constant(0)));
  }
}

/// Grazing, beginning an ulp beside the surface, along it and through its corners, at 2^50 times the mesh's
/// size from the origin as at it: the oracle excuses nothing.
class ExactFormsOnHardWays : public testing::TestWithParam<int> {
 protected:
  static TriangleMesh some_triangles() {
    CornerCases cases(37);
    std::vector<CornerCases::Corners> triangles;
    for (int i = 0; i < 30; ++i)
      triangles.push_back(i % 3 == 0 ? cases.needle() : i % 3 == 1 ? cases.on_lattice() : cases.plain());
    return mesh_of(triangles);
  }
};

TEST_P(ExactFormsOnHardWays, HitExactlyWhereTheyHit) {
  const Vec3 offset =
      GetParam() == 0 ? Vec3(Vec3::Zero()) : Vec3(std::ldexp(1.0, GetParam()) * Vec3(1, -0.7, 0.3));
  for (const TriangleMesh& whole : {octasphere(5), some_triangles()}) {
    const TriangleMesh mesh = whole.transformed(1, offset);
    const std::vector<Step> steps = bench::experiments::stress::CornerCaseSweeps(mesh, 41).trace(500);
    Examination(mesh).ask_all("hard ways", Query::sweep, steps);
    // Lazily made, and following from elsewhere.
    bench::contestants::ContestantOf<BruteForce> reference(BruteForce::build(mesh));
    const std::vector<Answer> expected = ask(reference, Query::sweep, steps);
    const auto expect_same = [&]<class D>(const char* name, D detector) {
      bench::contestants::ContestantOf<D> contestant(std::move(detector));
      EXPECT_EQ(first_difference(ask(contestant, Query::sweep, steps), expected), steps.size()) << name;
    };
    expect_same("grid-group, lazy", GridGroup::build(mesh, {.construction = GridGroup::Construction::lazy}));
    expect_same("sphere-cluster, lazy",
                SphereCluster::build(mesh, {.construction = SphereCluster::Construction::lazy}));
    const TriangleMesh elsewhere = whole.transformed(1.01, offset);
    const auto follow = [&]<class D>(const char* name, D detector) {
      detector.update(mesh);
      expect_same(name, std::move(detector));
    };
    follow("aabb-tree, updated", AabbTree::build(elsewhere));
    follow("grid-group, updated", GridGroup::build(elsewhere));
    follow("sphere-cluster, updated", SphereCluster::build(elsewhere));
  }
}

INSTANTIATE_TEST_SUITE_P(Offsets, ExactFormsOnHardWays, testing::Values(0, 20, 40, 50),
                         [](const auto& offset) { return "by_2_to_the_" + std::to_string(offset.param); });

template <class D>
struct Case {
  std::string name;
  typename D::Options options;
};

/// One session for two detectors, in turn.
template <class D>
void expect_no_harm_from_another_mesh(const Case<D>& form) {
  const TriangleMesh one = octasphere(6), other = octasphere(6).transformed(1, Vec3(0.05, 0, 0));
  const D first = D::build(one, form.options), second = D::build(other, form.options);
  typename D::Session shared;
  CornerCases cases(17);
  const double radius = 0.02;
  Vec3 at(1.03, 0, 0);
  for (int i = 0; i < 400; ++i) {
    at = (1.035 + 0.03 * std::sin(0.3 * i)) * (at + 0.01 * cases.vector()).normalized();
    const Probe probe{at, radius};
    for (const D* detector : {&first, &second}) {
      typename D::Session fresh, another;
      ASSERT_EQ(detector->touches(probe, shared), detector->touches(probe, fresh)) << form.name << ' ' << i;
      const auto contact = detector->nearest(probe, radius, shared),
                 expected = detector->nearest(probe, radius, another);
      ASSERT_EQ(contact.has_value(), expected.has_value()) << form.name << ' ' << i;
      if (contact) {
        ASSERT_EQ(contact->distance, expected->distance) << form.name << ' ' << i;
      }
    }
  }
}

TEST(ExactFormsInTurn, TakeNoHarmFromTheSessionOfAnotherMesh) {
  expect_no_harm_from_another_mesh<AabbTree>({"aabb-tree", {}});
  expect_no_harm_from_another_mesh<GridGroup>({"grid-group, direct", {}});
  expect_no_harm_from_another_mesh<SphereCluster>({"sphere-cluster, tree", {}});
}

}  // namespace
}  // namespace touchmark
