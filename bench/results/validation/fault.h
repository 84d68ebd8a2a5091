/// Something in a file that is not as it should be.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace touchmark::bench::results::validation {

struct Fault {
  std::string file;
  std::size_t line = 0;  ///< from 1; 0: the file as a whole
  std::string where;  ///< the column of a CSV file, the path inside a JSON file; empty: the line as a whole
  std::string value;  ///< as it stands in the file
  std::string wrong;  ///< "is not a number"
};

using Faults = std::vector<Fault>;

/// `results.csv:3: ns_p50 "fast" is not a number`: one line, whatever the value holds.
std::string line_of(const Fault& fault);

}  // namespace touchmark::bench::results::validation
