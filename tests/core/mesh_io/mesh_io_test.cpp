// Files as users have them: through load_mesh, from disk. What each reader refuses is in readers_test.cpp.
#include "core/mesh_io/mesh_io.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/temporary_folder.h"

namespace touchmark {
namespace {

std::string refusal(const std::string& path) {
  try {
    load_mesh(path);
  } catch (const MeshError& error) {
    return error.what();
  }
  return "accepted";
}

void expect_refusal(const std::string& path, const std::string& why) {
  const std::string message = refusal(path);
  EXPECT_EQ(message.rfind(path + ": ", 0), 0u) << message;
  EXPECT_NE(message.find(why), std::string::npos) << message << "\ndoes not say: " << why;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

const std::string square_obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
const std::string triangle_off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
const std::string triangle_ply =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
const std::string triangle_stl =
    "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
    "0\nendloop\nendfacet\nendsolid\n";

TEST(LoadMesh, ChoosesTheReaderByTheEndingInAnyCase) {
  const TemporaryFolder folder;
  EXPECT_EQ(load_mesh(folder.file("a.obj", square_obj)).size(), 2u);
  EXPECT_EQ(load_mesh(folder.file("a.OFF", triangle_off)).size(), 1u);
  EXPECT_EQ(load_mesh(folder.file("a.Ply", triangle_ply)).size(), 1u);
  EXPECT_EQ(load_mesh(folder.file("b c.d.stl", triangle_stl)).size(), 1u);
}

TEST(LoadMesh, ReadsWindowsAndOldMacintoshLines) {
  const TemporaryFolder folder;
  for (const char* line_end : {"\r\n", "\r"}) {
    for (const auto& [name, content] : {std::pair{"a.obj", square_obj},
                                        {"a.off", triangle_off},
                                        {"a.ply", triangle_ply},
                                        {"a.stl", triangle_stl}}) {
      std::string text;
      for (const char c : content) text += c == '\n' ? std::string(line_end) : std::string(1, c);
      EXPECT_EQ(refusal(folder.file(name, text)), "accepted") << name;
    }
  }
}

TEST(LoadMesh, RefusesWhatIsNoReadableFile) {
  const TemporaryFolder folder;
  expect_refusal(folder.file("missing.ply"), "no such file");
  expect_refusal(folder.file("missing/a.ply"), "no such file");
  expect_refusal(folder.path(), "is a directory");
  std::filesystem::create_directory(folder.file("folder.obj"));
  expect_refusal(folder.file("folder.obj"), "is a directory");
  std::filesystem::create_symlink(folder.file("nowhere"), folder.file("dangling.obj"));
  expect_refusal(folder.file("dangling.obj"), "no such file");
}

TEST(LoadMesh, ReadsAPipeThatSomebodyWritesTo) {
  const TemporaryFolder folder;
  const std::string pipe = folder.file("pipe.obj");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::thread writer([&] {
    std::ofstream out(pipe);
    out << "v 0 0 0\nv 1 0 0\nv 0 1 0\n" << std::flush;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    out << "f 1 2 3\n";
  });
  EXPECT_EQ(load_mesh(pipe).size(), 1u);
  writer.join();
}

TEST(LoadMesh, APipeThatNobodyWritesToIsRefused) {
  const TemporaryFolder folder;
  const std::string pipe = folder.file("pipe.ply");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  expect_refusal(pipe, "is a pipe that nobody writes to");
}

TEST(LoadMesh, RefusesAFileOfMoreThanFourGibibytesUnread) {
  const TemporaryFolder folder;
  const std::string path = folder.file("large.stl", "solid\n");
  std::error_code no_room;
  std::filesystem::resize_file(path, (std::uintmax_t{4} << 30) + 1, no_room);
  if (no_room) GTEST_SKIP() << "the file system takes no sparse file of this size";
  expect_refusal(path, "has 4294967297 bytes; at most 4294967296 are read (4 GiB)");
}

TEST(LoadMesh, RefusesDevices) { expect_refusal("/dev/null", "is neither a file nor a pipe"); }

TEST(LoadMesh, ACadFileIsToldFromAMesh) {
  const TemporaryFolder folder;
  const std::string step = "ISO-10303-21;\nHEADER;\n", what = "is a CAD exchange file (STEP), not a mesh";
  for (const char* name : {"a.step", "a.STP", "a.stl", "a.txt"})
    expect_refusal(folder.file(name, step), what);
  expect_refusal(folder.file("a.igs", "S      1\n"), "is a CAD exchange file (IGES), not a mesh");
}

TEST(LoadMesh, RefusesAFileThatMayNotBeRead) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may read everything";
  const TemporaryFolder folder;
  const std::string path = folder.file("secret.obj", square_obj);
  std::filesystem::permissions(path, std::filesystem::perms::none);
  expect_refusal(path, "Permission denied");
}

TEST(LoadMesh, RefusesEmptyFilesOfEveryFormat) {
  const TemporaryFolder folder;
  for (const char* name : {"a.ply", "a.obj", "a.off", "a.stl", "a.gltf", "a.3ds"}) {
    expect_refusal(folder.file(name, ""), "is empty");
  }
}

TEST(LoadMesh, RefusesEndingsOfNoFormatAndNone) {
  const TemporaryFolder folder;
  expect_refusal(folder.file("a.txt", "hello"), "'.txt'");
  expect_refusal(folder.file("a.ply~", triangle_ply), "'.ply~'");
  expect_refusal(folder.file("noending", triangle_ply), "''");
}

TEST(LoadMesh, RefusesOneFormatUnderAnothersEnding) {
  const TemporaryFolder folder;
  expect_refusal(folder.file("a.ply", square_obj), "line 1");
  expect_refusal(folder.file("a.obj", triangle_ply), "line 1");
  expect_refusal(folder.file("a.off", triangle_stl), "line 1");
  expect_refusal(folder.file("a.stl", triangle_off), "line 1");
}

TEST(LoadMesh, KeepsNumbersThatSinglePrecisionCannot) {
  const TemporaryFolder folder;
  const TriangleMesh mesh =
      load_mesh(folder.file("far.obj", "v 1000000.001 1e300 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
  EXPECT_EQ(mesh.vertices()[0], Vec3(1000000.001, 1e300, 0));
}

TEST(LoadMesh, KeepsDegenerateTrianglesAndRepeatedVertices) {
  const TemporaryFolder folder;
  const TriangleMesh mesh =
      load_mesh(folder.file("a.obj", "v 0 0 0\nv 1 0 0\nv 1 0 0\nv 2 0 0\nf 1 1 1\nf 1 2 3\nf 1 2 4\n"));
  EXPECT_EQ(mesh.size(), 3u);
  EXPECT_EQ(mesh.vertices().size(), 4u);
}

TEST(LoadMesh, MaterialsAndGroupsDoNotReorderFaces) {
  const TemporaryFolder folder;
  const TriangleMesh mesh = load_mesh(
      folder.file("a.obj",
                  "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\no a\nusemtl red\nf 1 2 3\no b\nusemtl blue\nf 2 3 4\n"
                  "p 1\nl 1 2\nusemtl red\nf 1 2 3 4\ng c\nf 3 4 1\n"));
  const std::vector<TriangleId> expected = {0, 1, 2, 2, 3};
  EXPECT_TRUE(std::equal(mesh.ids().begin(), mesh.ids().end(), expected.begin(), expected.end()));
  EXPECT_EQ(mesh.triangles()[1], (TriangleMesh::Corners{1, 2, 3}));
  EXPECT_EQ(mesh.triangles()[4], (TriangleMesh::Corners{2, 3, 0}));
}

// A damaged file is refused by its reader or still is a mesh; nothing else may come out, and no time or
// memory that the file's size does not justify.
TEST(LoadMesh, SurvivesEveryCutAndEveryChangedByte) {
  const TemporaryFolder folder;
  for (const auto& [name, content] : {std::pair{"a.obj", square_obj},
                                      {"a.off", triangle_off},
                                      {"a.ply", triangle_ply},
                                      {"a.stl", triangle_stl}}) {
    for (std::size_t length = 1; length < content.size(); ++length) {
      const std::string path = folder.file(name, content.substr(0, length));
      const std::string message = refusal(path);
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
    for (std::size_t at = 0; at < content.size(); ++at) {
      for (const char c : {'9', '-', '\0'}) {
        std::string changed = content;
        changed[at] = c;
        const std::string message = refusal(folder.file(name, changed));
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
      }
    }
  }
}

TEST(LoadMesh, NamesTheCallThatReadsOtherFormats) {
  const TemporaryFolder folder;
  for (const char* name : {"a.3ds", "a.nosuch", "a"}) {
    const std::string path = folder.file(name, "content");
    EXPECT_FALSE(is_read_strictly(path));
    expect_refusal(path, "load_mesh_with_assimp of <touchmark/mesh_io_assimp.h>");
    EXPECT_THROW(load_node_tree(path), MeshError);
  }
}

TEST(LoadMesh, ReadsTheSharedModels) {
  const std::filesystem::path models = TOUCHMARK_SHARED_MODELS;
  if (!std::filesystem::exists(models / "bunny-902.ply"))
    GTEST_SKIP() << models / "bunny-902.ply"
                 << " is not there";
  EXPECT_EQ(load_mesh(models / "bunny-902.ply").size(), 902u);
  EXPECT_EQ(load_mesh(models / "bun_zipper_res2.ply").size(), 16301u);
  EXPECT_EQ(load_mesh(models / "bun_zipper_res3.ply").size(), 3851u);
  EXPECT_EQ(load_mesh(models / "bun_zipper_res4.ply").size(), 948u);
}

TEST(LoadMesh, ReadsDebiansBunny) {
  const char* bunny = "/usr/share/glmark2/models/bunny.obj";
  if (!std::filesystem::exists(bunny)) GTEST_SKIP() << bunny << " is not there";
  const TriangleMesh mesh = load_mesh(bunny);
  EXPECT_EQ(mesh.size(), 69666u);
  EXPECT_EQ(mesh.vertices().size(), 34835u);
}

}  // namespace
}  // namespace touchmark
