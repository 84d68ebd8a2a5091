#include "bench/meshes/meshes.h"

#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

namespace touchmark::bench::meshes {
namespace {

std::string refusal(const std::string& name) {
  try {
    load_mesh(name);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Meshes, EveryExampleLoadsAndIsTheSameTwice) {
  for (const NamedMesh& named : named_meshes()) {
    if (named.example.empty()) continue;
    const TriangleMesh once = load_mesh(named.example), twice = load_mesh(named.example);
    ASSERT_EQ(once.size(), twice.size()) << named.name;
    ASSERT_TRUE(std::equal(once.vertices().begin(), once.vertices().end(), twice.vertices().begin(),
                           twice.vertices().end()))
        << named.name;
    ASSERT_TRUE(std::equal(once.triangles().begin(), once.triangles().end(), twice.triangles().begin(),
                           twice.triangles().end()))
        << named.name;
  }
}

TEST(Meshes, ModifiersApplyInTheOrderWritten) {
  EXPECT_EQ(load_mesh("cube@scale=4@offset=1").bounds().min, Vec3(-1, -1, -1));
  EXPECT_EQ(load_mesh("cube@offset=1@scale=4").bounds().min, Vec3(2, 2, 2));
  EXPECT_DOUBLE_EQ(load_mesh("cube@offset=8@normalize").diagonal(), 1);
}

TEST(Meshes, ABadNameOrParameterIsNamedInOneLine) {
  for (const char* name : {"",
                           "cub",
                           "icosphere",
                           "icosphere:",
                           "icosphere:x",
                           "icosphere:12",
                           "icosphere:-1",
                           "icosphere:1.5",
                           "torus:8",
                           "torus:2x3",
                           "torus:8x8x8",
                           "torus:1000000x1000000",
                           "cube:1",
                           "noisy-sphere:5",
                           "noisy-sphere:99999999999",
                           "soup:0",
                           "cube@",
                           "cube@scale",
                           "cube@scale=",
                           "cube@scale=0",
                           "cube@scale=-1",
                           "cube@scale=inf",
                           "cube@scale=nan",
                           "cube@offset=1e999",
                           "cube@grow=2",
                           "cube@normalize=1",
                           "dragon:5",
                           "dragon:0",
                           "bunny:2"}) {
    const std::string message = refusal(name);
    EXPECT_NE(message.find(std::string("\"").append(name).append("\"")), std::string::npos)
        << name << ": " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace touchmark::bench::meshes
