#include "core/mesh_io/gltf/gltf_accessor.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "core/mesh_io/mesh_builder.h"

namespace touchmark::mesh_io {
namespace {

using ComponentType = GltfAccessor::ComponentType;

/// More zeros than this come from no bytes at all.
constexpr std::size_t max_zeros = std::size_t{1} << 16;

std::size_t components_of(std::string_view type) { return type == "SCALAR" ? 1 : type == "VEC3" ? 3 : 4; }

/// Calls visit() with a number of the type.
template <class Visit>
auto with_type(ComponentType type, const Visit& visit) {
  switch (type) {
    case ComponentType::int8:
      return visit(std::int8_t{});
    case ComponentType::uint8:
      return visit(std::uint8_t{});
    case ComponentType::int16:
      return visit(std::int16_t{});
    case ComponentType::uint16:
      return visit(std::uint16_t{});
    case ComponentType::uint32:
      return visit(std::uint32_t{});
    case ComponentType::float32:
      break;
  }
  return visit(float{});
}

std::size_t size_of(ComponentType type) {
  return with_type(type, [](auto zero) { return sizeof zero; });
}

double largest(ComponentType type) {
  return with_type(type,
                   [](auto zero) { return static_cast<double>(std::numeric_limits<decltype(zero)>::max()); });
}

}  // namespace

GltfAccessor::GltfAccessor(const GltfDocument& document, const JsonValue& index, std::string_view type,
                           Use use)
    : place_(document.named_by(index, "accessors")), count_(place_.at("count").whole()) {
  const std::string stated = place_.at("type").text();
  if (stated != type) fail("has the type " + mesh_io::quoted(stated) + " instead of " + std::string(type));
  if (count_ == 0) fail("has a count of 0");
  const ComponentType component_type = component_type_of(place_);
  if (const std::optional<JsonValue> normalized = place_.find("normalized"))
    normalized_ = normalized->is_true();
  if (normalized_ && (component_type == ComponentType::float32 || component_type == ComponentType::uint32))
    fail("is normalized, which 32-bit numbers cannot be");
  const std::optional<JsonValue> sparse = place_.find("sparse");
  if (place_.find("bufferView")) {
    base_ = numbers_of(document, place_, component_type, components_of(type), count_, use);
  } else if (count_ > max_zeros) {
    fail("has a count of " + std::to_string(count_) + " and no bufferView; " + std::to_string(max_zeros) +
         " zeros are the most");
  }
  base_.type = component_type;
  if (sparse) read_sparse(document, *sparse, components_of(type));
}

ComponentType GltfAccessor::component_type_of(const JsonValue& holder) {
  const JsonValue number = holder.at("componentType");
  const std::size_t value = number.whole();
  if (value < 5120 || value > 5126 || value == 5124)
    number.fail("is " + std::to_string(value) + ", which is no component type");
  return static_cast<ComponentType>(value);
}

GltfAccessor::Numbers GltfAccessor::numbers_of(const GltfDocument& document, const JsonValue& holder,
                                               ComponentType type, std::size_t components, std::size_t count,
                                               Use use) const {
  const GltfDocument::View view = document.view(holder.at("bufferView"));
  const std::size_t offset = holder.whole("byteOffset", 0), element = components * size_of(type);
  const std::size_t stride = view.stride.value_or(element);
  if (stride < element || (use == Use::indices && stride != element))
    holder.fail("its elements have " + std::to_string(element) + " bytes, its view a byteStride of " +
                std::to_string(stride));
  if (offset % size_of(type) != 0 || (view.offset + offset) % size_of(type) != 0)
    holder.fail("starts at byte " + std::to_string(view.offset + offset) +
                " of its buffer, no multiple of the " + std::to_string(size_of(type)) + " bytes of a number");
  if (offset > view.bytes.size() || element > view.bytes.size() - offset ||
      count - 1 > (view.bytes.size() - offset - element) / stride)
    holder.fail(std::to_string(count) + " elements of " + std::to_string(stride) + " bytes from byte " +
                std::to_string(offset) + " on do not fit its view of " + std::to_string(view.bytes.size()));
  return {view.bytes.substr(offset), stride, type};
}

void GltfAccessor::read_sparse(const GltfDocument& document, const JsonValue& sparse,
                               std::size_t components) {
  const std::size_t count = sparse.at("count").whole();
  if (count == 0 || count > count_)
    sparse.fail("replaces " + std::to_string(count) + " of " + std::to_string(count_) + " elements");
  const JsonValue indices = sparse.at("indices");
  const ComponentType type = component_type_of(indices);
  if (type != ComponentType::uint8 && type != ComponentType::uint16 && type != ComponentType::uint32)
    indices.fail("its component type is no unsigned one");
  const Numbers numbers = numbers_of(document, indices, type, 1, count, Use::indices);
  replacements_ = numbers_of(document, sparse.at("values"), base_.type, components, count, Use::indices);
  for (std::size_t i = 0; i < count; ++i) {
    const auto index = static_cast<std::size_t>(numbers.at(i, 0));
    if (index >= count_)
      indices.fail("index " + std::to_string(i) + " names element " + std::to_string(index) + " of " +
                   std::to_string(count_));
    if (!replaced_.empty() && index <= replaced_.back())
      indices.fail("index " + std::to_string(i) + " is " + std::to_string(index) + " after " +
                   std::to_string(replaced_.back()) + "; they must ascend");
    replaced_.push_back(index);
  }
}

double GltfAccessor::Numbers::at(std::size_t element, std::size_t component) const {
  if (bytes.empty()) return 0;
  return with_type(type, [&](auto value) {
    std::memcpy(&value, bytes.data() + element * stride + component * sizeof value, sizeof value);
    return static_cast<double>(value);
  });
}

double GltfAccessor::number(std::size_t element, std::size_t component) const {
  const auto replaced = std::lower_bound(replaced_.begin(), replaced_.end(), element);
  const double value =
      replaced != replaced_.end() && *replaced == element
          ? replacements_.at(static_cast<std::size_t>(replaced - replaced_.begin()), component)
          : base_.at(element, component);
  return normalized_ ? std::max(value / largest(base_.type), -1.0) : value;
}

}  // namespace touchmark::mesh_io
