# Headers, libraries, the command, a CMake package and a pkg-config file. All of it can be moved
# to another folder after it is installed.
include(CMakePackageConfigHelpers)

install(TARGETS wrapatlas wrapatlas_io EXPORT wrapatlas-targets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
        INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
if(WRAPATLAS_BAKE)
  install(TARGETS wrapatlas_bake EXPORT wrapatlas-targets
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
          LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
endif()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/wrapatlas DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "*.h")
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
if(WRAPATLAS_CLI)
  install(TARGETS wrapatlas_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/wrapatlas)
install(EXPORT wrapatlas-targets NAMESPACE wrapatlas:: DESTINATION ${package_dir}
        FILE wrapatlasTargets.cmake)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/wrapatlasConfig.cmake.in
                              ${PROJECT_BINARY_DIR}/wrapatlasConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/wrapatlasConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/wrapatlasConfig.cmake
              ${PROJECT_BINARY_DIR}/wrapatlasConfigVersion.cmake
        DESTINATION ${package_dir})

# pkg-config looks at Requires.private for `--static` alone, which nobody passes; so where our
# libraries are static, what they need is required outright.
file(RELATIVE_PATH pc_prefix ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
string(REGEX REPLACE "/$" "" pc_prefix ${pc_prefix})
get_target_property(library_type wrapatlas TYPE)
set(pc_private "")
if(library_type STREQUAL SHARED_LIBRARY)
  set(pc_private .private)
endif()
configure_file(${CMAKE_CURRENT_LIST_DIR}/wrapatlas.pc.in ${PROJECT_BINARY_DIR}/wrapatlas.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/wrapatlas.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
