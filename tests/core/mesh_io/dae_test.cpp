// COLLADA files that are one tetrahedron, and what may be wrong with each part of them.
#include <array>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/mesh_io/dae/read_dae.h"
#include "core/mesh_io/mesh_io.h"
#include "tests/core/mesh_io/volume.h"
#include "tests/temporary_folder.h"

namespace touchmark {
namespace {

using test::volume;
using Replacement = std::pair<std::string, std::string>;

/// The tetrahedron (0,0,0) (1,0,0) (0,2,0) (0,0,3), with texts replaced at their first place.
std::string tetra(const std::vector<Replacement>& replacements = {}) {
  std::string text = R"(<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit meter="1"/><up_axis>Y_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="s"><float_array id="a" count="12">0 0 0 1 0 0 0 2 0 0 0 3</float_array><technique_common>
<accessor source="#a" count="4" stride="3"><param name="X"/><param name="Y"/><param name="Z"/></accessor>
</technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#s"/></vertices>
<triangles count="4"><input semantic="VERTEX" source="#v" offset="0"/><p>0 2 1 0 1 3 0 3 2 1 2 3</p></triangles>
</mesh></geometry></library_geometries>
<library_nodes><node id="l"><node/></node></library_nodes>
<library_visual_scenes><visual_scene id="S"><node id="n" name="part"><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#S"/></scene></COLLADA>
)";
  for (const auto& [from, to] : replacements) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
  }
  return text;
}

/// A primitive that names the vertices as the first of its inputs.
std::string primitive(const std::string& start, const std::string& lists) {
  const std::string name = start.substr(0, start.find(' '));
  return tetra({{"<triangles count=\"4\">", "<" + start + ">"},
                {"<p>0 2 1 0 1 3 0 3 2 1 2 3</p></triangles>", lists + "</" + name + ">"}});
}

std::string transformed(const std::string& transforms) {
  return tetra({{"<instance_geometry", transforms + "<instance_geometry"}});
}

TriangleMesh mesh_of(const std::string& text) { return mesh_io::mesh_of(mesh_io::read_dae(text)); }

void expect_corners(const TriangleMesh& mesh, const std::array<Vec3, 4>& corners) {
  ASSERT_EQ(mesh.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_LT((mesh.vertices()[i] - corners[i]).norm(), 1e-12) << i;
}

void expect_tetra(const std::string& text) {
  const TriangleMesh mesh = mesh_of(text);
  expect_corners(mesh, {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 2, 0), Vec3(0, 0, 3)});
  EXPECT_DOUBLE_EQ(volume(mesh), 1);
}

void expect_refused(const std::string& text, const std::string& why) {
  std::string message = "accepted";
  try {
    mesh_io::read_dae(text);
  } catch (const MeshError& error) {
    message = error.what();
  }
  EXPECT_NE(message.find(why), std::string::npos) << message << "\ndoes not say: " << why;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

void expect_refused(const std::vector<Replacement>& replacements, const std::string& why) {
  expect_refused(tetra(replacements), why);
}

std::string utf16(const std::string& ascii, bool is_big) {
  std::string wide = is_big ? "\xfe\xff" : "\xff\xfe";
  for (const char c : ascii) wide += is_big ? std::string{'\0', c} : std::string{c, '\0'};
  return wide;
}

TEST(ReadDae, FindsIdsThatTheReferenceEncodes) {
  expect_tetra(tetra({{"id=\"g\"", "id=\"a b\""}, {"url=\"#g\"", "url=\"#a%20b\""}}));
  expect_tetra(tetra({{"id=\"g\"", "id=\"\u00e4\""}, {"url=\"#g\"", "url=\"#%C3%A4\""}}));
  expect_tetra(tetra({{"id=\"g\"", "id=\"a%20b\""}, {"url=\"#g\"", "url=\"#a%20b\""}}));
}

TEST(ReadDae, TurnsNoAxesAndAppliesTheUnit) {
  for (const std::string axes : {"X_UP", "Y_UP", "Z_UP"}) {
    expect_tetra(tetra({{"Y_UP", axes}}));
    EXPECT_EQ(mesh_io::read_dae(tetra({{"Y_UP", axes}})).axes, axes);
  }
  const mesh_io::SceneGraph graph = mesh_io::read_dae(tetra({{"meter=\"1\"", "meter=\"0.001\""}}));
  EXPECT_EQ(graph.unit, 0.001);
  EXPECT_TRUE(graph.states_unit);
  EXPECT_EQ(mesh_io::mesh_of(graph).vertices()[3], Vec3(0, 0, 0.003));
  EXPECT_FALSE(mesh_io::read_dae(tetra({{"<unit meter=\"1\"/>", ""}})).states_unit);
}

TEST(ReadDae, ReadsEveryPrimitiveWithFaces) {
  expect_tetra(primitive("polylist count=\"4\"", "<vcount>3 3 3 3</vcount><p>0 2 1 0 1 3 0 3 2 1 2 3</p>"));
  expect_tetra(primitive("polygons count=\"4\"", "<p>0 2 1</p><p>0 1 3</p><p>0 3 2</p><p>1 2 3</p>"));
  expect_tetra(primitive("tristrips count=\"1\"", "<p>0 2 1 3 0 2</p>"));
  expect_tetra(primitive("trifans count=\"2\"", "<p>0 2 1 3 2</p><p>1 2 3</p>"));
  EXPECT_EQ(mesh_of(primitive("tristrips count=\"1\"", "<p>0 2 1 1 0 1 3</p>")).size(), 2u);  // stitched
  EXPECT_EQ(mesh_of(primitive("polygons count=\"1\"", "<p>0 2 1 3</p>")).id(1), 0u);
  expect_tetra(tetra({{"<triangles", "<lines count=\"9\"/><linestrips count=\"9\"/><triangles"}}));
}

TEST(ReadDae, ReadsOneOfSeveralInputs) {
  expect_tetra(tetra({{"offset=\"0\"/><p>0 2 1 0 1 3 0 3 2 1 2 3",
                       "offset=\"1\"/><input semantic=\"NORMAL\" source=\"#x\" offset=\"0\"/><p>9 0 9 2 9 1 "
                       "9 0 9 1 9 3 9 0 9 3 9 2 9 1 9 2 9 3"}}));
}

TEST(ReadDae, ReadsInterleavedArraysAndSkipsUnnamedParams) {
  const std::string array = "count=\"12\">0 0 0 1 0 0 0 2 0 0 0 3<";
  expect_tetra(tetra({{array, "count=\"24\">9 9 9 0 0 0 9 9 9 1 0 0 9 9 9 0 2 0 9 9 9 0 0 3<"},
                      {"stride=\"3\"", "stride=\"6\" offset=\"3\""}}));
  expect_tetra(tetra({{array, "count=\"16\">0 9 0 0 1 9 0 0 0 9 2 0 0 9 0 3<"},
                      {"stride=\"3\"", "stride=\"4\""},
                      {"<param name=\"Y\"/>", "<param/><param name=\"Y\"/>"}}));
}

TEST(ReadDae, ReadsTextAsXmlHasIt) {
  expect_tetra(tetra({{"0 0 0 1 0 0 0 2", "0 0<!-- a --> <!-- b -->0 <![CDATA[1]]> 0 0 0 &#50;"}}));
  std::string prefixed;
  for (const char c : tetra({{"<?xml version=\"1.0\" encoding=\"utf-8\"?>\n", ""}}))
    prefixed += c == '<' ? "<c:" : std::string(1, c);
  for (std::size_t at = 0; (at = prefixed.find("<c:/", at)) != prefixed.npos;)
    prefixed.replace(at, 4, "</c:");
  expect_tetra(prefixed);
  expect_tetra("\xef\xbb\xbf" + tetra());
  expect_tetra(utf16(tetra({{"utf-8", "utf-16"}}), false));
  expect_tetra(utf16(tetra({{"utf-8", "utf-16"}}), true));
  expect_refused(utf16(tetra({{"1 2 3<", "1 2 9<"}}), true), "line 9: <p> in 'g': the number of corner 11");
}

TEST(ReadDae, AppliesTransformsInTheirOrder) {
  const auto corners_of = [](const std::string& transforms) { return mesh_of(transformed(transforms)); };
  expect_corners(corners_of("<matrix>0 -1 0 5 1 0 0 6 0 0 1 7 0 0 0 1</matrix>"),
                 {Vec3(5, 6, 7), Vec3(5, 7, 7), Vec3(3, 6, 7), Vec3(5, 6, 10)});
  expect_corners(corners_of("<translate>5 6 7</translate><rotate>0 0 2 90</rotate>"),
                 {Vec3(5, 6, 7), Vec3(5, 7, 7), Vec3(3, 6, 7), Vec3(5, 6, 10)});
  expect_corners(corners_of("<rotate>0 0 1 -270</rotate><translate>6 -5 7</translate>"),
                 {Vec3(5, 6, 7), Vec3(5, 7, 7), Vec3(3, 6, 7), Vec3(5, 6, 10)});
  expect_corners(corners_of("<skew>45 0 1 0 1 0 0</skew>"),
                 {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 2, 0), Vec3(0, 0, 3)});
  // The eye sees the target on its -z.
  expect_corners(corners_of("<lookat>5 0 0 0 0 0 0 0 1</lookat>"),
                 {Vec3(5, 0, 0), Vec3(5, 1, 0), Vec3(5, 0, 2), Vec3(8, 0, 0)});
}

TEST(ReadDae, KeepsTheInsideOfAMirroredPart) {
  EXPECT_DOUBLE_EQ(volume(mesh_of(transformed("<matrix>-1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix>"))), 1);
  EXPECT_DOUBLE_EQ(volume(mesh_of(transformed("<scale>-2 -3 -1</scale>"))), 6);
}

TEST(ReadDae, PlacesInstancesAndNamesTheirNodes) {
  const mesh_io::SceneGraph graph = mesh_io::read_dae(
      tetra({{"<node/>", "<scale>2 2 2</scale><instance_geometry url=\"#g\"/>"},
             {"</node></visual_scene>",
              "<instance_node url=\"#l\"/><instance_node url=\"#l\"/></node></visual_scene>"}}));
  ASSERT_EQ(graph.nodes.size(), 3u);
  EXPECT_EQ(graph.parts.size(), 1u);
  EXPECT_EQ(graph.nodes[0].name, "part");
  EXPECT_EQ(graph.nodes[1].name, "l");  // the id of a node without a name
  EXPECT_DOUBLE_EQ(volume(mesh_io::mesh_of(graph)), 1 + 8 + 8);
}

TEST(ReadDae, RefusesArraysThatAreNotWhatTheySay) {
  expect_refused({{"count=\"12\"", "count=\"3\""}},
                 "line 5: <float_array> 'a': has 12 numbers, but its count is 3");
  expect_refused({{"0 0 3<", "0 0<"}}, "has 11 numbers, but its count is 12");
  expect_refused({{"0 0 3<", "0 0 0,3<"}}, "line 5: <float_array> 'a': the number '0,3'");
  for (const std::string number : {"NaN", "INF", "-INF"})
    expect_refused({{"0 0 3<", "0 0 " + number + "<"}}, "is not finite");
  for (const std::string stride :
       {"stride=\"30\"", "stride=\"3\" offset=\"1\"", "stride=\"6148914691236517206\""})
    expect_refused({{"stride=\"3\"", stride}}, "line 6: <accessor> in 's': count 4");
  expect_refused({{"count=\"4\" stride", "count=\"5\" stride"}}, "reach beyond the 12 numbers");
  expect_refused({{"stride=\"3\"", "offset=\"-3\" stride=\"3\""}}, "offset -3 is negative");
  expect_refused({{"stride=\"3\"", ""}}, "has 3 params, but its stride is 1");
  expect_refused({{"\"X\"", "\"Z\""}}, "named params are 'ZYZ'");
  expect_refused({{"<param name=\"X\"/>", ""}}, "named params are 'YZ'");
}

TEST(ReadDae, RefusesFacesThatAreNotWhatTheySay) {
  expect_refused({{"1 2 3<", "1 2 -1<"}}, "line 9: <p> in 'g': the number of corner 11 names vertex -1 of 4");
  expect_refused({{"1 2 3<", "1 2 4<"}}, "corner 11 names vertex 4 of 4");
  expect_refused({{"1 2 3<", "1 2<"}}, "11 corners are no whole triangles");
  expect_refused({{"triangles count=\"4\"", "triangles count=\"5\""}}, "has 4 triangles, but its count is 5");
  expect_refused({{"triangles count=\"4\"", "triangles count=\"4\" count=\"5\""}},
                 "has two attributes count");
  expect_refused(primitive("polylist count=\"1\"", "<vcount>3</vcount><p>0 1 2 3</p>"), "its vcount names 3");
  expect_refused(primitive("polylist count=\"1\"", "<vcount>5</vcount><p>0 1 2 3</p>"), "and 4 are left");
  expect_refused(primitive("polylist count=\"2\"", "<vcount>2 3</vcount><p>0 1 0 1 2</p>"),
                 "takes at least 3");
  expect_refused(primitive("polylist count=\"2\"", "<vcount>3</vcount><p>0 1 2</p>"), "has 1 polygons");
  expect_refused(primitive("tristrips count=\"2\"", "<p>0 1 2</p>"), "has 1 <p>, but its count is 2");
  expect_refused(primitive("trifans count=\"1\"", "<p>0 1</p>"), "has 2 corners");
  expect_refused(primitive("polygons count=\"1\"", "<ph><p>0 1 2</p><h>0 1 3</h></ph>"),
                 "polygons with holes");
  expect_refused({{"\" offset=\"0\"/>", "\" offset=\"0\"/><input semantic=\"NORMAL\" offset=\"4\"/>"}},
                 "has 12 numbers");
  expect_refused({{"<triangles", "<patches/><triangles"}}, "<patches> in 'g': cannot stand in <mesh>");
}

TEST(ReadDae, RefusesOtherGeometries) {
  for (const std::string name : {"spline", "brep", "convex_mesh convex_hull_of=\"#h\""})
    expect_refused({{"<mesh>", "<" + name + "/><m>"}, {"</mesh>", "</m>"}}, name.substr(0, name.find(' ')));
  expect_refused({{"<instance_geometry", "<instance_controller"}}, "skins and morphs are not read");
  expect_refused({{"<triangles count=\"4\">", "<lines>"}, {"</triangles>", "</lines>"}},
                 "shows no triangles");
}

TEST(ReadDae, RefusesTransformsThatAreNone) {
  expect_refused(transformed("<translate>1 2</translate>"), "<translate> in 'n': has 2 numbers; it takes 3");
  expect_refused(transformed("<translate>1 2 INF</translate>"), "is not finite");
  expect_refused(transformed("<rotate>0 0 0 90</rotate>"), "its axis has no length");
  expect_tetra(transformed("<rotate>0 0 0 0</rotate>"));
  expect_tetra(transformed("<rotate>0 0 0 360</rotate>"));
  expect_refused(transformed("<matrix>1 0 0 0 0 1 0 0 0 0 1 0 5 6 7 1</matrix>"), "its last row");
  expect_refused(transformed("<skew>45 1 0 0 1 0 0</skew>"), "axes are parallel");
  expect_refused(transformed("<lookat>0 0 5 0 0 0 0 0 1</lookat>"), "in one line");
  expect_refused(transformed("<rotation>0 0 1 90</rotation>"), "<rotation> in 'n': cannot stand in <node>");
}

TEST(ReadDae, RefusesUnitsAndAxesThatAreNone) {
  for (const std::string meter : {"0", "-1", "NaN", "INF", ""})
    expect_refused({{"meter=\"1\"", "meter=\"" + meter + "\""}}, "line 3: <unit>: meter");
  expect_refused({{"Y_UP", "W_UP"}}, "'W_UP' is none of");
  expect_refused({{"<mesh>", "<asset><unit meter=\"0.01\"/></asset><mesh>"}}, "is not the unit of the file");
}

TEST(ReadDae, RefusesTargetsThatAreNotThere) {
  expect_refused({{"url=\"#g\"", "url=\"#nosuch\""}}, "names '#nosuch', but no <geometry> has this id");
  expect_refused({{"source=\"#a\"", "source=\"#s\""}}, "no <float_array> or <int_array>");
  expect_refused({{"url=\"#g\"", "url=\"other.dae#g\""}}, "in another file");
  expect_refused({{"<library_nodes>", "<geometry id=\"g\"/><library_nodes>"}},
                 "an id that 2 <geometry> have");
  expect_refused({{"<scene><instance_visual_scene url=\"#S\"/></scene>", ""},
                  {"id=\"l\"><node/>", "id=\"l\"><visual_scene/>"}},
                 "has 2 visual scenes");
}

TEST(ReadDae, RefusesNodesThatContainThemselvesOrAreTooMany) {
  expect_refused({{"<node/>", "<instance_node url=\"#l\"/>"},
                  {"<instance_geometry", "<instance_node url=\"#l\"/><instance_geometry"}},
                 "names '#l', a node that it is in");
  std::string deep, ends, laughs;
  for (int i = 0; i < 100'000; ++i) deep += "<node>", ends += "</node>";
  expect_refused({{"<instance_geometry url=\"#g\"/>", deep + "<instance_geometry url=\"#g\"/>" + ends}},
                 "is deeper than 1000");
  for (int i = 0; i < 40; ++i) {
    const std::string next = "<instance_node url=\"#l" + std::to_string(i + 1) + "\"/>";
    laughs += "<node id=\"l" + std::to_string(i) + "\">" + next + next + "</node>";
  }
  expect_refused({{"id=\"l\"", "id=\"l40\""},
                  {"<library_nodes>", "<library_nodes>" + laughs},
                  {"<instance_geometry", "<instance_node url=\"#l0\"/><instance_geometry"}},
                 "repeat more than 1048576 elements");
  std::string many = "<instance_geometry url=\"#g\"/>", zeros;
  for (int i = 0; i < 12; ++i) many += many;
  for (int i = 0; i < 60'000; ++i) zeros += " 0";
  expect_refused({{"<instance_geometry url=\"#g\"/>", many},
                  {"count=\"12\">", "count=\"60012\">"},
                  {"0 0 3<", "0 0 3" + zeros + "<"},
                  {"count=\"4\" stride", "count=\"20004\" stride"}},
                 "repeat more than 67108864 vertices and corners");
}

TEST(ReadDae, RefusesOtherXml) {
  expect_refused(tetra().substr(0, 600), "no well-formed XML");
  expect_refused(tetra() + "more", "goes on after the end of its XML");
  expect_refused(tetra() + std::string("\0<more/>", 8), "line 14: goes on after");
  expect_tetra(tetra() + std::string("\0\x1a\n", 3));
  expect_refused(tetra() + "<COLLADA/>", "has 2 root elements");
  expect_refused({{"1.4.1", "1.3.0"}}, "COLLADA '1.3.0' is not read");
  expect_refused("<html/>", "begins with 'html' instead of COLLADA");
  expect_refused({{"<COLLADA", "<!DOCTYPE COLLADA [<!ENTITY a \"3\">]>\n<COLLADA"}}, "declares entities");
  expect_refused("PK\x03\x04 and more", "is a zip archive");
}

TEST(ReadDae, IsWhatLoadMeshAndLoadNodeTreeCall) {
  const TemporaryFolder folder;
  const std::string path = folder.file("part.DAE", tetra({{"meter=\"1\"", "meter=\"2\""}}));
  EXPECT_DOUBLE_EQ(volume(load_mesh(path)), 8);
  const NodeTree tree = load_node_tree(path);
  ASSERT_EQ(tree.nodes.size(), 1u);
  EXPECT_EQ(tree.nodes[0].name, "part");
  EXPECT_EQ(tree.nodes[0].rotation, Eigen::Matrix3d::Identity());
  EXPECT_DOUBLE_EQ(volume(tree.meshes[0]), 8);
}

}  // namespace
}  // namespace touchmark
