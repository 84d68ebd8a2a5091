/// Checks for enough memory before it is taken.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace touchmark::bench::support {

/// Bytes that can be taken now without swapping and within the process's own limit (ulimit -v), which so is a
/// budget that anybody can state; nothing where the system does not say.
std::optional<std::uint64_t> available_memory();

/// Bytes of this process's address space.
std::uint64_t address_space();

/// Throws ResourceError("WHAT need about N MB of memory, and M MB are available") where there is less. Any
/// number of bytes, infinity too.
void require_memory(std::string_view what, double bytes);

/// Requires memory for "N triangles at B bytes each".
void require_memory_for_triangles(std::size_t count, double bytes_each);

/// Any detector keeps a copy of the triangles, and a structure over them.
inline constexpr double min_bytes_per_triangle = 150;

/// How a contestant's refusal begins that is for want of memory.
inline constexpr std::string_view no_memory = "no memory: ";

}  // namespace touchmark::bench::support
