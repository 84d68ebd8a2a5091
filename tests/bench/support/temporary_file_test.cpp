/// Tests that temporary files lie in TMPDIR, and that an unusable folder is named.
#include "bench/support/files/temporary_file.h"

#include <cstdio>
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "bench/support/failures.h"
#include "tests/temporary_folder.h"

namespace touchmark::bench::support {
namespace {

TEST(ATemporaryFile, IsInTMPDIRHasNoNameAndHoldsWhatIsWritten) {
  const TemporaryFolder folder;
  setenv("TMPDIR", folder.path().c_str(), 1);
  const File file = temporary_file();
  unsetenv("TMPDIR");
  ASSERT_NE(file, nullptr);
  EXPECT_EQ(folder.entries(), 0U);
  std::fputs("some", file.get());
  std::rewind(file.get());
  EXPECT_EQ(std::fgetc(file.get()), 's');
}

TEST(ATemporaryFile, ThatCannotBeMadeIsRefusedNamingTheFolderAndTheWayOut) {
  setenv("TMPDIR", "/proc", 1);
  std::string text;
  try {
    temporary_file();
  } catch (const ResourceError& error) {
    text = error.what();
  }
  unsetenv("TMPDIR");
  EXPECT_EQ(text.find("no temporary file can be made in /proc: "), 0U) << text;
  EXPECT_NE(text.find("set TMPDIR to a folder that can be written to"), std::string::npos) << text;
}

}  // namespace
}  // namespace touchmark::bench::support
