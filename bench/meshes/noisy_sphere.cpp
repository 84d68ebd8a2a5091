#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "bench/meshes/generated_meshes.h"
#include "bench/meshes/portable_noise.h"
#include "bench/meshes/portable_sincos.h"

namespace touchmark::bench::meshes {
namespace {

constexpr double pi = 3.14159265358979323846;

/// Rings of latitude from pole to pole, `sizes[i]` vertices on ring i, at least 3; they sum to half the
/// triangles.
std::vector<std::uint32_t> ring_sizes(std::uint64_t vertices_on_rings) {
  // Equilateral triangles of edge e: e^2 = 16 pi / (sqrt 3 F), rings e sqrt(3)/2 apart.
  const double edge = std::sqrt(8 * pi / (std::sqrt(3.0) * static_cast<double>(vertices_on_rings)));
  const double most = static_cast<double>(vertices_on_rings / 3);
  const auto rings =
      static_cast<std::size_t>(std::clamp(std::round(2 * pi / (std::sqrt(3.0) * edge)) - 1, 1.0, most));

  // Three each, the rest in proportion to what equal spacing asks beyond that.
  std::vector<double> wanted(rings);
  double total = 0;
  for (std::size_t i = 0; i < rings; ++i) {
    const double circumference =
        2 * pi * portable_sincos(static_cast<double>(i + 1) / static_cast<double>(2 * rings + 2)).sin;
    wanted[i] = std::max(circumference / edge - 3, 1e-3);
    total += wanted[i];
  }
  std::vector<std::uint32_t> sizes(rings);
  const std::uint64_t spare = vertices_on_rings - 3 * rings;
  std::uint64_t given = 0;
  double so_far = 0;
  for (std::size_t i = 0; i < rings; ++i) {
    so_far += wanted[i];
    const std::uint64_t due =
        i + 1 == rings ? spare
                       : static_cast<std::uint64_t>(std::round(so_far / total * static_cast<double>(spare)));
    sizes[i] = static_cast<std::uint32_t>(3 + due - given);
    given = due;
  }
  return sizes;
}

class NoisySphere {
 public:
  explicit NoisySphere(std::uint64_t triangles) : sizes_(ring_sizes(triangles / 2)) {
    vertices_.reserve(triangles / 2 + 2);
    triangles_.reserve(triangles / 2 * 2);
    jitter_ = 0.1 * pi / static_cast<double>(sizes_.size() + 1);
    jitter_ = std::min(jitter_, 0.03);
  }

  TriangleMesh mesh() && {
    add({1, 0}, {1, 0});
    for (std::size_t ring = 0; ring < sizes_.size(); ++ring) {
      const SinCos latitude =
          portable_sincos(static_cast<double>(ring + 1) / static_cast<double>(2 * sizes_.size() + 2));
      for (std::uint32_t i = 0; i < sizes_[ring]; ++i)
        add(latitude, portable_sincos(static_cast<double>(i) / static_cast<double>(sizes_[ring])));
    }
    add({-1, 0}, {1, 0});
    cap_at_first_pole();
    std::uint32_t first = 1;
    for (std::size_t ring = 0; ring + 1 < sizes_.size(); ++ring) {
      zip(first, sizes_[ring], sizes_[ring + 1]);
      first += sizes_[ring];
    }
    cap_at_last_pole(first);
    return {std::move(vertices_), std::move(triangles_)};
  }

 private:
  void add(const SinCos& latitude, const SinCos& longitude) {
    const Vec3 direction(latitude.sin * longitude.cos, latitude.sin * longitude.sin, latitude.cos);
    double height = jitter_ * signed_unit(mixed(vertices_.size()));
    double amplitude = 0.06, frequency = 2;
    for (std::uint64_t octave = 0; octave < 5; ++octave) {  // amplitudes sum to less than 0.12
      height += amplitude * bumps(frequency * direction, mixed(~octave));
      amplitude /= 2;
      frequency *= 2.5;
    }
    vertices_.push_back((1 + height) * direction);
  }

  void cap_at_first_pole() {
    for (std::uint32_t i = 0; i < sizes_.front(); ++i)
      triangles_.push_back({0, 1 + i, 1 + (i + 1) % sizes_.front()});
  }
  void cap_at_last_pole(std::uint32_t first) {
    const auto pole = static_cast<std::uint32_t>(vertices_.size() - 1);
    const std::uint32_t size = sizes_.back();
    for (std::uint32_t i = 0; i < size; ++i) triangles_.push_back({pole, first + (i + 1) % size, first + i});
  }
  /// The strip between two rings: always the ring whose next vertex comes sooner moves on.
  void zip(std::uint32_t upper, std::uint32_t upper_size, std::uint32_t lower_size) {
    const std::uint32_t lower = upper + upper_size;
    std::uint32_t i = 0, j = 0;
    while (i < upper_size || j < lower_size) {
      const std::uint32_t a = upper + i % upper_size, b = lower + j % lower_size;
      if (std::uint64_t{i + 1} * lower_size <= std::uint64_t{j + 1} * upper_size) {
        triangles_.push_back({a, b, upper + ++i % upper_size});
      } else {
        triangles_.push_back({a, b, lower + ++j % lower_size});
      }
    }
  }

  std::vector<std::uint32_t> sizes_;
  std::vector<Vec3> vertices_;
  std::vector<TriangleMesh::Corners> triangles_;
  double jitter_ = 0;
};

}  // namespace

TriangleMesh noisy_sphere(std::uint64_t triangles) { return NoisySphere(triangles).mesh(); }

}  // namespace touchmark::bench::meshes
