#include "bench/contestants/storage_rounding.h"

namespace touchmark::bench {

Storing stored_in_single_precision(double scale, const Vec3& origin) {
  return {[=](const Vec3& point) -> Vec3 {
            return (scale * (point - origin)).cast<float>().cast<double>() / scale + origin;
          },
          [=](double length) { return static_cast<double>(static_cast<float>(scale * length)) / scale; }};
}

}  // namespace touchmark::bench
