#include "bench/cli/extra/coupling_options.h"

#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/cli/options.h"
#include "bench/support/checked.h"
#include "bench/support/numbers.h"

namespace touchmark::bench::cli {
namespace {

double checked_number(const char* option, const std::string& text) {
  const std::optional<double> value = support::parse_number(text);
  if (!value || !(*value >= 0) || !std::isfinite(*value))
    throw support::bad_value(option, text, "a finite number of 0 or more");
  return *value;
}

/// "MU" for both coefficients, or "STATIC,DYNAMIC".
std::array<double, 2> checked_friction(const std::string& text) {
  const std::size_t comma = text.find(',');
  const double at_rest = checked_number("--friction", text.substr(0, comma));
  const double in_motion =
      comma == std::string::npos ? at_rest : checked_number("--friction", text.substr(comma + 1));
  if (in_motion > at_rest)
    throw std::invalid_argument(
        fmt::format("--friction \"{}\": the dynamic coefficient is above the static one", text));
  return {at_rest, in_motion};
}

}  // namespace

void add_coupling(CLI::App& command, CouplingSelectors& selectors) {
  add_value(command, "--stiffness", selectors.stiffness, "N/m",
            "of the spring between proxy and device, mesh units being metres");
  add_value(command, "--friction", selectors.friction, "MU[,MU]",
            "coefficients, static and dynamic, or one for both");
  add_value(command, "--damping", selectors.damping, "NS/M",
            "against the device's velocity while in contact");
  add_value(command, "--shading", selectors.shading, "SHARE",
            "0 to 1, how far our force turns to the normal interpolated between vertices; the way stays");
}

Coupling checked_coupling(const CouplingSelectors& selectors) {
  Coupling coupling;
  const std::array<double, 2> friction = checked_friction(selectors.friction);
  coupling.stiffness = checked_number("--stiffness", selectors.stiffness);
  coupling.static_friction = friction[0];
  coupling.dynamic_friction = friction[1];
  coupling.damping = checked_number("--damping", selectors.damping);
  coupling.shading = checked_number("--shading", selectors.shading);
  if (coupling.shading > 1)
    throw std::invalid_argument(fmt::format("--shading \"{}\" is above 1", selectors.shading));
  return coupling;
}

}  // namespace touchmark::bench::cli
