#include "bench/contestants/rival_module.h"

#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

namespace touchmark::bench::contestants {
namespace {

TEST(RivalModule, ThatIsNotBesideTheProgramIsNamed) {
  try {
    builder_of("no-such-rival");
    FAIL() << "it was loaded";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("no-such-rival cannot be loaded: "), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("touchmark-no-such-rival.so"), std::string::npos);
  }
}

}  // namespace
}  // namespace touchmark::bench::contestants
