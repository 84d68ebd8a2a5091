// What a session remembers changes the cost, never the answer: a fresh session for every probe, one used
// session, and several threads with a session each give the bits that brute force gives.
#include <cstdint>
#include <cstring>
#include <future>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bench/contestants/contestant.h"
#include "bench/workload/answer.h"
#include "core/float_limits.h"
#include "tests/conformance_meshes.h"
#include "tests/own_forms.h"

namespace touchmark {
namespace {

using bench::contestants::Contestant;
using bench::workload::Answer;
using bench::workload::Query;
using bench::workload::QueryTrace;

/// Four questions of each centre in turn, so that a session sees them mixed.
class Questions {
 public:
  Questions(const std::vector<Vec3>& centers, double radius) {
    for (const Vec3& center : centers) {
      within_radius_.push_back({{center, radius}, radius});
      at_any_reach_.push_back({{center, radius}, infinity});
    }
  }

  std::size_t size() const { return within_radius_.size(); }

  void ask(Contestant& contestant, std::size_t i, std::vector<Answer>& answers) const {
    std::uint64_t work;
    for (const QueryTrace& trace :
         {QueryTrace{Query::nearest, within_radius_}, QueryTrace{Query::nearest, at_any_reach_},
          QueryTrace{Query::touches, within_radius_}, QueryTrace{Query::sweep, within_radius_}}) {
      Answer& answer = answers.emplace_back();
      contestant.answer(trace, {i, i + 1}, std::span(&answer, 1), std::span(&work, 1));
    }
  }

 private:
  std::vector<bench::workload::Step> within_radius_, at_any_reach_;
};

std::vector<Answer> answers_of_one_session(const Contestant& shared, const Questions& questions) {
  const std::unique_ptr<Contestant> contestant = shared.share();
  std::vector<Answer> answers;
  for (std::size_t i = 0; i < questions.size(); ++i) questions.ask(*contestant, i, answers);
  return answers;
}

std::vector<Answer> answers_of_fresh_sessions(Contestant& contestant, const Questions& questions) {
  std::vector<Answer> answers;
  for (std::size_t i = 0; i < questions.size(); ++i) {
    contestant.forget();
    questions.ask(contestant, i, answers);
  }
  return answers;
}

/// The first answer that differs in any bit; none: their number.
std::size_t first_difference(const std::vector<Answer>& a, const std::vector<Answer>& b) {
  std::size_t i = 0;
  while (i < a.size() && i < b.size() && std::memcmp(&a[i], &b[i], sizeof(Answer)) == 0) ++i;
  return i;
}

class Sessions : public testing::TestWithParam<std::string> {};

TEST_P(Sessions, GiveTheBitsOfBruteForceFreshUsedAndInThreads) {
  const TriangleMesh mesh = bench::meshes::load_mesh(GetParam());
  // An eighth, since each is asked up to eight times of some twenty detectors.
  const Questions questions(adversarial_centers(mesh, affordable(mesh) / 8), 0.005 * mesh.diagonal());
  std::vector<Answer> expected;
  for (const ExactForm& form : exact_forms(mesh)) {
    const std::vector<Answer> fresh = answers_of_fresh_sessions(*form.detector, questions);
    if (expected.empty()) expected = fresh;  // brute force is the first
    EXPECT_EQ(first_difference(fresh, expected), expected.size()) << form.name << ", fresh sessions";
    EXPECT_EQ(first_difference(answers_of_one_session(*form.detector, questions), expected), expected.size())
        << form.name << ", one session";
    // Scans look at everything and remember nothing: two threads show what they share.
    std::vector<std::future<std::vector<Answer>>> threads;
    for (int i = form.as_published ? 2 : 6; i > 0; --i) {
      threads.push_back(
          std::async(std::launch::async, [&] { return answers_of_one_session(*form.detector, questions); }));
    }
    for (auto& thread : threads)
      EXPECT_EQ(first_difference(thread.get(), expected), expected.size()) << form.name << ", in threads";
  }
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Meshes, Sessions, testing::ValuesIn(conformance_meshes()), test_name);
INSTANTIATE_TEST_SUITE_P(Resized, Sessions, testing::ValuesIn(resized_meshes()), test_name);

}  // namespace
}  // namespace touchmark
