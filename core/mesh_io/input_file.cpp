#include "core/mesh_io/input_file.h"

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace touchmark::mesh_io {
namespace {

using std::filesystem::file_type;

constexpr std::chrono::milliseconds patience{1000}, between_tries{10};

file_type kind_of(mode_t mode) {
  if (S_ISREG(mode)) return file_type::regular;
  if (S_ISFIFO(mode)) return file_type::fifo;
  if (S_ISDIR(mode)) return file_type::directory;
  return S_ISCHR(mode) ? file_type::character : file_type::unknown;
}

}  // namespace

InputFile::InputFile(const std::filesystem::path& path)
    // Opening a pipe that nobody writes to would wait for ever.
    : descriptor_(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)), kind_(file_type::none) {
  struct stat status {};
  if (descriptor_ < 0) throw InputError(std::strerror(errno));
  if (::fstat(descriptor_, &status) != 0) {
    const int failure = errno;
    ::close(descriptor_);
    throw InputError(std::strerror(failure));
  }
  kind_ = kind_of(status.st_mode);
  if (is_regular()) size_ = static_cast<std::size_t>(status.st_size);
  may_lack_a_writer_ = is_pipe();
  if (!may_lack_a_writer_) stop_waiting_for_a_writer();
}

InputFile::~InputFile() { ::close(descriptor_); }

/// From here on reading waits for what is written.
void InputFile::stop_waiting_for_a_writer() {
  may_lack_a_writer_ = false;
  ::fcntl(descriptor_, F_SETFL, ::fcntl(descriptor_, F_GETFL) & ~O_NONBLOCK);
}

std::size_t InputFile::read(char* to, std::size_t most) {
  const auto begin = std::chrono::steady_clock::now();
  for (;;) {
    const ssize_t got = ::read(descriptor_, to, most);
    if (got < 0 && errno == EINTR) continue;
    if (may_lack_a_writer_ && got == 0) {
      if (std::chrono::steady_clock::now() - begin > patience)
        throw InputError("is a pipe that nobody writes to");
      std::this_thread::sleep_for(between_tries);
      continue;
    }
    const bool must_wait = may_lack_a_writer_ && got < 0 && (errno == EAGAIN || errno == EWOULDBLOCK);
    if (got < 0 && !must_wait) throw InputError(std::strerror(errno));
    if (may_lack_a_writer_) stop_waiting_for_a_writer();
    if (!must_wait) return static_cast<std::size_t>(got);
  }
}

}  // namespace touchmark::mesh_io
