/// What is expected of each form of a rival, as tests with names of their own.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/baselines/answers.h"
#include "tests/baselines/asking.h"
#include "tests/baselines/meshes.h"

namespace touchmark::baselines {

/// How near a rival's answers come to the truth about the unit square.
struct Closeness {
  double rounding = 0;  ///< of distances and points; 0: the rival has a test of its own
  double reach = 0.5;   ///< surely finds what is 0.5 away
  double short_reach = 0.499;
  double radius = 0.5;  ///< surely touches what is 0.5 away
  double away = 2;      ///< where probes ask for the ids of a file
};

template <class D>
class FormTest : public testing::Test {
 public:
  using Body = std::function<void(const typename D::Options& form)>;
  FormTest(Body body, const typename D::Options& form) : body_(std::move(body)), form_(form) {}
  void TestBody() override { body_(form_); }

 private:
  Body body_;
  typename D::Options form_;
};

/// Registers the tests of each form, which are named after it. Returns true.
template <class D>
bool test_each_form(const char* suite, const std::vector<typename D::Options>& forms,
                    std::string (*name_of)(const typename D::Options& form), const Closeness& close) {
  using Form = typename D::Options;
  const auto on_square = [](auto expect) {
    return [expect](const Form& form) {
      typename D::Session session;
      expect(D::build(square(), form), session);
    };
  };
  std::vector<std::pair<std::string, typename FormTest<D>::Body>> tests{
      {"FindsNothingBeyondTheReach", on_square([close](const D& detector, auto& session) {
         expect_nothing_beyond_the_reach(detector, session, close.reach, close.short_reach);
       })},
      {"TouchesUpToTheRadius", on_square([close](const D& detector, auto& session) {
         expect_touches_up_to_the_radius(detector, session, close.radius);
       })},
      {"AProbeThatIsNotANumberTouchesNothing", on_square([](const D& detector, auto& session) {
         expect_what_is_not_a_number_to_touch_nothing(detector, session);
       })},
      {"GivesTheIdsOfTheFile",
       [close](const Form& form) {
         expect_the_ids_of_the_file([&](const TriangleMesh& mesh) { return D::build(mesh, form); },
                                    close.away);
       }},
      {"AUsedSessionAndAFreshOneGiveTheSameBits",
       [](const Form& form) {
         expect_used_and_fresh_sessions_to_give_the_same_bits(D::build(bumps(12), form));
       }},
      {"AskingTheBoxAndTheLastTriangleFirstChangesNoAnswer", [](const Form& form) {
         expect_asking_changes_no_answer<D>(bumps(12), form);
         expect_asking_changes_no_answer<D>(soup(120, 4), form);
         expect_asking_to_save_work<D>(form);
       }}};
  if (close.rounding > 0)
    tests.emplace_back("FindsTheTriangleBelowTheProbe", on_square([close](const D& detector, auto& session) {
                         expect_the_triangle_below_the_probe(detector, session, close.rounding);
                       }));
  for (const Form& form : forms)
    for (const auto& [name, body] : tests)
      testing::RegisterTest(suite, (name + '/' + name_of(form)).c_str(), nullptr, nullptr, __FILE__, __LINE__,
                            [body = body, form]() -> FormTest<D>* { return new FormTest<D>(body, form); });
  return true;
}

}  // namespace touchmark::baselines
