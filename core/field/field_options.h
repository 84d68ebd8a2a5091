/// What a certified field is built with.
#pragma once

#include "core/field/cell_octree.h"

namespace touchmark {

struct FieldOptions {
  double error = 0;      ///< mesh units: answers are off by at most this; 0: 1 % of the diagonal
  double band = 0;       ///< mesh units: farther from the mesh the field knows no more; 0: a twentieth
  bool refines = false;  ///< true: what the field does not see to be out of reach is answered exactly
  unsigned threads = 1;  ///< divide space, at most 256; 0: as many as there are processors; the same bits
};

namespace field {

/// Throws std::invalid_argument, naming the offender.
Division checked_division(const FieldOptions& options, double diagonal);

}  // namespace field
}  // namespace touchmark
