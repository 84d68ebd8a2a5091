#include <array>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "bench/contestants/roster.h"
#include "bench/proxies/sweeper.h"

namespace touchmark::bench::proxies {
namespace {

class ContestantSweeper final : public Sweeper {
 public:
  explicit ContestantSweeper(std::unique_ptr<contestants::Contestant> contestant)
      : contestant_(std::move(contestant)) {}

  std::optional<SweepHit> first_hit(const Vec3& from, const Vec3& to, double radius) override {
    const std::array<workload::Step, 2> steps{workload::Step{{from, radius}, 0},
                                              workload::Step{{to, radius}, 0}};
    std::array<workload::Answer, 1> answer;
    std::array<std::uint64_t, 1> work{};
    contestant_->answer({workload::Query::sweep, steps}, {1, 2}, answer, work);
    work_ += work[0];
    if (answer[0].found == 0) return std::nullopt;
    const Vec3 normal(answer[0].normal[0], answer[0].normal[1], answer[0].normal[2]);
    return SweepHit{answer[0].fraction, normal, answer[0].triangle};
  }
  void update(const TriangleMesh& mesh) override { contestant_->update(mesh); }
  std::uint64_t work() const override { return work_; }

 private:
  std::unique_ptr<contestants::Contestant> contestant_;
  std::uint64_t work_ = 0;
};

}  // namespace

std::unique_ptr<Sweeper> sweeper_of(const contestants::Roster& roster, const std::string& contestant,
                                    const TriangleMesh& mesh) {
  const contestants::ContestantSpec spec = roster.parse(contestant);
  std::unique_ptr<contestants::Contestant> built = roster.build(spec, mesh);
  if (!built->answers(workload::Query::sweep))
    throw std::invalid_argument(fmt::format("{} answers no sweep, so no proxy can run on it", contestant));
  return std::make_unique<ContestantSweeper>(std::move(built));
}

}  // namespace touchmark::bench::proxies
