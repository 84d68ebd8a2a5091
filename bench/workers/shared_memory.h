/// Memory that the program and its workers both see, so that all contestants read identical bytes.
#pragma once

#include <cstddef>
#include <span>

namespace touchmark::bench::workers {

/// An anonymous file mapped into memory; unmapped and closed at the end of its life.
class SharedMemory {
 public:
  enum class Access { read, write };

  /// Zeroed. Throws ResourceError when there is not so much memory.
  static SharedMemory create(std::size_t bytes);
  /// What another process created; takes the descriptor over. Throws ResourceError.
  static SharedMemory attach(int descriptor, Access access);

  SharedMemory(SharedMemory&& other) noexcept;
  SharedMemory& operator=(SharedMemory&&) = delete;
  ~SharedMemory();

  std::span<std::byte> bytes() const noexcept { return {data_, size_}; }
  int descriptor() const noexcept { return descriptor_; }

 private:
  SharedMemory(int descriptor, std::size_t size, int protection);

  int descriptor_;
  std::size_t size_;
  std::byte* data_ = nullptr;
};

}  // namespace touchmark::bench::workers
