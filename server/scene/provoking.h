// Gives each triangle a vertex of its own, to carry the triangle's index (shared/scene.h).
#pragma once

#include <cstdint>
#include <vector>

namespace sundial {

// Rotates each triangle of `indices` (three a triangle, each < vertexCount, distinct within a triangle;
// winding is kept) so that no two triangles begin with the same vertex. Where a triangle finds none of its
// vertices free, its first one is duplicated: the result lists, for each vertex from `vertexCount` on, which
// vertex it duplicates.
std::vector<std::uint32_t> assignProvokingVertices(std::vector<std::uint32_t>& indices,
                                                   std::uint32_t vertexCount);

}  // namespace sundial
