# SPDX-License-Identifier: BSD-3-Clause
# What every target of this project is compiled with.

# ode_ext_compile_options(<target>...)
function(ode_ext_compile_options)
  foreach(target IN LISTS ARGN)
    set_target_properties(${target} PROPERTIES
      POSITION_INDEPENDENT_CODE ON
      C_VISIBILITY_PRESET hidden
      CXX_VISIBILITY_PRESET hidden
      VISIBILITY_INLINES_HIDDEN ON)
    target_compile_options(${target} PRIVATE
      -Wall -Wextra -Wconversion -Wshadow $<$<BOOL:${ODE_EXT_WERROR}>:-Werror>
      # Part of -Wconversion for clang, not for GCC.
      $<$<CXX_COMPILER_ID:Clang>:-Wno-sign-conversion>
      # Host and device share geometry code whose results must not depend on whether the compiler
      # finds a multiply-add to contract.
      -ffp-contract=off)
    if(ODE_EXT_SANITIZE)
      list(JOIN ODE_EXT_SANITIZE "," sanitizers)
      target_compile_options(${target} PRIVATE
        -fsanitize=${sanitizers} -fno-sanitize-recover=all -fno-omit-frame-pointer)
      target_link_options(${target} PUBLIC -fsanitize=${sanitizers})
    endif()
  endforeach()
endfunction()

# ode_ext_whole_rooms(<target>): if ODE_EXT_WHOLE_ROOMS names the target, its sources of a folder are
# compiled as one file. That takes a fifth of the time, of which the headers are the most.
function(ode_ext_whole_rooms target)
  if(NOT target IN_LIST ODE_EXT_WHOLE_ROOMS)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "^${PROJECT_SOURCE_DIR}/.*\\.cpp$")
  foreach(source IN LISTS sources)
    cmake_path(GET source PARENT_PATH folder)
    cmake_path(GET folder FILENAME room)
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${room})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()

find_program(CCACHE ccache)
mark_as_advanced(CCACHE)
if(CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # Without this ccache gives up at precompiled headers.
  set(with_precompiled ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros)
  set(CMAKE_C_COMPILER_LAUNCHER ${with_precompiled} ${CCACHE})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${with_precompiled} ${CCACHE})
endif()
