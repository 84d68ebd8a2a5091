// Ours: core/haptics/proxy.h over one of our detectors, as a contestant of the suite.
#include "bench/proxies/certified.h"

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "bench/contestants/built_in.h"
#include "bench/contestants/guided_proxy.h"
#include "bench/proxies/methods.h"

namespace touchmark::bench::proxies {
namespace {

Status status_of(ProxyStatus status) {
  switch (status) {
    case ProxyStatus::free:
      return Status::free;
    case ProxyStatus::in_contact:
      return Status::in_contact;
    case ProxyStatus::stuck:
      return Status::stuck;
    case ProxyStatus::unanswered:
      break;
  }
  return Status::no_answer;
}

/// Asks for the nearest and keeps a session of its own.
class BareQuery {
 public:
  explicit BareQuery(std::unique_ptr<contestants::Contestant> contestant)
      : contestant_(std::move(contestant)) {}

  void ask(const Vec3& goal) {
    step_[0] = {{goal, 0}, std::numeric_limits<double>::infinity()};
    contestant_->answer({workload::Query::nearest, step_}, {0, 1}, answer_, work_);
  }
  void update(const TriangleMesh& mesh) { contestant_->update(mesh); }

 private:
  std::unique_ptr<contestants::Contestant> contestant_;
  std::array<workload::Step, 1> step_{};
  std::array<workload::Answer, 1> answer_{};
  std::array<std::uint64_t, 1> work_{};
};

class Certified final : public ProxyMethod {
 public:
  Certified(std::unique_ptr<contestants::Contestant> contestant, BareQuery bare, const TriangleMesh& mesh,
            const Coupling& coupling)
      : bare_(std::move(bare)), proxy_(std::move(contestant), mesh, coupling) {}

  void place(const Vec3& position) override { proxy_.place(position); }
  void step(const Vec3& goal, Step& step) override { take(proxy_.step(goal), step); }
  void update(const TriangleMesh& mesh) override {
    bare_.update(mesh);
    proxy_.update(mesh);
  }
  bool ask_nearest(const Vec3& goal) override { return bare_.ask(goal), true; }
  std::uint64_t work() const override { return proxy_.work().total(); }

 private:
  BareQuery bare_;
  contestants::GuidedProxy proxy_;
};

}  // namespace

void take(const ProxyState& state, Step& step) {
  step.way.assign(state.way.begin(), state.way.begin() + static_cast<std::ptrdiff_t>(state.pieces + 1));
  step.contacts = state.contacts;
  step.force = state.force;
  step.status = status_of(state.status);
}

std::unique_ptr<ProxyMethod> certified_method(const MethodRequest& request) {
  if (!request.bodies.empty())
    if (std::unique_ptr<ProxyMethod> over_bodies = certified_over_bodies(request)) return over_bodies;
  const contestants::ContestantSpec spec = request.roster.parse(request.detector);
  std::unique_ptr<contestants::Contestant> built = request.roster.build(spec, request.mesh);
  if (!built->guides_proxy())
    throw std::invalid_argument(fmt::format(
        "{} does not answer touches, sweep and contacts, so our proxy cannot run on it", request.detector));
  BareQuery bare(request.roster.build(spec, request.mesh));
  return std::make_unique<Certified>(std::move(built), std::move(bare), request.mesh, request.coupling);
}

}  // namespace touchmark::bench::proxies
