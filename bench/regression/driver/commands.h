/// What the program touchmark-regression can do. Each writes a CSV file that appears only when it is
/// complete, and throws as the program's commands do (bench/support/failures.h).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace touchmark::bench::regression::driver {

/// case,needs_file,inputs,cells,spheres,boxes,triangles,answers,details,note: checksums in hexadecimal; where
/// there is a note, it says why there are no numbers. `generated` leaves out the cases whose mesh is a file.
void write_answers(const std::string& plugin, const std::string& out, bool generated);

/// One replay of every timed case with instructions counted, for valgrind --tool=callgrind
/// --instr-atstart=no: a dump for each case, named after it. Throws ResourceError when built without
/// valgrind's headers.
void count_instructions(const std::string& plugin);

struct Timing {
  std::string base, control, head;  ///< plug-ins; control is a copy of base under another name
  std::vector<std::string> only;    ///< names of cases; empty: all timed ones
  std::uint64_t seed = 1;           ///< for the random order
};

/// case,sitting,round,base_ns,control_ns,head_ns: processor time of a pass. Cases that a plug-in refuses are
/// left out.
void write_times(const Timing& timing, const std::string& out);

}  // namespace touchmark::bench::regression::driver
