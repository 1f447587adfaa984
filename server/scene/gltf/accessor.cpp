#include "scene/gltf/accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <type_traits>

namespace sundial::gltf {

namespace {

constexpr std::uint64_t kMaxStride = 256;  // glTF says 252, meshopt's extension 256

// Elements in a row of bytes, of `components` numbers of one type.
struct Elements {
  Bytes bytes;
  std::uint64_t stride = 0, count = 0;
  unsigned components = 0;
  int componentType = 0;
  bool normalized = false;
};

unsigned componentBytes(int componentType) {
  switch (componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      return 0;
  }
}

Result<Elements> elements(Bytes view, std::uint64_t offset, std::uint64_t stride, std::uint64_t count,
                          unsigned components, int componentType, bool normalized) {
  const std::uint64_t element = std::uint64_t{components} * componentBytes(componentType);
  if (element == 0)
    return invalid(
        fmt::format("component type {} is not one of glTF's: export the file again", componentType));
  if (stride == 0) stride = element;
  if (stride < element || stride > kMaxStride)
    return invalid(fmt::format("byteStride is {}, but must be {} to {}: export the file again", stride,
                               element, kMaxStride));
  if (count == 0) return Elements{{}, stride, 0, components, componentType, normalized};
  if (offset > view.size() || element > view.size() - offset ||
      count - 1 > (view.size() - offset - element) / stride)
    return invalid(fmt::format(
        "{} elements, {} bytes apart, from byte {}, do not fit into a buffer view of {} bytes: the "
        "file is damaged or was exported wrongly",
        count, stride, offset, view.size()));
  return Elements{view.subspan(offset), stride, count, components, componentType, normalized};
}

// Integers stay what they are; as floats they may be normalised, as KHR_mesh_quantization spells it.
template <class T, class Component>
T convert(Component value, bool normalized) {
  if constexpr (std::is_same_v<T, float> && std::is_integral_v<Component>) {
    if (!normalized) return static_cast<float>(value);
    const float unit = static_cast<float>(value) / static_cast<float>(std::numeric_limits<Component>::max());
    return std::max(unit, -1.0f);
  } else {
    return static_cast<T>(value);
  }
}

template <class T, class Component>
void copyAs(const Elements& from, std::optional<std::span<const std::uint32_t>> which, T* to) {
  const std::uint64_t count = which ? which->size() : from.count;
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::byte* element = from.bytes.data() + (which ? (*which)[i] : i) * from.stride;
    for (unsigned c = 0; c < from.components; ++c) {
      Component value;
      std::memcpy(&value, element + c * sizeof(Component), sizeof(Component));
      *to++ = convert<T>(value, from.normalized);
    }
  }
}

template <class T>
void copy(const Elements& from, std::optional<std::span<const std::uint32_t>> which, T* to) {
  switch (from.componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return copyAs<T, std::int8_t>(from, which, to);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return copyAs<T, std::uint8_t>(from, which, to);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return copyAs<T, std::int16_t>(from, which, to);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return copyAs<T, std::uint16_t>(from, which, to);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return copyAs<T, std::uint32_t>(from, which, to);
    default:
      return copyAs<T, float>(from, which, to);
  }
}

bool isUnsignedInteger(int componentType) {
  return componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
         componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
         componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

std::unexpected<Error> at(int accessor, const Error& error) {
  return fail(error.code, fmt::format("accessors[{}]: {}", accessor, error.message));
}

}  // namespace

AccessorReader::AccessorReader(const Document& document, BufferData& data, Budget& budget)
    : document_(document), data_(data), budget_(budget) {}

std::uint64_t AccessorReader::count(int accessor) const {
  return document_.model.accessors[static_cast<std::size_t>(accessor)].count;
}

unsigned AccessorReader::components(int accessor) const {
  return static_cast<unsigned>(tinygltf::GetNumComponentsInType(
      static_cast<std::uint32_t>(document_.model.accessors[static_cast<std::size_t>(accessor)].type)));
}

// The accessor's own elements, zero where it has no buffer view, then its sparse replacements.
template <class T>
Result<std::vector<T>> AccessorReader::all(int index) {
  const tinygltf::Accessor& accessor = document_.model.accessors[static_cast<std::size_t>(index)];
  const unsigned size = components(index);
  std::vector<T> values;
  const auto base = [&]() -> Result<Elements> {
    const auto view = static_cast<std::size_t>(accessor.bufferView);
    const Result<Bytes> bytes = data_.bufferView(view);
    if (!bytes) return std::unexpected(bytes.error());
    return elements(*bytes, accessor.byteOffset, document_.bufferViews[view].byteStride, accessor.count, size,
                    accessor.componentType, accessor.normalized);
  };
  Result<Elements> from;
  if (accessor.bufferView >= 0) {
    from = base();
    if (!from) return at(index, from.error());
  }
  if (auto ok = budget_.spend(accessor.count, size * sizeof(T)); !ok) return at(index, ok.error());
  values.resize(accessor.count * size);
  if (accessor.bufferView >= 0) copy(*from, std::nullopt, values.data());
  if (!accessor.sparse.isSparse) return values;

  const auto& sparse = accessor.sparse;
  const auto overlay = [&](int view, int offset, unsigned width, int type) -> Result<Elements> {
    const Result<Bytes> bytes = data_.bufferView(static_cast<std::size_t>(view));
    if (!bytes) return std::unexpected(bytes.error());
    return elements(*bytes, static_cast<std::uint64_t>(offset), 0, static_cast<std::uint64_t>(sparse.count),
                    width, type, accessor.normalized);
  };
  if (!isUnsignedInteger(sparse.indices.componentType))
    return at(index,
              Error{ErrorCode::invalidArgument,
                    fmt::format("sparse indices of component type {} are not unsigned integers: export "
                                "the file again",
                                sparse.indices.componentType)});
  const Result<Elements> where =
      overlay(sparse.indices.bufferView, sparse.indices.byteOffset, 1, sparse.indices.componentType);
  if (!where) return at(index, where.error());
  const Result<Elements> what =
      overlay(sparse.values.bufferView, sparse.values.byteOffset, size, accessor.componentType);
  if (!what) return at(index, what.error());
  std::vector<std::uint32_t> positions(where->count);
  copy(*where, std::nullopt, positions.data());
  std::vector<T> replacements(what->count * size);
  copy(*what, std::nullopt, replacements.data());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (positions[i] >= accessor.count)
      return at(index, Error{ErrorCode::invalidArgument,
                             fmt::format("sparse index {} is {}, but there are {} elements: the file is "
                                         "damaged or was exported wrongly",
                                         i, positions[i], accessor.count)});
    std::copy_n(replacements.begin() + static_cast<std::ptrdiff_t>(i * size), size,
                values.begin() + static_cast<std::ptrdiff_t>(std::size_t{positions[i]} * size));
  }
  return values;
}

Result<std::vector<std::uint32_t>> AccessorReader::indices(int index) {
  const tinygltf::Accessor& accessor = document_.model.accessors[static_cast<std::size_t>(index)];
  if (components(index) != 1 || !isUnsignedInteger(accessor.componentType))
    return at(index, Error{ErrorCode::invalidArgument,
                           fmt::format("indices must be unsigned scalars, not component type {}: export the "
                                       "file again",
                                       accessor.componentType)});
  return all<std::uint32_t>(index);
}

Result<std::vector<float>> AccessorReader::floats(int index, unsigned size,
                                                  std::optional<std::span<const std::uint32_t>> which) {
  const tinygltf::Accessor& accessor = document_.model.accessors[static_cast<std::size_t>(index)];
  if (components(index) != size)
    return at(index, Error{ErrorCode::invalidArgument,
                           fmt::format("has {} components an element where {} are needed: export the file "
                                       "again",
                                       components(index), size)});
  if (!which) return all<float>(index);
  if (accessor.sparse.isSparse || accessor.bufferView < 0) {
    const Result<std::vector<float>> values = all<float>(index);
    if (!values) return values;
    std::vector<float> picked;
    picked.reserve(which->size() * size);
    for (const std::uint32_t i : *which)
      for (unsigned c = 0; c < size; ++c) picked.push_back((*values)[std::size_t{i} * size + c]);
    return picked;
  }
  const auto view = static_cast<std::size_t>(accessor.bufferView);
  const Result<Bytes> bytes = data_.bufferView(view);
  if (!bytes) return at(index, bytes.error());
  const Result<Elements> from = elements(*bytes, accessor.byteOffset, document_.bufferViews[view].byteStride,
                                         accessor.count, size, accessor.componentType, accessor.normalized);
  if (!from) return at(index, from.error());
  if (auto ok = budget_.spend(which->size(), size * sizeof(float)); !ok) return at(index, ok.error());
  std::vector<float> picked(which->size() * size);
  copy(*from, which, picked.data());
  return picked;
}

}  // namespace sundial::gltf
