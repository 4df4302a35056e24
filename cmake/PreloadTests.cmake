# SPDX-License-Identifier: BSD-3-Clause
# The tests of the preload: programs as others write them, with and without it.

set(preload_tests ${PROJECT_SOURCE_DIR}/tests/preload)

add_test(NAME preload_links_no_ode COMMAND ${preload_tests}/links_test.sh ${preload_output})

# Programs that know nothing of ode_ext, and the same ones with its calls in place of ODE's.
file(GLOB idiom_sources CONFIGURE_DEPENDS tests/preload/idioms/*.cpp)
foreach(variant idioms idioms_by_api)
  add_executable(${variant} ${idiom_sources})
  ode_ext_compile_options(${variant})
  target_include_directories(${variant} PRIVATE tests)
  target_link_libraries(${variant} PRIVATE ODE::ODE Threads::Threads)
endforeach()
target_compile_definitions(idioms_by_api PRIVATE IDIOMS_BY_API)
target_link_libraries(idioms_by_api PRIVATE ode_ext::ode_ext)

file(STRINGS ${preload_tests}/idioms/main.cpp idioms REGEX "^    {\"[a-z_]+\", ")
foreach(line IN LISTS idioms)
  string(REGEX REPLACE "^    {\"([a-z_]+)\".*" "\\1" idiom "${line}")
  add_test(NAME preload_idiom_${idiom}
           COMMAND ${preload_tests}/idiom_test.sh ${PROJECT_BINARY_DIR}/bin ${idiom})
  set_tests_properties(preload_idiom_${idiom} PROPERTIES TIMEOUT 120)
endforeach()

add_test(NAME preload_run COMMAND ${preload_tests}/run_test.sh ${PROJECT_BINARY_DIR}/bin)
set_tests_properties(preload_run PROPERTIES TIMEOUT 120)
