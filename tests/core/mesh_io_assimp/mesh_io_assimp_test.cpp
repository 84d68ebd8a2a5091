// Formats without a reader of their own.
#include "core/mesh_io_assimp/mesh_io_assimp.h"

#include <array>
#include <cstdint>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "tests/temporary_folder.h"

namespace touchmark {
namespace {

/// A chunk of a 3DS file.
std::string chunk(unsigned kind, const std::string& content) {
  const auto number = [](std::size_t value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> 8 * i & 0xff);
    return text;
  };
  return number(kind, 2) + number(content.size() + 6, 4) + content;
}

/// The last face names (1, 2, `last`).
std::string tetrahedron_3ds(std::uint16_t last = 3) {
  const std::array<float, 12> positions = {0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3};
  const std::array<std::uint16_t, 16> faces = {0, 2, 1, 0, 0, 1, 3, 0, 0, 3, 2, 0, 1, 2, last, 0};
  const auto counted = [](const auto& numbers) {
    return std::string("\4\0", 2) +
           std::string(reinterpret_cast<const char*>(numbers.data()), sizeof numbers);
  };
  const std::string mesh = chunk(0x4110, counted(positions)) + chunk(0x4120, counted(faces));
  return chunk(0x4d4d, chunk(0x3d3d, chunk(0x4000, std::string("a\0", 2) + chunk(0x4100, mesh))));
}

const std::string tetrahedron_x =
    "xof 0303txt 0032\nMesh a {\n4;\n0;0;0;,\n1;0;0;,\n0;2;0;,\n0;0;3;;\n"
    "4;\n3;0,2,1;,\n3;0,1,3;,\n3;0,3,2;,\n3;1,2,3;;\n}\n";

const std::string tetrahedron_ase =
    "*3DSMAX_ASCIIEXPORT 200\n*GEOMOBJECT {\n*NODE_NAME \"a\"\n*NODE_TM {\n*NODE_NAME \"a\"\n*TM_ROW0 1 0 0\n"
    "*TM_ROW1 0 1 0\n*TM_ROW2 0 0 1\n*TM_ROW3 0 0 0\n}\n*MESH {\n*TIMEVALUE 0\n*MESH_NUMVERTEX 4\n"
    "*MESH_NUMFACES 4\n*MESH_VERTEX_LIST {\n*MESH_VERTEX 0 0 0 0\n*MESH_VERTEX 1 1 0 0\n*MESH_VERTEX 2 0 2 "
    "0\n"
    "*MESH_VERTEX 3 0 0 3\n}\n*MESH_FACE_LIST {\n*MESH_FACE 0: A: 0 B: 2 C: 1\n*MESH_FACE 1: A: 0 B: 1 C: 3\n"
    "*MESH_FACE 2: A: 0 B: 3 C: 2\n*MESH_FACE 3: A: 1 B: 2 C: 3\n}\n}\n}\n";

const std::string tetrahedron_amf =
    "<?xml version=\"1.0\"?>\n<amf unit=\"millimeter\" version=\"1.1\"><object "
    "id=\"0\"><mesh><vertices><vertex><coordinates><x>0</x><y>0</y><z>0</z></coordinates></"
    "vertex><vertex><coordinates><x>1000</x><y>0</y><z>0</z></coordinates></"
    "vertex><vertex><coordinates><x>0</x><y>2000</y><z>0</z></coordinates></"
    "vertex><vertex><coordinates><x>0</x><y>0</y><z>3000</z></coordinates></vertex></"
    "vertices><volume><triangle><v1>0</v1><v2>2</v2><v3>1</v3></triangle><triangle><v1>0</v1><v2>1</"
    "v2><v3>3</v3></triangle><triangle><v1>0</v1><v2>3</v2><v3>2</v3></triangle><triangle><v1>1</v1><v2>2</"
    "v2><v3>3</v3></triangle></volume></mesh></object></amf>\n";

/// Z up, in units of 10 cm.
const std::string tetrahedron_fbx =
    "; FBX 7.3.0 project file\nFBXHeaderExtension:  {\n\tFBXHeaderVersion: 1003\n\tFBXVersion: 7300\n}\n"
    "GlobalSettings:  {\n\tVersion: 1000\n\tProperties70:  {\n"
    "\t\tP: \"UpAxis\", \"int\", \"Integer\", \"\",2\n\t\tP: \"FrontAxis\", \"int\", \"Integer\", \"\",1\n"
    "\t\tP: \"FrontAxisSign\", \"int\", \"Integer\", \"\",-1\n"
    "\t\tP: \"UnitScaleFactor\", \"double\", \"Number\", \"\",10.0\n\t}\n}\n"
    "Definitions:  {\n\tVersion: 100\n\tCount: 2\n}\n"
    "Objects:  {\n\tGeometry: 1001, \"Geometry::a\", \"Mesh\" {\n"
    "\t\tVertices: *12 {\n\t\t\ta: 0,0,0,10,0,0,0,20,0,0,0,30\n\t\t}\n"
    "\t\tPolygonVertexIndex: *12 {\n\t\t\ta: 0,2,-2,0,1,-4,0,3,-3,1,2,-4\n\t\t}\n\t\tGeometryVersion: "
    "124\n\t}\n"
    "\tModel: 1002, \"Model::a\", \"Mesh\" {\n\t\tVersion: 232\n\t}\n}\n"
    "Connections:  {\n\tC: \"OO\",1002,0\n\tC: \"OO\",1001,1002\n}\n";

const std::string tetrahedron_nff =
    "p 3\n0 0 0\n0 2 0\n1 0 0\np 3\n0 0 0\n1 0 0\n0 0 3\np 3\n0 0 0\n0 0 3\n0 2 0\np 3\n1 0 0\n0 2 0\n0 0 "
    "3\n";

TEST(LoadMeshWithAssimp, NeitherTurnsNorMirrorsAxesAndAppliesUnits) {
  struct Case {
    const char* name;
    std::string content, unit, axes = "as written";
  };
  const std::string unknown = "not known: assimp does not tell it";
  const TemporaryFolder folder;
  for (const auto& [name, content, unit, axes] :
       {Case{"a.3ds", tetrahedron_3ds(), unknown},
        {"a.x", tetrahedron_x, unknown},
        {"a.ase", tetrahedron_ase, unknown},
        {"a.nff", tetrahedron_nff, unknown},
        {"a.amf", tetrahedron_amf, "0.001 m, from the file"},
        {"a.fbx", tetrahedron_fbx, "0.1 m, from the file", "as written (the file says Z up)"}}) {
    const MeshFile file = load_mesh_file_with_assimp(folder.file(name, content));
    EXPECT_EQ(file.axes, axes) << name;
    EXPECT_EQ(file.unit, unit) << name;
    EXPECT_LE((file.mesh.bounds().min - Vec3(0, 0, 0)).norm(), 1e-6) << name;
    EXPECT_LE((file.mesh.bounds().max - Vec3(1, 2, 3)).norm(), 1e-6) << name;
    double volume = 0;
    for (std::size_t i = 0; i < file.mesh.size(); ++i)
      volume += file.mesh.corner(i, 0).dot(file.mesh.corner(i, 1).cross(file.mesh.corner(i, 2))) / 6;
    EXPECT_NEAR(volume, 1, 1e-6) << name;
    const NodeTree tree = load_node_tree_with_assimp(folder.file(name));
    EXPECT_LE((tree.meshes[tree.nodes[0].mesh].bounds().max - Vec3(1, 2, 3)).norm(), 1e-6) << name;
  }
}

std::string refusal(const std::string& path) {
  try {
    load_mesh_with_assimp(path);
  } catch (const MeshError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(LoadMeshWithAssimp, RefusesGarbage) {
  const TemporaryFolder folder;
  for (const char* name : {"garbage.3ds", "garbage.dae", "garbage.nosuch"}) {
    const std::string path = folder.file(name, "<this is no file of that kind");
    EXPECT_TRUE(refusal(path).starts_with(path + ": ")) << refusal(path);
  }
}

TEST(LoadMeshWithAssimp, RefusesWhatAssimpMends) {
  const TemporaryFolder folder;
  EXPECT_NE(refusal(folder.file("a.3ds", tetrahedron_3ds(9))).find("assimp changed its surface"),
            std::string::npos);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(LoadMeshWithAssimp, RefusesWhatAssimpMisreads) {
  const TemporaryFolder folder;
  const std::string turned =
      "</object><constellation id=\"1\"><instance "
      "objectid=\"0\"><deltax>1</deltax><deltay>0</deltay><deltaz>0</deltaz><rx>90</rx><ry>0</ry><rz>0</rz></"
      "instance></constellation>";
  EXPECT_NE(refusal(folder.file("a.amf", replaced(tetrahedron_amf, "</object>", turned))).find("<rx>"),
            std::string::npos);
  const std::string face =
      "<X3D version=\"3.0\"><Scene><Shape><IndexedFaceSet ccw=\"false\" coordIndex=\"0 1 2 -1\"><Coordinate "
      "point=\"0 0 0 1 0 0 0 1 0\"/></IndexedFaceSet></Shape></Scene></X3D>\n";
  EXPECT_NE(refusal(folder.file("a.x3d", face)).find("ccw"), std::string::npos);
  EXPECT_EQ(refusal(folder.file("b.x3d", replaced(face, "false", "true"))), "accepted");
  const std::string part =
      "AC3Db\nMATERIAL \"\" rgb 1 1 1  amb 1 1 1  emis 0 0 0  spec 0 0 0  shi 0  trans 0\n"
      "OBJECT world\nkids 1\nOBJECT poly\nloc 1 2 3\nrot -1 0 0 0 -1 0 0 0 1\nnumvert 3\n0 0 0\n"
      "1 0 0\n0 1 0\nnumsurf 1\nSURF 0x20\nmat 0\nrefs 3\n0 0 0\n1 0 0\n2 0 0\nkids 0\n";
  EXPECT_NE(refusal(folder.file("a.ac", part)).find("rot"), std::string::npos);
  EXPECT_EQ(refusal(folder.file("b.ac", replaced(part, "rot -1 0 0 0 -1 0 0 0 1\n", ""))), "accepted");
}

TEST(LoadMeshWithAssimp, AnAmfWithoutAUnitIsInMillimetres) {
  const TemporaryFolder folder;
  const MeshFile file =
      load_mesh_file_with_assimp(folder.file("a.amf", replaced(tetrahedron_amf, " unit=\"millimeter\"", "")));
  EXPECT_LE((file.mesh.bounds().max - Vec3(1, 2, 3)).norm(), 1e-6);
}

TEST(LoadMeshWithAssimp, ReadsStrictFormatsStrictly) {
  const TemporaryFolder folder;
  EXPECT_EQ(
      load_mesh_with_assimp(folder.file("a.off", "OFF\n3 1 0\n0 0 0\n1000000.001 0 0\n0 1 0\n3 0 1 2\n"))
          .bounds()
          .max.x(),
      1000000.001);
}

}  // namespace
}  // namespace touchmark
