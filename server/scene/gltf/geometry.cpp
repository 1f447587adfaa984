#include "scene/gltf/geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sundial::gltf {

namespace {

int attribute(const tinygltf::Primitive& primitive, const std::string& name) {
  const auto it = primitive.attributes.find(name);
  return it == primitive.attributes.end() ? -1 : it->second;
}

std::uint64_t cornerCount(const tinygltf::Primitive& primitive, const AccessorReader& reader) {
  const int position = attribute(primitive, "POSITION");
  if (position < 0) return 0;  // glTF: not to be drawn
  return reader.count(primitive.indices >= 0 ? primitive.indices : position);
}

// Strips and fans become lists; corner order as glTF 2.0 section 3.7.2.1 gives it.
std::vector<std::uint32_t> toList(std::vector<std::uint32_t> corners, int mode) {
  if (mode == TINYGLTF_MODE_TRIANGLES) {
    corners.resize(corners.size() / 3 * 3);
    return corners;
  }
  std::vector<std::uint32_t> list;
  const std::size_t triangles = corners.size() < 3 ? 0 : corners.size() - 2;
  list.reserve(3 * triangles);
  for (std::size_t i = 0; i < triangles; ++i) {
    if (mode == TINYGLTF_MODE_TRIANGLE_STRIP)
      list.insert(list.end(), {corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]});
    else
      list.insert(list.end(), {corners[i + 1], corners[i + 2], corners[0]});
  }
  return list;
}

template <class Vector>
std::vector<Vector> grouped(const std::vector<float>& values) {
  constexpr auto kSize = static_cast<std::size_t>(Vector::length());
  std::vector<Vector> result(values.size() / kSize);
  for (std::size_t i = 0; i < result.size(); ++i)
    for (std::size_t c = 0; c < kSize; ++c) result[i][static_cast<int>(c)] = values[i * kSize + c];
  return result;
}

std::uint32_t packColour(const float* rgba, unsigned components) {
  std::uint32_t packed = 0;
  for (unsigned c = 0; c < 4; ++c) {
    const float value = c < components ? rgba[c] : 1.0f;
    // NaN fails the comparison and becomes 0.
    const float clamped = value > 0 ? std::min(value, 1.0f) : 0.0f;
    packed |= static_cast<std::uint32_t>(std::lround(clamped * 255)) << (8 * c);
  }
  return packed;
}

}  // namespace

std::uint64_t triangleCount(const tinygltf::Primitive& primitive, const AccessorReader& reader) {
  const std::uint64_t corners = cornerCount(primitive, reader);
  switch (primitive.mode) {
    case TINYGLTF_MODE_TRIANGLES:
      return corners / 3;
    case TINYGLTF_MODE_TRIANGLE_STRIP:
    case TINYGLTF_MODE_TRIANGLE_FAN:
      return corners < 3 ? 0 : corners - 2;
    default:
      return 0;
  }
}

Result<Primitive> readPrimitive(const tinygltf::Primitive& from, const TexCoordUse& texCoord,
                                AccessorReader& reader) {
  if (from.mode > TINYGLTF_MODE_TRIANGLE_FAN)
    return invalid(fmt::format("mode {} is not one of glTF's 0 to 6: export the file again", from.mode));
  Primitive primitive;
  if (triangleCount(from, reader) == 0) return primitive;

  const int position = attribute(from, "POSITION");
  const std::uint64_t vertexCount = reader.count(position);
  if (vertexCount > std::numeric_limits<std::uint32_t>::max() - 1)
    return invalid(fmt::format("{} vertices are more than glTF's indices can name", vertexCount));
  std::vector<std::uint32_t> corners;
  if (from.indices >= 0) {
    Result<std::vector<std::uint32_t>> read = reader.indices(from.indices);
    if (!read) return std::unexpected(read.error());
    corners = std::move(*read);
    const auto outside = std::ranges::find_if(corners, [&](std::uint32_t i) { return i >= vertexCount; });
    if (outside != corners.end())
      return invalid(
          fmt::format("index {} is {}, but there are {} vertices: the file is damaged or was "
                      "exported wrongly",
                      outside - corners.begin(), *outside, vertexCount));
  } else {
    // Ask for the positions before believing in their count.
    const Result<std::vector<float>> positions = reader.floats(position, 3, std::nullopt);
    if (!positions) return std::unexpected(positions.error());
    corners.resize(vertexCount);
    std::iota(corners.begin(), corners.end(), 0u);
  }

  // Many primitives may share one large accessor: read no more of it than this one uses.
  std::optional<std::vector<std::uint32_t>> used;
  if (vertexCount > corners.size()) {
    used = corners;
    std::ranges::sort(*used);
    used->erase(std::ranges::unique(*used).begin(), used->end());
    for (std::uint32_t& corner : corners)
      corner = static_cast<std::uint32_t>(std::ranges::lower_bound(*used, corner) - used->begin());
  }
  const auto read = [&](int accessor, unsigned components) -> Result<std::vector<float>> {
    if (reader.count(accessor) != vertexCount)
      return invalid(fmt::format("accessors[{}] has {} elements for {} positions: export the file again",
                                 accessor, reader.count(accessor), vertexCount));
    if (used) return reader.floats(accessor, components, *used);
    return reader.floats(accessor, components, std::nullopt);
  };

  const Result<std::vector<float>> positions = read(position, 3);
  if (!positions) return std::unexpected(positions.error());
  primitive.positions = grouped<glm::vec3>(*positions);

  if (const int uv = attribute(from, fmt::format("TEXCOORD_{}", texCoord.set)); uv >= 0) {
    const Result<std::vector<float>> uvs = read(uv, 2);
    if (!uvs) return std::unexpected(uvs.error());
    primitive.uvs = grouped<glm::vec2>(*uvs);
    if (texCoord.uvFromTexCoord != glm::mat3(1))
      for (glm::vec2& v : primitive.uvs) v = glm::vec2(texCoord.uvFromTexCoord * glm::vec3(v, 1));
  }

  if (const int colour = attribute(from, "COLOR_0"); colour >= 0) {
    const unsigned components = reader.components(colour) == 3 ? 3 : 4;
    const Result<std::vector<float>> colours = read(colour, components);
    if (!colours) return std::unexpected(colours.error());
    primitive.colours.resize(colours->size() / components);
    for (std::size_t i = 0; i < primitive.colours.size(); ++i)
      primitive.colours[i] = packColour(&(*colours)[i * components], components);
  }

  primitive.indices = toList(std::move(corners), from.mode);
  return primitive;
}

}  // namespace sundial::gltf
