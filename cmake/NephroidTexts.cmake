# nephroid_texts(TARGET HEADER.h file ...): embeds text files as C++ strings. page.css is nephroid::page_css in "HEADER.h".
function(nephroid_texts target header)
  set(generated ${CMAKE_BINARY_DIR}/generated/${header})
  foreach(source ${ARGN})
    get_filename_component(path ${source} ABSOLUTE)
    list(APPEND paths ${path})
  endforeach()
  add_custom_command(
    OUTPUT ${generated}
    COMMAND ${CMAKE_COMMAND} "-DTEXTS=${paths}" -DHEADER=${generated} -P ${PROJECT_SOURCE_DIR}/cmake/embed_texts.cmake
    DEPENDS ${paths} ${PROJECT_SOURCE_DIR}/cmake/embed_texts.cmake
    VERBATIM)
  # A custom command is known only in the folder it is written in, a target's dependencies everywhere.
  add_custom_target(${target}_${header} DEPENDS ${generated})
  add_dependencies(${target} ${target}_${header})
  target_include_directories(${target} PRIVATE ${CMAKE_BINARY_DIR}/generated)
endfunction()
