file(READ ${WORDS} words)
if(SOURCE)
  set(include "#include \"gpu/reloadable_shader.h\"")
  set(shader "inline gpu::ReloadableShader ${SYMBOL}{\"${SOURCE}\", ${SYMBOL}_words};")
else()
  set(include "#include <span>")
  set(shader "inline constexpr std::span<const std::uint32_t> ${SYMBOL}{${SYMBOL}_words};")
endif()
file(WRITE ${HEADER} "#pragma once
#include <cstdint>
${include}
namespace nephroid::shaders {
inline constexpr std::uint32_t ${SYMBOL}_words[] = {
${words}};
${shader}
}  // namespace nephroid::shaders
")
