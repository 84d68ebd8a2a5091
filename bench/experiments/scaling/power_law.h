/// A power law through measurements, quantity = factor * size^exponent, and how well its exponent is known.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace touchmark::bench::experiments::scaling {

/// Both above 0.
struct SizedQuantity {
  double size = 0;
  double quantity = 0;
};

struct ExponentInterval {
  double low = 0;
  double high = 0;
};

struct PowerLaw {
  std::size_t points = 0;
  double exponent = 0;
  double factor = 0;
  /// Holds the true exponent in 95 of 100 cases, if logarithms scatter normally and alike about a power law.
  /// Nothing with two points, which every power law goes through.
  std::optional<ExponentInterval> interval;
};

/// Least squares of log(quantity) against log(size). Nothing with fewer than two different sizes.
std::optional<PowerLaw> fit_power_law(std::span<const SizedQuantity> measured);

/// The t that a variable with Student's distribution stays within, on both sides, with this probability,
/// above 0 and below 1; of at least one degree of freedom.
double student_t(double probability, std::size_t degrees);

}  // namespace touchmark::bench::experiments::scaling
