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
      # Host and device share geometry code whose results must not depend on whether the compiler
      # finds a multiply-add to contract.
      -ffp-contract=off)
    if(ODE_EXT_FUZZ)
      # What libFuzzer needs to see new paths. Not its tracing of comparisons, with which building a
      # mesh takes three times as long: no magic numbers are to be found here.
      target_compile_options(${target} PRIVATE
        -fsanitize-coverage=inline-8bit-counters,pc-table)
    endif()
    if(ODE_EXT_SANITIZE)
      list(JOIN ODE_EXT_SANITIZE "," sanitizers)
      target_compile_options(${target} PRIVATE
        -fsanitize=${sanitizers} -fno-sanitize-recover=all -fno-omit-frame-pointer)
      target_link_options(${target} PUBLIC -fsanitize=${sanitizers})
    endif()
  endforeach()
endfunction()

find_program(CCACHE ccache)
mark_as_advanced(CCACHE)
if(CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # Without this ccache gives up at precompiled headers.
  set(with_precompiled ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros)
  set(CMAKE_C_COMPILER_LAUNCHER ${with_precompiled} ${CCACHE})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${with_precompiled} ${CCACHE})
endif()
