/// Limits that the system sets to this process and its workers, in the words of those who can raise them.
#pragma once

#include <string>

struct rusage;

namespace touchmark::bench::support {

/// The limit that is behind `error`, an errno: ": no more than 8 open files in a process (ulimit -n)". Empty
/// where it is none that is known.
std::string limit_behind(int error);
/// What the error says, and that.
std::string described_with_limit(int error);

/// ": no more than 100 MB in a process (ulimit -v)"; empty where the memory of a process is not limited.
std::string memory_limit();

/// Returns true if a process that used so much has come to the end of the processor time that one may have.
bool used_up_its_time(const rusage& used);
std::string time_limit();  ///< "no more than 5 s of processor time in a process (ulimit -t)"

/// From now on a file that may not grow is an error of the write, and processor time that is used up ends the
/// program with one line and exit_resources: no signal ends it without a word.
void survive_limits();

}  // namespace touchmark::bench::support
