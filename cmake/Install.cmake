# cmake --install: headers, library, command, find_package(pillowmesh) and pkg-config.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/pillowmesh)

target_include_directories(pillowmesh_core PUBLIC $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
install(TARGETS pillowmesh_core EXPORT pillowmeshTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY core/pillowmesh DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(EXPORT pillowmeshTargets NAMESPACE pillowmesh:: DESTINATION ${package_dir})
if(TARGET pillowmesh_cli)
  install(TARGETS pillowmesh_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

configure_package_config_file(cmake/pillowmeshConfig.cmake.in pillowmeshConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(pillowmeshConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/pillowmeshConfig.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/pillowmeshConfigVersion.cmake DESTINATION ${package_dir})

# Relative to the .pc file, so that the installed tree can be moved.
file(RELATIVE_PATH PILLOWMESH_PC_PREFIX /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
string(REGEX REPLACE "/$" "" PILLOWMESH_PC_PREFIX "${PILLOWMESH_PC_PREFIX}")
configure_file(cmake/pillowmesh.pc.in pillowmesh.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/pillowmesh.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
