// Which hits of a shadow ray count: not those on the receiver itself, nor in holes of alpha-tested materials.
// Embree calls it for every triangle that it finds on a ray's way and goes on searching where it says no.
#pragma once

#include <embree3/rtcore.h>

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "reference/alpha.h"
#include "scene/scene.h"

namespace sundial {

inline constexpr unsigned kPacketSize = 16;

// Embree's context of one packet, extended by what its rays start from. A ray's id is its place in the
// packet.
struct PacketContext {
  struct Receiver {
    std::uint32_t instance, triangle;  // of the scene
    float rise;                        // metres above the receiver's plane for each unit of the ray's length
  };

  RTCIntersectContext embree;  // first, so that Embree's pointer to it is a pointer to the whole
  std::array<Receiver, kPacketSize> receivers;
};

class HitFilter {
 public:
  // `centreFromMesh`: per instance, relative to the centre of the scene's bounds, metres. Both must outlive
  // it.
  HitFilter(const Scene&, std::span<const glm::mat4x3> centreFromMesh);
  HitFilter(const HitFilter&) = delete;
  HitFilter& operator=(const HitFilter&) = delete;

  // Makes the filter that of a mesh's geometry. The filter must outlive the geometry.
  void attachTo(RTCGeometry, std::uint32_t mesh);

 private:
  struct MeshFilter {
    const HitFilter* filter;
    std::uint32_t firstTriangle;
    bool masked;
  };
  static void reject(const RTCFilterFunctionNArguments*);
  bool isReceiver(const PacketContext::Receiver&, std::uint32_t instance, std::uint32_t triangle,
                  float distance) const;
  std::array<glm::vec3, 3> corners(std::uint32_t instance, std::uint32_t triangle) const;

  const Scene& scene_;
  AlphaTest alpha_;
  std::span<const glm::mat4x3> centreFromMesh_;
  std::vector<MeshFilter> meshes_;
  float coplanarHeight_;      // metres
  float coincidentDistance_;  // metres
};

}  // namespace sundial
