/// What is in a sample's time, told by the order of the calls.
#include "bench/workers/timing/throughput.h"

#include <cstddef>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "bench/contestants/contestant_of.h"
#include "bench/meshes/meshes.h"

namespace touchmark::bench::workers {
namespace {

/// Notes where its bodies are placed, and that it is asked.
class Noting {
 public:
  struct Options {};
  struct Session {
    Work work;
    std::uint32_t body = 0;
  };
  static constexpr int asked = -1;

  explicit Noting(std::vector<int>& notes) : notes_(&notes) {}
  static Noting build(const TriangleMesh&, const Options&) { throw MeshError("it is made of its notes"); }
  std::optional<Contact> nearest(const Probe&, double, Session&) const noexcept {
    notes_->push_back(asked);
    return std::nullopt;
  }
  bool stand_at(const scenes::ScheduleView*, std::size_t step) noexcept {
    notes_->push_back(static_cast<int>(step));
    return true;
  }
  std::size_t bytes() const noexcept { return 0; }
  Accuracy accuracy() const noexcept { return {}; }

 private:
  std::vector<int>* notes_;
};

// What moves before a range's first step is placed after the clock has started: from the step before.
TEST(Throughput, ASampleOfOneStepPlacesWhatMovedBeforeIt) {
  initialize_throughput({});
  std::vector<int> notes;
  contestants::ContestantOf<Noting> contestant{Noting(notes)};
  const std::vector<workload::Step> steps(12);
  const scenes::Schedule schedule;
  const scenes::ScheduleView view = schedule.view();
  const workload::QueryTrace trace{workload::Query::nearest, steps, &view};
  sample_throughput(contestant, trace, {{0, 1}, {5, 6}, {9, 11}}, 1, 1);
  constexpr int asked = Noting::asked;
  const std::vector<int> once{0, 0, asked, 4, 5, asked, 8, 9, asked, 10, asked};
  const std::vector<int> warm_up{9, asked, 10, asked};
  std::vector<int> expected = warm_up;
  expected.insert(expected.end(), once.begin(), once.end());
  EXPECT_EQ(notes, expected);
}

}  // namespace
}  // namespace touchmark::bench::workers
