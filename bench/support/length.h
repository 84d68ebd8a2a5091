/// Lengths as people write them.
#pragma once

#include <optional>
#include <string_view>

#include "bench/support/numbers.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::support {

/// A length as written: in mesh units, or in percent of the mesh's box diagonal ("0.5%").
struct Length {
  double value = 0;
  bool percent = false;

  double in_mesh_units(const TriangleMesh& mesh) const noexcept { return along(mesh.diagonal()); }
  /// Returns it where 100 % is that diagonal.
  double along(double diagonal) const noexcept { return percent ? value / 100 * diagonal : value; }
};

/// 0 or more, "inf" allowed. Nothing when it is anything else.
inline std::optional<Length> parse_length(std::string_view text) noexcept {
  const bool percent = text.ends_with('%');
  if (percent) text.remove_suffix(1);
  const std::optional<double> value = parse_number(text);
  if (!value || !(*value >= 0)) return std::nullopt;
  return Length{*value, percent};
}

/// Returns a share, 0.1 as well as 10%. What is no share of 0 or more is 0, which no caller allows.
inline double parse_share(std::string_view text) noexcept {
  return parse_length(text).value_or(Length{}).along(1);
}

}  // namespace touchmark::bench::support
