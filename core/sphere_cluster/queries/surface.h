/// What the queries of the sphere-cluster detector search.
#pragma once

#include "core/bvh/wide_bvh.h"

namespace touchmark::spheres {

struct Surface {
  WideBvh bvh;
  bool certified = true;  ///< false: contact as doubles have it
};

}  // namespace touchmark::spheres
