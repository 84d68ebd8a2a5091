#include "bench/experiments/scaling/power_law.h"

#include <cassert>
#include <cmath>

namespace touchmark::bench::experiments::scaling {
namespace {

constexpr double half_pi = 1.57079632679489661923;
constexpr double confidence = 0.95;

/// The probability that |t| <= sqrt(degrees) tan(angle): Abramowitz & Stegun 26.7.3 and 26.7.4.
double student_probability(double angle, std::size_t degrees) {
  const double cosine = std::cos(angle);
  const bool odd = degrees % 2 == 1;
  double term = odd ? cosine : 1, sum = 0;
  for (std::size_t power = odd ? 1 : 0; power + 2 <= degrees; power += 2) {
    sum += term;
    const double next = static_cast<double>(power + 1) / static_cast<double>(power + 2);
    term *= next * cosine * cosine;
  }
  return odd ? (angle + std::sin(angle) * sum) / half_pi : std::sin(angle) * sum;
}

}  // namespace

double student_t(double probability, std::size_t degrees) {
  assert(degrees >= 1 && probability > 0 && probability < 1);
  double low = 0, high = half_pi;
  for (;;) {
    const double middle = (low + high) / 2;
    if (!(low < middle && middle < high)) break;  // neighbouring doubles
    (student_probability(middle, degrees) < probability ? low : high) = middle;
  }
  return std::sqrt(static_cast<double>(degrees)) * std::tan(low);
}

std::optional<PowerLaw> fit_power_law(std::span<const SizedQuantity> measured) {
  const double n = static_cast<double>(measured.size());
  double mean_x = 0, mean_y = 0;
  bool differ = false;
  for (const SizedQuantity& point : measured) {
    assert(point.size > 0 && point.quantity > 0);
    differ = differ || point.size != measured.front().size;
    mean_x += std::log(point.size) / n;
    mean_y += std::log(point.quantity) / n;
  }
  if (!differ) return std::nullopt;
  double xx = 0, xy = 0;
  for (const SizedQuantity& point : measured) {
    const double x = std::log(point.size) - mean_x;
    xx += x * x;
    xy += x * (std::log(point.quantity) - mean_y);
  }
  PowerLaw law{measured.size(), xy / xx, 0, std::nullopt};
  law.factor = std::exp(mean_y - law.exponent * mean_x);
  if (measured.size() < 3) return law;
  double residual = 0;
  for (const SizedQuantity& point : measured) {
    const double off = std::log(point.quantity) - mean_y - law.exponent * (std::log(point.size) - mean_x);
    residual += off * off;
  }
  const std::size_t degrees = measured.size() - 2;
  const double error = std::sqrt(residual / static_cast<double>(degrees) / xx);
  const double reach = student_t(confidence, degrees) * error;
  law.interval = {law.exponent - reach, law.exponent + reach};
  return law;
}

}  // namespace touchmark::bench::experiments::scaling
