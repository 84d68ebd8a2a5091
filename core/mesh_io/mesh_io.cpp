#include "core/mesh_io/mesh_io.h"

#include <algorithm>
#include <cctype>
#include <new>
#include <string>

#include "core/mesh_io/mesh_file.h"
#include "core/mesh_io/read_with_assimp.h"
#include "core/mesh_io/readers.h"

namespace touchmark {
namespace {

std::string lower_case_ending(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

TriangleMesh read(const std::string& bytes, const std::string& ending) {
  if (ending == ".ply") return mesh_io::read_ply(bytes);
  if (ending == ".obj") return mesh_io::read_obj(bytes);
  if (ending == ".off") return mesh_io::read_off(bytes);
  if (ending == ".stl") return mesh_io::read_stl(bytes);
  return mesh_io::read_with_assimp(bytes, ending);
}

}  // namespace

TriangleMesh load_mesh(const std::filesystem::path& path) {
  try {
    return read(mesh_io::read_file(path), lower_case_ending(path));
  } catch (const MeshError& error) {
    throw MeshError(path.string() + ": " + error.what());
  } catch (const std::bad_alloc&) {
    throw MeshError(path.string() + ": does not fit in memory");
  }
}

}  // namespace touchmark
