// Every contestant of the roster on every small mesh, ours with every option, judged by the oracle. Those
// that claim exactness must keep their word; ours must give brute force's bits besides. Rivals, in the forms
// that are compared by default, answer in processes of their own.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <new>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench/contestants/built_in.h"
#include "bench/contestants/contestant_of.h"
#include "bench/oracle/judge.h"
#include "core/brute_force/brute_force.h"
#include "core/float_limits.h"
#include "tests/conformance_meshes.h"

namespace touchmark::bench {
namespace {

/// One query along all centres, with one reach.
struct Part {
  std::string name;
  workload::Query query;
  double reach;
  std::vector<workload::Step> steps;
};

std::vector<Probe> probes_of(const Part& part) {
  std::vector<Probe> probes;
  for (const workload::Step& step : part.steps) probes.push_back(step.probe);
  return probes;
}

std::vector<Sweep> sweeps_of(const Part& part) {
  std::vector<Sweep> sweeps;
  for (std::size_t i = 0; i < part.steps.size(); ++i) {
    const Probe& now = part.steps[i].probe;
    sweeps.push_back({part.steps[i > 0 ? i - 1 : 0].probe.center, now.center, now.radius});
  }
  return sweeps;
}

/// A mesh with its truth, found out once for all contestants.
class Exam {
 public:
  explicit Exam(const std::string& mesh_name) : mesh_(meshes::load_mesh(mesh_name)), oracle_(mesh_) {
    const std::vector<Vec3> centers = adversarial_centers(mesh_, affordable(mesh_));
    for (const Vec3& center : centers) truths_.push_back(oracle_.solve(center));
    const double radius = 0.005 * mesh_.diagonal();
    const auto part = [&](const char* name, workload::Query query, double reach, auto radius_at) {
      Part made{name, query, reach, {}};
      for (std::size_t i = 0; i < centers.size(); ++i)
        made.steps.push_back({{centers[i], radius_at(truths_[i].high)}, reach});
      parts_.push_back(std::move(made));
    };
    part("nearest within a radius", workload::Query::nearest, radius, [&](double) { return radius; });
    part("nearest at any reach", workload::Query::nearest, infinity, [&](double) { return radius; });
    part("nearest within nothing", workload::Query::nearest, 0, [&](double) { return 0.0; });
    part("touches", workload::Query::touches, 0, [&](double) { return radius; });
    part("touches at the very distance", workload::Query::touches, 0, [](double d) { return d; });
    part("touches an ulp short of it", workload::Query::touches, 0,
         [](double d) { return std::nextafter(d, 0); });
    part("sweep", workload::Query::sweep, 0, [&](double) { return radius; });
    part("sweep of a point", workload::Query::sweep, 0, [](double) { return 0.0; });
    for (const Part& one : parts_)
      sweep_truths_.push_back(one.query == workload::Query::sweep ? oracle_.solve(sweeps_of(one))
                                                                  : std::vector<oracle::SweepGroundTruth>());
  }

  const TriangleMesh& mesh() const { return mesh_; }
  const std::vector<Part>& parts() const { return parts_; }

  oracle::ErrorCounts judge_answers(std::size_t part, const std::vector<workload::Answer>& answers,
                                    const Accuracy& accuracy) const {
    const Part& asked = parts_[part];
    if (asked.query == workload::Query::sweep)
      return oracle::judge(oracle_, sweep_truths_[part], sweeps_of(asked), answers, accuracy);
    return oracle::judge(oracle_, truths_, asked.query, probes_of(asked), asked.reach, answers, accuracy);
  }

 private:
  TriangleMesh mesh_;
  oracle::Oracle oracle_;
  std::vector<oracle::GroundTruth> truths_;
  std::vector<Part> parts_;
  std::vector<std::vector<oracle::SweepGroundTruth>> sweep_truths_;
};

/// What the oracle says of answers, found out once for all contestants that give the same bits and claim the
/// same: most of ours do.
class Verdicts {
 public:
  explicit Verdicts(const Exam& exam) : exam_(exam), given_(exam.parts().size()) {}

  const oracle::ErrorCounts& on(std::size_t part, const std::vector<workload::Answer>& answers,
                                const Accuracy& accuracy) {
    for (const Verdict& known : given_[part])
      if (same(known.accuracy, accuracy) && same(known.answers, answers)) return known.counts;
    given_[part].push_back({accuracy, answers, exam_.judge_answers(part, answers, accuracy)});
    return given_[part].back().counts;
  }

 private:
  struct Verdict {
    Accuracy accuracy;
    std::vector<workload::Answer> answers;
    oracle::ErrorCounts counts;
  };
  static bool same(const Accuracy& a, const Accuracy& b) {
    return a.guarantee == b.guarantee && a.relative == b.relative && a.absolute == b.absolute &&
           a.decides_exactly == b.decides_exactly && a.names_exactly == b.names_exactly;
  }
  static bool same(const std::vector<workload::Answer>& a, const std::vector<workload::Answer>& b) {
    return std::memcmp(a.data(), b.data(), a.size() * sizeof(workload::Answer)) == 0;
  }

  const Exam& exam_;
  std::vector<std::vector<Verdict>> given_;  ///< of each part
};

std::vector<workload::Answer> ask(contestants::Contestant& contestant, const Part& part) {
  std::vector<workload::Answer> answers(part.steps.size());
  std::vector<std::uint64_t> work(answers.size());
  contestant.answer({part.query, part.steps}, {0, answers.size()}, answers, work);
  return answers;
}

/// How a rival fared in a process of its own, part by part.
struct Testimony {
  enum class State { not_reached, unsupported, answered } state;
  Accuracy accuracy;
};

/// Room that a child process can write to: a testimony a part, then all answers.
class SharedRoom {
 public:
  SharedRoom(std::size_t parts, std::size_t answers)
      : parts_(parts),
        bytes_(parts * sizeof(Testimony) + parts * answers * sizeof(workload::Answer)),
        memory_(mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)) {
    if (memory_ == MAP_FAILED) throw std::bad_alloc();
  }
  SharedRoom(const SharedRoom&) = delete;
  SharedRoom& operator=(const SharedRoom&) = delete;
  ~SharedRoom() { munmap(memory_, bytes_); }

  Testimony* testimonies() const { return static_cast<Testimony*>(memory_); }
  workload::Answer* answers() const {
    return reinterpret_cast<workload::Answer*>(static_cast<std::byte*>(memory_) + parts_ * sizeof(Testimony));
  }

 private:
  std::size_t parts_;
  std::size_t bytes_;
  void* memory_;
};

/// The child's life: builds and answers from part `first` on. Its exit says how it went if it is not
/// killed.
[[noreturn]] void testify(const contestants::ContestantSpec& spec, const Exam& exam, std::size_t first,
                          const SharedRoom& room) {
  constexpr unsigned timeout_s = 20;
  constexpr int refused = 3;
  alarm(timeout_s);
  if (std::freopen("/dev/null", "w", stdout) == nullptr || std::freopen("/dev/null", "w", stderr) == nullptr)
    _exit(1);
  try {
    const auto contestant = contestants::roster().build(spec, exam.mesh());
    for (std::size_t i = first; i < exam.parts().size(); ++i) {
      const Part& part = exam.parts()[i];
      Testimony& testimony = room.testimonies()[i];
      testimony.accuracy = contestant->accuracy();
      if (!contestant->answers(part.query)) {
        testimony.state = Testimony::State::unsupported;
        continue;
      }
      const std::vector<workload::Answer> answers = ask(*contestant, part);
      std::copy(answers.begin(), answers.end(), room.answers() + i * part.steps.size());
      testimony.state = Testimony::State::answered;
    }
  } catch (...) {
    _exit(refused);
  }
  _exit(0);
}

/// Calls judged(part, testimony, answers) for every part that a rival ended, and ended(part, status)
/// for those it did not survive. In child processes, since some abort, divide by zero or never end.
template <class Judged, class Ended>
void examine_in_processes(const contestants::ContestantSpec& spec, const Exam& exam, const Judged& judged,
                          const Ended& ended) {
  const std::size_t parts = exam.parts().size(), steps = exam.parts().front().steps.size();
  const SharedRoom room(parts, steps);
  // It loads the contestant's library once for all children.
  contestants::roster().prepare_to_build(spec, exam.mesh().size());
  for (std::size_t next = 0; next < parts;) {
    const pid_t child = fork();
    if (child == 0) testify(spec, exam, next, room);
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    while (next < parts && room.testimonies()[next].state != Testimony::State::not_reached) {
      if (room.testimonies()[next].state == Testimony::State::answered) {
        const workload::Answer* answers = room.answers() + next * steps;
        judged(next, room.testimonies()[next].accuracy,
               std::vector<workload::Answer>(answers, answers + steps));
      }
      ++next;
    }
    if (next == parts) return;
    if (WIFSIGNALED(status)) {
      ended(next++, "signal " + std::to_string(WTERMSIG(status)));
    } else {
      ended(next, "exit " + std::to_string(WEXITSTATUS(status)));
      return;  // it refuses the mesh
    }
  }
}

/// Those that do not change where is looked, or go with the defaults of others only, or only steer which form
/// is chosen: each value is tried beside the defaults of all others.
bool stands_alone(const contestants::OptionInfo& option) {
  for (const char* key : {"side", "certified", "build", "simd", "precision", "query", "reach", "speed"})
    if (option.key == key) return true;
  return false;
}

/// With an option that another one leaves without a meaning: the shape is of groups that are scanned, and
/// only a tree prepares.
bool repeats_another(const contestants::ContestantSpec& spec) {
  const auto has = [&](const char* choice) { return spec.options.find(choice) != std::string::npos; };
  return (has("lookup=direct") && has("shape=sphere")) || (has("lookup=scan") && has("prepare=true"));
}

/// A length has its default and 3 % of the diagonal.
std::vector<std::string> values_of(const contestants::OptionInfo& option) {
  if (option.kind == contestants::OptionKind::length) return {option.default_value, "3%"};
  return option.choices;
}

/// The error of a field: one as small as its default takes seconds to build on a mesh of needles, so the
/// default is asked by itself, and combinations have the other value.
bool takes_long(const contestants::OptionInfo& option) { return option.key == "error"; }

/// The default, every combination of values that differs from the others, and each value of those that stand
/// alone.
std::vector<contestants::ContestantSpec> every_option(const contestants::ContestantInfo& info) {
  std::vector<std::string> combined = {info.name};
  std::vector<std::string> alone;
  for (const contestants::OptionInfo& option : info.options) {
    std::vector<std::string> values = values_of(option);
    if (takes_long(option)) {
      alone.push_back(info.name);
      std::erase(values, option.default_value);
    }
    if (stands_alone(option)) {
      std::erase(values, option.default_value);
      for (const std::string& value : values) alone.push_back(info.name + ":" + option.key + "=" + value);
    } else if (!values.empty()) {
      std::vector<std::string> longer;
      for (const std::string& text : combined)
        for (const std::string& value : values)
          longer.push_back(text + (text == info.name ? ":" : ",") + option.key + "=" + value);
      combined = longer;
    }
  }
  std::vector<contestants::ContestantSpec> specs;
  for (const auto* texts : {&combined, &alone})
    for (const std::string& text : *texts) specs.push_back(contestants::roster().parse(text));
  std::erase_if(specs, repeats_another);
  return specs;
}

/// Those that are compared by default; of a rival that is not, those that are verified.
std::vector<contestants::ContestantSpec> rivals_asked() {
  std::vector<contestants::ContestantSpec> specs;
  for (const contestants::ContestantInfo& info : contestants::roster().contestants()) {
    if (info.ours || !info.built()) continue;
    for (const std::string& options : info.forms.compared.empty() ? info.forms.verified : info.forms.compared)
      specs.push_back(contestants::roster().parse(options.empty() ? info.name : info.name + ":" + options));
  }
  return specs;
}

std::string summary(const oracle::ErrorCounts& t) {
  return fmt::format(
      "{} missed, {} false, {} wrong triangle, {} beyond, {} point, {} normal, {} malformed; {}", t.missed,
      t.false_contacts, t.wrong_triangle, t.beyond_bound, t.wrong_point, t.wrong_normal, t.malformed,
      t.max_distance_error);
}

class Conformance : public testing::TestWithParam<std::string> {};

TEST_P(Conformance, OursKeepTheirWordAndTheExactOnesGiveTheBitsOfBruteForce) {
  const Exam exam(GetParam());
  Verdicts verdicts(exam);
  const BruteForce reference = BruteForce::build(exam.mesh());
  contestants::ContestantOf<BruteForce> brute_force(reference);
  std::vector<std::vector<workload::Answer>> expected;
  for (const Part& part : exam.parts()) expected.push_back(ask(brute_force, part));
  for (const contestants::ContestantInfo& info : contestants::roster().contestants()) {
    if (!info.ours || info.scenes_only) continue;
    for (const contestants::ContestantSpec& spec : every_option(info)) {
      const auto contestant = contestants::roster().build(spec, exam.mesh());
      const Accuracy accuracy = contestant->accuracy();
      for (std::size_t i = 0; i < exam.parts().size(); ++i) {
        const Part& part = exam.parts()[i];
        if (!contestant->answers(part.query)) continue;
        std::vector<workload::Answer> answers = ask(*contestant, part);
        const oracle::ErrorCounts counts = verdicts.on(i, answers, accuracy);
        EXPECT_TRUE(oracle::meets_guarantee(counts, accuracy))
            << spec.text() << ", " << part.name << ": " << summary(counts);
        if (accuracy.guarantee != Guarantee::exact || !accuracy.decides_exactly) continue;
        for (workload::Answer& answer : answers) answer.side = Side::unasked;  // the reference was not asked
        EXPECT_EQ(std::memcmp(answers.data(), expected[i].data(), answers.size() * sizeof(workload::Answer)),
                  0)
            << spec.text() << ", " << part.name;
      }
    }
  }
}

/// What a rival did not survive, and what it gets wrong without claiming otherwise, is printed: verify counts
/// it.
TEST_P(Conformance, RivalsThatClaimExactnessKeepTheirWord) {
  const Exam exam(GetParam());
  Verdicts verdicts(exam);
  for (const contestants::ContestantSpec& spec : rivals_asked()) {
    const auto judged = [&](std::size_t i, const Accuracy& accuracy,
                            const std::vector<workload::Answer>& answers) {
      const oracle::ErrorCounts counts = verdicts.on(i, answers, accuracy);
      const std::string finding =
          fmt::format("{}, {}: {}", spec.text(), exam.parts()[i].name, summary(counts));
      if (accuracy.guarantee == Guarantee::exact) {
        EXPECT_TRUE(oracle::meets_guarantee(counts, accuracy)) << finding;
      } else if (!oracle::meets_guarantee(counts, {Guarantee::exact, accuracy.relative, accuracy.absolute})) {
        fmt::print("    faulty: {}\n", finding);
      }
    };
    const auto ended = [&](std::size_t i, const std::string& how) {
      fmt::print("    ended: {}, {}: {}\n", spec.text(), exam.parts()[i].name, how);
    };
    examine_in_processes(spec, exam, judged, ended);
  }
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Meshes, Conformance, testing::ValuesIn(conformance_meshes()), test_name);
INSTANTIATE_TEST_SUITE_P(Resized, Conformance, testing::ValuesIn(resized_meshes()), test_name);

}  // namespace
}  // namespace touchmark::bench
