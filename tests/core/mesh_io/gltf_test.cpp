// glTF files as users have them: a tetrahedron of volume 1, written in every way that glTF has, and damaged.
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/mesh_io/mesh_io.h"
#include "tests/temporary_folder.h"

namespace touchmark {
namespace {

using Json = nlohmann::json;

std::string base64(const std::string& bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned bits = 0;
    for (std::size_t k = i; k < i + 3; ++k)
      bits = bits << 8 | (k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0u);
    for (int shift = 18; shift >= 0; shift -= 6) text += digits[bits >> shift & 63];
  }
  for (std::size_t missing = (3 - bytes.size() % 3) % 3; missing > 0; --missing)
    text[text.size() - missing] = '=';
  return text;
}

template <class Number>
std::string bytes_of(const std::vector<Number>& numbers) {
  std::string bytes(numbers.size() * sizeof(Number), '\0');
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

const std::string positions = bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3});
const std::string corners = bytes_of<std::uint16_t>({0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});

std::string data_uri(const std::string& bytes) {
  return "data:application/octet-stream;base64," + base64(bytes);
}

/// View 0 and accessor 0 are the positions, 1 the corners.
Json tetrahedron(const std::string& vertices = positions, const std::string& indices = corners) {
  Json file = Json::parse(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"name": "part", "mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                  {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}],
    "bufferViews": [{"buffer": 0}, {"buffer": 0}], "buffers": [{}]})");
  file["bufferViews"][0]["byteLength"] = vertices.size();
  file["bufferViews"][1]["byteOffset"] = vertices.size();
  file["bufferViews"][1]["byteLength"] = indices.size();
  file["buffers"][0] = {{"byteLength", vertices.size() + indices.size()},
                        {"uri", data_uri(vertices + indices)}};
  return file;
}

/// `patch` is a list of JSON patches: [["/nodes/0/mesh", 7]]; null removes.
Json patched(Json file, const std::string& patch) {
  for (const Json& change : Json::parse(patch)) {
    const Json::json_pointer at(change[0].get<std::string>());
    if (change[1].is_null())
      file[at.parent_pointer()].erase(at.back());
    else
      file[at] = change[1];
  }
  return file;
}

std::string glb_of(Json file, std::string binary) {
  file["buffers"][0].erase("uri");
  std::string json = file.dump();
  json.resize((json.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  const auto word = [](std::size_t value) {
    return bytes_of<std::uint32_t>({static_cast<std::uint32_t>(value)});
  };
  return "glTF" + word(2) + word(28 + json.size() + binary.size()) + word(json.size()) + "JSON" + json +
         word(binary.size()) + std::string("BIN\0", 4) + binary;
}

class Gltf : public testing::Test {
 protected:
  std::string file(const Json& json) const { return folder_.file("a.gltf", json.dump()); }

  std::string refusal(const std::string& path) const {
    try {
      load_mesh(path);
    } catch (const MeshError& error) {
      const std::string message = error.what();
      EXPECT_EQ(message.rfind(path + ": ", 0), 0u) << message;
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
      return message.substr(path.size() + 2);
    }
    return "accepted";
  }
  void expect_refusal(const std::string& path, const std::string& why) const {
    EXPECT_NE(refusal(path).find(why), std::string::npos) << refusal(path) << "\ndoes not say: " << why;
  }

  /// The tetrahedron, times `size`.
  void expect_tetrahedron(const TriangleMesh& mesh, double size = 1) const {
    EXPECT_EQ(mesh.size(), 4u);
    EXPECT_LT((mesh.bounds().max - mesh.bounds().min - size * Vec3(1, 2, 3)).norm(), 1e-6 * size);
    double volume = 0;
    for (std::size_t i = 0; i < mesh.size(); ++i)
      volume += mesh.corner(i, 0).dot(mesh.corner(i, 1).cross(mesh.corner(i, 2))) / 6;
    EXPECT_NEAR(volume / (size * size * size), 1, 1e-6);
  }

  TemporaryFolder folder_;
};

TEST_F(Gltf, CoordinatesStandAsWritten) {
  const MeshFile read = load_mesh_file(file(tetrahedron()));
  expect_tetrahedron(read.mesh);
  EXPECT_EQ(read.mesh.bounds().min, Vec3(0, 0, 0));
  EXPECT_EQ(read.axes, "as written (glTF is Y up)");
  EXPECT_EQ(read.unit, "1 m, as in every glTF");
  expect_tetrahedron(load_mesh(folder_.file("a.glb", glb_of(tetrahedron(), positions + corners))));
}

TEST_F(Gltf, ReadsStripsFansAndVerticesInTheirOrder) {
  const std::string five = bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0});
  const auto triangles = [&](const std::string& patch) {
    const TriangleMesh mesh =
        load_mesh(file(patched(tetrahedron(five, bytes_of<std::uint16_t>({0, 1, 2, 3, 4})), patch)));
    return std::vector(mesh.triangles().begin(), mesh.triangles().end());
  };
  using Triangles = std::vector<TriangleMesh::Corners>;
  const std::string all =
      R"([["/accessors/0/count", 5], ["/accessors/1/count", 5], ["/meshes/0/primitives/0/mode", )";
  EXPECT_EQ(triangles(all + "5]]"), (Triangles{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
  EXPECT_EQ(triangles(all + "6]]"), (Triangles{{1, 2, 0}, {2, 3, 0}, {3, 4, 0}}));
  EXPECT_EQ(triangles(all + R"(5], ["/meshes/0/primitives/0/indices", null]])"), triangles(all + "5]]"));
}

TEST_F(Gltf, PointsAndLinesAreNoFaces) {
  for (const int mode : {0, 1, 2, 3}) {
    Json json = tetrahedron();
    json["meshes"][0]["primitives"].push_back({{"attributes", Json::object()}, {"mode", mode}});
    expect_tetrahedron(load_mesh(file(json)));
    json["meshes"][0]["primitives"].erase(0);
    expect_refusal(file(json), "the mesh has no triangle");
  }
}

TEST_F(Gltf, ReadsIndicesOfEveryUnsignedType) {
  const std::vector<int> in_bytes(corners.begin(), corners.end());
  std::vector<std::uint8_t> small;
  std::vector<std::uint32_t> large;
  for (std::size_t i = 0; i < corners.size(); i += 2) {
    small.push_back(static_cast<std::uint8_t>(corners[i]));
    large.push_back(small.back());
  }
  expect_tetrahedron(load_mesh(
      file(patched(tetrahedron(positions, bytes_of(small)), R"([["/accessors/1/componentType", 5121]])"))));
  expect_tetrahedron(load_mesh(
      file(patched(tetrahedron(positions, bytes_of(large)), R"([["/accessors/1/componentType", 5125]])"))));
}

TEST_F(Gltf, ReadsInterleavedVerticesUpToTheLastByte) {
  std::string interleaved;
  for (std::size_t i = 0; i < 4; ++i) interleaved += "abcd" + positions.substr(12 * i, 12) + "efgh";
  interleaved.resize(interleaved.size() - 4);  // none after the last element
  const Json json = patched(tetrahedron(interleaved),
                            R"([["/bufferViews/0/byteStride", 20], ["/accessors/0/byteOffset", 4]])");
  expect_tetrahedron(load_mesh(file(json)));
  expect_refusal(file(patched(json, R"([["/bufferViews/0/byteLength", 75]])")),
                 "accessors[0]: 4 elements of 20 bytes");
}

TEST_F(Gltf, ReadsQuantizedPositions) {
  const std::string used =
      R"([["/extensionsUsed", ["KHR_mesh_quantization"]], ["/accessors/0/componentType", )";
  const Json whole = tetrahedron(bytes_of<std::int16_t>({0, 0, 0, 9, 1, 0, 0, 9, 0, 2, 0, 9, 0, 0, 3, 9}));
  const std::string stride = R"(], ["/bufferViews/0/byteStride", 8]])";
  expect_tetrahedron(load_mesh(file(patched(whole, used + "5122" + stride))));
  expect_tetrahedron(load_mesh(file(patched(whole, used + "5123" + stride))));
  expect_refusal(
      file(patched(whole, R"([["/bufferViews/0/byteStride", 8], ["/accessors/0/componentType", 5122]])")),
      "must use KHR_mesh_quantization");
  // Three of 127, 255, 32767 and 65535 are exact to single precision at least; -128 is -1.
  const std::string scaled = R"(], ["/accessors/0/normalized", true], ["/bufferViews/0/byteStride", 4]])";
  const Json bytes =
      tetrahedron(bytes_of<std::int8_t>({-128, 0, 0, 9, 127, 0, 0, 9, 0, 127, 0, 9, 0, 0, 127, 9}));
  const TriangleMesh mesh = load_mesh(file(patched(bytes, used + "5120" + scaled)));
  EXPECT_EQ(mesh.bounds().min, Vec3(-1, 0, 0));
  EXPECT_EQ(mesh.bounds().max, Vec3(1, 1, 1));
}

TEST_F(Gltf, ReadsSparseAccessors) {
  const std::string moved = bytes_of<float>({1, 0, 0, 0, 2, 0, 0, 0, 3}),
                    places = bytes_of<std::uint32_t>({1, 2, 3});
  Json json = tetrahedron(places + moved);
  json["bufferViews"][0]["byteLength"] = places.size();
  json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", places.size()}, {"byteLength", moved.size()}});
  json["accessors"][0]["sparse"] = {{"count", 3},
                                    {"indices", {{"bufferView", 0}, {"componentType", 5125}}},
                                    {"values", {{"bufferView", 2}}}};
  json["accessors"][0].erase("bufferView");
  expect_tetrahedron(load_mesh(file(json)));
  expect_refusal(file(patched(json, R"([["/accessors/0/count", 3]])")), "index 2 names element 3 of 3");
  expect_refusal(file(patched(json, R"([["/accessors/0/sparse/count", 4], ["/accessors/0/count", 9]])")),
                 "do not fit");
  expect_refusal(file(patched(json, R"([["/accessors/0/sparse/count", 5]])")), "replaces 5 of 4");
  json["accessors"][0]["sparse"]["indices"]["byteOffset"] = 1;
  expect_refusal(file(json), "starts at byte 1");
  for (const auto& unordered : {bytes_of<std::uint32_t>({1, 1, 3}), bytes_of<std::uint32_t>({2, 1, 3})}) {
    json["accessors"][0]["sparse"]["indices"]["byteOffset"] = 0;
    json["buffers"][0]["uri"] = data_uri(unordered + moved + corners);
    expect_refusal(file(json), "they must ascend");
  }
}

TEST_F(Gltf, ReadsDraco) {
  const std::string compressed =
      "RFJBQ08CAgEBAAAABAQAAwAAAS8BARAB/"
      "wAAAQAJAwAAAAAAAAAAAAAAAABAQAAAAAAAAABAAAAAAAAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAA==";
  Json json = patched(tetrahedron(), R"([["/accessors/0/bufferView", null], ["/accessors/1/bufferView", null],
    ["/extensionsRequired", ["KHR_draco_mesh_compression"]], ["/bufferViews/0/byteLength", 82],
    ["/meshes/0/primitives/0/extensions", {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}}]])");
  json["buffers"][0] = {{"byteLength", 82}, {"uri", "data:;base64," + compressed}};
  if (refusal(file(json)).find("without Draco") != std::string::npos) GTEST_SKIP() << "built without Draco";
  expect_tetrahedron(load_mesh(file(json)));
  expect_refusal(file(patched(json, R"([["/bufferViews/0/byteLength", 60]])")), "Draco cannot read it");
  expect_refusal(file(patched(json, R"([["/accessors/0/count", 5]])")), "is 5, but Draco's data has 4");
  expect_refusal(file(patched(json, R"([["/meshes/0/primitives/0/mode", 5]])")), "no list of triangles");
}

TEST_F(Gltf, PlacesInstances) {
  const std::string places = bytes_of<float>({0, 0, 0, 10, 0, 0}),
                    turns = bytes_of<std::int8_t>({0, 0, 0, 127, 0, 0, 127, 0});
  Json json = tetrahedron(places + turns + positions);
  json["bufferViews"][0] = {{"buffer", 0}, {"byteOffset", 32}, {"byteLength", 48}};
  json["bufferViews"].push_back({{"buffer", 0}, {"byteLength", 24}});
  json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 24}, {"byteLength", 8}});
  json["accessors"].push_back({{"bufferView", 2}, {"componentType", 5126}, {"count", 2}, {"type", "VEC3"}});
  json["accessors"].push_back(
      {{"bufferView", 3}, {"componentType", 5120}, {"normalized", true}, {"count", 2}, {"type", "VEC4"}});
  json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {{"TRANSLATION", 2},
                                                                             {"ROTATION", 3}};
  json["nodes"][0]["scale"] = {2, 2, 2};
  const TriangleMesh mesh = load_mesh(file(json));
  EXPECT_EQ(mesh.size(), 8u);
  EXPECT_EQ(mesh.bounds().min, Vec3(0, -4, 0));
  EXPECT_EQ(mesh.bounds().max, Vec3(20, 4, 6));
  EXPECT_EQ(load_node_tree(file(json)).nodes.size(), 2u);
  expect_refusal(file(patched(json, R"([["/accessors/2/count", 1]])")), "differ in their count");
}

TEST_F(Gltf, BodiesAreTheNodesWithTriangles) {
  Json json = tetrahedron();
  json["meshes"].push_back(json["meshes"][0]);
  json["meshes"][1]["primitives"][0]["mode"] = 1;
  json["nodes"] =
      Json::parse(R"([{"name": "root", "children": [2, 1], "scale": [1, 1, -1]}, {"name": "line", "mesh": 1},
    {"name": "part", "mesh": 0, "children": [3], "translation": [0, 0, 5]}, {"mesh": 0, "rotation": [0, 0, 1, 0]}])");
  const NodeTree tree = load_node_tree(file(json));
  ASSERT_EQ(tree.nodes.size(), 2u);
  EXPECT_EQ(tree.nodes[0].name, "part");
  EXPECT_EQ(tree.nodes[0].translation, Vec3(0, 0, -5));
  EXPECT_EQ(tree.nodes[1].name, "");
  for (const NodeTree::Node& node : tree.nodes) expect_tetrahedron(tree.meshes[node.mesh]);
}

TEST_F(Gltf, OnlyTheDefaultSceneIsRead) {
  Json json = tetrahedron();
  json["nodes"].push_back({{"mesh", 0}, {"scale", {3, 3, 3}}});
  json["scenes"].push_back({{"nodes", {1}}});
  expect_tetrahedron(load_mesh(file(json)));
  expect_tetrahedron(load_mesh(file(patched(json, R"([["/scene", 1]])"))), 3);
  expect_tetrahedron(load_mesh(file(patched(json, R"([["/scene", null]])"))));
  EXPECT_EQ(load_mesh(file(patched(json, R"([["/scene", null], ["/scenes", []]])"))).size(), 8u);
}

TEST_F(Gltf, SideFilesLieBesideTheFile) {
  std::filesystem::create_directory(folder_.file("part"));
  std::filesystem::create_directory(folder_.file("part/below"));
  std::filesystem::create_directory(folder_.file("elsewhere"));
  folder_.file("part/the data.bin", positions + corners);
  folder_.file("part/below/data.bin", positions + corners);
  folder_.file("elsewhere/foreign.bin", positions + corners);
  const auto named = [&](const std::string& uri) {
    Json json = tetrahedron();
    json["buffers"][0]["uri"] = uri;
    return folder_.file("part/a.gltf", json.dump());
  };
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder_.file("elsewhere"));
  for (const char* uri : {"the%20data.bin", "the data.bin", "./below/data.bin"})
    expect_tetrahedron(load_mesh(named(uri)));
  expect_refusal(named("foreign.bin"), "buffers[0].uri: file 'foreign.bin' beside this one: no such file");
  for (const char* uri : {"../elsewhere/foreign.bin", "%2e%2E/elsewhere/foreign.bin", "/etc/passwd", ""})
    expect_refusal(named(uri), "names no file beside this one");
  for (const char* uri : {"file:///etc/passwd", "http://example.org/a.bin", "C:\\a.bin"})
    expect_refusal(named(uri), "is neither data nor a file");
  expect_refusal(named("50%.bin"), "two hexadecimal digits");
  expect_refusal(named("below"), "is a directory");
  std::filesystem::current_path(folder_.file("part"));
  expect_tetrahedron(load_mesh((named("the%20data.bin"), "a.gltf")));
  std::filesystem::current_path(before);
}

TEST_F(Gltf, RefusesDataThatIsNoBase64) {
  for (const auto& [uri, why] : {std::pair{"data:;base64,AAA", "no multiple of 4"},
                                 {"data:;base64,AA\nA", "'?' is no digit"},
                                 {"data:;base64,A===", "'=' is no digit"},
                                 {"data:text/plain,abc", "not in base64"},
                                 {"data:;base64,AAAA", "has a byteLength of 72, but 3 bytes"}}) {
    Json json = tetrahedron();
    json["buffers"][0]["uri"] = uri;
    expect_refusal(file(json), why);
  }
}

TEST_F(Gltf, RefusesWhatDoesNotFitAndNamesIt) {
  const std::pair<const char*, const char*> damages[] = {
      {R"([["/asset/version", "1.0"]])", "is glTF '1.0'; 2.0 is read"},
      {R"([["/asset", null]])", "has no asset"},
      {R"([["/extensionsRequired", ["EXT_unheard_of"]]])", "needs 'EXT_unheard_of'"},
      {R"([["/extensionsRequired", ["EXT_meshopt_compression"]]])", "needs 'EXT_meshopt_compression'"},
      {R"([["/bufferViews/0/extensions", {"EXT_meshopt_compression": {}}]])", "EXT_meshopt_compression"},
      {R"([["/scene", 1]])", "scene: names scenes[1] of 1"},
      {R"([["/scenes/0/nodes", [0, 0]]])", "scenes[0].nodes[1]: names a node a second time"},
      {R"([["/scenes/0/nodes", [1]]])", "names nodes[1] of 1"},
      {R"([["/scenes/0/nodes", [-1]]])", "is -1, which is no whole number"},
      {R"([["/nodes/0/mesh", 1.5]])", "nodes[0].mesh: is 1.5, which is no whole number"},
      {R"([["/nodes/0/mesh", "0"]])", "nodes[0].mesh: is not a number"},
      {R"([["/nodes/0/mesh", 1]])", "names meshes[1] of 1"},
      {R"([["/nodes/0/children", [0]]])", "nodes[0]: is a child of itself"},
      {R"([["/nodes/1", {"children": [2]}], ["/nodes/2", {"children": [1]}]])", "is a child of itself"},
      {R"([["/nodes/1", {"children": [2]}], ["/nodes/2", {}], ["/nodes/3", {"children": [2]}]])",
       "nodes[3].children[0]: nodes[2] is also a child of nodes[1]"},
      {R"([["/nodes/1", {"children": [0]}]])", "names a node that has a parent"},
      {R"([["/nodes/0/matrix", [1,0,0,0, 0,1,0,0, 0,0,1,1, 0,0,0,1]]])",
       "node 'part': its transform is a projection"},
      {R"([["/nodes/0/matrix", [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0]]])", "has 15 numbers instead of 16"},
      {R"([["/nodes/0/matrix", [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]], ["/nodes/0/scale", [1,1,1]]])",
       "has a matrix and"},
      {R"([["/nodes/0/rotation", [0,0,0,2]]])", "a quaternion of length 2.0"},
      {R"([["/nodes/0/rotation", [0,0,0,0]]])", "a quaternion of length 0.0"},
      {R"([["/meshes/0/primitives/0/attributes", {}]])",
       "meshes[0].primitives[0].attributes: has no POSITION"},
      {R"([["/meshes/0/primitives/0/mode", 7]])", "has the mode 7"},
      {R"([["/meshes/0/primitives/0/indices", 2]])", "names accessors[2] of 2"},
      {R"([["/accessors/1/count", 11]])", "has 11 corners"},
      {R"([["/accessors/1/count", 13]])",
       "accessors[1]: 13 elements of 2 bytes from byte 0 on do not fit its view of 24"},
      {R"([["/accessors/1/count", 0]])", "has a count of 0"},
      {R"([["/accessors/1/count", 9007199254740992]])", "do not fit"},
      {R"([["/accessors/1/byteOffset", 1]])", "starts at byte 49"},
      {R"([["/accessors/1/byteOffset", 9007199254740992]])", "do not fit"},
      {R"([["/accessors/1/componentType", 5122]])", "no plain unsigned numbers"},
      {R"([["/accessors/1/componentType", 5124]])", "is no component type"},
      {R"([["/accessors/1/type", "VEC3"]])", "has the type 'VEC3' instead of SCALAR"},
      {R"([["/accessors/1/normalized", true]])", "no plain unsigned numbers"},
      {R"([["/bufferViews/1/byteStride", 4]])", "its view a byteStride of 4"},
      {R"([["/accessors/0/componentType", 5125]])", "positions of component type 5125"},
      {R"([["/accessors/0/normalized", true]])", "is normalized"},
      {R"([["/accessors/0/bufferView", null], ["/accessors/0/count", 65537]])", "65536 zeros are the most"},
      {R"([["/bufferViews/0/byteStride", 8]])", "have 12 bytes, its view a byteStride of 8"},
      {R"([["/bufferViews/0/byteStride", 14]])", "no multiple of 4"},
      {R"([["/bufferViews/1/byteLength", 25]])", "covers 25 bytes from byte 48 on, its buffer has 72"},
      {R"([["/bufferViews/1/byteOffset", 73]])", "its buffer has 72"},
      {R"([["/bufferViews/0/buffer", 1]])", "names buffers[1] of 1"},
      {R"([["/buffers/0/byteLength", 73]])", "has a byteLength of 73, but 72 bytes"},
      {R"([["/buffers/0/uri", null]])", "has neither a uri nor"}};
  for (const auto& [patch, why] : damages) expect_refusal(file(patched(tetrahedron(), patch)), why);
}

TEST_F(Gltf, RefusesIndicesBeyondTheVertices) {
  std::vector<std::uint16_t> wrong = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 9};
  expect_refusal(file(tetrahedron(positions, bytes_of(wrong))),
                 "meshes[0].primitives[0]: triangle 3 names vertex 9 of 4");
  wrong.back() = 0xffff;
  expect_refusal(file(tetrahedron(positions, bytes_of(wrong))), "index 11 is the largest of its type");
}

TEST_F(Gltf, RefusesPositionsThatAreNotFinite) {
  for (const float bad : {NAN, INFINITY, -INFINITY}) {
    const std::string three = positions.substr(0, 36);
    expect_refusal(file(tetrahedron(three + bytes_of<float>({0, bad, 0}))),
                   "accessors[0]: vertex 3 is not finite");
  }
}

TEST_F(Gltf, RefusesBrokenJson) {
  const std::string whole = tetrahedron().dump(1);
  expect_refusal(folder_.file("a.gltf", whole.substr(0, 400)), "its JSON ends early");
  expect_refusal(folder_.file("a.gltf", "{\n\"asset\": nonsense}"), "line 2: is not JSON");
  expect_refusal(folder_.file("a.gltf", whole + "}"), "is not JSON");
  expect_refusal(folder_.file("a.gltf", whole + std::string("\0}", 2)), "a zero byte");
  expect_refusal(folder_.file("a.gltf", R"({"asset": {"version": "2.0"}, "scene": 0, "scene": 1})"),
                 "key 'scene' twice");
  expect_refusal(folder_.file("a.gltf", R"({"asset": 1e999})"), "a number does not fit a double");
  expect_refusal(folder_.file("a.gltf", "[]"), "the file is not an object");
  expect_refusal(folder_.file("a.gltf", "\xff\xfe{"), "UTF-16");
  expect_refusal(folder_.file("a.gltf", std::string(1000000, '[')), "nests more than 512 values");
}

TEST_F(Gltf, RefusesBrokenChunks) {
  const std::string whole = glb_of(tetrahedron(), positions + corners);
  for (const std::size_t length : {std::size_t{5}, std::size_t{16}, whole.size() - 80, whole.size() - 1})
    expect_refusal(folder_.file("a.glb", whole.substr(0, length)), "byte ");
  expect_refusal(folder_.file("a.glb", whole + "more"), "byte 8: states a length of");
  expect_tetrahedron(load_mesh(folder_.file("a.glb", whole + std::string(5, '\0'))));
  const auto changed = [&](std::size_t at, char to) {
    std::string bytes = whole;
    bytes[at] = to;
    return folder_.file("a.glb", bytes);
  };
  expect_refusal(changed(4, 1), "is a .glb of version 1");
  expect_refusal(changed(12, static_cast<char>(whole[12] + 1)), "no multiple of 4");
  expect_refusal(changed(13, '\x7f'), " follow");
  expect_refusal(changed(16, 'X'), "begins with one chunk of JSON");
  const std::size_t chunk = whole.size() - 76;  // its type
  expect_refusal(changed(chunk, 'X'), "has neither a uri nor a chunk");
}

TEST_F(Gltf, ManyNestedNodesTakeNoStack) {
  Json json = tetrahedron();
  constexpr std::size_t depth = 100000;
  json["nodes"][0].erase("mesh");
  for (std::size_t i = 0; i < depth; ++i) {
    json["nodes"][i]["children"] = {i + 1};
    json["nodes"][i]["translation"] = {0, 0, 1};
  }
  json["nodes"][depth]["mesh"] = 0;
  const TriangleMesh mesh = load_mesh(file(json));
  expect_tetrahedron(mesh);
  EXPECT_EQ(mesh.bounds().min.z(), depth);
}

TEST_F(Gltf, PrimitivesThatShareVerticesKeepTheirOwn) {
  std::vector<float> many(3 * 1000, 0.5f);
  std::memcpy(many.data() + 3 * 500, positions.data(), positions.size());
  const std::string far =
      bytes_of<std::uint16_t>({500, 502, 501, 500, 501, 503, 500, 503, 502, 501, 502, 503});
  Json json = patched(tetrahedron(bytes_of(many), far), R"([["/accessors/0/count", 1000]])");
  const TriangleMesh mesh = load_mesh(file(json));
  expect_tetrahedron(mesh);
  EXPECT_EQ(mesh.vertices().size(), 4u);
}

TEST_F(Gltf, SurvivesEveryCutAndManyChangedBytes) {
  const std::string whole = glb_of(tetrahedron(), positions + corners);
  for (std::size_t length = 1; length < whole.size(); length += 3)
    refusal(folder_.file("a.glb", whole.substr(0, length)));
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string changed = whole;
    changed[at] = at % 2 == 0 ? '9' : '\xff';
    refusal(folder_.file("a.glb", changed));
  }
}

}  // namespace
}  // namespace touchmark
