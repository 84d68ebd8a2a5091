#include "tests/bench/workers/hostile_roster.h"

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include <unistd.h>

#include "bench/contestants/contestant_of.h"
#include "core/brute_force/brute_force.h"
#include "core/sphere_cluster/sphere_cluster.h"

namespace touchmark::bench::workers {
namespace {

[[noreturn]] void hang() {
  for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
}

/// What the answers so far have cost, in the nanoseconds that their contestants claim to need.
std::atomic<std::int64_t> spent_ns = 0;

struct Honest {
  static void at_build() {}
  static std::optional<Contact> at_answer(std::optional<Contact> contact) { return contact; }
  static std::int64_t cost_ns() { return 10000; }
};

/// BruteForce, with something that happens to each answer of `nearest`.
template <class Misdeed>
class Misbehaving {
 public:
  struct Options {};
  using Session = BruteForce::Session;

  static Misbehaving build(const TriangleMesh& mesh, const Options&) {
    Misdeed::at_build();
    return Misbehaving(BruteForce::build(mesh));
  }
  std::optional<Contact> nearest(const Probe& probe, double reach, Session& session) const noexcept {
    spent_ns += Misdeed::cost_ns();
    return Misdeed::at_answer(detector_.nearest(probe, reach, session));
  }
  std::size_t bytes() const noexcept { return detector_.bytes(); }
  Accuracy accuracy() const noexcept { return detector_.accuracy(); }

 private:
  explicit Misbehaving(BruteForce detector) : detector_(std::move(detector)) {}
  BruteForce detector_;
};

struct Aborts : Honest {
  static std::optional<Contact> at_answer(const std::optional<Contact>&) { std::abort(); }
};
struct AbortsAtBuild : Honest {
  static void at_build() { std::abort(); }
};
struct DividesByZero : Honest {
  static std::optional<Contact> at_answer(const std::optional<Contact>&) {
    std::raise(SIGFPE);  // what an integer division by zero does, without the undefined behaviour
    return std::nullopt;
  }
};
struct Throws : Honest {
  static std::optional<Contact> at_answer(const std::optional<Contact>&) {
    throw std::runtime_error("from a query that is noexcept");
  }
};
struct Exits : Honest {
  static std::optional<Contact> at_answer(const std::optional<Contact>&) { _exit(7); }
};
struct Hangs : Honest {
  static std::optional<Contact> at_answer(const std::optional<Contact>&) { hang(); }
};
/// Hangs where nothing is within reach.
struct HangsFarAway : Honest {
  static std::optional<Contact> at_answer(const std::optional<Contact>& contact) {
    if (!contact) hang();
    return contact;
  }
};
struct HangsAtBuild : Honest {
  static void at_build() { hang(); }
};
struct Refuses : Honest {
  static void at_build() { throw std::invalid_argument("no mesh is good enough"); }
};
struct Lies : Honest {
  static std::optional<Contact> at_answer(std::optional<Contact> contact) {
    if (contact) contact->distance *= 1.0001;
    return contact;
  }
};
/// Right while it is being verified, wrong when it is timed. Verifying 40 steps takes fewer than 200 answers.
struct Fickle : Honest {
  static std::optional<Contact> at_answer(std::optional<Contact> contact) {
    static std::atomic<int> answers = 0;
    if (contact && ++answers > 200) contact->distance = 0;
    return contact;
  }
};

const char* environment(const char* name, const char* otherwise) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : otherwise;
}

/// As slow as the test says.
struct Paced : Honest {
  static std::int64_t cost_ns() {
    static const int cost = std::atoi(environment("TOUCHMARK_TEST_COST_NS", "10000"));
    return cost;
  }
};
/// Slower by another process: each build, counted in a file, adds to it.
struct Moody : Honest {
  static void at_build() {
    std::FILE* const file = std::fopen(environment("TOUCHMARK_TEST_COUNTER", "/dev/null"), "ab");
    if (file == nullptr) return;
    std::fputc('x', file);
    builds() = std::ftell(file);
    std::fclose(file);
  }
  static std::int64_t cost_ns() { return 10000 * builds(); }
  static long& builds() {
    static long count = 1;
    return count;
  }
};

/// Says in a file that it is being built, and then does not answer.
struct Stalls : Moody {
  static std::optional<Contact> at_answer(const std::optional<Contact>&) { hang(); }
};

/// Its word is that distances are right to a thousandth. The first answer of a session and later ones differ
/// by `Change`, given how many came before.
template <double (*Change)(int before)>
class ByHistory {
 public:
  struct Options {};
  struct Session : BruteForce::Session {
    int answers = 0;
  };

  static ByHistory build(const TriangleMesh& mesh, const Options&) {
    return ByHistory(BruteForce::build(mesh));
  }
  std::optional<Contact> nearest(const Probe& probe, double reach, Session& session) const noexcept {
    spent_ns += Honest::cost_ns();
    std::optional<Contact> contact = detector_.nearest(probe, reach, session);
    if (contact) contact->distance *= 1 + Change(session.answers);
    ++session.answers;
    return contact;
  }
  std::size_t bytes() const noexcept { return detector_.bytes(); }
  Accuracy accuracy() const noexcept { return {Guarantee::exact, 1e-3, 0, false, false}; }

 private:
  explicit ByHistory(BruteForce detector) : detector_(std::move(detector)) {}
  BruteForce detector_;
};

double once(int before) { return before == 0 ? 0 : 1e-6; }
double ever_more(int before) { return 1e-9 * before; }
double much(int before) { return before < 40 ? 0 : 0.1; }  // 40: the steps of the tests

struct TouchesOnly {
  struct Options {};
  using Session = BruteForce::Session;
  BruteForce detector;
  static TouchesOnly build(const TriangleMesh& mesh, const Options&) { return {BruteForce::build(mesh)}; }
  bool touches(const Probe& probe, Session& session) const noexcept {
    return detector.touches(probe, session);
  }
  std::size_t bytes() const noexcept { return detector.bytes(); }
  Accuracy accuracy() const noexcept { return detector.accuracy(); }
};

template <Detector D>
contestants::ContestantInfo contestant(std::string name) {
  contestants::ContestantInfo info;
  info.name = std::move(name);
  info.accuracy = "exact";
  info.queries = contestants::queries_of<D>();
  info.build = [](const TriangleMesh& mesh,
                  const contestants::OptionValues&) -> std::unique_ptr<contestants::Contestant> {
    return std::make_unique<contestants::ContestantOf<D>>(D::build(mesh, {}));
  };
  info.worker_program = [](const contestants::OptionValues&) { return "touchmark-hostile-worker"; };
  return info;
}

contestants::ContestantInfo honest() {
  contestants::ContestantInfo info = contestant<Misbehaving<Honest>>("honest");
  info.forms.compared = {""};
  return info;
}

contestants::ContestantInfo makes_later() {
  contestants::ContestantInfo info = contestant<SphereCluster>("makes-later");
  info.build = [](const TriangleMesh& mesh,
                  const contestants::OptionValues&) -> std::unique_ptr<contestants::Contestant> {
    return std::make_unique<contestants::ContestantOf<SphereCluster>>(
        SphereCluster::build(mesh, {.construction = SphereCluster::Construction::lazy}));
  };
  return info;
}

}  // namespace

std::int64_t hostile_ns() noexcept { return spent_ns; }

const contestants::Roster& hostile_roster() {
  static const contestants::Roster all({honest(),
                                        contestant<Misbehaving<Aborts>>("aborts"),
                                        contestant<Misbehaving<AbortsAtBuild>>("aborts-at-build"),
                                        contestant<Misbehaving<DividesByZero>>("divides-by-zero"),
                                        contestant<Misbehaving<Throws>>("throws"),
                                        contestant<Misbehaving<Exits>>("exits"),
                                        contestant<Misbehaving<Hangs>>("hangs"),
                                        contestant<Misbehaving<HangsFarAway>>("hangs-far-away"),
                                        contestant<Misbehaving<HangsAtBuild>>("hangs-at-build"),
                                        contestant<Misbehaving<Refuses>>("refuses"),
                                        contestant<Misbehaving<Lies>>("lies"),
                                        contestant<Misbehaving<Fickle>>("fickle"),
                                        contestant<TouchesOnly>("touches-only"),
                                        contestant<Misbehaving<Paced>>("paced"),
                                        contestant<Misbehaving<Moody>>("moody"),
                                        contestant<Misbehaving<Stalls>>("stalls"),
                                        makes_later(),
                                        contestant<ByHistory<once>>("settles"),
                                        contestant<ByHistory<ever_more>>("drifts"),
                                        contestant<ByHistory<much>>("lies-later")});
  return all;
}

}  // namespace touchmark::bench::workers
