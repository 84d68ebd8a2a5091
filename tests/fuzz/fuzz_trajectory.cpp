#include <stdexcept>
#include <string>
#include <string_view>

#include <sys/mman.h>
#include <unistd.h>

#include "bench/trajectory_csv.h"
#include "tests/fuzz/target.h"

namespace touchmark::fuzz {
namespace {

/// A file of these bytes in memory, by a path.
class MemoryFile {
 public:
  MemoryFile(const std::uint8_t* data, std::size_t size) : file_(memfd_create("fuzz", 0)) {
    require(file_ >= 0 && write(file_, data, size) == static_cast<ssize_t>(size), "no file in memory");
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { close(file_); }
  std::string path() const { return "/proc/self/fd/" + std::to_string(file_); }

 private:
  int file_;
};

}  // namespace
}  // namespace touchmark::fuzz

/// A trajectory in CSV: std::invalid_argument, or steps that are all finite.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace touchmark;
  const fuzz::MemoryFile file(data, size);
  try {
    const bench::Trajectory trajectory = bench::read_trajectory(file.path());
    fuzz::require(trajectory.size() > 0 && trajectory.size() <= size, "no steps, or more than bytes");
    for (const Vec3& position : trajectory.positions) fuzz::require(position.allFinite(), "not finite");
    for (const double radius : trajectory.radii) fuzz::require(radius >= 0, "a radius below 0");
  } catch (const std::invalid_argument& error) {
    // One line, whatever the bytes are.
    for (const char c : std::string_view(error.what()))
      fuzz::require(c != '\n' && c != '\r' && c != '\0' && c != '\x1b', "a message of more than one line");
  }
  return 0;
}
