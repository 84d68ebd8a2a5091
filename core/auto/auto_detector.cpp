#include "core/auto/auto_detector.h"

#include <stdexcept>
#include <string>
#include <utility>

namespace touchmark {
namespace {

std::size_t bytes_of(const BuiltForm& form) noexcept {
  return std::visit([](const auto& built) { return built.bytes(); }, form);
}

void move_work(Work& from, Work& to) noexcept {
  if (from.total() + from.exact_decisions == 0) return;
  to += from;
  from = {};
}

}  // namespace

AutoDetector::AutoDetector(const Choice& choice, BuiltForm form) : choice_(choice) {
  if (auto* spheres = std::get_if<SphereCluster>(&form)) spheres_ = std::move(*spheres);
  if (auto* grid = std::get_if<GridGroup>(&form)) other_ = std::move(*grid);
  if (auto* boxes = std::get_if<AabbTree>(&form)) other_ = std::move(*boxes);
}

AutoDetector AutoDetector::build(const TriangleMesh& mesh, const Wish& wish) {
  ChosenForm chosen = choose_form(mesh, wish);
  if (!chosen.built) chosen.built = build_form(mesh, chosen.choice.options);
  // What is left when a choice turns out larger than estimated is the smallest.
  if (!(static_cast<double>(bytes_of(*chosen.built)) <= wish.max_bytes) && !wish.form) {
    chosen.choice.options = AabbTree::Options();
    chosen.built = build_form(mesh, chosen.choice.options);
  }
  if (const std::size_t bytes = bytes_of(*chosen.built); !(static_cast<double>(bytes) <= wish.max_bytes)) {
    throw std::invalid_argument("auto: " + std::string(name_of(chosen.choice.form())) + " takes " +
                                std::to_string(bytes) + " bytes, more than the " +
                                std::to_string(wish.max_bytes) + " that it may");
  }
  return {chosen.choice, std::move(*chosen.built)};
}

void AutoDetector::update(const TriangleMesh& mesh) {
  if (!other_) return spheres_.update(mesh);
  std::visit([&](auto& form) { form.update(mesh); }, *other_);
}

template <class Ask>
auto AutoDetector::ask_other(Session& session, const Ask& of) const noexcept {
  if (const auto* grid = std::get_if<GridGroup>(&*other_)) {
    auto answer = of(*grid, session.grid);
    move_work(session.grid.work, session.work);
    return answer;
  }
  auto answer = of(*std::get_if<AabbTree>(&*other_), session.boxes);
  move_work(session.boxes.work, session.work);
  return answer;
}

bool AutoDetector::look_for_touch(const Probe& probe, Session& session) const noexcept {
  if (!other_) return spheres_.touches(probe, session);
  return ask_other(session, [&](const auto& form, auto& own) { return form.touches(probe, own); });
}

std::optional<Contact> AutoDetector::look_for_nearest(const Probe& probe, double reach,
                                                      Session& session) const noexcept {
  if (!other_) return spheres_.nearest(probe, reach, session);
  return ask_other(session, [&](const auto& form, auto& own) { return form.nearest(probe, reach, own); });
}

std::optional<Impact> AutoDetector::look_for_impact(const Sweep& sweep, Session& session) const noexcept {
  if (!other_) return spheres_.first_hit(sweep, session);
  return ask_other(session, [&](const auto& form, auto& own) { return form.first_hit(sweep, own); });
}

std::size_t AutoDetector::look_for_contacts(const Probe& probe, double reach, Session& session,
                                            std::span<Contact> into) const noexcept {
  if (!other_) return spheres_.contacts(probe, reach, session, into);
  return ask_other(session,
                   [&](const auto& form, auto& own) { return form.contacts(probe, reach, own, into); });
}

void AutoDetector::prepare_other(Session& session) const noexcept {
  if (const auto* grid = std::get_if<GridGroup>(&*other_)) {
    grid->prepare(session.grid);
    move_work(session.grid.work, session.work);
  }
}

std::size_t AutoDetector::bytes() const noexcept {
  if (!other_) return spheres_.bytes();
  return std::visit([](const auto& form) { return form.bytes(); }, *other_);
}

Accuracy AutoDetector::accuracy() const noexcept {
  if (!other_) return spheres_.accuracy();
  return std::visit([](const auto& form) { return form.accuracy(); }, *other_);
}

}  // namespace touchmark
