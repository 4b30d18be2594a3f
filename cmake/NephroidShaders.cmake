# nephroid_shaders(TARGET file.comp ...): compiles GLSL to SPIR-V at build time and embeds it as C++ arrays.
# A shader src/a/b_c.comp is reached as nephroid::shaders::a_b_c_comp (std::span<const uint32_t>) from "shaders/a/b_c_comp.h"; one
# outside src/ has the whole of its path. With NEPHROID_SHADER_RELOAD it is a gpu::ReloadableShader.
#
# Shaders give their images names and no numbers: the compiler numbers them, and gpu::Program renumbers them for all its stages.
# Names of images and constants stay in the SPIR-V, since programs are fed by them.
find_program(GLSLANG_VALIDATOR glslangValidator REQUIRED)
set(NEPHROID_SHADER_COMPILER ${GLSLANG_VALIDATOR} --quiet --target-env vulkan1.3 --auto-map-bindings
                             -I${PROJECT_SOURCE_DIR}/src)

function(nephroid_shaders target)
  set(generated ${CMAKE_BINARY_DIR}/generated)
  foreach(source ${ARGN})
    get_filename_component(path ${source} ABSOLUTE)
    file(RELATIVE_PATH name ${PROJECT_SOURCE_DIR} ${path})
    string(REGEX REPLACE "^src/" "" name ${name})
    string(REPLACE "." "_" place ${name})
    string(REPLACE "/" "_" symbol ${place})
    set(words ${generated}/shaders/${place}.words)
    set(header ${generated}/shaders/${place}.h)
    get_filename_component(folder ${words} DIRECTORY)
    file(MAKE_DIRECTORY ${folder})
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
  string(MD5 here ${CMAKE_CURRENT_SOURCE_DIR})
  add_custom_target(${target}_shaders_${here} DEPENDS ${headers})
  add_dependencies(${target} ${target}_shaders_${here})
  target_include_directories(${target} PRIVATE ${generated})
endfunction()
