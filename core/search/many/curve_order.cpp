#include "core/search/many/curve_order.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/aabb.h"
#include "core/float_limits.h"

namespace touchmark {
namespace {

constexpr unsigned bits_an_axis = 10, bits_a_pass = 11, passes = 3;
constexpr std::uint32_t not_finite = 1U << (3 * bits_an_axis);  // above all codes
static_assert(passes * bits_a_pass > 3 * bits_an_axis);

Aabb box_of_finite(std::span<const Vec3> points) noexcept {
  Aabb box;
  for (const Vec3& point : points)
    if (point.allFinite()) box.extend(point);
  return box;
}

/// Spreads ten bits so that two others fit behind each.
std::uint32_t spread(std::uint32_t bits) noexcept {
  bits = (bits | bits << 16) & 0x030000ffU;
  bits = (bits | bits << 8) & 0x0300f00fU;
  bits = (bits | bits << 4) & 0x030c30c3U;
  return (bits | bits << 2) & 0x09249249U;
}

constexpr std::size_t samples = 64;

std::size_t sample_stride(std::size_t count) noexcept { return std::max<std::size_t>(count / samples, 1); }

/// The mean of what is finite of a sample of length(0) to length(count - 1).
template <class Length>
double mean_of_samples(std::size_t count, const Length& length) noexcept {
  double sum = 0;
  std::size_t finite = 0;
  for (std::size_t k = 0; k < count; k += sample_stride(count)) {
    const double one = length(k);
    if (!(one < infinity)) continue;
    sum += one;
    ++finite;
  }
  return finite > 0 ? sum / static_cast<double>(finite) : 0;
}

class Quantizer {
 public:
  explicit Quantizer(const Aabb& box) noexcept : min_(box.min) {
    const double extent = (box.max - box.min).maxCoeff();
    if (extent > 0) scale_ = largest / extent;
  }
  std::uint32_t code(const Vec3& point) const noexcept {
    if (!point.allFinite()) return not_finite;
    return spread(cell(point, 0)) | spread(cell(point, 1)) << 1 | spread(cell(point, 2)) << 2;
  }

 private:
  static constexpr double largest = (1U << bits_an_axis) - 1;

  /// The difference may overflow, and its product be no number: that is cell 0, for any order will do.
  std::uint32_t cell(const Vec3& point, int axis) const noexcept {
    const double at = (point[axis] - min_[axis]) * scale_;
    return at > 0 ? static_cast<std::uint32_t>(std::min(at, largest)) : 0;
  }

  Vec3 min_;
  double scale_ = 0;
};

}  // namespace

void CurveOrder::sort(std::span<const Vec3> points) {
  const std::size_t count = points.size();
  entries_.resize(count);
  swapped_.resize(count);
  indices_.resize(count);
  const Quantizer quantizer(box_of_finite(points));
  constexpr std::size_t buckets = std::size_t{1} << bits_a_pass;
  std::array<std::array<std::uint32_t, buckets>, passes> begin{};
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t code = quantizer.code(points[i]);
    entries_[i] = {code, i};
    for (unsigned pass = 0; pass < passes; ++pass)
      ++begin[pass][code >> (pass * bits_a_pass) & (buckets - 1)];
  }
  for (unsigned pass = 0; pass < passes; ++pass) {
    std::uint32_t sum = 0;
    for (std::uint32_t& bucket : begin[pass]) {
      const std::uint32_t size = bucket;
      bucket = sum;
      sum += size;
    }
    for (const Entry& entry : entries_)
      swapped_[begin[pass][entry.code >> (pass * bits_a_pass) & (buckets - 1)]++] = entry;
    entries_.swap(swapped_);
  }
  for (std::size_t i = 0; i < count; ++i) indices_[i] = entries_[i].index;
}

double mean_step(std::span<const Vec3> points, std::span<const std::uint32_t> indices) noexcept {
  const auto at = [&](std::size_t k) -> const Vec3& { return points[indices.empty() ? k : indices[k]]; };
  return mean_of_samples(points.empty() ? 0 : points.size() - 1,
                         [&](std::size_t k) { return (at(k + 1) - at(k)).norm(); });
}

void take_sample(std::span<const Vec3> points, std::vector<Vec3>& into) {
  into.clear();
  for (std::size_t k = 0; k < points.size(); k += sample_stride(points.size())) into.push_back(points[k]);
}

double mean_move(std::span<const Vec3> sampled, std::span<const Vec3> points) noexcept {
  const std::size_t stride = sample_stride(points.size());
  return mean_of_samples(points.size(),
                         [&](std::size_t k) { return (points[k] - sampled[k / stride]).norm(); });
}

bool is_coherent(std::span<const Vec3> points) noexcept {
  Aabb box;
  for (std::size_t k = 0; k < points.size(); k += sample_stride(points.size()))
    if (points[k].allFinite()) box.extend(points[k]);
  // Evenly on a square with the box's diagonal for its side, or twice as far apart.
  const double apart = 2 * (box.max - box.min).norm() / std::sqrt(static_cast<double>(points.size()));
  return !(mean_step(points) > apart);
}

}  // namespace touchmark
