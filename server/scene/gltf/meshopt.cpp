#include "scene/gltf/meshopt.h"

#include <fmt/format.h>
#include <meshoptimizer.h>

#include "scene/quoted_name.h"

namespace sundial::gltf {

namespace {

// The vertex codec's best case: 16 vertices' zero deltas in two bits. An index takes no less than a byte a
// triangle. A count beyond that is a lie, found before memory is spent on it.
constexpr std::uint64_t kMaxRatio = 64;
constexpr std::uint64_t kRatioSlack = 1 << 16;

Result<void> checkParameters(const MeshoptView& view) {
  const auto refuse = [&](std::string_view why) {
    return invalid(fmt::format("EXT_meshopt_compression with mode {}, filter {}, stride {} and count {}: {}",
                               quotedName(view.mode), quotedName(view.filter), view.byteStride, view.count,
                               why));
  };
  const bool attributes = view.mode == "ATTRIBUTES";
  if (!attributes && view.mode != "TRIANGLES" && view.mode != "INDICES")
    return refuse("the mode must be ATTRIBUTES, TRIANGLES or INDICES");
  if (attributes && (view.byteStride == 0 || view.byteStride > 256 || view.byteStride % 4 != 0))
    return refuse("the stride of ATTRIBUTES must be a multiple of 4, at most 256");
  if (!attributes && view.byteStride != 2 && view.byteStride != 4)
    return refuse("the stride of indices must be 2 or 4");
  if (view.mode == "TRIANGLES" && view.count % 3 != 0)
    return refuse("the count of TRIANGLES must be a multiple of 3");
  if (view.filter == "NONE") return {};
  if (!attributes) return refuse("only ATTRIBUTES can be filtered");
  if (view.filter == "OCTAHEDRAL")
    return view.byteStride == 4 || view.byteStride == 8 ? Result<void>{}
                                                        : refuse("the stride must be 4 or 8");
  if (view.filter == "QUATERNION")
    return view.byteStride == 8 ? Result<void>{} : refuse("the stride must be 8");
  if (view.filter == "EXPONENTIAL") return {};
  return refuse("the filter must be NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL");
}

}  // namespace

Result<std::vector<std::byte>> decodeMeshopt(const MeshoptView& view, Bytes compressed, Budget& budget) {
  if (auto ok = checkParameters(view); !ok) return std::unexpected(ok.error());
  if (auto ok = budget.spend(view.count, view.byteStride); !ok) return std::unexpected(ok.error());
  const std::uint64_t size = view.count * view.byteStride;
  const auto damaged = [&] {
    return fail(ErrorCode::dataLoss,
                fmt::format("{} bytes do not decode to {} elements of {} bytes: the file is damaged, or its "
                            "encoding is newer than meshoptimizer {}.{}; copy or export it again",
                            compressed.size(), view.count, view.byteStride, MESHOPTIMIZER_VERSION / 1000,
                            MESHOPTIMIZER_VERSION / 10 % 100));
  };
  if (size > compressed.size() * kMaxRatio + kRatioSlack) return damaged();

  std::vector<std::byte> bytes(size);
  if (view.count == 0) return bytes;
  const auto* from = reinterpret_cast<const unsigned char*>(compressed.data());
  int status = 0;
  if (view.mode == "ATTRIBUTES")
    status = meshopt_decodeVertexBuffer(bytes.data(), view.count, view.byteStride, from, compressed.size());
  else if (view.mode == "TRIANGLES")
    status = meshopt_decodeIndexBuffer(bytes.data(), view.count, view.byteStride, from, compressed.size());
  else
    status = meshopt_decodeIndexSequence(bytes.data(), view.count, view.byteStride, from, compressed.size());
  if (status != 0) return damaged();

  if (view.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(bytes.data(), view.count, view.byteStride);
  if (view.filter == "QUATERNION") meshopt_decodeFilterQuat(bytes.data(), view.count, view.byteStride);
  if (view.filter == "EXPONENTIAL") meshopt_decodeFilterExp(bytes.data(), view.count, view.byteStride);
  return bytes;
}

}  // namespace sundial::gltf
