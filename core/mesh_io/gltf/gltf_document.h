/// A glTF 2.0 file and the bytes that it names.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "core/mesh_io/gltf/gltf_json.h"

namespace touchmark::mesh_io {

class GltfDocument {
 public:
  /// A view of a buffer.
  struct View {
    std::string_view bytes;
    std::size_t offset;                 ///< its first byte in the buffer
    std::optional<std::size_t> stride;  ///< stated by the file
  };

  /// `bytes` is a .gltf or a .glb, by its content, and outlives this. Side files lie in `folder` or below.
  /// Throws MeshError, also for an extension that the file requires and that is not read.
  GltfDocument(std::string_view bytes, std::filesystem::path folder);

  JsonValue root() const { return json_.root(); }
  /// Returns the element of the root's array `kind` that the index names.
  JsonValue named_by(const JsonValue& index, const char* kind) const;
  /// Returns the bytes of a buffer view, whose buffer is read when it is first named.
  View view(const JsonValue& index) const;
  bool uses(std::string_view extension) const;

 private:
  struct Chunks {
    std::string_view json;
    std::optional<std::string_view> binary;
  };
  static Chunks chunks_of(std::string_view bytes);
  GltfDocument(const Chunks& chunks, std::filesystem::path folder);
  void check_version() const;
  void check_extensions() const;
  std::string_view buffer(std::size_t number, const JsonValue& buffer) const;
  std::string content_of(const JsonValue& uri) const;

  JsonDocument json_;
  std::optional<std::string_view> binary_;  // the chunk of a .glb
  std::filesystem::path folder_;
  mutable std::map<std::size_t, std::string> buffers_;  // those that were read
};

}  // namespace touchmark::mesh_io
