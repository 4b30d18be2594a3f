file(READ ${WORDS} words)
file(WRITE ${HEADER} "#pragma once
#include <cstdint>
#include <span>
namespace nephroid::shaders {
inline constexpr std::uint32_t ${SYMBOL}_words[] = {
${words}};
inline constexpr std::span<const std::uint32_t> ${SYMBOL}{${SYMBOL}_words};
}  // namespace nephroid::shaders
")
