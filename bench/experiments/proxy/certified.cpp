// Ours: core/haptics/proxy.h over one of our detectors, as a contestant of the suite.
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "bench/contestants/roster.h"
#include "bench/experiments/proxy/methods.h"
#include "core/haptics/force_shading.h"
#include "core/haptics/proxy.h"

namespace touchmark::bench::experiments::proxy {
namespace {

/// Any contestant as a detector that a proxy can ask. Its session is its own.
class AskedContestant {
 public:
  struct Session {};

  explicit AskedContestant(std::unique_ptr<contestants::Contestant> contestant)
      : contestant_(std::move(contestant)) {}

  bool touches(const Probe& probe, Session&) const noexcept { return contestant_->touches(probe); }
  std::optional<Impact> first_hit(const Sweep& sweep, Session&) const noexcept {
    return contestant_->first_hit(sweep);
  }
  std::size_t contacts(const Probe& probe, double reach, Session&, std::span<Contact> into) const noexcept {
    return contestant_->contacts(probe, reach, into);
  }
  void update(const TriangleMesh& mesh) { contestant_->update(mesh); }
  std::uint64_t work() const { return contestant_->work().total(); }

 private:
  std::unique_ptr<contestants::Contestant> contestant_;
};

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
  Certified(AskedContestant detector, BareQuery bare, const TriangleMesh& mesh, const Coupling& coupling)
      : mesh_(mesh),
        shading_(mesh_),
        detector_(std::move(detector)),
        bare_(std::move(bare)),
        proxy_(detector_, coupling, &mesh_, &shading_) {}

  void place(const Vec3& position) override { proxy_.place(position); }
  void step(const Vec3& goal, Step& step) override {
    const ProxyState& state = proxy_.step(goal, session_);
    step.way.assign(state.way.begin(), state.way.begin() + static_cast<std::ptrdiff_t>(state.pieces + 1));
    step.contacts = state.contacts;
    step.force = state.force;
    step.status = status_of(state.status);
  }
  void update(const TriangleMesh& mesh) override {
    detector_.update(mesh);
    bare_.update(mesh);
    mesh_ = mesh;
    shading_ = ForceShading(mesh_);
    proxy_.surface_moved(&mesh_);
  }
  bool ask_nearest(const Vec3& goal) override { return bare_.ask(goal), true; }
  std::uint64_t work() const override { return detector_.work(); }

 private:
  TriangleMesh mesh_;
  ForceShading shading_;
  AskedContestant detector_;
  BareQuery bare_;
  AskedContestant::Session session_;
  Proxy<AskedContestant> proxy_;
};

}  // namespace

std::unique_ptr<ProxyMethod> certified_method(const MethodRequest& request) {
  const contestants::ContestantSpec spec = request.roster.parse(request.detector);
  std::unique_ptr<contestants::Contestant> built = request.roster.build(spec, request.mesh);
  if (!built->guides_proxy())
    throw std::invalid_argument(fmt::format(
        "{} does not answer touches, sweep and contacts, so our proxy cannot run on it", request.detector));
  BareQuery bare(request.roster.build(spec, request.mesh));
  return std::make_unique<Certified>(AskedContestant(std::move(built)), std::move(bare), request.mesh,
                                     request.coupling);
}

}  // namespace touchmark::bench::experiments::proxy
