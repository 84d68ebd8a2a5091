#include "bench/experiments/papers/paper_meshes.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "bench/experiments/papers/decimation.h"
#include "bench/meshes/meshes.h"
#include "bench/results/system_info.h"

namespace touchmark::bench::experiments::papers {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t choi_sung_triangles = 902;
constexpr std::uint64_t choi_sung_fingerprint = 0x6bc1f56c22f3e624;

/// SplitMix64's finaliser.
std::uint64_t mixed(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return z ^ (z >> 31);
}

/// A hash of the triangles by their corners' places in millionths of a mesh unit, whatever their order and
/// the file's format.
std::uint64_t fingerprint(const TriangleMesh& mesh) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    std::uint64_t corners = 0;
    for (int k = 0; k < 3; ++k) {
      std::uint64_t corner = 0;
      for (const double x : mesh.corner(i, k))
        corner = mixed(corner ^ static_cast<std::uint64_t>(std::llround(x * 1e6)));
      corners += mixed(corner);
    }
    sum += mixed(corners);
  }
  return sum;
}

/// Returns the folders of meshes that no package ships: where scripts/setup puts what it is given, and
/// $TOUCHMARK_MODELS before it, or ../shared/models beside the working folder or beside the repository that
/// the program was built in (its path is REPOSITORY/build/PRESET/bin/touchmark).
std::vector<fs::path> model_folders() {
  if (const char* folder = std::getenv("TOUCHMARK_MODELS")) return {folder, meshes::data_folder()};
  std::vector<fs::path> folders{fs::path("..") / "shared" / "models"};
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (!error) {
    const fs::path repository = program.parent_path().parent_path().parent_path().parent_path();
    folders.push_back(repository.parent_path() / "shared" / "models");
  }
  folders.push_back(meshes::data_folder());
  return folders;
}

std::optional<fs::path> model(const char* file) {
  std::error_code ignored;
  for (const fs::path& folder : model_folders())
    if (fs::is_regular_file(folder / file, ignored)) return folder / file;
  return std::nullopt;
}

PaperMesh decimated(const std::string& name, std::size_t triangles) {
  TriangleMesh mesh = decimate(meshes::load_mesh(name), triangles);
  std::string origin =
      fmt::format("{} decimated to {} triangles (OpenMesh, quadric error)", name, mesh.size());
  return {fmt::format("{}-{}", results::without_directories(name), mesh.size()), std::move(mesh),
          std::move(origin)};
}

PaperMesh requested_mesh(const std::string& name) {
  return {results::without_directories(name), meshes::load_mesh(name), "as asked for with --mesh"};
}

}  // namespace

bool is_choi_sungs_bunny(const TriangleMesh& mesh) {
  // Far larger meshes have no millionths that fit.
  return mesh.size() == choi_sung_triangles && mesh.diagonal() < 10 &&
         fingerprint(mesh) == choi_sung_fingerprint;
}

PaperMesh choi_sung_mesh(const std::string& requested) {
  if (!requested.empty()) {
    PaperMesh mesh = requested_mesh(requested);
    if (is_choi_sungs_bunny(mesh.mesh)) mesh.origin = "the paper's own";
    return mesh;
  }
  for (const char* name : {"bunny-902.ply", "bunny-902.obj", "bunny.obj"}) {
    const std::optional<fs::path> file = model(name);
    if (!file) continue;
    PaperMesh mesh{name, meshes::load_mesh(file->string()), "the paper's own"};
    if (is_choi_sungs_bunny(mesh.mesh)) return mesh;
  }
  PaperMesh mesh = decimated(meshes::default_mesh(), choi_sung_triangles);
  mesh.origin += ", in place of the paper's own, which is not here: its counts cannot come out";
  return mesh;
}

std::vector<PaperMesh> park_jang_meshes(const std::vector<std::string>& requested, bool quick) {
  std::vector<PaperMesh> meshes;
  for (const std::string& name : requested) meshes.push_back(requested_mesh(name));
  if (!requested.empty()) return meshes;
  const std::string whole = meshes::default_mesh();
  const std::pair<const char*, std::size_t> stanford[] = {
      {"bun_zipper_res4.ply", 948}, {"bun_zipper_res3.ply", 3851}, {"bun_zipper_res2.ply", 16301}};
  for (const auto& [file, triangles] : stanford) {
    if (const std::optional<fs::path> path = model(file))
      meshes.push_back({file, meshes::load_mesh(path->string()), "of the Stanford laboratory"});
    else if (can_decimate())
      meshes.push_back(decimated(whole, triangles));
    if (quick && !meshes.empty()) return meshes;
  }
  meshes.push_back({whole, meshes::load_mesh(whole), "whole"});
  return meshes;
}

}  // namespace touchmark::bench::experiments::papers
