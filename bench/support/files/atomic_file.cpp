#include "bench/support/files/atomic_file.h"

#include <cerrno>
#include <filesystem>
#include <utility>

#include <unistd.h>

#include "bench/support/failures.h"
#include "bench/support/system/system_limit.h"

namespace touchmark::bench::support {

namespace {

/// Through a symbolic link to what it points to; /dev/stdout and the like are written as they are.
bool can_be_replaced(const std::string& path) {
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  return !std::filesystem::exists(status) || std::filesystem::is_regular_file(status);
}
std::string resolved(const std::string& path) {
  std::error_code error;
  const auto target = std::filesystem::canonical(path, error);
  return error ? path : target.string();
}

}  // namespace

AtomicFile::AtomicFile(const std::string& path)
    : path_(path),
      target_(resolved(path)),
      temporary_(can_be_replaced(path) ? target_ + ".part-" + std::to_string(::getpid()) : target_),
      file_(std::fopen(temporary_.c_str(), "wb")) {
  if (file_ == nullptr) fail(errno);
}

AtomicFile::~AtomicFile() {
  if (file_ == nullptr) return;
  std::fclose(file_);
  discard();
}

void AtomicFile::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), file_) != text.size()) fail(errno);
}

void AtomicFile::commit() {
  if (std::fclose(std::exchange(file_, nullptr)) != 0 ||
      (temporary_ != target_ && std::rename(temporary_.c_str(), target_.c_str()) != 0)) {
    const int error = errno;
    discard();
    fail(error);
  }
}

void AtomicFile::discard() const {
  if (temporary_ != target_) std::remove(temporary_.c_str());
}

void AtomicFile::fail(int error) const {
  throw ResourceError("cannot write " + path_ + ": " + described_with_limit(error));
}

}  // namespace touchmark::bench::support
