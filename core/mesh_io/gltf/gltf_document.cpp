#include "core/mesh_io/gltf/gltf_document.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <utility>

#include "core/mesh_io/mesh_builder.h"

namespace touchmark::mesh_io {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF's buffers are read in place");

constexpr std::string_view magic = "glTF";

/// The extensions that may be required, with a blank about each: the first three are read, the others change
/// no shape.
constexpr std::string_view known_extensions =
    " KHR_draco_mesh_compression KHR_mesh_quantization EXT_mesh_gpu_instancing EXT_lights_image_based "
    "EXT_texture_avif EXT_texture_webp KHR_lights_punctual KHR_materials_anisotropy KHR_materials_clearcoat "
    "KHR_materials_diffuse_transmission KHR_materials_dispersion KHR_materials_emissive_strength "
    "KHR_materials_ior KHR_materials_iridescence KHR_materials_pbrSpecularGlossiness KHR_materials_sheen "
    "KHR_materials_specular KHR_materials_transmission KHR_materials_unlit KHR_materials_variants "
    "KHR_materials_volume KHR_materials_volume_scatter KHR_texture_basisu KHR_texture_transform KHR_xmp "
    "KHR_xmp_json_ld MSFT_texture_dds ";

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return word;
}

/// Returns six bits of base64, or -1.
int six_bits(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

std::string decoded_base64(std::string_view text, const JsonValue& uri) {
  if (text.size() % 4 != 0)
    uri.fail("its base64 has " + std::to_string(text.size()) + " digits, no multiple of 4");
  for (int i = 0; i < 2 && text.ends_with('='); ++i) text.remove_suffix(1);
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const int more = six_bits(c);
    if (more < 0) uri.fail(mesh_io::quoted(std::string_view(&c, 1)) + " is no digit of base64");
    bits = bits << 6 | static_cast<std::uint32_t>(more);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 0xff);
  }
  return bytes;
}

bool is_data_uri(std::string_view uri) {
  constexpr std::string_view scheme = "data:";
  return uri.size() >= scheme.size() &&
         std::equal(scheme.begin(), scheme.end(), uri.begin(),
                    [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); });
}

bool has_scheme(std::string_view uri) {
  const std::size_t colon = uri.find(':');
  return colon != std::string_view::npos && uri.find_first_of("/?#") > colon;
}

}  // namespace

GltfDocument::GltfDocument(std::string_view bytes, std::filesystem::path folder)
    : GltfDocument(chunks_of(bytes), std::move(folder)) {}

GltfDocument::GltfDocument(const Chunks& chunks, std::filesystem::path folder)
    : json_(chunks.json), binary_(chunks.binary), folder_(std::move(folder)) {
  check_version();
  check_extensions();
}

GltfDocument::Chunks GltfDocument::chunks_of(std::string_view bytes) {
  if (!bytes.starts_with(magic)) return {without_byte_order_mark(bytes), std::nullopt};
  constexpr std::size_t header = 12, chunk_header = 8;
  constexpr std::uint32_t json = 0x4e4f534a, binary = 0x004e4942;
  const auto fail = [](std::size_t at, const std::string& message) {
    throw MeshError("byte " + std::to_string(at) + ": " + message);
  };
  if (bytes.size() < header) fail(bytes.size(), "ends within the header of a .glb");
  if (word_at(bytes, 4) != 2)
    fail(4, "is a .glb of version " + std::to_string(word_at(bytes, 4)) + " instead of 2");
  const std::size_t length = word_at(bytes, 8);
  if (length > bytes.size() || length < header || !is_padding(bytes.substr(length)))
    fail(8, "states a length of " + std::to_string(length) + " bytes, the file has " +
                std::to_string(bytes.size()));
  Chunks chunks;
  std::size_t number = 0;
  for (std::size_t at = header; at < length; ++number) {
    if (length - at < chunk_header) fail(at, "ends within the header of a chunk");
    const std::size_t size = word_at(bytes, at);
    const std::uint32_t type = word_at(bytes, at + 4);
    const std::size_t rest = length - at - chunk_header;
    if (size > rest)
      fail(at, "a chunk of " + std::to_string(size) + " bytes, but " + std::to_string(rest) + " follow");
    if (size % 4 != 0) fail(at, "a chunk of " + std::to_string(size) + " bytes, no multiple of 4");
    if ((type == json) != (number == 0) || (type == binary && number != 1))
      fail(at, "a .glb begins with one chunk of JSON, which one of binary data may follow");
    const std::string_view content = bytes.substr(at + chunk_header, size);
    if (type == json) chunks.json = content;
    if (type == binary) chunks.binary = content;
    at += chunk_header + size;
  }
  if (number == 0) fail(length, "ends before its JSON");
  return chunks;
}

void GltfDocument::check_version() const {
  const JsonValue asset = root().at("asset");
  const std::string version = asset.at("version").text();
  if (!version.starts_with("2."))
    asset.at("version").fail("is glTF " + mesh_io::quoted(version) + "; 2.0 is read");
  const std::optional<JsonValue> least = asset.find("minVersion");
  if (least && least->text() != "2.0")
    least->fail("is glTF " + mesh_io::quoted(least->text()) + "; 2.0 is read");
}

void GltfDocument::check_extensions() const {
  const std::optional<JsonValue> required = root().find("extensionsRequired");
  for (std::size_t i = 0; required && i < required->size(); ++i) {
    const std::string name = (*required)[i].text();
    if (known_extensions.find(" " + name + " ") == std::string_view::npos)
      (*required)[i].fail("the file needs " + mesh_io::quoted(name) +
                          ", which is not read; export it without");
  }
}

bool GltfDocument::uses(std::string_view extension) const {
  for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
    const std::optional<JsonValue> names = root().find(list);
    if (names && names->lists(extension)) return true;
  }
  return false;
}

JsonValue GltfDocument::named_by(const JsonValue& index, const char* kind) const {
  const std::optional<JsonValue> list = root().find(kind);
  const std::size_t size = list ? list->size() : 0, number = index.whole();
  if (number >= size)
    index.fail("names " + std::string(kind) + "[" + std::to_string(number) + "] of " + std::to_string(size));
  return (*list)[number];
}

GltfDocument::View GltfDocument::view(const JsonValue& index) const {
  const JsonValue view = named_by(index, "bufferViews");
  if (const auto extensions = view.find("extensions");
      extensions && extensions->find("EXT_meshopt_compression"))
    view.fail("is compressed with EXT_meshopt_compression, which is not read; export it without");
  const JsonValue number = view.at("buffer");
  const std::string_view bytes = buffer(number.whole(), named_by(number, "buffers"));
  const std::size_t offset = view.whole("byteOffset", 0), length = view.at("byteLength").whole();
  if (length == 0 || offset > bytes.size() || length > bytes.size() - offset)
    view.fail("covers " + std::to_string(length) + " bytes from byte " + std::to_string(offset) +
              " on, its buffer has " + std::to_string(bytes.size()));
  std::optional<std::size_t> stride;
  if (const std::optional<JsonValue> stated = view.find("byteStride")) {
    stride = stated->whole();
    if (*stride < 4 || *stride > 252 || *stride % 4 != 0)
      stated->fail("is " + std::to_string(*stride) + ", which is no multiple of 4 from 4 to 252");
  }
  return {bytes.substr(offset, length), offset, stride};
}

std::string_view GltfDocument::buffer(std::size_t number, const JsonValue& buffer) const {
  const std::size_t length = buffer.at("byteLength").whole();
  const std::optional<JsonValue> uri = buffer.find("uri");
  std::string_view bytes;
  if (uri) {
    auto known = buffers_.find(number);
    if (known == buffers_.end()) known = buffers_.emplace(number, content_of(*uri)).first;
    bytes = known->second;
  } else if (number == 0 && binary_) {
    bytes = *binary_;
  } else {
    buffer.fail("has neither a uri nor a chunk of a .glb");
  }
  if (length > bytes.size())
    buffer.fail("has a byteLength of " + std::to_string(length) + ", but " + std::to_string(bytes.size()) +
                " bytes");
  return bytes.substr(0, length);
}

std::string GltfDocument::content_of(const JsonValue& uri) const {
  const std::string text = uri.text();
  if (is_data_uri(text)) {
    constexpr std::string_view base64 = ";base64,";
    const std::size_t comma = text.find(',');
    const std::size_t start = text.find(base64);
    if (comma == std::string::npos || start + base64.size() != comma + 1)
      uri.fail("is data that is not in base64");
    return decoded_base64(std::string_view(text).substr(comma + 1), uri);
  }
  if (has_scheme(text)) uri.fail(mesh_io::quoted(text) + " is neither data nor a file beside this one");
  const std::optional<std::string> decoded = mesh_io::decoded_percents(text);
  if (!decoded) uri.fail(mesh_io::quoted(text) + " has a % without two hexadecimal digits of a letter");
  const std::filesystem::path name(*decoded);
  if (name.empty() || name.is_absolute() || std::find(name.begin(), name.end(), "..") != name.end())
    uri.fail(mesh_io::quoted(text) + " names no file beside this one or in a folder below");
  try {
    return read_file(folder_ / name);
  } catch (const MeshError& error) {
    uri.fail("file " + mesh_io::quoted(name.string()) + " beside this one: " + error.what());
  }
}

}  // namespace touchmark::mesh_io
