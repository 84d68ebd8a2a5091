#include "bench/support/files/packed_blocks.h"

#include <bit>
#include <limits>
#include <new>
#include <utility>

#include <zlib.h>

namespace touchmark::bench::support {

template <class T>
PackedBlock BlockPacker::add_integers(std::span<const T> items, bool delta) {
  std::string planes(items.size() * sizeof(T), '\0');
  T before = 0;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const T stored = delta ? static_cast<T>(items[i] - std::exchange(before, items[i])) : items[i];
    for (std::size_t byte = 0; byte < sizeof(T); ++byte)
      planes[byte * items.size() + i] =
          static_cast<char>((static_cast<std::uint64_t>(stored) >> (8 * byte)) & 0xff);
  }
  return add_planes(planes, sizeof(T), delta);
}

PackedBlock BlockPacker::add(std::span<const std::uint8_t> items) { return add_integers(items, false); }
PackedBlock BlockPacker::add(std::span<const std::uint16_t> items, bool delta) {
  return add_integers(items, delta);
}
PackedBlock BlockPacker::add(std::span<const std::uint32_t> items, bool delta) {
  return add_integers(items, delta);
}
PackedBlock BlockPacker::add(std::span<const std::uint64_t> items) { return add_integers(items, false); }

PackedBlock BlockPacker::add(std::span<const double> items) {
  std::vector<std::uint64_t> bits;
  bits.reserve(items.size());
  for (const double item : items) bits.push_back(std::bit_cast<std::uint64_t>(item));
  PackedBlock block = add(std::span<const std::uint64_t>(bits));
  block.real = true;
  return block;
}

PackedBlock BlockPacker::add_planes(const std::string& planes, std::size_t item_bytes, bool delta) {
  uLongf size = compressBound(static_cast<uLong>(planes.size()));
  std::string packed(size, '\0');
  const int status =
      compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(planes.data()),
                static_cast<uLong>(planes.size()), Z_DEFAULT_COMPRESSION);
  if (status != Z_OK) throw std::bad_alloc();  // the room is enough, so nothing else can be missing
  const PackedBlock block{bytes_.size(), size, planes.size() / item_bytes, item_bytes, false, delta};
  bytes_.append(packed, 0, size);
  return block;
}

std::optional<std::string> unpacked(std::string_view blocks, const PackedBlock& block) {
  constexpr std::size_t max_ratio = 1032;  // deflate makes nothing smaller than this part of it
  if (block.offset > blocks.size() || block.bytes > blocks.size() - block.offset) return std::nullopt;
  if (block.item_bytes == 0 || block.items > block.bytes * max_ratio / block.item_bytes) return std::nullopt;
  std::string planes(block.items * block.item_bytes, '\0');
  uLongf size = static_cast<uLongf>(planes.size());
  const int status = uncompress(reinterpret_cast<Bytef*>(planes.data()), &size,
                                reinterpret_cast<const Bytef*>(blocks.data() + block.offset),
                                static_cast<uLong>(block.bytes));
  if (status != Z_OK || size != planes.size()) return std::nullopt;
  return planes;
}

std::vector<std::uint32_t> integers_of(const std::string& planes, const PackedBlock& block) {
  std::vector<std::uint32_t> items(block.items);
  const std::uint32_t mask = block.item_bytes >= 4 ? std::numeric_limits<std::uint32_t>::max()
                                                   : (std::uint32_t{1} << (8 * block.item_bytes)) - 1;
  std::uint32_t before = 0;
  for (std::size_t i = 0; i < block.items; ++i) {
    std::uint32_t item = 0;
    for (std::size_t byte = 0; byte < block.item_bytes && byte < 4; ++byte)
      item |= static_cast<std::uint32_t>(static_cast<unsigned char>(planes[byte * block.items + i]))
              << (8 * byte);
    if (block.delta) before = item = (item + before) & mask;
    items[i] = item;
  }
  return items;
}

}  // namespace touchmark::bench::support
