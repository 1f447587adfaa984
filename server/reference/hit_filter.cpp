#include "reference/hit_filter.h"

#include <algorithm>

namespace sundial {

namespace {
// Shares of the scene's diagonal. Single precision places a corner to some 1e-7 of it and a view sample on
// its plane to some 1e-6: the first leaves ten times that, the second a hundred times.
constexpr double kCoincidentDistance = 1e-6;
constexpr double kCoplanarHeight = 1e-4;
}  // namespace

HitFilter::HitFilter(const Scene& scene, std::span<const glm::mat4x3> centreFromMesh)
    : scene_(scene),
      alpha_(scene),
      centreFromMesh_(centreFromMesh),
      coplanarHeight_(static_cast<float>(kCoplanarHeight * scene.bounds.diagonal())),
      coincidentDistance_(static_cast<float>(kCoincidentDistance * scene.bounds.diagonal())) {
  meshes_.reserve(scene.meshes.size());
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m)
    meshes_.push_back({this, scene.meshes[m].firstTriangle, alpha_.meshIsMasked(m)});
}

void HitFilter::attachTo(RTCGeometry geometry, std::uint32_t mesh) {
  rtcSetGeometryUserData(geometry, &meshes_[mesh]);
  rtcSetGeometryOccludedFilterFunction(geometry, &HitFilter::reject);
}

void HitFilter::reject(const RTCFilterFunctionNArguments* arguments) {
  const auto& mesh = *static_cast<const MeshFilter*>(arguments->geometryUserPtr);
  const auto& packet = *reinterpret_cast<const PacketContext*>(arguments->context);
  const unsigned n = arguments->N;
  for (unsigned i = 0; i < n; ++i) {
    if (!arguments->valid[i]) continue;
    const auto& receiver = packet.receivers[RTCRayN_id(arguments->ray, n, i)];
    const std::uint32_t instance = RTCHitN_instID(arguments->hit, n, i, 0);
    const std::uint32_t triangle = mesh.firstTriangle + RTCHitN_primID(arguments->hit, n, i);
    if (mesh.filter->isReceiver(receiver, instance, triangle, RTCRayN_tfar(arguments->ray, n, i)) ||
        (mesh.masked && mesh.filter->alpha_.isHole(triangle, RTCHitN_u(arguments->hit, n, i),
                                                   RTCHitN_v(arguments->hit, n, i))))
      arguments->valid[i] = 0;
  }
}

// Whether a hit is on the receiver's own triangle or on one coincident with it: one with the same three
// corners, in any order, in the same instance (a sheet modelled with two faces) or in another (a mesh placed
// twice). Corners are compared in the common space, with a tolerance for what different transforms round
// differently. That would be slow for every hit, but a coincident triangle shares the receiver's plane, and
// the ray leaves that plane where it starts: only hits at no height above it need the comparison, and those
// are few.
bool HitFilter::isReceiver(const PacketContext::Receiver& receiver, std::uint32_t instance,
                           std::uint32_t triangle, float distance) const {
  if (instance == receiver.instance && triangle == receiver.triangle) return true;
  if (distance * receiver.rise > coplanarHeight_) return false;
  if (receiver.instance >= scene_.instances.size() || receiver.triangle >= scene_.indices.size() / 3)
    return false;

  const auto mine = corners(receiver.instance, receiver.triangle);
  const auto other = corners(instance, triangle);
  const auto eachIsIn = [this](const auto& from, const auto& to) {
    return std::ranges::all_of(from, [&](const glm::vec3& a) {
      return std::ranges::any_of(
          to, [&](const glm::vec3& b) { return glm::distance(a, b) <= coincidentDistance_; });
    });
  };
  return eachIsIn(mine, other) && eachIsIn(other, mine);
}

std::array<glm::vec3, 3> HitFilter::corners(std::uint32_t instance, std::uint32_t triangle) const {
  std::array<glm::vec3, 3> result;
  for (std::size_t i = 0; i < 3; ++i) {
    const shared::Vertex& vertex = scene_.vertices[scene_.indices[std::size_t{3} * triangle + i]];
    result[i] = centreFromMesh_[instance] * glm::vec4(vertex.position, 1);
  }
  return result;
}

}  // namespace sundial
