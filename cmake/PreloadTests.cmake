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

add_executable(own_collider tests/preload/clients/own_collider.cpp)
ode_ext_compile_options(own_collider)
target_link_libraries(own_collider PRIVATE ODE::ODE)

add_test(NAME preload_run
         COMMAND ${preload_tests}/run_test.sh ${PROJECT_BINARY_DIR}/bin ${preload_output})
set_tests_properties(preload_run PROPERTIES TIMEOUT 120)

# The same programs as a plugin that brings ODE late, and with ODE within themselves, exported.
add_library(idioms_plugin MODULE ${idiom_sources})
ode_ext_compile_options(idioms_plugin)
target_include_directories(idioms_plugin PRIVATE tests)
target_compile_definitions(idioms_plugin PRIVATE IDIOMS_AS_PLUGIN)
target_link_libraries(idioms_plugin PRIVATE ODE::ODE Threads::Threads)
add_executable(late_host tests/preload/clients/late_host.cpp)
ode_ext_compile_options(late_host)
target_link_libraries(late_host PRIVATE ${CMAKE_DL_LIBS})
add_dependencies(late_host idioms_plugin)

set(preload_clients dart dartpy panda late two)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|amd64|AMD64)$")  # of which redirect.c has the jumps
  list(APPEND preload_clients static)
  find_library(ODE_ARCHIVE libode.a REQUIRED)
  add_executable(idioms_static ${idiom_sources})
  ode_ext_compile_options(idioms_static)
  set_target_properties(idioms_static PROPERTIES ENABLE_EXPORTS ON)
  target_include_directories(idioms_static PRIVATE tests ${ode_includes})
  target_link_libraries(idioms_static PRIVATE ${ODE_ARCHIVE} ccd Threads::Threads)
endif()

# Programs of others that come with an ODE or bind to Debian's.
get_directory_property(definitions COMPILE_DEFINITIONS)
find_package(DART CONFIG REQUIRED COMPONENTS collision-ode)
# It adds some to all that is compiled here.
set_directory_properties(PROPERTIES COMPILE_DEFINITIONS "${definitions}")
add_executable(dart_pairs tests/preload/clients/dart_pairs.cpp)
ode_ext_compile_options(dart_pairs)
# DART's headers are not written for these warnings.
target_include_directories(dart_pairs PRIVATE tests)
target_include_directories(dart_pairs SYSTEM PRIVATE ${DART_INCLUDE_DIRS})
target_link_libraries(dart_pairs PRIVATE CLI11::CLI11 dart-collision-ode)

add_executable(boxes tests/preload/clients/boxes.cpp)
ode_ext_compile_options(boxes)
target_include_directories(boxes PRIVATE tests)
target_link_libraries(boxes PRIVATE CLI11::CLI11 ODE::ODE)
add_test(NAME preload_leaves_boxes_alone
         COMMAND ${preload_tests}/overhead.sh ${PROJECT_BINARY_DIR}/bin 1)
set_tests_properties(preload_leaves_boxes_alone PROPERTIES TIMEOUT 120)

foreach(client IN LISTS preload_clients)
  add_test(NAME preload_client_${client}
           COMMAND ${preload_tests}/client_test.sh ${PROJECT_BINARY_DIR} ${client})
  set_tests_properties(preload_client_${client} PROPERTIES TIMEOUT 300)
endforeach()
