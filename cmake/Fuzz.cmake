# SPDX-License-Identifier: BSD-3-Clause
# The fuzzer. Its parts are in the tests too, which show that its oracles can fail.

file(GLOB fuzz_sources CONFIGURE_DEPENDS tests/fuzz/*.cpp)
list(FILTER fuzz_sources EXCLUDE REGEX "(_test|/fuzz_api)\\.cpp$")
add_library(ode_ext_fuzz_parts OBJECT EXCLUDE_FROM_ALL ${fuzz_sources})
ode_ext_compile_options(ode_ext_fuzz_parts)
target_link_libraries(ode_ext_fuzz_parts PUBLIC ode_ext_test_support OpenCL::OpenCL)

if(ODE_EXT_FUZZ)
  # What libFuzzer needs to see new paths in the library. Not its tracing of comparisons, with which
  # building a mesh takes three times as long: no magic numbers are to be found here.
  target_compile_options(ode_ext_core PRIVATE -fsanitize-coverage=inline-8bit-counters,pc-table)
  add_executable(fuzz_api EXCLUDE_FROM_ALL
    tests/fuzz/fuzz_api.cpp $<TARGET_OBJECTS:ode_ext_core>)
  ode_ext_compile_options(fuzz_api)
  target_link_options(fuzz_api PRIVATE -fsanitize=fuzzer)
  target_link_libraries(fuzz_api PRIVATE
    ode_ext_fuzz_parts ode_ext_oracles OpenCL::OpenCL)
endif()
