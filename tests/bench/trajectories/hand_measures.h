/// What the tests measure of a hand's motion, by code of their own: speeds, pauses, power by frequency,
/// turning.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/probe.h"

namespace touchmark::bench::trajectories::hands {

/// Positions of a millisecond each, in millimetres: z is along the normal.
using Way = std::vector<Vec3>;

inline double quantile(std::vector<double> values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

inline std::vector<Vec3> velocities(const Way& way) {
  std::vector<Vec3> all;
  for (std::size_t i = 1; i < way.size(); ++i) all.push_back(way[i] - way[i - 1]);
  return all;
}

inline std::vector<double> speeds(const Way& way) {
  std::vector<double> all;
  for (const Vec3& velocity : velocities(way)) all.push_back(velocity.norm());
  return all;
}

/// The lengths of the runs of ticks below 5 mm/s.
inline std::vector<std::size_t> pauses(const Way& way) {
  std::vector<std::size_t> runs;
  bool paused = false;
  for (const double speed : speeds(way)) {
    if (speed < 0.005 && !paused) runs.push_back(0);
    paused = speed < 0.005;
    if (paused) ++runs.back();
  }
  return runs;
}

/// The velocity's power by frequency, from windows of three seconds that overlap by half: Hann's, with the
/// mean of each taken out first.
class Spectrum {
 public:
  Spectrum(const Way& way, const std::vector<int>& axes) : power_(window / 2 + 1) {
    const std::vector<Vec3> velocity = velocities(way);
    for (std::size_t begin = 0; begin + window <= velocity.size(); begin += window / 2)
      for (const int axis : axes) add(velocity, begin, axis);
  }
  /// Returns the part of all power that lies between two frequencies.
  double share(double from_hz, double to_hz) const {
    double all = 0, inside = 0;
    for (std::size_t i = 0; i < power_.size(); ++i) {
      const double hz = 1000. * static_cast<double>(i) / window;
      all += power_[i];
      if (hz >= from_hz && hz < to_hz) inside += power_[i];
    }
    return inside / all;
  }

 private:
  static constexpr std::size_t window = 3000;

  static double cosine(std::size_t of_window) {
    return std::cos(2 * M_PI * static_cast<double>(of_window % window) / window);
  }

  void add(const std::vector<Vec3>& velocity, std::size_t begin, int axis) {
    static const std::vector<double> cosines = [] {
      std::vector<double> all(window);
      for (std::size_t i = 0; i < window; ++i) all[i] = cosine(i);
      return all;
    }();
    double mean = 0;
    for (std::size_t i = 0; i < window; ++i) mean += velocity[begin + i][axis] / window;
    std::vector<double> wave(window);
    for (std::size_t i = 0; i < window; ++i) wave[i] = (velocity[begin + i][axis] - mean) * (1 - cosines[i]);
    for (std::size_t k = 0; k < power_.size(); ++k) {
      double real = 0, imaginary = 0;
      for (std::size_t i = 0, at = 0; i < window; ++i, at = at + k < window ? at + k : at + k - window) {
        real += wave[i] * cosines[at];
        imaginary += wave[i] * cosines[at >= window / 4 ? at - window / 4 : at + window - window / 4];
      }
      power_[k] += real * real + imaginary * imaginary;
    }
  }

  std::vector<double> power_;
};

/// How the heading of single ticks differs from the one 20 ms before, where both are above 30 mm/s; degrees.
inline std::vector<double> turning(const Way& way) {
  const std::vector<Vec3> velocity = velocities(way);
  std::vector<double> all;
  for (std::size_t i = 20; i < velocity.size(); ++i) {
    const Eigen::Vector2d now = velocity[i].head<2>(), before = velocity[i - 20].head<2>();
    if (std::min(now.norm(), before.norm()) <= 0.03) continue;
    const double cross = before.x() * now.y() - before.y() * now.x();
    all.push_back(std::abs(std::atan2(cross, before.dot(now))) * 180 / M_PI);
  }
  return all;
}

/// The root mean square of what a mean over 50 ms leaves of the way along the normal.
inline double trembling(const Way& way) {
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < way.size(); ++i) {
    sum += way[i].z() - (i < 50 ? 0 : way[i - 50].z());
    if (i >= 50) squares += std::pow(way[i - 25].z() - sum / 50, 2);
  }
  return std::sqrt(squares / static_cast<double>(way.size() - 50));
}

}  // namespace touchmark::bench::trajectories::hands
