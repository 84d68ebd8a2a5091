/// Bytes that any thread may read and set at any time, also through a constant: what is found out late.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace touchmark {

/// Each byte by itself: a reader sees it as it was or as it is, and nothing of when others are set. A copy
/// takes each as it is then. To resize or assign, be alone.
class SharedBytes {
 public:
  SharedBytes() = default;
  SharedBytes(std::size_t count, std::uint8_t value) : bytes_(count, value) {}
  SharedBytes(const SharedBytes& other) : bytes_(other.size()) {
    for (std::size_t i = 0; i < other.size(); ++i) bytes_[i] = other[i];
  }
  SharedBytes& operator=(const SharedBytes& other) { return *this = SharedBytes(other); }
  SharedBytes(SharedBytes&&) noexcept = default;
  SharedBytes& operator=(SharedBytes&&) noexcept = default;
  ~SharedBytes() = default;

  std::uint8_t operator[](std::size_t i) const noexcept {
    return std::atomic_ref(bytes_[i]).load(std::memory_order_relaxed);
  }
  void set(std::size_t i, std::uint8_t value) const noexcept {
    std::atomic_ref(bytes_[i]).store(value, std::memory_order_relaxed);
  }
  /// Takes bits off.
  void clear(std::size_t i, std::uint8_t bits) const noexcept {
    std::atomic_ref(bytes_[i]).fetch_and(static_cast<std::uint8_t>(~bits), std::memory_order_relaxed);
  }

  std::size_t size() const noexcept { return bytes_.size(); }
  bool empty() const noexcept { return bytes_.empty(); }
  std::size_t bytes() const noexcept { return bytes_.capacity(); }

 private:
  mutable std::vector<std::uint8_t> bytes_;
};

}  // namespace touchmark
