#include "core/mesh_io/readers.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace touchmark::mesh_io {
namespace {

using Reader = TriangleMesh (*)(std::string_view);

std::string refusal(Reader read, const std::string& text) {
  try {
    read(text);
  } catch (const MeshError& error) {
    return error.what();
  }
  return "accepted";
}

double area(const TriangleMesh& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    const Vec3 u = mesh.corner(i, 1) - mesh.corner(i, 0), v = mesh.corner(i, 2) - mesh.corner(i, 0);
    sum += 0.5 *
           Vec3(u.y() * v.z() - u.z() * v.y(), u.z() * v.x() - u.x() * v.z(), u.x() * v.y() - u.y() * v.x())
               .norm();
  }
  return sum;
}

const std::string square_obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(ReadObj, KeepsEveryDouble) {
  const TriangleMesh mesh = read_obj("v 1000000.0000000001 0.1 -1e-300\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_EQ(mesh.vertices()[0], Vec3(1000000.0000000001, 0.1, -1e-300));
}

TEST(ReadObj, CountsFacesInTheFilesOrderAndPolygonsOnce) {
  const TriangleMesh mesh =
      read_obj(square_obj + "g one\nf 1 2 3\nusemtl red\nf 1 2 3 4\nl 1 2\nf 1/1 3//2 4/1/1\n");
  ASSERT_EQ(mesh.size(), 4u);
  EXPECT_EQ(mesh.id(0), 0u);
  EXPECT_EQ(mesh.id(1), 1u);
  EXPECT_EQ(mesh.id(2), 1u);
  EXPECT_EQ(mesh.id(3), 2u);
}

TEST(ReadObj, CountsBackwardsFromNegativeIndices) {
  const TriangleMesh mesh = read_obj("v 9 9 9\n" + square_obj + "f -4 -3 -1\n");
  EXPECT_EQ(mesh.triangles()[0], (TriangleMesh::Corners{1, 2, 4}));
}

TEST(ReadObj, TakesWindowsLinesCommentsAndContinuations) {
  const TriangleMesh mesh = read_obj("# a\r\nv 0 0 0 # origin\r\nv 1 0 \\\r\n 0\r\nv 0 1 0\r\nf 1 2 3");
  EXPECT_EQ(mesh.size(), 1u);
  EXPECT_EQ(mesh.vertices()[1], Vec3(1, 0, 0));
}

TEST(ReadObj, APolygonThatIsNotConvexKeepsItsArea) {
  // An arrowhead; a fan from its first corner would cover more. Its area by the shoelace formula:
  const TriangleMesh mesh = read_obj("v 2 0 0\nv 1 0.5 0\nv 2 2 0\nv 0 0.5 0\nf 1 2 3 4\n");
  const double x[] = {2, 1, 2, 0}, y[] = {0, 0.5, 2, 0.5};
  double expected = 0;
  for (int i = 0; i < 4; ++i) expected += 0.5 * (x[i] * y[(i + 1) % 4] - x[(i + 1) % 4] * y[i]);
  EXPECT_NEAR(area(mesh), expected, 1e-15);
}

TEST(ReadObj, NamesTheLineOfWhatItRefuses) {
  EXPECT_EQ(refusal(read_obj, "v 0 0 0\nv 1 0 x\n"), "line 2: z 'x' is not a number");
  EXPECT_EQ(refusal(read_obj, "v 0 0\n"), "line 1: z is missing");
  EXPECT_EQ(refusal(read_obj, "v 0 nan 0\n"), "line 1: y 'nan' is not finite");
  EXPECT_EQ(refusal(read_obj, "v 0 1e400 0\n"), "line 1: y '1e400' does not fit a double");
  EXPECT_EQ(refusal(read_obj, square_obj + "f 1 2 7\n"), "line 5: face 0 names vertex 7 of 4");
  EXPECT_EQ(refusal(read_obj, square_obj + "f 1 2 0\n"), "line 5: face 0 names vertex 0 of 4");
  EXPECT_EQ(refusal(read_obj, square_obj + "f 1 2 -5\n"), "line 5: face 0 names vertex -5 of 4 so far");
  EXPECT_EQ(refusal(read_obj, square_obj + "f 1 2\n"), "line 5: face 0 has 2 corners; a face has at least 3");
  EXPECT_EQ(refusal(read_obj, "hello\n"), "line 1: unknown statement 'hello'");
  EXPECT_EQ(refusal(read_obj, square_obj), "the mesh has no triangle");
}

TEST(ReadObj, AFaceMayStandBeforeItsVertices) {
  const TriangleMesh mesh = read_obj("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 9 9 9\nf 4 -1 2\n");
  ASSERT_EQ(mesh.size(), 3u);
  EXPECT_EQ(mesh.triangles()[0], (TriangleMesh::Corners{0, 1, 2}));
  EXPECT_EQ(mesh.triangles()[1], (TriangleMesh::Corners{0, 1, 2}));
  EXPECT_EQ(mesh.triangles()[2], (TriangleMesh::Corners{3, 3, 1}));
  EXPECT_EQ(refusal(read_obj, "f -1 -2 -3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"),
            "line 1: face 0 names vertex -1 of 0 so far");
}

TEST(ReadObj, PaddingMayFollowTheLastLine) {
  EXPECT_EQ(read_obj(square_obj + "f 1 2 3\n" + std::string("\0\0\x1a\n", 4)).size(), 1u);
  EXPECT_EQ(refusal(read_obj, square_obj + std::string("\0\nf 1 2 3\n", 10)),
            "line 5: unknown statement '?'");
}

TEST(ReadObj, SkipsCurvesAndRefusesFreeFormSurfacesByName) {
  EXPECT_EQ(read_obj(square_obj + "cstype bspline\ndeg 3\ncurv 0 1 1 2 3 4\nparm u 0 0 1 1\nend\n"
                                  "curv2 1 2 3\nsp 1\nf 1 2 3\n")
                .size(),
            1u);
  EXPECT_EQ(refusal(read_obj, square_obj + "f 1 2 3\nsurf 0 1 0 1 1 2 3 4\n"),
            "line 6: surf, a free-form surface, is not supported");
  EXPECT_EQ(refusal(read_obj, "call other.obj\n"), "line 1: call, another file, is not supported");
}

TEST(ReadObj, ALineThatEndsInABackslashGoesOnAndIsCounted) {
  for (const char* line_end : {"\n", "\r\n", "\r"}) {
    const std::string joined = std::string("\\") + line_end;
    EXPECT_EQ(read_obj(square_obj + "f 1 " + joined + " 2" + joined + "3\ng a" + joined + "f 9\n").size(),
              1u);
    EXPECT_EQ(refusal(read_obj, square_obj + "f 1 " + joined + "2 3\nhello\n"),
              "line 7: unknown statement 'hello'");
  }
}

TEST(ReadObj, ACommentsLastBackslashDoesNotHideTheNextLine) {
  EXPECT_EQ(read_obj("# C:\\meshes\\\n" + square_obj + "f 1 2 3#first \\\nf 1 3 4\n").size(), 2u);
}

TEST(ReadObj, SkipsTagsWeightsAndColoursThatProgramsAdd) {
  EXPECT_EQ(read_obj(square_obj + "t crease 2/1/0 0 1 2.0\nvw 1 2 0.5\nvc 1 0 0\nres 4 4\nf 1 2 3\n").size(),
            1u);
  EXPECT_EQ(read_obj("v 0 0 0 0.5 0.5 1\nv 1 0 0 1 0 0\nv 0 1 0 0 0 1\nf 1//1 2//1 3//1\n").size(), 1u);
  EXPECT_EQ(refusal(read_obj, square_obj + "tt 1\n"), "line 5: unknown statement 'tt'");
}

TEST(ReadText, ADecimalCommaIsNamed) {
  const std::string rest = "\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
                    comma = " has a decimal comma; write a decimal point";
  EXPECT_EQ(refusal(read_obj, "v 0 0,5 0" + rest), "line 1: y '0,5'" + comma);
  EXPECT_EQ(refusal(read_obj, "v 0 0 -1,5e-3" + rest), "line 1: z '-1,5e-3'" + comma);
  for (const char* other : {"0,", "0,0,0", "1,000.5", "a,5", "1,x"}) {
    EXPECT_EQ(refusal(read_obj, std::string("v ") + other + " 0 0" + rest),
              "line 1: x '" + std::string(other) + "' is not a number");
  }
  EXPECT_EQ(refusal(read_off, "OFF\n3 1 0\n0,0 0 0\n"), "line 3: x '0,0'" + comma);
  EXPECT_EQ(refusal(read_stl, "solid\nfacet normal 0,0 0,0 1,0\nouter loop\nvertex 0 0,0 0\n"),
            "line 4: y '0,0'" + comma);
  EXPECT_EQ(refusal(read_ply,
                    "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                    "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                    "end_header\n0 0 1,0\n0\n"),
            "line 10: z '1,0'" + comma);
}

/// A corner for each of `angles` in whole turns, on the unit circle; every `dented`-th one is pulled in.
std::string polygon_obj(int corners, int dented) {
  std::string text, face = "f";
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * 3.14159265358979323846 * i / corners,
                 r = dented != 0 && i % dented == 1 ? 0.5 : 1;
    text += "v " + std::to_string(r * std::cos(angle)) + " " + std::to_string(r * std::sin(angle)) + " 0\n";
    face += " " + std::to_string(i + 1);
  }
  return text + face + "\n";
}

TEST(ReadObj, ALargeConvexFaceKeepsItsArea) {
  for (const int corners : {1024, 1025, 5000, 20000}) {
    const TriangleMesh mesh = read_obj(polygon_obj(corners, 0));
    ASSERT_EQ(mesh.size(), static_cast<std::size_t>(corners) - 2);
    EXPECT_EQ(mesh.id(mesh.size() - 1), 0u);
    // Six digits are written of each coordinate.
    EXPECT_NEAR(area(mesh), 3.14159265358979323846, 1e-4) << corners;
  }
}

TEST(ReadObj, ALargeFaceThatIsNotConvexIsRefusedByItsCorners) {
  EXPECT_EQ(read_obj(polygon_obj(1024, 4)).size(), 1022u);
  EXPECT_EQ(refusal(read_obj, polygon_obj(1028, 4)),
            "line 1029: face 0 has 1028 corners and is not convex; 1024 are the most of one that is not");
}

const std::string byte_order_mark = "\xef\xbb\xbf";

const std::string ply_header =
    "ply\nformat ascii 1.0\ncomment x\nelement vertex 3\nproperty double x\nproperty double y\nproperty "
    "float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";

TEST(ReadPly, ReadsAscii) {
  const TriangleMesh mesh = read_ply(ply_header + "0 0 0\n1000000.0000000001 0 0\n0 1 0\n3 0 1 2\n");
  EXPECT_EQ(mesh.size(), 1u);
  EXPECT_EQ(mesh.vertices()[1].x(), 1000000.0000000001);
}

TEST(ReadPly, SkipsElementsAndPropertiesThatItDoesNotNeed) {
  const TriangleMesh mesh = read_ply(
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty uchar red\nproperty float x\nproperty float "
      "y\nproperty float z\n"
      "property list uchar float extra\nelement material 2\nproperty int a\nelement face 1\nproperty uchar "
      "flag\n"
      "property list uchar int vertex_index\nend_header\n"
      "9 0 0 0 2 5 5\n9 1 0 0 0\n9 0 1 0 1 5\n7\n8\n4 3 2 1 0\n");
  EXPECT_EQ(mesh.triangles()[0], (TriangleMesh::Corners{2, 1, 0}));
}

TEST(ReadPly, NamesTheLineOfWhatItRefuses) {
  EXPECT_EQ(refusal(read_ply, ply_header + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"),
            "line 14: face 0 names vertex 3 of 3");
  EXPECT_EQ(refusal(read_ply, ply_header + "0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n"),
            "line 14: face 0 names vertex -1 of 3");
  EXPECT_EQ(refusal(read_ply, ply_header + "0 0 0\n1 0 0\n"), "line 13: ends after 2 of 3 vertices");
  EXPECT_EQ(refusal(read_ply, ply_header + "0 0 0\n1 0 0\n0 1 0\n"), "line 14: ends after 0 of 1 faces");
  EXPECT_EQ(refusal(read_ply, ply_header + "0 0 0\n1 0 inf\n"), "line 12: z 'inf' is not finite");
  EXPECT_EQ(refusal(read_ply, ply_header + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\nmore"),
            "line 15: goes on after its last element");
  EXPECT_EQ(refusal(read_ply, "plx\n"), "line 1: does not start with 'ply'");
  EXPECT_EQ(refusal(read_ply, "ply\nformat ascii 1.0\nelement vertex 3\n"),
            "line 4: the header has no end_header");
}

TEST(ReadPly, NamesWhatStandsInTheHeaderTwice) {
  const auto with = [](const std::string& lines) {
    return "ply\nformat ascii 1.0\n" + lines + "end_header\n";
  };
  EXPECT_EQ(refusal(read_ply, with("element vertex 3\nproperty float x\nproperty double x\n")),
            "line 5: element 'vertex' has property 'x' twice");
  EXPECT_EQ(refusal(read_ply, with("element vertex 3\nproperty float x\nelement vertex 3\n")),
            "line 5: element 'vertex' stands in the header twice");
  EXPECT_EQ(refusal(read_ply, with("format ascii 1.0\n")), "line 3: a second format");
}

TEST(ReadPly, SaysWhichPartOfASurfaceIsNotThere) {
  const std::string points =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
  EXPECT_EQ(refusal(read_ply, points + "end_header\n0 0 0\n"),
            "the header has no element face: these are points without a surface");
  const std::string no_faces = "element face 0\nproperty list uchar int vertex_indices\n",
                    edge = "element edge 1\nproperty int vertex1\nproperty int vertex2\n";
  EXPECT_EQ(refusal(read_ply, points + no_faces + "end_header\n0 0 0\n"),
            "line 7: element 'face' has count 0: these are points without a surface");
  EXPECT_EQ(refusal(read_ply, points + edge + "end_header\n0 0 0\n0 0\n"),
            "line 7: element 'edge' is no surface, and there are no faces");
  EXPECT_EQ(refusal(read_ply, points + no_faces + edge + "end_header\n0 0 0\n0 0\n"),
            "line 9: element 'edge' is no surface, and there are no faces");
  EXPECT_EQ(refusal(read_ply, points + "element range_grid 1\nproperty list uchar int vertex_indices\n"
                                       "end_header\n0 0 0\n1 0\n"),
            "line 7: element 'range_grid' is not supported, and there are no faces");
  EXPECT_EQ(refusal(read_ply, points + "element face 1\nproperty int vertex_indices\nend_header\n0 0 0\n0\n"),
            "line 7: element 'face' has no list vertex_indices");
  EXPECT_EQ(refusal(read_ply,
                    "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                    "element face 1\nproperty list uchar int vertex_indices\nend_header\n"),
            "line 3: element 'vertex' has no coordinate z");
}

TEST(ReadPly, ReadsTriangleStrips) {
  // Two strips in one list, the first with a vertex twice: it leads on without being a face.
  const TriangleMesh mesh = read_ply(
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n10 0 1 2 3 3 4 -1 2 3 4\n");
  ASSERT_EQ(mesh.size(), 3u);
  EXPECT_EQ(mesh.triangles()[0], (TriangleMesh::Corners{0, 1, 2}));
  EXPECT_EQ(mesh.triangles()[1], (TriangleMesh::Corners{2, 1, 3}));
  EXPECT_EQ(mesh.triangles()[2], (TriangleMesh::Corners{2, 3, 4}));
  EXPECT_EQ(mesh.id(2), 2u);
  EXPECT_EQ(refusal(read_ply,
                    "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                    "property float z\nelement tristrips 1\nproperty list int int vertex_indices\n"
                    "end_header\n0 0 0\n3 0 0 -2\n"),
            "line 11: face 0 names vertex -2 of 1");
}

TEST(ReadPly, AStripKeepsTheSurfacesSide) {
  const TriangleMesh mesh = read_ply(
      "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n1 2 0\n6 0 1 2 3 4 5\n");
  ASSERT_EQ(mesh.size(), 4u);
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    const Vec3 u = mesh.corner(i, 1) - mesh.corner(i, 0), v = mesh.corner(i, 2) - mesh.corner(i, 0);
    EXPECT_GT(u.x() * v.y() - u.y() * v.x(), 0) << i;
  }
}

TEST(ReadPly, ReadsIndicesStoredAsFloatingPointNumbers) {
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar float vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n";
  EXPECT_EQ(read_ply(header + "3 2.0 1 0e0\n").triangles()[0], (TriangleMesh::Corners{2, 1, 0}));
  EXPECT_EQ(refusal(read_ply, header + "3 0 1 1.5\n"), "line 13: a face's vertex is not a whole number");
  EXPECT_EQ(refusal(read_ply, header + "3 0 1 16777216\n"),
            "line 13: a face's vertex is beyond the whole numbers of its type");
}

TEST(ReadPly, FacesMayStandBeforeVertices) {
  const TriangleMesh mesh = read_ply(
      "ply\nformat ascii 1.0\nelement face 2\nproperty list uchar int vertex_indices\nelement vertex 4\n"
      "property float x\nproperty float y\nproperty float z\nend_header\n"
      "3 2 1 0\n4 0 1 2 3\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n");
  ASSERT_EQ(mesh.size(), 3u);
  EXPECT_EQ(mesh.triangles()[0], (TriangleMesh::Corners{2, 1, 0}));
  EXPECT_EQ(mesh.id(2), 1u);
}

TEST(ReadPly, PaddingMayFollowTheLastElement) {
  const std::string whole = ply_header + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  EXPECT_EQ(read_ply(whole + std::string("\n\x1a\0\0", 4)).size(), 1u);
  EXPECT_EQ(read_ply(byte_order_mark + whole).size(), 1u);
}

TEST(ReadPly, HoldsDeclaredCountsAgainstTheFilesSize) {
  const std::string huge =
      "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
  EXPECT_NE(refusal(read_ply, huge).find("declares 4000000000 of element 'vertex'"), std::string::npos);
}

template <class T>
void append(std::string& bytes, T value, bool swapped) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof raw);
  if (swapped) std::reverse(raw, raw + sizeof raw);
  bytes.append(raw, sizeof raw);
}

std::string binary_ply(bool big) {
  std::string bytes =
      std::string("ply\nformat binary_") + (big ? "big" : "little") +
      "_endian 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  for (const double x : {0.0, 0.0, 0.0, 0.1, 0.0, 0.0, 0.0, 0.3, 0.0}) append(bytes, x, big);
  bytes.push_back(3);
  for (const std::int32_t i : {0, 1, 2}) append(bytes, i, big);
  return bytes;
}

TEST(ReadPly, ReadsBinaryOfEitherByteOrder) {
  for (const bool big : {false, true}) {
    const TriangleMesh mesh = read_ply(binary_ply(big));
    EXPECT_EQ(mesh.vertices()[1], Vec3(0.1, 0, 0));
    EXPECT_EQ(mesh.triangles()[0], (TriangleMesh::Corners{0, 1, 2}));
  }
}

TEST(ReadPly, BinaryPaddingIsReadAndMoreDataIsNot) {
  const std::string whole = binary_ply(false);
  EXPECT_EQ(read_ply(whole + "\n").size(), 1u);
  EXPECT_EQ(read_ply(whole + std::string(100, '\0')).size(), 1u);
  EXPECT_EQ(refusal(read_ply, whole + std::string(8, '\0') + "\3"),
            "byte " + std::to_string(whole.size()) + ": goes on after its last element");
}

TEST(ReadPly, EveryTruncationOfABinaryFileIsRefused) {
  const std::string whole = binary_ply(false);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    EXPECT_NE(refusal(read_ply, whole.substr(0, length)), "accepted") << length;
  }
}

const std::string off = "OFF # comment\n3 1 0\n0 0 0\n1 0 0 255 0 0\n0 1 0\n3 0 1 2 1 0 0\n";

TEST(ReadOff, ReadsVerticesAndFacesAndLeavesColours) {
  EXPECT_EQ(read_off(off).size(), 1u);
  EXPECT_EQ(read_off("COFF 3 1 0\n0 0 0 1 1 1 1\n1 0 0 1 1 1 1\n0 1 0 1 1 1 1\n3 0 1 2\n").size(), 1u);
}

TEST(ReadOff, NamesTheLineOfWhatItRefuses) {
  EXPECT_EQ(refusal(read_off, "of 3 1 0\n"), "line 1: starts with 'of' instead of OFF");
  EXPECT_EQ(refusal(read_off, "OFFX\n3 1 0\n"), "line 1: starts with 'OFFX' instead of OFF");
  EXPECT_EQ(refusal(read_off, "OFF BINARY\n"), "line 1: binary OFF is not supported");
  EXPECT_EQ(refusal(read_off, "nOFF\n5\n3 1 0\n"), "line 2: dimension 5 is not supported; 3 is");
  EXPECT_EQ(refusal(read_off, "4OFF\n1 0 0\n1 2 3 0\n"), "line 3: a vertex at infinity");
  EXPECT_EQ(refusal(read_off, "OFF\n3 1 0\n0 0 0\n"), "line 4: ends after 1 of 3 vertices");
  EXPECT_EQ(refusal(read_off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 5\n"),
            "line 6: face 0 names vertex 5 of 3");
  EXPECT_EQ(refusal(read_off, "OFF\n999999 1 0\n0 0 0\n"),
            "line 2: the number of vertices 999999 in a file of 21 bytes");
  EXPECT_EQ(refusal(read_off, off + "3 0 1 2\n"), "line 7: goes on after its 1 faces");
}

TEST(ReadOff, ReadsEveryFormOfTheHeader) {
  const std::string body = "3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  const std::string homogeneous = "3 1 0\n0 0 0 1\n2 0 0 2\n0 0.5 0 0.5\n3 0 1 2\n";
  for (const std::string& text : {body, "\n# a comment\n" + body, "nOFF 3\n" + body, "STCNOFF\n" + body,
                                  byte_order_mark + "OFF\n" + body, "4OFF\n" + homogeneous,
                                  "4nOFF\n3\n" + homogeneous, "OFF\n" + body + std::string("\0\0\x1a", 3)}) {
    const TriangleMesh mesh = read_off(text);
    ASSERT_EQ(mesh.size(), 1u) << text;
    EXPECT_EQ(mesh.corner(0, 1), Vec3(1, 0, 0)) << text;
    EXPECT_EQ(mesh.corner(0, 2), Vec3(0, 1, 0)) << text;
  }
}

TEST(ReadOff, TheHeadersPartsComeInAnyOrderAndCaseAndMayBeGluedToTheCounts) {
  const std::string body = "3 1 0\n0 0 0 7 7\n1 0 0 7 7\n0 1 0 7 7\n3 0 1 2\n";
  const std::string homogeneous = "3 1 0\n0 0 0 1\n2 0 0 2\n0 0.5 0 0.5\n3 0 1 2\n";
  std::vector<std::string> texts;
  for (const char* header : {"OFF",     "off",     "Off",    "COFF",       "coff",     "NOFF",     "noff",
                             "CNOFF",   "NCOFF",   "ncoff",  "STOFF",      "CSTOFF",   "STCOFF",   "NCSTOFF",
                             "STNCOFF", "cnstoff", "nOFF3 ", "CnOFF\n3\n", "NnOFF 3 ", "noff\n3\n"}) {
    texts.push_back(header + body);
    texts.push_back(std::string(header) + "\n" + body);
  }
  for (const char* header : {"4OFF", "4off", "C4OFF", "4COFF", "n4OFF3 ", "4nOFF 3 "})
    texts.push_back(header + homogeneous);
  for (const std::string& text : texts) {
    ASSERT_EQ(refusal(read_off, text), "accepted") << text;
    EXPECT_EQ(read_off(text).corner(0, 1), Vec3(1, 0, 0)) << text;
    EXPECT_EQ(read_off(text).corner(0, 2), Vec3(0, 1, 0)) << text;
  }
}

TEST(ReadOff, RefusesHeadersOfUnknownOrRepeatedParts) {
  for (const char* header : {"CCOFF", "STSTOFF", "TOFF", "SOFF", "nnoff", "OFF-", "OFFx", "OFF3x"}) {
    EXPECT_EQ(refusal(read_off, std::string(header) + " 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
              "line 1: starts with '" + std::string(header) + "' instead of OFF");
  }
  EXPECT_EQ(refusal(read_off, "coff binary\n"), "line 1: binary OFF is not supported");
}

TEST(ReadOff, TheNumberOfEdgesIsOnTheCountsLineOrAloneOnTheNext) {
  const std::string body = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  const std::string missing = "has no number of edges; write 0 where it is unknown";
  EXPECT_EQ(read_off("OFF\n3 # vertices\n1#face\n\n0\n" + body).size(), 1u);
  EXPECT_EQ(refusal(read_off, "OFF\n3 1\n" + body), "line 2: " + missing);
  EXPECT_EQ(refusal(read_off, "OFF3 1 # no edges\n\n" + body), "line 1: " + missing);
  EXPECT_EQ(refusal(read_off, "3 1\n" + body), "line 1: " + missing);
  EXPECT_EQ(refusal(read_off, "OFF\n2 1"), "line 2: the number of edges is missing");
}

std::string ascii_facet(const std::string& last) {
  return "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex " + last +
         "\nendloop\nendfacet\n";
}

TEST(ReadStl, ReadsAsciiAndJoinsEqualCorners) {
  const TriangleMesh mesh =
      read_stl("solid a b\n" + ascii_facet("0 1 0") + ascii_facet("0 0 -1.5e-7") + "endsolid a b\n");
  EXPECT_EQ(mesh.size(), 2u);
  EXPECT_EQ(mesh.vertices().size(), 4u);
  EXPECT_EQ(mesh.corner(1, 2).z(), -1.5e-7);
}

TEST(ReadStl, NamesTheLineOfWhatItRefuses) {
  EXPECT_EQ(refusal(read_stl, "solid a\n" + ascii_facet("0 1 0")),
            "line 9: the end stands where 'facet' or 'endsolid' should");
  EXPECT_EQ(refusal(read_stl, "solid a\nfacet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\n"),
            "line 7: the end stands where 'endfacet' should");
  EXPECT_EQ(refusal(read_stl, ascii_facet("0 1 0")), "line 1: 'facet' stands where 'solid' should");
}

TEST(ReadStl, SkipsWordsAfterAStatementAndLinesOfColour) {
  EXPECT_EQ(
      read_stl("solid a facet b outer loop vertex\ncolor 1 0 0\nfacet normal 0 0 1 extra\nCOLOR 0,5 0 0\n"
               "outer loop of facet 1\nvertex 0 0 0\ncolor 1\nvertex 1 0 0\nvertex 0 1 0\nendloop 1\n"
               "endfacet end of facet 1\n" +
               ascii_facet("0 1 0") + "color 1 0 0\nendsolid a facet\nsolid b\nendsolid b\n")
          .size(),
      2u);
}

TEST(ReadStl, StatementsMayShareALine) {
  const std::string facet =
      "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet";
  EXPECT_EQ(read_stl("solid a\n" + facet + "\n" + facet + " " + facet + " endsolid\n").size(), 3u);
}

TEST(ReadStl, NoPartOfTheSurfaceIsLostAmongSkippedWords) {
  const std::string loop = "outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop ",
                    facet = "facet " + loop;
  const std::string where_facet = "'endfacet' stands where 'facet' or 'endsolid' should";
  EXPECT_EQ(refusal(read_stl, "solid a " + facet + "endfacet\n" + ascii_facet("0 1 0") + "endsolid\n"),
            "line 1: " + where_facet);
  EXPECT_EQ(refusal(read_stl, "solid\n" + facet + "endfacet x " + facet + "endfacet\nendsolid\n"),
            "line 2: " + where_facet);
  EXPECT_EQ(refusal(read_stl, "solid\n" + facet + loop + "endfacet\nendsolid\n"),
            "line 2: 'vertex' stands where 'endfacet' should");
  EXPECT_EQ(refusal(read_stl, "solid\ncolor 1 0 0 " + facet + "endfacet\nendsolid\n"),
            "line 2: 'vertex' stands where 'facet' or 'endsolid' should");
  EXPECT_EQ(
      refusal(read_stl, "solid\n" + ascii_facet("0 1 0") + "endsolid a solid b " + facet + "endfacet\n"),
      "line 9: 'endfacet' stands where 'solid' should");
}

TEST(ReadStl, ReadsPolygonsCapitalsAndAByteOrderMark) {
  const TriangleMesh mesh = read_stl(byte_order_mark +
                                     "SOLID a\nFACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 0 0 0\nVERTEX 1 0 0\n"
                                     "VERTEX 1 1 0\nVERTEX 0 1 0\nENDLOOP\nENDFACET\n" +
                                     ascii_facet("0 1 0") + "ENDSOLID\n" + std::string(3, '\0'));
  ASSERT_EQ(mesh.size(), 3u);
  EXPECT_EQ(mesh.id(1), 0u);
  EXPECT_EQ(mesh.id(2), 1u);
  EXPECT_EQ(area(mesh), 1.5);
  EXPECT_EQ(refusal(read_stl, "solid\nfacet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\nendfacet\n"),
            "line 7: face 0 has 2 corners; a face has at least 3");
  EXPECT_EQ(refusal(read_stl, "\xff\xfes\0o\0"),
            "line 1: is UTF-16 text, which is not supported; save it as UTF-8 or ASCII");
}

std::string binary_stl(const std::string& title, std::uint32_t declared, float last) {
  std::string bytes = title;
  bytes.resize(80, ' ');
  append(bytes, declared, false);
  for (const float x : {0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, last}) append(bytes, x, false);
  bytes.append(2, '\0');
  return bytes;
}

TEST(ReadStl, ReadsBinaryEvenWhenItsTitleSaysSolid) {
  EXPECT_EQ(read_stl(binary_stl("solid", 1, 0.5f)).corner(0, 2), Vec3(0, 1, 0.5));
}

TEST(ReadStl, PaddingMayFollowTheLastFacet) {
  EXPECT_EQ(read_stl(binary_stl("x", 1, 0.5f) + std::string(7, '\0')).size(), 1u);
  EXPECT_EQ(refusal(read_stl, binary_stl("x", 1, 0.5f) + "more"),
            "byte 80: 1 facets need 134 bytes, the file has 138");
}

TEST(ReadStl, RefusesBinaryOfTheWrongSizeAndNotANumber) {
  EXPECT_EQ(refusal(read_stl, binary_stl("x", 2, 0)), "byte 80: 2 facets need 184 bytes, the file has 134");
  EXPECT_EQ(refusal(read_stl, binary_stl("x", 1, std::numeric_limits<float>::quiet_NaN())),
            "byte 120: corner 2 of facet 0 is not finite");
}

}  // namespace
}  // namespace touchmark::mesh_io
