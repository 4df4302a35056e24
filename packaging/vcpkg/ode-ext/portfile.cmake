# SPDX-License-Identifier: BSD-3-Clause
# A published release takes its sources by vcpkg_from_git or vcpkg_from_github in place of this.
get_filename_component(SOURCE_PATH "${CURRENT_PORT_DIR}/../../.." ABSOLUTE)

vcpkg_check_features(OUT_FEATURE_OPTIONS FEATURE_OPTIONS
  FEATURES tools ODE_EXT_BUILD_TOOLS)

vcpkg_cmake_configure(
  SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS
    ${FEATURE_OPTIONS}
    -DODE_EXT_BUILD_DEMOS=OFF
    -DODE_EXT_BUILD_TESTS=OFF)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(PACKAGE_NAME ode_ext CONFIG_PATH lib/cmake/ode_ext)
vcpkg_fixup_pkgconfig()

if("tools" IN_LIST FEATURES)
  # It looks for its library beside itself, and vcpkg moves programs.
  file(REMOVE "${CURRENT_PACKAGES_DIR}/bin/ode_ext-run" "${CURRENT_PACKAGES_DIR}/debug/bin/ode_ext-run")
  vcpkg_copy_tools(TOOL_NAMES ode_ext-info ode_ext-replay AUTO_CLEAN)
endif()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
