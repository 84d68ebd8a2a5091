/// What a mesh or a trace holds, as a number: equal content has equal numbers on every machine.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "bench/workload/steps.h"
#include "bench/workload/workload.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::workload {

/// FNV-1a, 64 bits.
class ContentHash {
 public:
  void add(const void* data, std::size_t size) noexcept {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) value_ = (value_ ^ bytes[i]) * 0x100000001b3;
  }
  void add(double value) noexcept {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    add(&bits, sizeof bits);
  }
  /// Adds a text with its end, so that "ab", "c" is not "a", "bc".
  void add(std::string_view text) noexcept {
    add(text.data(), text.size());
    add("", 1);
  }
  std::uint64_t value() const noexcept { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325;
};

/// Over the bits of vertices, corners and ids.
std::uint64_t hash_of(const TriangleMesh& mesh);
/// Over the bits of each step's centre, radius and reach.
std::uint64_t hash_of(std::span<const Step> trace);
/// Over the workload's mesh; of a scene over its shapes, and over the bodies and where they are at the start.
std::uint64_t hash_of_things(const Workload& workload);
/// Over a trace, and over the places that the bodies of a scene take in its steps.
std::uint64_t hash_of_motion(const Workload& workload, std::size_t trace);

}  // namespace touchmark::bench::workload
