# The library, its headers, the program with its scenes, and what find_package(nephroid) reads. Shaders are inside the library.
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/nephroid)
install(TARGETS nephroid EXPORT nephroidTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/nephroid
        FILES_MATCHING PATTERN *.h)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/nephroid)
install(EXPORT nephroidTargets NAMESPACE nephroid:: DESTINATION ${package_folder})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/nephroidConfig.cmake.in
                              ${CMAKE_BINARY_DIR}/nephroidConfig.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/nephroidConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/nephroidConfig.cmake ${CMAKE_BINARY_DIR}/nephroidConfigVersion.cmake
              ${PROJECT_SOURCE_DIR}/cmake/NephroidDependencies.cmake DESTINATION ${package_folder})
