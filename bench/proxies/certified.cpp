// Ours: core/haptics/proxy.h over one of our detectors, as a contestant of the suite.
#include "bench/proxies/certified.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "bench/contestants/built_in.h"
#include "bench/contestants/guided_proxy.h"
#include "bench/proxies/methods.h"
#include "bench/support/random.h"

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
  void step(const Vec3& goal, Step& step) override {
    take(proxy_.step(goal), step);
    step.squeezed = std::exchange(squeezed_, false);
    if (step.squeezed) step.status = Status::stuck;
  }
  void update(const TriangleMesh& mesh) override {
    bare_.update(mesh);
    squeezed_ = !proxy_.update(mesh);
  }
  bool limit_work(std::uint64_t max_work) override { return proxy_.limit_work(max_work); }
  bool ask_nearest(const Vec3& goal) override { return bare_.ask(goal), true; }
  std::uint64_t work() const override { return proxy_.work().total(); }

 private:
  BareQuery bare_;
  contestants::GuidedProxy proxy_;
  bool squeezed_ = false;  ///< for the next step to say
};

}  // namespace

void take(const ProxyState& state, Step& step) {
  // What it was carried is no way of its own among bodies that stand.
  step.way.assign(state.way.begin() + static_cast<std::ptrdiff_t>(state.carried),
                  state.way.begin() + static_cast<std::ptrdiff_t>(state.pieces + 1));
  step.contacts = state.contacts;
  step.force = state.force;
  step.status = status_of(state.status);
  step.unfinished = state.unfinished;
}

namespace {

std::unique_ptr<ProxyMethod> unlimited(const MethodRequest& request) {
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

/// One within a limit of work, and one without beside it.
class Limited final : public ProxyMethod {
 public:
  /// Without `max_work` each tick draws another limit.
  Limited(std::unique_ptr<ProxyMethod> limited, std::unique_ptr<ProxyMethod> free,
          std::optional<std::uint64_t> max_work)
      : limited_(std::move(limited)), free_(std::move(free)), max_work_(max_work) {}

  void place(const Vec3& position) override {
    limited_->place(position);
    free_->place(position);
  }
  void step(const Vec3& goal, Step& step) override {
    limited_->limit_work(max_work_ ? *max_work_ : drawn());
    limited_->step(goal, step);
    position_ = step.position();
  }
  void update(const TriangleMesh& mesh) override {
    limited_->update(mesh);
    free_->update(mesh);
  }
  void move(std::span<const Vec3> places, const TriangleMesh& mesh) override {
    limited_->move(places, mesh);
    free_->move(places, mesh);
  }
  bool ask_nearest(const Vec3& goal) override { return limited_->ask_nearest(goal); }
  double lag(const Vec3& goal) override {
    free_->step(goal, step_);
    return (step_.position() - position_).norm();
  }
  std::uint64_t work() const override { return limited_->work(); }

 private:
  /// From 1 up, each size as often as its double.
  std::uint64_t drawn() { return static_cast<std::uint64_t>(std::exp2(16 * random_.unit())); }

  std::unique_ptr<ProxyMethod> limited_, free_;
  std::optional<std::uint64_t> max_work_;
  support::Random random_{1};
  Step step_;
  Vec3 position_ = Vec3::Zero();
};

}  // namespace

std::unique_ptr<ProxyMethod> certified_method(const MethodRequest& request) {
  const std::string& text = request.options.text("max_work");
  std::unique_ptr<ProxyMethod> method = unlimited(request);
  if (text == "0") return method;
  std::optional<std::uint64_t> max_work;
  if (text != "random") max_work = static_cast<std::uint64_t>(request.options.number("max_work"));
  if (!method->limit_work(1))
    throw std::invalid_argument(fmt::format("max_work={}: {} keeps to no limit", text, request.detector));
  return std::make_unique<Limited>(std::move(method), unlimited(request), max_work);
}

}  // namespace touchmark::bench::proxies
