# SPDX-License-Identifier: BSD-3-Clause
# Stand-ins for vcpkg's functions, to run a portfile without vcpkg:
#   cmake -DPORT=<folder> -DFEATURES=tools -DWORK=<folder> -P vcpkg.cmake
# Configuring is done; what would build, install or look at what was installed checks its arguments.

cmake_minimum_required(VERSION 3.25)
set(CURRENT_PORT_DIR ${PORT})
set(CURRENT_PACKAGES_DIR ${WORK}/packages)

# As vcpkg's: FEATURES <feature> <option>...
function(vcpkg_check_features)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "OUT_FEATURE_OPTIONS" "FEATURES")
  set(options)
  while(arg_FEATURES)
    list(POP_FRONT arg_FEATURES feature option)
    if(feature IN_LIST FEATURES)
      list(APPEND options -D${option}=ON)
    else()
      list(APPEND options -D${option}=OFF)
    endif()
  endwhile()
  set(${arg_OUT_FEATURE_OPTIONS} ${options} PARENT_SCOPE)
endfunction()

function(vcpkg_cmake_configure)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "SOURCE_PATH" "OPTIONS")
  # An option that the project does not have is a mistake.
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${arg_SOURCE_PATH} -B ${WORK}/build -G Ninja
                          -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=OFF
                          -DCMAKE_INSTALL_PREFIX=${CURRENT_PACKAGES_DIR} ${arg_OPTIONS}
                  OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE result)
  if(NOT result EQUAL 0 OR output MATCHES "not used by the project")
    message(FATAL_ERROR "the port does not configure:\n${output}")
  endif()
endfunction()

function(expect_file file)
  if(NOT EXISTS ${file})
    message(FATAL_ERROR "the port names ${file}, which is not there")
  endif()
endfunction()

# What is to be installed, by the install scripts that configuring wrote.
function(expect_installed text)
  file(GLOB scripts ${WORK}/build/cmake_install.cmake)
  file(READ ${scripts} script)
  string(FIND "${script}" "${text}" at)
  if(at EQUAL -1)
    message(FATAL_ERROR "the port counts on ${text} being installed, and it is not")
  endif()
endfunction()

function(vcpkg_cmake_install)
  expect_file(${WORK}/build/build.ninja)
endfunction()
function(vcpkg_cmake_config_fixup)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "PACKAGE_NAME;CONFIG_PATH" "")
  string(REGEX REPLACE "^lib/" "/" path ${arg_CONFIG_PATH})  # of Debian it may be lib/<triplet>
  expect_installed("${path}")
  expect_file(${WORK}/build/${arg_PACKAGE_NAME}-config.cmake)
endfunction()
function(vcpkg_fixup_pkgconfig)
  expect_installed(/pkgconfig)
endfunction()
function(vcpkg_copy_tools)
  cmake_parse_arguments(PARSE_ARGV 0 arg "AUTO_CLEAN" "" "TOOL_NAMES")
  foreach(tool IN LISTS arg_TOOL_NAMES)
    expect_installed(/bin/${tool})
  endforeach()
endfunction()
function(vcpkg_install_copyright)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "" "FILE_LIST")
  expect_file(${arg_FILE_LIST})
endfunction()

include(${PORT}/portfile.cmake)
