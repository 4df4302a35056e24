# SPDX-License-Identifier: BSD-3-Clause
# Finds the Open Dynamics Engine: upstream's CMake config, else pkg-config (all that Debian ships),
# else a plain search. Installed beside ode_ext-config.cmake, so that consumers find ODE in the same
# way.
#
#   ODE::ODE     imported target
#   ODE_FOUND    ODE_VERSION (if known)

if(NOT TARGET ODE::ODE)
  find_package(ODE CONFIG QUIET)
endif()

if(TARGET ODE::ODE)
  set(ODE_LIBRARY ODE::ODE)
  set(ODE_INCLUDE_DIR ODE::ODE)
else()
  find_package(PkgConfig QUIET)
  if(PkgConfig_FOUND)
    pkg_check_modules(PC_ODE QUIET ode)
    set(ODE_VERSION ${PC_ODE_VERSION})
  endif()
  find_path(ODE_INCLUDE_DIR ode/ode.h HINTS ${PC_ODE_INCLUDE_DIRS})
  find_library(ODE_LIBRARY ode HINTS ${PC_ODE_LIBRARY_DIRS})
  mark_as_advanced(ODE_INCLUDE_DIR ODE_LIBRARY)
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(ODE REQUIRED_VARS ODE_LIBRARY ODE_INCLUDE_DIR
                                  VERSION_VAR ODE_VERSION)

if(ODE_FOUND AND NOT TARGET ODE::ODE)
  add_library(ODE::ODE UNKNOWN IMPORTED)
  set_target_properties(ODE::ODE PROPERTIES
    IMPORTED_LOCATION ${ODE_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${ODE_INCLUDE_DIR})
endif()
