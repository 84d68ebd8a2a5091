#include "core/mesh_io_assimp/read_with_assimp.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <exception>
#include <mutex>
#include <utility>

#include <assimp/DefaultLogger.hpp>
#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include "core/triangle_mesh.h"

namespace touchmark::mesh_io {
namespace {

SceneGraph::Part part_of(const aiMesh& mesh, std::size_t number) {
  SceneGraph::Part part;
  for (unsigned i = 0; i < mesh.mNumVertices; ++i)
    part.vertices.emplace_back(mesh.mVertices[i].x, mesh.mVertices[i].y, mesh.mVertices[i].z);
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    if (face.mNumIndices < 3) continue;  // a point or a line
    for (unsigned k = 0; k < face.mNumIndices; ++k) {
      if (face.mIndices[k] >= mesh.mNumVertices)
        throw MeshError("part " + std::to_string(number) + ": face " + std::to_string(i) + " names vertex " +
                        std::to_string(face.mIndices[k]) + " of " + std::to_string(mesh.mNumVertices));
      part.corners.push_back(face.mIndices[k]);
    }
    part.ends.push_back(static_cast<std::uint32_t>(part.corners.size()));
  }
  return part;
}

Eigen::Matrix4d matrix_of(const aiMatrix4x4& m) {
  Eigen::Matrix4d matrix;
  matrix << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2, m.d3, m.d4;
  return matrix;
}

bool is_one_of(std::string_view endings, const std::string& ending) {
  return endings.find(" " + ending + " ") != std::string_view::npos;
}

/// Returns what brings the scene back into the axes of the file, which some importers turn so that y is up,
/// or mirror so that they are right-handed; those turn all faces, too.
Eigen::Matrix4d into_axes_of_file(const aiScene& scene, const std::string& ending) {
  Eigen::Matrix4d turn = Eigen::Matrix4d::Identity();
  turn.block<2, 2>(1, 1) << 0, 1, -1, 0;
  if (is_one_of(" .3ds .ase .ask .dxf .hmp .md3 .md5mesh .mdc .mdl .prj ", ending) &&
      matrix_of(scene.mRootNode->mTransformation) == turn)
    return turn.transpose();
  const double z = is_one_of(" .3d .b3d .lwo .lws .lxo .pmx .uc .x ", ending) ? -1 : 1;
  return Eigen::Vector4d(1, 1, z, 1).asDiagonal().toDenseMatrix();
}

/// Assimp turns the faces of a Neutral File Format.
void turn_faces(SceneGraph& graph) {
  for (SceneGraph::Part& part : graph.parts) {
    auto begin = part.corners.begin();
    for (const std::uint32_t end : part.ends) {
      std::reverse(begin, part.corners.begin() + end);
      begin = part.corners.begin() + end;
    }
  }
}

/// Adds the nodes below, parents before children, each before what follows it in the file.
void add(const aiScene& scene, const aiNode& node, const Eigen::Matrix4d& parent, SceneGraph& graph) {
  const Eigen::Matrix4d transform = parent * matrix_of(node.mTransformation);
  if (node.mNumMeshes > 0) {
    graph.nodes.push_back({node.mName.C_Str(), transform, {node.mMeshes, node.mMeshes + node.mNumMeshes}});
    for (const std::size_t part : graph.nodes.back().parts)
      if (part >= scene.mNumMeshes)
        throw MeshError("part " + std::to_string(part) + " does not exist, the file has " +
                        std::to_string(scene.mNumMeshes));
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) add(scene, *node.mChildren[i], transform, graph);
}

/// Keeps the first warning that says that faces or vertices were dropped or changed.
class Losses : public Assimp::LogStream {
 public:
  void write(const char* message) override {
    std::string text = message;  // "Warn,  T0: AC3D: Invalid vertex reference\n"
    if (const std::size_t thread = text.find(": "); thread != std::string::npos) text.erase(0, thread + 2);
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0) text.pop_back();
    std::string lower = text;
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    const auto names_one_of = [&lower](const auto& words) {
      return std::any_of(words.begin(), words.end(),
                         [&lower](const char* word) { return lower.find(word) != std::string::npos; });
    };
    constexpr std::array surface{"face",  "triangle", "polygon",  "vertex",       "vertices", "mesh",
                                 "index", "indices",  "overflow", "out of range", "end of"};
    constexpr std::array other{"validation", "normal", "tangent", "texture",   "uv",    "color", "material",
                               "shader",     "bone",   "weight",  "animation", "light", "camera"};
    if (first_.empty() && names_one_of(surface) && !names_one_of(other)) first_ = text;
  }
  const std::string& first() const noexcept { return first_; }

 private:
  std::string first_;
};

/// While it lives, assimp's log goes to `losses`, too. Assimp has one log for all threads.
class Watch {
 public:
  explicit Watch(Losses& losses) : losses_(&losses), made_(Assimp::DefaultLogger::isNullLogger()) {
    if (made_) Assimp::DefaultLogger::create("", Assimp::Logger::NORMAL, 0);
    Assimp::DefaultLogger::get()->attachStream(losses_, severities);
  }
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;
  ~Watch() {
    Assimp::DefaultLogger::get()->detachStream(losses_, severities);
    if (made_) Assimp::DefaultLogger::kill();
  }

 private:
  static constexpr unsigned severities = Assimp::Logger::Warn | Assimp::Logger::Err;
  static inline std::mutex one_at_a_time;

  std::lock_guard<std::mutex> lock_{one_at_a_time};
  Losses* losses_;
  bool made_;
};

/// The number that the file had before it was rounded to single precision.
double decimal(float number) {
  std::array<char, 32> text{};
  const char* const end = std::to_chars(text.data(), text.data() + text.size(), number).ptr;
  double result = 0;
  std::from_chars(text.data(), end, result);
  return result;
}

/// What an FBX file states of its axes and its unit.
void add_frame_of_fbx(const aiScene& scene, SceneGraph& graph) {
  if (scene.mMetaData == nullptr) return;
  float centimetres = 1;
  if (scene.mMetaData->Get("UnitScaleFactor", centimetres)) {
    graph.unit = decimal(centimetres) / 100;
    graph.states_unit = true;
  }
  std::int32_t up = -1;
  if (scene.mMetaData->Get("UpAxis", up) && up >= 0 && up < 3) graph.axes = std::string(1, "XYZ"[up]) + " up";
}

/// Refuses what assimp reads as something else.
void refuse_misread(std::string_view bytes, const std::string& ending) {
  const auto has = [bytes](std::string_view text) { return bytes.find(text) != std::string_view::npos; };
  if (ending == ".amf" && (has("<rx") || has("<ry") || has("<rz")))
    throw MeshError(
        "turns an object (<rx>, <ry>, <rz>), which assimp reads as a move; export it as STL, PLY or OBJ");
  if ((ending == ".x3d" || ending == ".x3dz") && (has("ccw=\"false\"") || has("ccw='false'")))
    throw MeshError("has faces with ccw=\"false\", which assimp does not turn; export it as STL, PLY or OBJ");
  if ((ending == ".ac" || ending == ".ac3d" || ending == ".acc") && has("\nrot "))
    throw MeshError("turns an object (rot), which assimp misplaces; export it as STL, PLY or OBJ");
}

/// The unit that an AMF file states; millimetres where it states none (ISO/ASTM 52915).
void add_unit_of_amf(std::string_view bytes, SceneGraph& graph) {
  graph.unit = 1e-3;
  graph.states_unit = true;
  const std::size_t begin = bytes.find("<amf"), end = bytes.find('>', begin);
  const std::string_view root = begin < end ? bytes.substr(begin, end - begin) : std::string_view();
  constexpr std::array<std::pair<std::string_view, double>, 5> units{
      {{"millimeter", 1e-3}, {"inch", 0.0254}, {"feet", 0.3048}, {"meter", 1}, {"micron", 1e-6}}};
  for (const auto& [name, metres] : units) {
    for (const char quote : {'"', '\''}) {
      const std::string attribute = std::string("unit=") + quote + std::string(name) + quote;
      if (root.find(attribute) == std::string_view::npos) continue;
      graph.unit = metres;
    }
  }
}

constexpr unsigned steps = aiProcess_ValidateDataStructure;  // none that drops, merges or reorders faces

void expect_known_ending(const Assimp::Importer& importer, const std::string& ending) {
  if (ending.empty() || !importer.IsExtensionSupported(ending))
    throw MeshError("the ending '" + ending + "' is of no known mesh format");
}

/// What `read(importer)` makes of a file, checked.
template <class Read>
const aiScene& imported(Assimp::Importer& importer, const Read& read) {
  const aiScene* scene = nullptr;
  try {
    scene = read(importer);
  } catch (const std::exception& error) {
    throw MeshError(std::string("assimp failed: ") + error.what());
  }
  if (scene == nullptr || scene->mRootNode == nullptr) {
    std::string message = importer.GetErrorString();
    for (char& c : message) c = c == '\n' || c == '\r' ? ' ' : c;
    throw MeshError("assimp cannot read it: " + message);
  }
  if ((scene->mFlags & AI_SCENE_FLAGS_INCOMPLETE) != 0) throw MeshError("assimp calls it incomplete");
  return *scene;
}

}  // namespace

SceneGraph read_with_assimp(const std::filesystem::path& path, std::string_view bytes,
                            const std::string& ending) {
  Losses losses;
  const Watch watch(losses);
  Assimp::Importer importer;
  expect_known_ending(importer, ending);
  refuse_misread(bytes, ending);
  const aiScene& scene = imported(importer, [&](Assimp::Importer& reader) {
    return std::filesystem::is_regular_file(path)
               ? reader.ReadFile(path.string(), steps)
               : reader.ReadFileFromMemory(bytes.data(), bytes.size(), steps, ending.c_str() + 1);
  });
  SceneGraph graph;
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) graph.parts.push_back(part_of(*scene.mMeshes[i], i));
  if (!losses.first().empty()) throw MeshError("assimp changed its surface: " + losses.first());
  if (ending == ".fbx") add_frame_of_fbx(scene, graph);
  if (ending == ".amf") add_unit_of_amf(bytes, graph);
  Eigen::Matrix4d to_file = into_axes_of_file(scene, ending);
  to_file.topRows<3>() *= graph.unit;
  add(scene, *scene.mRootNode, to_file, graph);
  if (ending == ".nff") turn_faces(graph);
  return graph;
}

}  // namespace touchmark::mesh_io
