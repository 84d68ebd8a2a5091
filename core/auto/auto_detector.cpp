#include "core/auto/auto_detector.h"

#include <stdexcept>
#include <string>

namespace touchmark {
namespace {

std::size_t bytes_of(const BuiltForm& form) noexcept {
  return std::visit([](const auto& built) { return built.bytes(); }, form);
}

}  // namespace

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
  std::visit([&](auto& form) { form.update(mesh); }, form_);
}

std::size_t AutoDetector::bytes() const noexcept { return bytes_of(form_); }

Accuracy AutoDetector::accuracy() const noexcept {
  return std::visit([](const auto& form) { return form.accuracy(); }, form_);
}

}  // namespace touchmark
