# SPDX-License-Identifier: BSD-3-Clause
# The tests: one GoogleTest program, and checks of the sources and of the installed library.

include(GoogleTest)
find_package(GTest REQUIRED)
find_package(rapidcheck REQUIRED)
find_package(fcl REQUIRED)
find_package(ccd REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE)

# All of contact_accuracy but main, once for the program and once for its tests.
file(GLOB accuracy_sources CONFIGURE_DEPENDS tests/accuracy/*.cpp)
list(FILTER accuracy_sources EXCLUDE REGEX "(/main|_test)\\.cpp$")
add_library(contact_accuracy_parts OBJECT ${accuracy_sources})
ode_ext_compile_options(contact_accuracy_parts)
target_link_libraries(contact_accuracy_parts PUBLIC
  ode_ext_test_support nlohmann_json::nlohmann_json)


# Apart, for its options (CGAL wants all code compiled for directed rounding) and for its time.
set(CGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE TRUE)
find_package(CGAL REQUIRED)
add_library(ode_ext_cgal_oracle STATIC EXCLUDE_FROM_ALL tests/support/cgal_oracle.cpp)
ode_ext_compile_options(ode_ext_cgal_oracle)
target_include_directories(ode_ext_cgal_oracle PRIVATE tests)
target_link_libraries(ode_ext_cgal_oracle PRIVATE CGAL::CGAL)

include(Fuzz)

file(GLOB test_sources CONFIGURE_DEPENDS tests/*/*_test.cpp
     tests/support/fcl_*.cpp tests/support/ccd_*.cpp
     tests/audit/scene_audit.cpp tests/audit/kind*.cpp tests/audit/pair_*.cpp
     tests/stability/bench.cpp tests/stability/ground.cpp tests/stability/report.cpp
     tests/stability/shape.cpp tests/stability/stack.cpp)
if(test_sources)
  add_executable(ode_ext_tests ${test_sources})
  ode_ext_compile_options(ode_ext_tests)
  target_compile_definitions(ode_ext_tests PRIVATE ODE_EXT_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  target_link_libraries(ode_ext_tests PRIVATE
    ode_ext_core ode_ext_test_support $<TARGET_NAME_IF_EXISTS:falling_objects_parts>
    $<TARGET_NAME_IF_EXISTS:paper_parts> contact_accuracy_parts ode_ext_cgal_oracle
    ode_ext_fuzz_parts nlohmann_json::nlohmann_json GTest::gtest_main GTest::gmock rapidcheck fcl ccd Eigen3::Eigen
    ${CMAKE_DL_LIBS})
  # Half of what compiling a test takes is this header.
  target_precompile_headers(ode_ext_tests PRIVATE <gtest/gtest.h>)
  # A fixed seed: a run that fails must fail again. For other seeds run bin/ode_ext_tests itself.
  gtest_discover_tests(ode_ext_tests
    NO_PRETTY_VALUES DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60
    PROPERTIES TIMEOUT 120 ENVIRONMENT "RC_PARAMS=seed=1")
endif()

# The tests of threads alone: what ThreadSanitizer is run over, in a tenth of the time that building
# all tests with it takes.
file(GLOB thread_test_sources CONFIGURE_DEPENDS tests/threads/*_test.cpp)
add_executable(thread_tests EXCLUDE_FROM_ALL tests/api/threads_test.cpp ${thread_test_sources})
ode_ext_compile_options(thread_tests)
target_link_libraries(thread_tests PRIVATE ode_ext_core ode_ext_test_support GTest::gtest_main)

# Passes by the thousand in a scene that never stays the same, with a table of memory and speed.
file(GLOB soak_sources CONFIGURE_DEPENDS tests/soak/*.cpp)
list(FILTER soak_sources EXCLUDE REGEX "_test\\.cpp$")
add_executable(soak ${soak_sources})
ode_ext_compile_options(soak)
target_link_libraries(soak PRIVATE ode_ext_core ode_ext_test_support CLI11::CLI11)
add_test(NAME short_soak COMMAND soak --passes 300)
set_tests_properties(short_soak PROPERTIES TIMEOUT 120)

# The contacts of a whole run against FCL; too long for the tests, which audit a small scene.
add_executable(rigid_audit EXCLUDE_FROM_ALL
  tests/audit/rigid_audit.cpp tests/audit/scene_audit.cpp tests/audit/pair_audit.cpp
  tests/audit/pair_poses.cpp tests/support/fcl_oracle.cpp)
ode_ext_compile_options(rigid_audit)
target_link_libraries(rigid_audit PRIVATE ode_ext_core ode_ext_test_support falling_objects_parts
                      CLI11::CLI11 fcl Eigen3::Eigen)

# Do bodies rest, slide and stand on the contacts? Minutes; the tests try its parts.
file(GLOB stability_sources CONFIGURE_DEPENDS tests/stability/*.cpp)
list(FILTER stability_sources EXCLUDE REGEX "_test\\.cpp$")
add_executable(contact_stability ${stability_sources})
ode_ext_compile_options(contact_stability)
target_link_libraries(contact_stability PRIVATE
  ode_ext_core ode_ext_test_support falling_objects_parts CLI11::CLI11
  nlohmann_json::nlohmann_json)

# How true are the contacts, against oracles and beside ODE's own collider? Half a minute; the tests judge its trials.
add_executable(contact_accuracy tests/accuracy/main.cpp tests/support/ccd_oracle.cpp)
ode_ext_compile_options(contact_accuracy)
target_link_libraries(contact_accuracy PRIVATE
  ode_ext::ode_ext contact_accuracy_parts ode_ext_test_support CLI11::CLI11 ccd)

# Every kind of mesh against every other in random poses, and the same scene.
file(GLOB missed_pairs_sources CONFIGURE_DEPENDS tests/audit/*.cpp tests/support/fcl_*.cpp)
list(FILTER missed_pairs_sources EXCLUDE REGEX "(_test|rigid_audit)\\.cpp$")
add_executable(missed_pairs EXCLUDE_FROM_ALL ${missed_pairs_sources})
ode_ext_compile_options(missed_pairs)
target_link_libraries(missed_pairs PRIVATE ode_ext_core ode_ext_test_support falling_objects_parts
                      CLI11::CLI11 nlohmann_json::nlohmann_json fcl Eigen3::Eigen)

# What a pair costs, beside ODE's own collider and FCL. Minutes.
file(GLOB pair_times_sources CONFIGURE_DEPENDS tests/bench/*.cpp tests/support/fcl_*.cpp)
add_executable(pair_times EXCLUDE_FROM_ALL ${pair_times_sources})
ode_ext_compile_options(pair_times)
target_link_libraries(pair_times PRIVATE ode_ext::ode_ext ode_ext_test_support CLI11::CLI11
                      GTest::gtest fcl Eigen3::Eigen)

# Every check of the sources has a test that it fails where it should.
set(scripts ${PROJECT_SOURCE_DIR}/scripts)
add_test(NAME house_rules COMMAND ${scripts}/check-house)
add_test(NAME kernels_compile COMMAND ${scripts}/check-kernels)
add_test(NAME format COMMAND ${scripts}/check-format)
add_test(NAME checks_fail_on_violations COMMAND ${PROJECT_SOURCE_DIR}/tests/support/checks_test.sh)
set_tests_properties(house_rules kernels_compile format checks_fail_on_violations PROPERTIES
                     TIMEOUT 120)

if(TARGET falling_objects)
  add_test(NAME same_contacts_in_every_run
           COMMAND ${PROJECT_SOURCE_DIR}/tests/demos/same_hash_test.sh $<TARGET_FILE:falling_objects>)
  set_tests_properties(same_contacts_in_every_run PROPERTIES TIMEOUT 120)
endif()

if(TARGET paper)
  add_test(NAME figures_of_the_paper
           COMMAND ${PROJECT_SOURCE_DIR}/tests/demos/figures_test.sh $<TARGET_FILE:paper>)
  set_tests_properties(figures_of_the_paper PROPERTIES TIMEOUT 120)
endif()

if(TARGET contacts)
  add_test(NAME pictures_of_contacts
           COMMAND ${PROJECT_SOURCE_DIR}/tests/demos/contact_pictures_test.sh
                   $<TARGET_FILE:contacts>)
  set_tests_properties(pictures_of_contacts PROPERTIES TIMEOUT 120)
endif()

# The consumer is not built with sanitizers, so it cannot link a library that is.
if(PROJECT_IS_TOP_LEVEL AND NOT ODE_EXT_SANITIZE)
  add_test(NAME install_consumer
           COMMAND ${PROJECT_SOURCE_DIR}/tests/install/run.sh ${PROJECT_BINARY_DIR})
  set_tests_properties(install_consumer PROPERTIES TIMEOUT 300)
endif()
