#include <stdexcept>

#include "bench/bodies/urdf.h"

namespace touchmark::bench::bodies {

BodyScene read_urdf(const std::string& path) {
  throw std::invalid_argument(path + ": this program is built without liburdfdom, which reads URDF");
}

}  // namespace touchmark::bench::bodies
