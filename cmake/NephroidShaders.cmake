# nephroid_shaders(TARGET file.comp ...): compiles GLSL to SPIR-V at build time and embeds it as C++ arrays.
# A shader src/a/b_c.comp is reached as nephroid::shaders::b_c_comp (std::span<const uint32_t>) from "shaders/b_c_comp.h". With
# NEPHROID_SHADER_RELOAD it is a gpu::ReloadableShader.
find_program(GLSLANG_VALIDATOR glslangValidator REQUIRED)
set(NEPHROID_SHADER_COMPILER ${GLSLANG_VALIDATOR} --quiet --target-env vulkan1.3 -g0 -I${PROJECT_SOURCE_DIR}/src)

function(nephroid_shaders target)
  set(generated ${CMAKE_BINARY_DIR}/generated)
  file(MAKE_DIRECTORY ${generated}/shaders)
  foreach(source ${ARGN})
    get_filename_component(path ${source} ABSOLUTE)
    get_filename_component(name ${source} NAME)
    string(REPLACE "." "_" symbol ${name})
    set(words ${generated}/shaders/${symbol}.words)
    set(header ${generated}/shaders/${symbol}.h)
    add_custom_command(
      OUTPUT ${words}
      COMMAND ${NEPHROID_SHADER_COMPILER} -x -o ${words} --depfile ${words}.d ${path}
      DEPENDS ${path}
      DEPFILE ${words}.d
      COMMENT "Shader ${name}"
      VERBATIM)
    # Those of the library, which knows gpu/.
    set(source_define)
    if(NEPHROID_SHADER_RELOAD AND target MATCHES "^nephroid_")
      set(source_define -DSOURCE=${path})
    endif()
    add_custom_command(
      OUTPUT ${header}
      COMMAND ${CMAKE_COMMAND} -DWORDS=${words} -DHEADER=${header} -DSYMBOL=${symbol} ${source_define}
              -P ${PROJECT_SOURCE_DIR}/cmake/embed_shader.cmake
      DEPENDS ${words} ${PROJECT_SOURCE_DIR}/cmake/embed_shader.cmake
      VERBATIM)
    list(APPEND headers ${header})
  endforeach()
  # A custom command is known only in the folder it is written in, a target's dependencies everywhere.
  string(MD5 folder ${CMAKE_CURRENT_SOURCE_DIR})
  add_custom_target(${target}_shaders_${folder} DEPENDS ${headers})
  add_dependencies(${target} ${target}_shaders_${folder})
  target_include_directories(${target} PRIVATE ${generated})
endfunction()
