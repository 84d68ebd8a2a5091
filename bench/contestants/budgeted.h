/// A detector that answers `nearest` within a budget of work, as a contestant: what is left open is a
/// bracket.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "bench/contestants/entry.h"
#include "core/detector.h"

namespace touchmark::bench::contestants {

template <AnswersWithinBudget D>
class Budgeted {
 public:
  struct Options {
    typename D::Options of_detector;
    std::uint64_t budget = 0;  ///< see the concept AnswersWithinBudget
  };
  using Session = typename D::Session;

  static Budgeted build(const TriangleMesh& mesh, const Options& options) {
    return Budgeted(D::build(mesh, options.of_detector), options.budget);
  }

  Bracket bracket(const Probe& probe, double reach, Session& session) const noexcept {
    return detector_.nearest(probe, reach, session, budget_);
  }
  std::optional<Contact> nearest(const Probe& probe, double reach, Session& session) const noexcept {
    return bracket(probe, reach, session).contact;
  }
  std::size_t bytes() const noexcept { return detector_.bytes(); }
  /// What is left open counts as contact.
  Accuracy accuracy() const noexcept {
    const Accuracy finished = detector_.accuracy();
    return {Guarantee::conservative, finished.relative, finished.absolute};
  }

 private:
  Budgeted(D detector, std::uint64_t budget) : detector_(std::move(detector)), budget_(budget) {}

  D detector_;
  std::uint64_t budget_;
};

inline OptionInfo budget_option() {
  return {"budget",
          OptionKind::count,
          {},
          "0",
          "about how many boxes, spheres and triangles nearest may look at; then it tells a bracket; 0: all"};
}

/// Throws std::invalid_argument where a budget is asked for, which the form that is built does not keep to.
inline void refuse_budget(const OptionValues& values) {
  if (values.number("budget") != 0)
    throw std::invalid_argument("this form keeps to no budget; sphere-cluster, grid-group and aabb-tree do");
}

/// Returns null where no budget is asked for. Throws std::invalid_argument where it is asked for beside an
/// option that it does not go with.
template <AnswersWithinBudget D>
std::unique_ptr<Contestant> budgeted(const TriangleMesh& mesh, const typename D::Options& options,
                                     const OptionValues& values) {
  const double budget = values.number("budget");
  if (budget == 0) return nullptr;
  const auto prepare = values.all().find("prepare");
  if (asks_for_side(values) || is_updated(values) ||
      (prepare != values.all().end() && prepare->second == "true"))
    throw std::invalid_argument("budget goes with no prepare, side or updated: it is for nearest alone");
  return contestant<Budgeted<D>>(mesh, {options, static_cast<std::uint64_t>(budget)});
}

}  // namespace touchmark::bench::contestants
