#include "bench/scenes/scene_json.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/meshes/meshes.h"
#include "bench/scenes/primitives.h"
#include "bench/support/did_you_mean.h"
#include "bench/support/files/text_file.h"
#include "core/scene/round/primitives.h"

namespace touchmark::bench::scenes {
namespace {

using Json = nlohmann::json;

/// What every body has, and what is of one kind of shape.
constexpr std::string_view of_all[] = {"name", "position", "orientation"};
struct ShapeKind {
  std::string_view name;
  std::vector<std::string_view> sizes;  ///< the keys of its numbers
};
const ShapeKind shape_kinds[] = {
    {"plane", {"size"}}, {"box", {"size"}}, {"sphere", {"radius"}}, {"capsule", {"radius", "length"}}};

/// JSON lets an object have a key twice and says nothing of which one counts.
class KeysOnce {
 public:
  bool operator()(int, Json::parse_event_t event, Json& parsed) {
    if (event == Json::parse_event_t::object_start) seen_.emplace_back();
    if (event == Json::parse_event_t::object_end) seen_.pop_back();
    if (event == Json::parse_event_t::key && !seen_.back().insert(parsed.get<std::string>()).second)
      throw std::invalid_argument(
          fmt::format("an object has the key \"{}\" twice", parsed.get<std::string>()));
    return true;
  }

 private:
  std::vector<std::set<std::string>> seen_;
};

Json parsed(const std::string& text) {
  try {
    KeysOnce once;
    return Json::parse(
        text, [&](int depth, Json::parse_event_t event, Json& value) { return once(depth, event, value); });
  } catch (const Json::exception& error) {
    throw std::invalid_argument(fmt::format("is not JSON: {}", error.what()));
  }
}

void expect_keys(const Json& object, std::span<const std::string_view> keys) {
  if (!object.is_object()) throw std::invalid_argument("is not an object");
  for (const auto& [key, value] : object.items())
    if (std::ranges::find(keys, key) == keys.end())
      throw std::invalid_argument(
          fmt::format("unknown key \"{}\"; did you mean {}?", key,
                      support::near_names(key, std::vector<std::string>(keys.begin(), keys.end()))));
  for (const std::string_view key : keys)
    if (!object.contains(key)) throw std::invalid_argument(fmt::format("\"{}\" is missing", key));
}

std::string text_of(const Json& body, const char* key) {
  const Json& value = body[key];
  if (!value.is_string()) throw std::invalid_argument(fmt::format("\"{}\" is not a text", key));
  if (value.get_ref<const std::string&>().empty())
    throw std::invalid_argument(fmt::format("\"{}\" is empty", key));
  return value.get<std::string>();
}

template <std::size_t size>
std::array<double, size> numbers_of(const Json& body, const char* key, const char* what) {
  const Json& list = body[key];
  if (!list.is_array()) throw std::invalid_argument(fmt::format("\"{}\" is not a list", key));
  if (list.size() != size)
    throw std::invalid_argument(
        fmt::format("\"{}\" has {} numbers, not {}: {}", key, list.size(), size, what));
  std::array<double, size> numbers{};
  for (std::size_t i = 0; i < size; ++i) {
    if (!list[i].is_number())
      throw std::invalid_argument(fmt::format("\"{}\": number {} is none", key, i + 1));
    numbers[i] = list[i].get<double>();
    if (!std::isfinite(numbers[i]))
      throw std::invalid_argument(fmt::format("\"{}\": number {} is not finite", key, i + 1));
  }
  return numbers;
}

void expect_size(double size, const std::string& what) {
  if (is_primitive_size(size)) return;
  throw std::invalid_argument(fmt::format("{} is {}, and a size is from {} to {}", what, size,
                                          min_primitive_size, max_primitive_size));
}

template <std::size_t size>
std::array<double, size> sizes_of(const Json& body, const char* key, const char* what) {
  const std::array<double, size> sizes = numbers_of<size>(body, key, what);
  for (std::size_t i = 0; i < size; ++i) expect_size(sizes[i], fmt::format("\"{}\": number {}", key, i + 1));
  return sizes;
}

double size_of(const Json& body, const char* key) {
  if (!body[key].is_number()) throw std::invalid_argument(fmt::format("\"{}\" is not a number", key));
  const auto size = body[key].get<double>();
  expect_size(size, fmt::format("\"{}\"", key));
  return size;
}

Placement placement_of(const Json& body) {
  const auto position = numbers_of<3>(body, "position", "x, y, z");
  const auto orientation = numbers_of<4>(body, "orientation", "w, x, y, z");
  if (std::ranges::all_of(orientation, [](double x) { return x == 0; }))
    throw std::invalid_argument("\"orientation\" is the quaternion of zeros, which turns nothing anywhere");
  return {{position[0], position[1], position[2]}, orientation};
}

/// A name as for --mesh, or a file in the scene's folder.
std::string resolved(const std::string& mesh, const std::filesystem::path& folder) {
  return meshes::is_named(mesh) ? mesh : (folder / mesh).string();
}

const ShapeKind& kind_of(const Json& body) {
  const std::string name = text_of(body, "shape");
  const auto* const kind = std::ranges::find(shape_kinds, name, &ShapeKind::name);
  if (kind != std::end(shape_kinds)) return *kind;
  std::vector<std::string> names;
  for (const ShapeKind& known : shape_kinds) names.emplace_back(known.name);
  throw std::invalid_argument(
      fmt::format("\"shape\": \"{}\" is none; it is one of {}", name, fmt::join(names, ", ")));
}

/// A body has a mesh, or a shape with its sizes.
void expect_body_keys(const Json& body) {
  std::vector<std::string_view> keys(std::begin(of_all), std::end(of_all));
  if (body.is_object() && body.contains("shape")) {
    if (body.contains("mesh")) throw std::invalid_argument("has both \"mesh\" and \"shape\"");
    const ShapeKind& kind = kind_of(body);
    keys.emplace_back("shape");
    keys.insert(keys.end(), kind.sizes.begin(), kind.sizes.end());
  } else {
    keys.emplace_back("mesh");
  }
  expect_keys(body, keys);
}

std::optional<RoundShape> round_shape_of(const Json& body) {
  const std::string_view name = kind_of(body).name;
  if (name == "sphere") return RoundShape{0, size_of(body, "radius")};
  if (name == "capsule") return RoundShape{0.5 * size_of(body, "length"), size_of(body, "radius")};
  return std::nullopt;
}

TriangleMesh flat_shape_of(const Json& body) {
  if (kind_of(body).name == "plane") {
    const auto size = sizes_of<2>(body, "size", "x, y");
    return plane_mesh(size[0], size[1]);
  }
  const auto size = sizes_of<3>(body, "size", "x, y, z");
  return box_mesh({size[0], size[1], size[2]});
}

/// Tells shapes apart by their sizes as they are written; a mesh's name never begins like that.
std::string key_of_primitive(const Json& body) {
  std::string key = "\n" + body["shape"].dump();
  for (const std::string_view size : kind_of(body).sizes) key += body[std::string(size)].dump() + "\n";
  return key;
}

class SceneReader {
 public:
  explicit SceneReader(const std::string& path) : folder_(std::filesystem::path(path).parent_path()) {}

  void add(const Json& json) {
    expect_body_keys(json);
    Body body{text_of(json, "name"), 0, {}};
    if (!names_.insert(body.name).second) throw std::invalid_argument("another body has this name");
    body.start = placement_of(json);
    body.shape = shape_of(json);
    scene_.bodies.push_back(std::move(body));
  }
  BodyScene scene() && { return std::move(scene_); }

 private:
  std::size_t shape_of(const Json& json) {
    const bool is_primitive = json.contains("shape");
    const std::string mesh = is_primitive ? "" : resolved(text_of(json, "mesh"), folder_);
    const std::string key = is_primitive ? key_of_primitive(json) : mesh;
    const auto known = shapes_.find(key);
    if (known != shapes_.end()) return known->second;
    const std::size_t index = scene_.shapes.size();
    const std::optional<RoundShape> round = is_primitive ? round_shape_of(json) : std::nullopt;
    if (round) scene_.round.emplace(index, *round);
    TriangleMesh made = round          ? facets_of(*round)
                        : is_primitive ? flat_shape_of(json)
                                       : meshes::load_mesh(mesh);
    scene_.shapes.push_back(std::make_shared<const TriangleMesh>(std::move(made)));
    shapes_.emplace(key, index);
    return index;
  }

  std::filesystem::path folder_;
  BodyScene scene_;
  std::set<std::string> names_;
  std::map<std::string, std::size_t> shapes_;
};

/// Which body a message speaks of.
std::string title_of(const Json& body, std::size_t index) {
  const bool named = body.is_object() && body.contains("name") && body["name"].is_string();
  return named ? fmt::format("body {} \"{}\"", index, body["name"].get<std::string>())
               : fmt::format("body {}", index);
}

}  // namespace

BodyScene read_scene_json(const std::string& path) {
  const std::string text = support::read_text_file(path);
  std::string where;
  try {
    const Json json = parsed(text);
    constexpr std::array<std::string_view, 1> keys{"bodies"};
    expect_keys(json, keys);
    const Json& bodies = json["bodies"];
    if (!bodies.is_array() || bodies.empty())
      throw std::invalid_argument("\"bodies\" is not a list of one body or more");
    SceneReader reader(path);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      where = title_of(bodies[i], i) + ": ";
      reader.add(bodies[i]);
    }
    return std::move(reader).scene();
  } catch (const MeshError& error) {
    throw MeshError(fmt::format("{}: {}{}", path, where, error.what()));
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("{}: {}{}", path, where, error.what()));
  }
}

}  // namespace touchmark::bench::scenes
