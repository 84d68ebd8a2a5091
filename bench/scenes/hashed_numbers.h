/// Numbers that belong to a body and a purpose, whatever was drawn before: the same on every machine.
#pragma once

#include <cstddef>
#include <cstdint>

namespace touchmark::bench::scenes {

class HashedNumbers {
 public:
  HashedNumbers(std::uint32_t body, std::uint32_t purpose) noexcept
      : seed_((std::uint64_t{purpose} << 32) | body) {}

  /// Uniform in [-1, 1).
  double operator()(std::uint64_t which) const noexcept {
    return static_cast<double>(bits(which) >> 11) * 0x1p-52 - 1;
  }
  std::size_t below(std::size_t count) const noexcept { return static_cast<std::size_t>(bits(0) % count); }

 private:
  /// The finaliser of splitmix64 (Steele, Lea and Flood 2014), twice.
  static std::uint64_t mixed(std::uint64_t x) noexcept {
    x += 0x9e3779b97f4a7c15;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
    x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
    return x ^ (x >> 31);
  }
  std::uint64_t bits(std::uint64_t which) const noexcept { return mixed(mixed(seed_) + which); }

  std::uint64_t seed_;
};

}  // namespace touchmark::bench::scenes
