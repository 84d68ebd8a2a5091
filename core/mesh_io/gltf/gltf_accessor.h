/// Numbers in a glTF file's buffers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh_io/gltf/gltf_document.h"

namespace touchmark::mesh_io {

/// Elements of an accessor, checked against the bytes that hold them. Valid as long as its document is.
class GltfAccessor {
 public:
  enum class ComponentType { int8 = 5120, uint8, int16, uint16, uint32 = 5125, float32 };
  enum class Use { indices, attribute };

  /// `index` names the accessor; `type` is SCALAR, VEC3 or VEC4. Throws MeshError.
  GltfAccessor(const GltfDocument& document, const JsonValue& index, std::string_view type, Use use);

  std::size_t count() const noexcept { return count_; }
  ComponentType component_type() const noexcept { return base_.type; }
  bool is_normalized() const noexcept { return normalized_; }
  /// Returns a number as the file has it, or where it is normalized from -1 to 1.
  double number(std::size_t element, std::size_t component) const;

  /// Throws MeshError("PLACE: message").
  [[noreturn]] void fail(const std::string& message) const { place_.fail(message); }

 private:
  /// Numbers at equal distances.
  struct Numbers {
    std::string_view bytes;  // empty: zeros
    std::size_t stride = 0;
    ComponentType type = ComponentType::float32;
    double at(std::size_t element, std::size_t component) const;
  };
  static ComponentType component_type_of(const JsonValue& holder);
  Numbers numbers_of(const GltfDocument& document, const JsonValue& holder, ComponentType type,
                     std::size_t components, std::size_t count, Use use) const;
  void read_sparse(const GltfDocument& document, const JsonValue& sparse, std::size_t components);

  JsonValue place_;
  std::size_t count_;
  bool normalized_ = false;
  Numbers base_;
  Numbers replacements_;
  std::vector<std::size_t> replaced_;  // ascending
};

}  // namespace touchmark::mesh_io
