#include "bench/meshes/meshes.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "bench/meshes/generated_meshes.h"
#include "bench/meshes/sized_meshes.h"
#include "bench/support/did_you_mean.h"
#include "bench/support/numbers.h"
#include "bench/support/system/available_memory.h"

namespace touchmark::bench::meshes {
namespace {

namespace fs = std::filesystem;

/// A mesh as asked for: what follows the colon, and the whole for messages.
struct Request {
  std::string name;
  std::optional<std::string> parameter;
  std::string whole;

  std::invalid_argument refusal(std::string_view why) const {
    return std::invalid_argument(fmt::format("mesh \"{}\": {}", whole, why));
  }
};

std::uint64_t whole_number(const Request& request, std::string_view text, std::string_view what,
                           std::uint64_t least, std::uint64_t most) {
  const std::optional<std::uint64_t> value = support::parse_count(text);
  if (!value || *value < least || *value > most)
    throw request.refusal(
        fmt::format("{} \"{}\" is not a whole number from {} to {}", what, text, least, most));
  return *value;
}

const std::string& parameter(const Request& request, std::string_view form) {
  if (!request.parameter) throw request.refusal(fmt::format("its parameter is missing; write {}", form));
  return *request.parameter;
}

/// For closed meshes and soup alike: corners, up to three vertices each, a transformed copy.
void require_memory_for(const Request& request, std::uint64_t triangles, std::uint64_t vertices) {
  support::require_memory(
      fmt::format("mesh \"{}\": {} triangles", request.whole, triangles),
      static_cast<double>(2 * (triangles * sizeof(TriangleMesh::Corners) + vertices * sizeof(Vec3))));
}

/// A file is read whole, and its mesh takes about as much again.
ImportedMesh load_file(const fs::path& file) {
  std::error_code ignored;
  if (fs::is_regular_file(file, ignored)) {
    const std::uintmax_t size = fs::file_size(file, ignored);
    if (!ignored)
      support::require_memory(fmt::format("mesh {}: {} bytes", file.string(), size),
                              2 * static_cast<double>(size));
  }
  return import_mesh(file);
}

TriangleMesh make_icosphere(const Request& request) {
  const std::uint64_t levels = whole_number(request, parameter(request, "icosphere:N"), "N", 0, 11);
  const std::uint64_t triangles = std::uint64_t{20} << (2 * levels);
  require_memory_for(request, 4 * triangles, triangles / 2);  // the edges are sorted on the way
  return icosphere(static_cast<unsigned>(levels));
}

TriangleMesh make_torus(const Request& request) {
  const std::string_view text = parameter(request, "torus:NxM");
  const std::size_t cross = text.find('x');
  if (cross == std::string_view::npos) throw request.refusal("write torus:NxM, as torus:64x32");
  constexpr std::uint64_t most = 1'000'000;
  const std::uint64_t around = whole_number(request, text.substr(0, cross), "N", 3, most);
  const std::uint64_t along = whole_number(request, text.substr(cross + 1), "M", 3, most);
  const std::uint64_t triangles = 2 * around * along;
  if (triangles > max_generated_triangles)
    throw request.refusal(fmt::format("{} triangles, more than {}", triangles, max_generated_triangles));
  require_memory_for(request, triangles, triangles / 2);
  return torus(static_cast<std::uint32_t>(around), static_cast<std::uint32_t>(along));
}

TriangleMesh make_sized(const SizedMesh& sized, const Request& request) {
  const std::string_view form = sized.form;
  const std::uint64_t triangles =
      whole_number(request, parameter(request, form), form.substr(form.find(':') + 1), sized.min_triangles,
                   max_generated_triangles);
  require_memory_for(request, triangles, 3 * triangles);
  return sized.make(triangles);
}

template <TriangleMesh (*make)()>
TriangleMesh make_plain(const Request& request) {
  if (request.parameter) throw request.refusal(fmt::format("{} takes no parameter", request.name));
  return make();
}

// From glmark2-data; other distributions keep it under local, too.
constexpr const char* bunny_files[] = {"/usr/share/glmark2/models/bunny.obj",
                                       "/usr/local/share/glmark2/models/bunny.obj"};

fs::path bunny_file() {
  std::error_code ignored;
  for (const char* file : bunny_files)
    if (fs::exists(file, ignored)) return file;
  return {};
}

TriangleMesh make_bunny(const Request& request) {
  if (request.parameter) throw request.refusal("bunny takes no parameter");
  const fs::path file = bunny_file();
  if (file.empty())
    throw request.refusal(fmt::format("{} is not there; install the package glmark2-data", bunny_files[0]));
  return load_file(file).mesh;
}

fs::path dragon_file(std::uint64_t resolution) {
  return data_folder() /
         (resolution == 1 ? "dragon_vrip.ply" : fmt::format("dragon_vrip_res{}.ply", resolution));
}

TriangleMesh make_dragon(const Request& request) {
  const std::uint64_t resolution = whole_number(request, request.parameter.value_or("1"), "resolution", 1, 4);
  const fs::path file = dragon_file(resolution);
  std::error_code ignored;
  if (!fs::exists(file, ignored))
    throw request.refusal(
        fmt::format("{} is not there; fetch it with scripts/setup --dragon", file.string()));
  return load_file(file).mesh;
}

bool always() { return true; }
bool has_bunny() { return !bunny_file().empty(); }
bool has_dragon() {
  std::error_code ignored;
  return fs::exists(dragon_file(1), ignored);
}

struct MeshKind {
  const char* form;
  const char* description;
  const char* example;
  TriangleMesh (*make)(const Request&);
  bool (*available)() = always;
};

/// Returns what stands before the parameter.
std::string name_in(std::string_view form) { return std::string(form.substr(0, form.find_first_of(":["))); }

// One line a mesh.
constexpr MeshKind mesh_kinds[] = {
    {"bunny", "the Stanford bunny, 69,666 triangles, from the package glmark2-data", "", make_bunny,
     has_bunny},
    {"dragon[:1..4]", "the Stanford dragon, 871,414 to 11,102 triangles, from scripts/setup --dragon", "",
     make_dragon, has_dragon},
    {"icosphere:N", "unit sphere from an icosahedron split N times, 20 * 4^N triangles", "icosphere:3",
     make_icosphere},
    {"torus:NxM", "torus of radii 1 and 0.4, N around the axis, M round the tube, 2 * N * M triangles",
     "torus:24x12", make_torus},
    {"thin-plate", "closed slab 1 x 1 x 0.001, 4,352 triangles", "thin-plate", make_plain<thin_plate>},
    {"sliver-fan", "1,000 slivers round one vertex, the thinnest 1.3e-10 radians wide", "sliver-fan",
     make_plain<sliver_fan>},
    {"degenerate", "points, segments and collinear triangles among good ones", "degenerate",
     make_plain<degenerate>},
    {"doubled", "a sphere with each triangle three times: twice alike, once the other way round", "doubled",
     make_plain<doubled>},
    {"needles", "triangles with one short edge, aspect ratios to 1e15", "needles", make_plain<needles>},
    {"caps", "triangles whose apex all but lies on the longest edge, aspect ratios to 1e15", "caps",
     make_plain<caps>},
    {"single-triangle", "one equilateral triangle", "single-triangle", make_plain<single_triangle>},
    {"cube", "edge 1, 12 triangles, all edges sharp", "cube", make_plain<cube>},
    {"wedge", "closed blade with an edge of 2 degrees", "wedge", make_plain<wedge>},
};

struct Modifier {
  enum class Kind { scale, offset, normalize } kind;
  double value = 0;
};

double finite_number(const Request& request, std::string_view modifier, std::string_view text) {
  const std::optional<double> value = support::parse_number(text);
  if (!value || *value > std::numeric_limits<double>::max() || *value < std::numeric_limits<double>::lowest())
    throw request.refusal(fmt::format("@{} \"{}\" is not a finite number", modifier, text));
  return *value;
}

/// Nothing when `text` is no modifier at all, but part of a file's name.
std::optional<Modifier> parse_modifier(const Request& request, std::string_view text) {
  constexpr std::string_view scale = "scale=", offset = "offset=";
  if (text == "normalize") return Modifier{Modifier::Kind::normalize};
  if (text.starts_with(scale)) {
    const double factor = finite_number(request, "scale", text.substr(scale.size()));
    if (!(factor > 0)) throw request.refusal(fmt::format("@scale \"{}\" is not above 0", factor));
    return Modifier{Modifier::Kind::scale, factor};
  }
  if (text.starts_with(offset))
    return Modifier{Modifier::Kind::offset, finite_number(request, "offset", text.substr(offset.size()))};
  return std::nullopt;
}

/// Takes the modifiers off the end of request.name, and gives them in the order written.
std::vector<Modifier> split_modifiers(Request& request) {
  std::vector<Modifier> modifiers;
  for (std::size_t at = request.name.rfind('@'); at != std::string::npos; at = request.name.rfind('@')) {
    const std::optional<Modifier> modifier =
        parse_modifier(request, std::string_view(request.name).substr(at + 1));
    if (!modifier) break;
    modifiers.insert(modifiers.begin(), *modifier);
    request.name.resize(at);
  }
  return modifiers;
}

TriangleMesh modified(TriangleMesh mesh, const Modifier& modifier) {
  switch (modifier.kind) {
    case Modifier::Kind::scale:
      return mesh.transformed(modifier.value, Vec3::Zero());
    case Modifier::Kind::offset:
      return mesh.transformed(1, Vec3::Constant(modifier.value));
    default:
      return mesh.normalized();
  }
}

[[noreturn]] void refuse_unknown(const Request& request) {
  if (request.name == "-")
    throw request.refusal("standard input is not read, as no ending names its format; write it to a file");
  const std::size_t at = request.name.rfind('@');
  if (at != std::string::npos)
    throw request.refusal(
        fmt::format("no file has this name, and \"{}\" is no modifier (@scale=, @offset=, @normalize)",
                    request.name.substr(at)));
  std::vector<std::string> known;
  for (const NamedMesh& named : named_meshes()) known.push_back(name_in(named.name));
  throw request.refusal(
      fmt::format("no scene and no file has this name; did you mean {}?",
                  support::near_names(request.name.substr(0, request.name.find(':')), known)));
}

ImportedMesh load_unmodified(Request& request) {
  const std::size_t colon = request.name.find(':');
  const std::string name = request.name.substr(0, colon);
  if (colon != std::string::npos) request.parameter = request.name.substr(colon + 1);
  for (const MeshKind& kind : mesh_kinds)
    if (name_in(kind.form) == name) return {{kind.make(request), "", ""}};
  for (const SizedMesh& sized : sized_meshes())
    if (name_in(sized.form) == name) return {{make_sized(sized, request), "", ""}};
  std::error_code ignored;
  const auto has = [&](const char* any) { return request.name.find_first_of(any) != std::string::npos; };
  if ((has("/.") && !has("@")) || fs::exists(request.name, ignored)) return load_file(request.name);
  refuse_unknown(request);
}

}  // namespace

fs::path data_folder() {
  const auto variable = [](const char* name) -> fs::path {
    const char* value = std::getenv(name);
    return value == nullptr ? fs::path() : fs::path(value);
  };
  const fs::path data = variable("TOUCHMARK_DATA"), cache = variable("XDG_CACHE_HOME");
  if (!data.empty()) return data;
  return (cache.empty() ? variable("HOME") / ".cache" : cache) / "touchmark";
}

std::vector<NamedMesh> named_meshes() {
  std::vector<NamedMesh> infos;
  for (const MeshKind& kind : mesh_kinds)
    infos.push_back({kind.form, kind.description, kind.example, kind.available()});
  for (const SizedMesh& sized : sized_meshes())
    infos.push_back({sized.form, sized.description, sized.example});
  return infos;
}

bool is_named(const std::string& text) {
  const std::string name = text.substr(0, text.find_first_of(":@"));
  const std::vector<NamedMesh> known = named_meshes();
  return std::ranges::any_of(known, [&](const NamedMesh& named) { return name_in(named.name) == name; });
}

std::string default_mesh() { return has_bunny() ? "bunny" : "icosphere:6"; }

ImportedMesh load_with_frame(const std::string& name, bool normalize) {
  Request request{name, std::nullopt, name};
  const std::vector<Modifier> modifiers = split_modifiers(request);
  ImportedMesh file = load_unmodified(request);
  try {
    for (const Modifier& modifier : modifiers) file.mesh = modified(std::move(file.mesh), modifier);
  } catch (const MeshError& error) {
    throw MeshError(fmt::format("mesh \"{}\": {}", name, error.what()));
  }
  if (normalize) file.mesh = file.mesh.normalized();
  return file;
}

TriangleMesh load_mesh(const std::string& name) { return load_with_frame(name, false).mesh; }

TriangleMesh load_mesh(const std::string& name, bool normalize) {
  return load_with_frame(name, normalize).mesh;
}

}  // namespace touchmark::bench::meshes
