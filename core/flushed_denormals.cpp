#include "core/flushed_denormals.h"

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <locale>
#include <sstream>

#include "core/triangle_mesh.h"

namespace touchmark {
namespace {

bool flushes_denormals() noexcept {
  // Volatile, so that the processor computes it in this thread's mode. DAZ shows in the comparison.
  const volatile double smallest = std::numeric_limits<double>::min();
  const volatile double half = smallest / 2;
  return half == 0;
}

}  // namespace

void check_flushed_denormals(const TriangleMesh& mesh) {
  // From 2^-970 on doubles are multiples of the smallest normal one, and so are differences. 2^70 more are
  // room for probes, whose centres and radii have smaller numbers.
  constexpr double least = 0x1p-900;
  if (!flushes_denormals()) return;
  for (std::size_t i = 0; i < mesh.vertices().size(); ++i) {
    for (const double x : mesh.vertices()[i]) {
      // By its bits: a comparison may take a denormal number for 0.
      if (std::bit_cast<std::uint64_t>(x) << 1 == 0 || std::abs(x) >= least) continue;
      std::ostringstream text;
      text.imbue(std::locale::classic());
      text << "vertex " << i << " has the coordinate " << x
           << ", which is below 2^-900: this thread flushes denormal numbers to zero, as a library built "
              "with -ffast-math may have made it, and could answer wrongly; scale the mesh up, or switch FTZ "
              "and DAZ off";
      throw MeshError(text.str());
    }
  }
}

}  // namespace touchmark
