/// Reads what follows a detector's name, "key=value,key=value", as the command line has it.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/named/option.h"
#include "core/triangle_mesh.h"

namespace touchmark::named {

/// Sets the options that the text names, and leaves the others as they are. Throws std::invalid_argument,
/// naming the detector, the key and the value, for what is not key=value, a key that is given twice or that
/// no option has, and a value that its option refuses.
void read_options(const std::string& detector, std::string_view text, const TriangleMesh& mesh,
                  std::span<const Option> options);

}  // namespace touchmark::named
