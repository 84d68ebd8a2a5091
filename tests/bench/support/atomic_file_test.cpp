#include "bench/support/files/atomic_file.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "tests/temporary_folder.h"

namespace touchmark::bench::support {
namespace {

TEST(AtomicFile, HasItsNameOnlyOnceItIsComplete) {
  const TemporaryFolder folder;
  const std::string path = folder.file("out.csv");
  {
    AtomicFile given_up(path);
    given_up.write("half");
  }
  EXPECT_EQ(folder.entries(), 0U);
  AtomicFile file(path);
  file.write("whole");
  EXPECT_FALSE(std::filesystem::exists(path));
  file.commit();
  EXPECT_EQ(folder.entries(), 1U);
  std::string text;
  std::ifstream(path) >> text;
  EXPECT_EQ(text, "whole");
}

TEST(AtomicFile, LeavesNothingBehindWhereItCannotWrite) {
  const TemporaryFolder folder;
  const std::string path = folder.file("no such folder") + "/out.csv";
  try {
    const AtomicFile lost(path);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(error.what(), "cannot write " + path + ": No such file or directory");
  }
  const std::string taken = folder.file("taken.csv");
  std::filesystem::create_directory(taken);
  EXPECT_THROW(
      {
        AtomicFile file(taken);
        file.write("lost");
        file.commit();
      },
      std::runtime_error);
  EXPECT_EQ(folder.entries(), 1U);
}

TEST(AtomicFile, WritesIntoDevicesWithoutReplacingThem) {
  AtomicFile file("/dev/null");
  file.write("gone");
  file.commit();
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(AtomicFile, FailsOnAFullDisk) {
  EXPECT_THROW(
      {
        AtomicFile file("/dev/full");
        file.write(std::string(1'000'000, 'x'));
        file.commit();
      },
      std::runtime_error);
}

}  // namespace
}  // namespace touchmark::bench::support
