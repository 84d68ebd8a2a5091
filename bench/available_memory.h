#pragma once

#include <cstdint>
#include <optional>

namespace touchmark::bench {

/// Bytes that can be taken now without swapping; nothing where the system does not say.
std::optional<std::uint64_t> available_memory();

}  // namespace touchmark::bench
