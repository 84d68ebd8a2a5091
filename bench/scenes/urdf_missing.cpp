#include <stdexcept>

#include "bench/scenes/urdf.h"

namespace touchmark::bench::scenes {

BodyScene read_urdf(const std::string& path, const RosPackages&) {
  throw std::invalid_argument(
      path + ": URDF needs liburdfdom: install liburdfdom-dev (scripts/setup bench) and build again");
}

}  // namespace touchmark::bench::scenes
