#include <stdexcept>

#include "bench/bodies/urdf.h"

namespace touchmark::bench::bodies {

BodyScene read_urdf(const std::string& path, const RosPackages&) {
  throw std::invalid_argument(
      path + ": URDF needs liburdfdom: install liburdfdom-dev (scripts/setup bench) and build again");
}

}  // namespace touchmark::bench::bodies
