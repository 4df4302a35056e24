# SPDX-License-Identifier: BSD-3-Clause
# cmake --install: library, headers, CMake package, pkg-config file.

include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/ode_ext)

install(TARGETS ode_ext EXPORT ode_ext-targets)
install(FILES include/ode_ext/ode_ext.h include/ode_ext/export.h
              ${PROJECT_BINARY_DIR}/generated/include/ode_ext/version.h
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/ode_ext)
install(EXPORT ode_ext-targets NAMESPACE ode_ext:: DESTINATION ${package_dir})

configure_package_config_file(cmake/ode_ext-config.cmake.in ode_ext-config.cmake
                              INSTALL_DESTINATION ${package_dir})
# While the version is 0.x every minor version may break the API.
write_basic_package_version_file(ode_ext-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/ode_ext-config.cmake
              ${PROJECT_BINARY_DIR}/ode_ext-config-version.cmake
              cmake/FindODE.cmake
        DESTINATION ${package_dir})

# Relative to the file itself, so that an installed tree can be moved.
file(RELATIVE_PATH pc_to_prefix
     ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
string(REGEX REPLACE "/$" "" pc_to_prefix ${pc_to_prefix})
set(pc_cflags)
if(NOT BUILD_SHARED_LIBS)
  set(pc_cflags " -DODE_EXT_STATIC")
endif()
configure_file(cmake/ode_ext.pc.in ode_ext.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/ode_ext.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
