# SPDX-License-Identifier: BSD-3-Clause
# cmake --install, in components: the library (runtime), headers, CMake package and pkg-config file
# (dev), the programs with their manual pages (tools), and the documentation (docs).

include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/ode_ext)

install(TARGETS ode_ext EXPORT ode_ext-targets
        LIBRARY COMPONENT runtime NAMELINK_COMPONENT dev
        RUNTIME COMPONENT runtime
        ARCHIVE COMPONENT dev)
install(FILES include/ode_ext/ode_ext.h include/ode_ext/export.h
              ${PROJECT_BINARY_DIR}/generated/include/ode_ext/version.h
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/ode_ext COMPONENT dev)
install(EXPORT ode_ext-targets NAMESPACE ode_ext:: DESTINATION ${package_dir} COMPONENT dev)

configure_package_config_file(cmake/ode_ext-config.cmake.in ode_ext-config.cmake
                              INSTALL_DESTINATION ${package_dir})
# While the version is 0.x every minor version may break the API.
write_basic_package_version_file(ode_ext-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/ode_ext-config.cmake
              ${PROJECT_BINARY_DIR}/ode_ext-config-version.cmake
              cmake/FindODE.cmake
        DESTINATION ${package_dir} COMPONENT dev)

# Relative to the file itself, so that an installed tree can be moved; but for what is given as an
# absolute path.
set(pc_includedir "\${prefix}/${CMAKE_INSTALL_INCLUDEDIR}")
set(pc_libdir "\${prefix}/${CMAKE_INSTALL_LIBDIR}")
foreach(dir includedir libdir)
  string(TOUPPER ${dir} DIR)
  if(IS_ABSOLUTE "${CMAKE_INSTALL_${DIR}}")
    set(pc_${dir} "${CMAKE_INSTALL_${DIR}}")
  endif()
endforeach()
file(RELATIVE_PATH pc_to_prefix
     ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
string(REGEX REPLACE "/$" "" pc_to_prefix ${pc_to_prefix})
set(pc_cflags)
set(pc_requires_private)
if(NOT BUILD_SHARED_LIBS)
  set(pc_cflags " -DODE_EXT_STATIC")
  # pkg-config asks for these whenever flags are asked for: a shared ode_ext needs no OpenCL of who
  # links it.
  set(pc_requires_private "Requires.private: OpenCL\n")
endif()
configure_file(cmake/ode_ext.pc.in ode_ext.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/ode_ext.pc
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT dev)

# The programs, which find the library in whatever prefix.
set(manual_pages)
file(RELATIVE_PATH bin_to_lib ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR})
foreach(tool IN LISTS ODE_EXT_TOOLS)
  if(BUILD_SHARED_LIBS AND NOT ODE_EXT_DEBIAN_PACKAGES)
    set_target_properties(ode_ext-${tool} PROPERTIES INSTALL_RPATH $ORIGIN/${bin_to_lib})
  endif()
  install(TARGETS ode_ext-${tool} RUNTIME COMPONENT tools)
  list(APPEND manual_pages ode_ext/tools/${tool}/ode_ext-${tool}.1)
endforeach()
if(TARGET ode_ext_run)  # installs itself, with the preload
  list(APPEND manual_pages ode_ext/tools/run/ode_ext-run.1)
endif()
if(NOT ODE_EXT_DEBIAN_PACKAGES)  # there they are compressed
  install(FILES ${manual_pages} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT tools)
endif()

# As they refer to one another.
install(FILES README.md CHANGELOG.md LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT docs)
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs COMPONENT docs
        FILES_MATCHING PATTERN *.md PATTERN *.txt PATTERN *.svg PATTERN *.png PATTERN *.webp
        PATTERN site EXCLUDE)
install(FILES demos/hello/hello.c
        DESTINATION ${CMAKE_INSTALL_DOCDIR}/demos/hello COMPONENT docs)

if(ODE_EXT_DEBIAN_PACKAGES)
  include(DebianPackages)
endif()
