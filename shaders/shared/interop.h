// What lets one header serve C++ and GLSL: the vector types, under GLSL's names, in scalar block layout
// (which is C++'s own for these types). Included first by every header in this folder.
#ifndef SUNDIAL_SHARED_INTEROP_H
#define SUNDIAL_SHARED_INTEROP_H

#ifdef __cplusplus
#include <cstdint>
#include <glm/glm.hpp>
namespace sundial::shared {
using glm::mat4;
using glm::uvec2;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;
using uint = std::uint32_t;
// What functions that both languages compile call.
using glm::abs;
using glm::atan;
using glm::clamp;
using glm::dot;
using glm::exp;
using glm::floor;
using glm::log;
using glm::max;
using glm::min;
using glm::pow;
using glm::sign;
using glm::sqrt;
using glm::tan;
}  // namespace sundial::shared
#define SUNDIAL_SHARED_BEGIN namespace sundial::shared {
#define SUNDIAL_SHARED_END }
#define SUNDIAL_CONST inline constexpr uint
#define SUNDIAL_CONST_FLOAT inline constexpr float
#define SUNDIAL_FUNCTION inline
#else
#extension GL_EXT_scalar_block_layout : require

#define SUNDIAL_SHARED_BEGIN
#define SUNDIAL_SHARED_END
#define SUNDIAL_CONST const uint
#define SUNDIAL_CONST_FLOAT const float
#define SUNDIAL_FUNCTION
#endif

#endif
