# SPDX-License-Identifier: BSD-3-Clause
# Debian packages by CPack, of a build with the preset `package`: libode-ext<soversion>,
# libode-ext-dev (with the documentation) and ode-ext-tools. scripts/package makes and checks them.
#
# DEBFULLNAME and DEBEMAIL name the maintainer, as for Debian's own tools.

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME ode-ext)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_VERSION ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(name $ENV{DEBFULLNAME})
if(NOT name)
  set(name "The ode_ext authors")
endif()
set(address $ENV{DEBEMAIL})
if(NOT address)
  set(address ode_ext@example.org)
endif()
set(maintainer "${name} <${address}>")
set(CPACK_DEBIAN_PACKAGE_MAINTAINER ${maintainer})

# --- the packages ------------------------------------------------------------------------------

set(debian ${PROJECT_BINARY_DIR}/debian)
get_target_property(soversion ode_ext SOVERSION)
set(library libode-ext${soversion})
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL runtime dev tools docs)
set(CPACK_COMPONENT_DOCS_GROUP dev)
set(CPACK_COMPONENT_DEV_GROUP dev)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR})
set(about "All mesh pairs of a collide pass of the Open Dynamics Engine collide together,
on a GPU or on all cores, and come back as contacts from the callback that a
program already has. Any OpenCL 1.2 device will do; PoCL makes one of every
processor.")

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME ${library})
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
# A device, whichever: without one a program uses ODE's own collider.
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS "pocl-opencl-icd | opencl-icd")
set(CPACK_DEBIAN_RUNTIME_DESCRIPTION
    "batched mesh-mesh collider for the Open Dynamics Engine\n${about}")
# CPack's own scripts call ldconfig, and lintian wants the trigger.
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA ${debian}/triggers)
file(WRITE ${debian}/triggers "activate-noawait ldconfig\n")

set(CPACK_DEBIAN_DEV_PACKAGE_NAME libode-ext-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "${library} (= ${CPACK_DEBIAN_VERSION}), libode-dev")
set(CPACK_DEBIAN_DEV_DESCRIPTION
    "batched mesh-mesh collider for ODE - development files\n${about}\n
This package has the headers, what CMake and pkg-config need, and the
documentation.")

set(CPACK_DEBIAN_TOOLS_PACKAGE_NAME ode-ext-tools)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SECTION utils)
set(CPACK_DEBIAN_TOOLS_PACKAGE_DEPENDS "${library} (= ${CPACK_DEBIAN_VERSION})")
set(CPACK_DEBIAN_TOOLS_DESCRIPTION
    "batched mesh-mesh collider for ODE - programs\n${about}\n
This package has ode_ext-info, which lists the devices of a machine,
ode_ext-replay, which collides again what a program collided, and
ode_ext-run, which runs programs that were not written for ode_ext.")

# --- what Debian wants in each -----------------------------------------------------------------

# The time of the last change, so that packages of one commit are the same bytes.
set(seconds $ENV{SOURCE_DATE_EPOCH})
if(NOT seconds)
  string(TIMESTAMP seconds %s)
endif()
execute_process(COMMAND date -u -R -d @${seconds} OUTPUT_VARIABLE date
                OUTPUT_STRIP_TRAILING_WHITESPACE)

file(STRINGS ${PROJECT_SOURCE_DIR}/LICENSE license)
list(FILTER license EXCLUDE REGEX "^(BSD 3-Clause License|Copyright.*|)$")
list(TRANSFORM license PREPEND " ")
list(JOIN license "\n" license)
configure_file(packaging/debian/copyright.in ${debian}/copyright @ONLY)
configure_file(packaging/debian/changelog.in ${debian}/changelog.Debian @ONLY)

# compress(<file> <compressed>): the same bytes whenever.
function(compress file compressed)
  execute_process(COMMAND gzip -9 -n -c ${file} OUTPUT_FILE ${compressed}
                  COMMAND_ERROR_IS_FATAL ANY)
endfunction()

compress(${debian}/changelog.Debian ${debian}/changelog.Debian.gz)
compress(${PROJECT_SOURCE_DIR}/CHANGELOG.md ${debian}/changelog.gz)
foreach(component RUNTIME DEV TOOLS)
  string(TOLOWER ${component} lower)
  install(FILES ${debian}/copyright ${debian}/changelog.Debian.gz ${debian}/changelog.gz
          DESTINATION share/doc/${CPACK_DEBIAN_${component}_PACKAGE_NAME} COMPONENT ${lower})
endforeach()
foreach(page IN LISTS manual_pages)
  get_filename_component(name ${page} NAME)
  compress(${PROJECT_SOURCE_DIR}/${page} ${debian}/${name}.gz)
  install(FILES ${debian}/${name}.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT tools)
endforeach()

include(CPack)
