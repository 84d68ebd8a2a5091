/// What the queries search.
#pragma once

#include "core/bvh/wide_bvh.h"

namespace touchmark::queries {

struct Surface {
  WideBvh bvh;
  bool certified = true;  ///< false: contact as doubles have it
};

}  // namespace touchmark::queries
