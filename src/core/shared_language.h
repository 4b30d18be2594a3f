// Macros for files that are both C++ and GLSL. Shared structs and functions are written between SHARED_BEGIN
// and SHARED_END; functions are marked SHARED_FUNCTION, and output parameters OUT(type) or INOUT(type).
// Structs have GLSL's layout `scalar`.
#ifndef NEPHROID_CORE_SHARED_LANGUAGE_H
#define NEPHROID_CORE_SHARED_LANGUAGE_H

#ifdef __cplusplus

#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace nephroid {
using glm::abs;
using glm::acos;
using glm::asin;
using glm::atan;
using glm::ceil;
using glm::clamp;
using glm::cross;
using glm::degrees;
using glm::dot;
using glm::exp;
using glm::floor;
using glm::ivec2;
using glm::ivec3;
using glm::length;
using glm::lessThanEqual;
using glm::log2;
using glm::mat3;
using glm::mat4;
using glm::max;
using glm::min;
using glm::mix;
using glm::normalize;
using glm::pow;
using glm::quat;
using glm::sqrt;
using glm::uvec2;
using glm::uvec3;
using glm::uvec4;
using glm::vec2;
using glm::vec3;
using glm::vec4;
using uint = std::uint32_t;
}  // namespace nephroid

#define SHARED_BEGIN namespace nephroid {
#define SHARED_END }
#define SHARED_FUNCTION inline
#define SHARED_CONSTANT inline constexpr
#define OUT(type) type&
#define INOUT(type) type&

#else

#define SHARED_BEGIN
#define SHARED_END
#define SHARED_FUNCTION
#define SHARED_CONSTANT const
#define OUT(type) out type
#define INOUT(type) inout type

#endif

#endif
