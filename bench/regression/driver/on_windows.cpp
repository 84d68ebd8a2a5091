/// What the driver needs of the system, on Windows: plain files, and memory without a limit.
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <io.h>

#include "bench/support/system/available_memory.h"
#include "bench/support/system/system_limit.h"
#include "core/mesh_io/input_file.h"

namespace touchmark {

mesh_io::InputFile::InputFile(const std::filesystem::path& path)
    : descriptor_(::_wopen(path.c_str(), _O_RDONLY | _O_BINARY)), kind_(std::filesystem::file_type::regular) {
  if (descriptor_ < 0) throw InputError(std::strerror(errno));
  size_ = static_cast<std::size_t>(::_filelengthi64(descriptor_));
}

mesh_io::InputFile::~InputFile() { ::_close(descriptor_); }

std::size_t mesh_io::InputFile::read(char* to, std::size_t most) {
  const int got = ::_read(descriptor_, to, static_cast<unsigned>(most));
  if (got < 0) throw InputError(std::strerror(errno));
  return static_cast<std::size_t>(got);
}

std::string bench::support::described_with_limit(int error) { return std::strerror(error); }
void bench::support::require_memory(std::string_view, double) {}
void bench::support::require_memory_for_triangles(std::size_t, double) {}

}  // namespace touchmark
