#include "bench/workers/shared_memory.h"

#include <cerrno>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "bench/support/failures.h"
#include "bench/support/system/system_limit.h"

namespace touchmark::bench::workers {
namespace {

support::ResourceError no_memory(std::size_t bytes, int error) {
  return support::ResourceError(fmt::format("cannot share {} MB with the workers: {}", (bytes >> 20U) + 1,
                                            support::described_with_limit(error)));
}

}  // namespace

SharedMemory::SharedMemory(int descriptor, std::size_t size, int protection)
    : descriptor_(descriptor), size_(size) {
  void* mapped = mmap(nullptr, size, protection, MAP_SHARED, descriptor, 0);
  if (mapped == MAP_FAILED) {
    const int error = errno;
    close(descriptor);
    throw no_memory(size, error);
  }
  data_ = static_cast<std::byte*>(mapped);
}

SharedMemory SharedMemory::create(std::size_t bytes) {
  const std::size_t size = bytes > 0 ? bytes : 1;
  const int descriptor = memfd_create("touchmark", MFD_CLOEXEC);
  if (descriptor < 0) throw no_memory(size, errno);
  // Reserved now: memory that runs out later would be a signal, not an error.
  const int error = posix_fallocate(descriptor, 0, static_cast<off_t>(size));
  if (error != 0) {
    close(descriptor);
    throw no_memory(size, error);
  }
  return SharedMemory(descriptor, size, PROT_READ | PROT_WRITE);
}

SharedMemory SharedMemory::attach(int descriptor, Access access) {
  struct stat status {};
  if (fstat(descriptor, &status) != 0) throw no_memory(0, errno);
  return SharedMemory(descriptor, static_cast<std::size_t>(status.st_size),
                      access == Access::read ? PROT_READ : PROT_READ | PROT_WRITE);
}

SharedMemory::SharedMemory(SharedMemory&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      size_(std::exchange(other.size_, 0)),
      data_(std::exchange(other.data_, nullptr)) {}

SharedMemory::~SharedMemory() {
  if (data_ != nullptr) munmap(data_, size_);
  if (descriptor_ >= 0) close(descriptor_);
}

}  // namespace touchmark::bench::workers
