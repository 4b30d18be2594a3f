add_custom_target(rooms)  # links each alone

# nephroid_room(NAME KNOWS room ... SOURCES file ... SHADERS file ... TEXTS header file ... LIBRARIES library ... SYSTEM_INCLUDES folder ...)
#
# A folder of src/ as a target, nephroid_NAME, which may use the rooms that it KNOWS and those that they know. Its objects are part
# of the library nephroid, which is linked with its LIBRARIES. A room without SOURCES is of headers alone.
#
# With NEPHROID_CHECK_ROOMS each room is linked by itself too, with the rooms that it knows and nothing else, so that the linker
# refuses a room that uses another.
function(nephroid_room name)
  cmake_parse_arguments(room "" "" "KNOWS;SOURCES;SHADERS;TEXTS;LIBRARIES;SYSTEM_INCLUDES" ${ARGN})
  list(TRANSFORM room_KNOWS PREPEND nephroid_ OUTPUT_VARIABLE known)
  if(NOT room_SOURCES)
    add_library(nephroid_${name} INTERFACE)
    target_link_libraries(nephroid_${name} INTERFACE ${known})
    return()
  endif()
  add_library(nephroid_${name} OBJECT)
  target_include_directories(nephroid_${name} PUBLIC ${PROJECT_SOURCE_DIR}/src)
  target_compile_features(nephroid_${name} PUBLIC cxx_std_20)
  target_link_libraries(nephroid_${name} PUBLIC ${known} glm::glm TBB::tbb Threads::Threads)
  nephroid_compile_options(nephroid_${name})
  if(room_TEXTS)
    nephroid_texts(nephroid_${name} ${room_TEXTS})
  endif()
  target_sources(nephroid PRIVATE $<TARGET_OBJECTS:nephroid_${name}>)
  if(NEPHROID_CHECK_ROOMS)
    add_library(nephroid_${name}_alone SHARED $<TARGET_OBJECTS:nephroid_${name}>)
    add_dependencies(rooms nephroid_${name}_alone)
    set_target_properties(nephroid_${name}_alone PROPERTIES LINKER_LANGUAGE CXX
                          LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/rooms)
    target_link_options(nephroid_${name}_alone PRIVATE -Wl,-z,defs)
    list(TRANSFORM known APPEND _alone)
    foreach(other ${known})
      if(TARGET ${other})
        target_link_libraries(nephroid_${name}_alone PUBLIC ${other})
      endif()
    endforeach()
    target_link_libraries(nephroid_${name}_alone PRIVATE glm::glm TBB::tbb Threads::Threads)
  endif()
  nephroid_room_sources(${name} SOURCES ${room_SOURCES} SHADERS ${room_SHADERS} LIBRARIES ${room_LIBRARIES} SYSTEM_INCLUDES ${room_SYSTEM_INCLUDES})
endfunction()

# Adds to a room: from a folder within it, or where a part of it depends on what is installed.
function(nephroid_room_sources name)
  cmake_parse_arguments(room "" "" "SOURCES;SHADERS;LIBRARIES;SYSTEM_INCLUDES" ${ARGN})
  if(room_SHADERS)
    nephroid_shaders(nephroid_${name} ${room_SHADERS})
  endif()
  target_sources(nephroid_${name} PRIVATE ${room_SOURCES})
  target_include_directories(nephroid_${name} SYSTEM PUBLIC ${room_SYSTEM_INCLUDES})
  foreach(target nephroid_${name} nephroid nephroid_${name}_alone)
    if(TARGET ${target})
      target_link_libraries(${target} PRIVATE ${room_LIBRARIES})
    endif()
  endforeach()
endfunction()
