#include "bench/support/files/packed_blocks.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace touchmark::bench::support {
namespace {

TEST(PackedBlocks, GiveBackWhatWasPackedOneBehindTheOther) {
  const std::vector<std::uint8_t> small{0, 255, 3};
  const std::vector<std::uint16_t> falling{65535, 0, 7, 6};
  const std::vector<std::uint32_t> large{0, 4294967295U, 1U << 31};
  BlockPacker packer;
  const PackedBlock first = packer.add(std::span<const std::uint8_t>(small));
  const PackedBlock second = packer.add(std::span<const std::uint16_t>(falling), true);
  const PackedBlock third = packer.add(std::span<const std::uint32_t>(large));
  const auto items = [&](const PackedBlock& block) {
    return integers_of(unpacked(packer.bytes(), block).value(), block);
  };
  EXPECT_EQ(items(first), (std::vector<std::uint32_t>{0, 255, 3}));
  EXPECT_EQ(items(second), (std::vector<std::uint32_t>{65535, 0, 7, 6}));
  EXPECT_EQ(items(third), (std::vector<std::uint32_t>{0, 4294967295U, 1U << 31}));
}

TEST(PackedBlocks, HaveTheLowestBytesOfAllItemsFirst) {
  const std::vector<double> items{1.0, -2.0};  // 3ff0..., c000...
  BlockPacker packer;
  const PackedBlock block = packer.add(std::span<const double>(items));
  EXPECT_TRUE(block.real);
  std::string expected(16, '\0');
  expected[12] = '\xf0';
  expected[14] = '\x3f';
  expected[15] = '\xc0';
  EXPECT_EQ(unpacked(packer.bytes(), block), expected);
}

TEST(PackedBlocks, AnEmptyListIsABlockToo) {
  BlockPacker packer;
  const PackedBlock block = packer.add(std::span<const std::uint32_t>());
  EXPECT_EQ(unpacked(packer.bytes(), block), "");
}

TEST(PackedBlocks, NothingComesOfABlockThatIsDamagedOrLies) {
  const std::vector<std::uint32_t> items(100, 9);
  BlockPacker packer;
  const PackedBlock block = packer.add(std::span<const std::uint32_t>(items));
  const std::string bytes = packer.bytes();
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string damaged = bytes;
    damaged[i] = static_cast<char>(~damaged[i]);
    EXPECT_NE(unpacked(damaged, block), unpacked(bytes, block)) << i;
  }
  PackedBlock longer = block, beyond = block, huge = block;
  longer.items = 101;
  beyond.offset = bytes.size() + 1;
  huge.items = std::size_t{1} << 60;
  for (const PackedBlock& lie : {longer, beyond, huge}) EXPECT_EQ(unpacked(bytes, lie), std::nullopt);
}

}  // namespace
}  // namespace touchmark::bench::support
