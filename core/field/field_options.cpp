#include "core/field/field_options.h"

#include <stdexcept>
#include <string>

#include "core/geometry/point_triangle_avx2.h"
#include "core/search/parallel.h"
#include "core/simd/dispatch.h"
#include "core/simd/target.h"

namespace touchmark::field {
namespace {

double checked_length(double length, const char* name, double otherwise) {
  if (!(length >= 0))
    throw std::invalid_argument(std::string("field: ") + name + " is " + std::to_string(length) +
                                ", not a number of 0 or more");
  return length > 0 ? length : otherwise;
}

}  // namespace

Division checked_division(const FieldOptions& options, double diagonal) {
  constexpr double default_error = 0.01, default_band = 0.05;  // of the diagonal
  constexpr std::size_t max_bytes = std::size_t{1} << 30;
  return {checked_length(options.error, "error", default_error * diagonal),
          checked_length(options.band, "band", default_band * diagonal),
          threads_to_use(options.threads, "field"), max_bytes};
}

Offset offset_from(const PreparedTriangle& triangle, const Vec3& point) noexcept {
#if TOUCHMARK_HAS_AVX2
  static const bool has_avx2 = widest_simd() != Simd::portable;
  if (has_avx2) return avx2::offset_from(triangle, point);
#endif
  return touchmark::offset_from(triangle, point);
}

}  // namespace touchmark::field
