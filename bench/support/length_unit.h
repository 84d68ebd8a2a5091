/// What a mesh unit is, where the user says it.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace touchmark::bench::support {

struct LengthUnit {
  std::string_view name;
  double metres = 1;
};

inline constexpr std::array<LengthUnit, 5> length_units = {
    {{"um", 1e-6}, {"mm", 1e-3}, {"cm", 1e-2}, {"m", 1}, {"in", 0.0254}}};

inline std::optional<LengthUnit> length_unit_named(std::string_view name) noexcept {
  for (const LengthUnit& unit : length_units)
    if (unit.name == name) return unit;
  return std::nullopt;
}

}  // namespace touchmark::bench::support
