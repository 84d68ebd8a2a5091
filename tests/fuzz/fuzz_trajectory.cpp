#include <stdexcept>
#include <string>
#include <string_view>

#include <sys/mman.h>
#include <unistd.h>

#include "bench/trajectories/trajectory_csv.h"
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

void read(const std::string& path, std::size_t most, const bench::trajectories::MotionOptions& options,
          std::size_t size) {
  try {
    const bench::trajectories::Trajectory trajectory =
        bench::trajectories::read_trajectory(path, most, options);
    require(trajectory.size() > 0, "no steps");
    require(trajectory.size() <= (options.rate_hz ? most : size), "more steps than bytes, or than wanted");
    for (const Vec3& position : trajectory.positions) require(position.allFinite(), "not finite");
    for (const double radius : trajectory.radii) require(radius >= 0, "a radius below 0");
    for (const double time : trajectory.times_s) require(time - time == 0, "a time that is not finite");
  } catch (const std::invalid_argument& error) {
    // One line, whatever the bytes are.
    for (const char c : std::string_view(error.what()))
      require(c != '\n' && c != '\r' && c != '\0' && c != '\x1b', "a message of more than one line");
  }
}

}  // namespace
}  // namespace touchmark::fuzz

/// A trajectory in CSV: std::invalid_argument, or steps that are all finite; also resampled, and with columns
/// by number.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace touchmark;
  const fuzz::MemoryFile file(data, size);
  fuzz::read(file.path(), 0, {}, size);
  fuzz::read(file.path(), 100, bench::trajectories::parse_motion_options("", "1000", "333"), size);
  fuzz::read(file.path(), 100, bench::trajectories::parse_motion_options("x=2,y=3,z=4,time_ms=1", "", "1000"),
             size);
  fuzz::read(file.path(), 0, bench::trajectories::parse_motion_options("x=1,y=2,z=3", "1e-3", ""), size);
  fuzz::read(file.path(), 0, bench::trajectories::parse_motion_options("x=3,y=4,z=5", "", ""), size);
  fuzz::read(file.path(), 100,
             bench::trajectories::parse_motion_options("x=x,y=4,z=5,time_s=1,time_ns=2", "", "1000"), size);
  return 0;
}
