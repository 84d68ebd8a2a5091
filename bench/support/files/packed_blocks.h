/// Lists of numbers as compressed blocks, one behind the other, in a file that other programs read:
/// docs/reference/steps-bin.md says how.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace touchmark::bench::support {

/// A block: its place in the file, and its items.
struct PackedBlock {
  std::size_t offset = 0;  ///< bytes from the first block's begin
  std::size_t bytes = 0;   ///< compressed
  std::size_t items = 0;
  std::size_t item_bytes = 1;
  bool real = false;   ///< doubles, not integers
  bool delta = false;  ///< each item is stored less the one before it
};

/// Packs unsigned integers and doubles, little end first. Bytes of equal weight stand together, so that the
/// high ones, which vary little, compress well.
class BlockPacker {
 public:
  PackedBlock add(std::span<const std::uint8_t> items);
  PackedBlock add(std::span<const std::uint16_t> items, bool delta = false);
  PackedBlock add(std::span<const std::uint32_t> items, bool delta = false);
  PackedBlock add(std::span<const std::uint64_t> items);
  PackedBlock add(std::span<const double> items);

  /// All blocks.
  const std::string& bytes() const noexcept { return bytes_; }

 private:
  template <class T>
  PackedBlock add_integers(std::span<const T> items, bool delta);
  PackedBlock add_planes(const std::string& planes, std::size_t item_bytes, bool delta);

  std::string bytes_;
};

/// Returns the bytes that a block was compressed from; nothing where it is damaged, or lies or grows beyond
/// what `block` says.
std::optional<std::string> unpacked(std::string_view blocks, const PackedBlock& block);

/// Returns the items of a block of at most 4 bytes each, whose bytes unpacked() returned.
std::vector<std::uint32_t> integers_of(const std::string& planes, const PackedBlock& block);

}  // namespace touchmark::bench::support
