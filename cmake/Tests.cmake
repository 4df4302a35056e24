# SPDX-License-Identifier: BSD-3-Clause
# The tests: one GoogleTest program, and checks of the sources and of the installed library.

include(GoogleTest)
find_package(GTest REQUIRED)
find_package(rapidcheck REQUIRED)
find_package(fcl REQUIRED)
find_package(ccd REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE)

# Worlds, meshes and poses, all that the tests of threads and the soak need: apart, so that
# ThreadSanitizer is not waited for longer.
add_library(ode_ext_test_world STATIC EXCLUDE_FROM_ALL tests/support/contacts.cpp
            tests/support/mesh_makers.cpp tests/support/ode_world.cpp tests/support/poses.cpp)
ode_ext_compile_options(ode_ext_test_world)
# Headers only: the objects of ode_ext_core come from whoever links this.
target_include_directories(ode_ext_test_world PUBLIC
  tests $<TARGET_PROPERTY:ode_ext_core,INTERFACE_INCLUDE_DIRECTORIES>)
target_compile_options(ode_ext_test_world PUBLIC ${public_options})
target_link_libraries(ode_ext_test_world PUBLIC demo_geometry ODE::ODE Threads::Threads)

# The slow, obvious oracle and the measurements. Needs nothing that the library does not need.
file(GLOB support_sources CONFIGURE_DEPENDS tests/support/*.cpp tests/reference/*.cpp)
list(FILTER support_sources EXCLUDE REGEX "_test\\.cpp$")
list(FILTER support_sources EXCLUDE REGEX "/(fcl|ccd|cgal)_[a-z_]*\\.cpp$")  # below
get_target_property(world_sources ode_ext_test_world SOURCES)
list(TRANSFORM world_sources PREPEND ${PROJECT_SOURCE_DIR}/)
list(REMOVE_ITEM support_sources ${world_sources} ${PROJECT_SOURCE_DIR}/tests/support/leak_check.cpp)
add_library(ode_ext_test_support STATIC EXCLUDE_FROM_ALL ${support_sources})
set_target_properties(ode_ext_test_support PROPERTIES LINKER_LANGUAGE CXX)
ode_ext_compile_options(ode_ext_test_support)
target_link_libraries(ode_ext_test_support PUBLIC ode_ext_test_world)

# For programs of many files, of whose compiling more than half is reading these.
function(ode_ext_precompile target)
  target_precompile_headers(${target} PRIVATE <nlohmann/json.hpp> <functional> <map> <ostream>
                            <${PROJECT_SOURCE_DIR}/tests/support/ode_world.h>)
endfunction()

# All of contact_accuracy but main, once for the program and once for its tests.
file(GLOB accuracy_sources CONFIGURE_DEPENDS tests/bench/accuracy/*.cpp)
list(FILTER accuracy_sources EXCLUDE REGEX "(/main|_test)\\.cpp$")
add_library(contact_accuracy_parts OBJECT ${accuracy_sources})
ode_ext_compile_options(contact_accuracy_parts)
ode_ext_precompile(contact_accuracy_parts)
# Where a string is put together there, gcc 12 sees it overrun.
set_source_files_properties(tests/bench/accuracy/markdown.cpp PROPERTIES
                            SKIP_PRECOMPILE_HEADERS ON)
target_link_libraries(contact_accuracy_parts PUBLIC
  ode_ext_test_support nlohmann_json::nlohmann_json)

# Apart, for its options (CGAL wants all code compiled for directed rounding) and for its time.
set(CGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE TRUE)
find_package(CGAL REQUIRED)
add_library(ode_ext_cgal_oracle STATIC EXCLUDE_FROM_ALL tests/support/cgal_oracle.cpp)
ode_ext_compile_options(ode_ext_cgal_oracle)
target_include_directories(ode_ext_cgal_oracle PRIVATE tests)
target_link_libraries(ode_ext_cgal_oracle PRIVATE CGAL::CGAL)

# Oracles by libraries of others, and by brute force, which takes long enough to be optimized.
file(GLOB oracle_sources CONFIGURE_DEPENDS tests/support/fcl_*.cpp tests/support/ccd_*.cpp
     tests/search/*_comparison.cpp tests/search/*_oracle.cpp)
add_library(ode_ext_oracles STATIC EXCLUDE_FROM_ALL ${oracle_sources})
ode_ext_compile_options(ode_ext_oracles)
target_link_libraries(ode_ext_oracles PUBLIC ode_ext_test_support fcl ccd Eigen3::Eigen)

include(Fuzz)

# Of programs that measure, what the tests try.
file(GLOB measuring_sources CONFIGURE_DEPENDS
     tests/bench/audit/scene_audit.cpp tests/bench/audit/kind*.cpp tests/bench/audit/pair_*.cpp
     tests/bench/stability/bench.cpp tests/bench/stability/ground.cpp
     tests/bench/stability/report.cpp tests/bench/stability/shape.cpp
     tests/bench/stability/stack.cpp)
list(FILTER measuring_sources EXCLUDE REGEX "_test\\.cpp$")
add_library(ode_ext_measuring_parts OBJECT EXCLUDE_FROM_ALL ${measuring_sources})
ode_ext_compile_options(ode_ext_measuring_parts)
ode_ext_precompile(ode_ext_measuring_parts)
target_link_libraries(ode_ext_measuring_parts PUBLIC
  ode_ext_test_support demo_parts nlohmann_json::nlohmann_json CLI11::CLI11 fcl Eigen3::Eigen)

# ode_ext_gtest(<program>)
function(ode_ext_gtest program)
  ode_ext_compile_options(${program})
  target_compile_definitions(${program} PRIVATE ODE_EXT_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  # Half of what compiling a test takes is this header, and half of the rest optimizing what runs
  # once; what a test needs much time for is in the libraries above.
  target_precompile_headers(${program} PRIVATE <gtest/gtest.h>)
  target_compile_options(${program} PRIVATE -O0)
  target_sources(${program} PRIVATE tests/support/leak_check.cpp)
  ode_ext_whole_rooms(${program})
  target_link_libraries(${program} PRIVATE
    ode_ext_core ode_ext_oracles ode_ext_test_support GTest::gtest_main GTest::gmock rapidcheck
    ${CMAKE_DL_LIBS})
endfunction()

file(GLOB test_sources CONFIGURE_DEPENDS tests/*/*_test.cpp tests/bench/*/*_test.cpp)
list(FILTER test_sources EXCLUDE REGEX "/tests/view/")
if(test_sources)
  add_executable(ode_ext_tests ${test_sources})
  ode_ext_gtest(ode_ext_tests)
  target_link_libraries(ode_ext_tests PRIVATE
    falling_objects_parts demo_parts paper_parts ode_ext_measuring_parts
    contact_accuracy_parts ode_ext_cgal_oracle ode_ext_fuzz_parts)
  # A fixed seed: a run that fails must fail again. For other seeds run bin/ode_ext_tests itself.
  gtest_discover_tests(ode_ext_tests
    NO_PRETTY_VALUES DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60
    PROPERTIES TIMEOUT 300 LABELS gtest ENVIRONMENT "RC_PARAMS=seed=1")
endif()

# The tests of the product's rooms: what sanitizers are run over. They see the host's code, and of
# demos, oracles and programs that measure none is linked by anybody else's program.
file(GLOB product_test_sources CONFIGURE_DEPENDS
     tests/api/*_test.cpp tests/collide/*_test.cpp tests/contacts/*_test.cpp tests/mesh/*_test.cpp
     tests/opencl/*_test.cpp tests/paper/*_test.cpp tests/search/*_test.cpp
     tests/threads/*_test.cpp)
add_executable(product_tests EXCLUDE_FROM_ALL ${product_test_sources}
  tests/bench/accuracy/contact_match.cpp)
ode_ext_gtest(product_tests)

# The readers of the demos' files, which are given what anybody wrote: for sanitizers too, without
# all that demos do with a scene.
file(GLOB reader_sources CONFIGURE_DEPENDS
     demos/geometry/*.cpp demos/meshes/*.cpp demos/makers/*.cpp demos/scene_file/*.cpp)
add_executable(reader_tests EXCLUDE_FROM_ALL tests/demos/mesh_file_test.cpp
               tests/demos/scene_file_test.cpp tests/support/leak_check.cpp ${reader_sources})
ode_ext_compile_options(reader_tests)
target_include_directories(reader_tests PRIVATE demos tests)
target_compile_definitions(reader_tests PRIVATE ODE_EXT_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
target_link_libraries(reader_tests PRIVATE
  assimp::assimp PkgConfig::tomlplusplus GTest::gtest_main GTest::gmock)

# The tests of threads alone: what ThreadSanitizer is run over, in a tenth of the time that building
# all tests with it takes.
file(GLOB thread_test_sources CONFIGURE_DEPENDS tests/threads/*_test.cpp)
add_executable(thread_tests EXCLUDE_FROM_ALL tests/api/threads_test.cpp ${thread_test_sources})
ode_ext_compile_options(thread_tests)
target_link_libraries(thread_tests PRIVATE ode_ext_core ode_ext_test_world GTest::gtest_main)

# Passes by the thousand in a scene that never stays the same, with a table of memory and speed.
file(GLOB soak_sources CONFIGURE_DEPENDS tests/soak/*.cpp)
list(FILTER soak_sources EXCLUDE REGEX "_test\\.cpp$")
add_executable(soak ${soak_sources})
ode_ext_compile_options(soak)
target_link_libraries(soak PRIVATE ode_ext_core ode_ext_test_world CLI11::CLI11)
add_test(NAME short_soak COMMAND soak --passes 300)
set_tests_properties(short_soak PROPERTIES TIMEOUT 120)

# The contacts of a whole run against FCL; too long for the tests, which audit a small scene.
add_executable(rigid_audit EXCLUDE_FROM_ALL
  tests/bench/audit/rigid_audit.cpp tests/bench/audit/scene_audit.cpp tests/bench/audit/pair_audit.cpp
  tests/bench/audit/pair_poses.cpp)
ode_ext_compile_options(rigid_audit)
target_link_libraries(rigid_audit PRIVATE ode_ext_core ode_ext_oracles demo_parts
                      CLI11::CLI11)

# What the search finds, crossings and vertices inside, beside brute force. Minutes.
add_executable(search_audit EXCLUDE_FROM_ALL
  tests/bench/audit/search_audit.cpp tests/bench/audit/kinds.cpp tests/bench/audit/pair_poses.cpp)
ode_ext_compile_options(search_audit)
target_link_libraries(search_audit PRIVATE ode_ext_core ode_ext_oracles demo_parts
                      CLI11::CLI11)

# Do bodies rest, slide and stand on the contacts? Minutes; the tests try its parts.
file(GLOB stability_sources CONFIGURE_DEPENDS tests/bench/stability/*.cpp)
list(FILTER stability_sources EXCLUDE REGEX "_test\\.cpp$")
list(REMOVE_ITEM stability_sources ${measuring_sources})
add_executable(contact_stability ${stability_sources})
ode_ext_compile_options(contact_stability)
ode_ext_precompile(contact_stability)
target_link_libraries(contact_stability PRIVATE
  ode_ext_core ode_ext_measuring_parts ode_ext_oracles demo_parts)

# How true are the contacts, against oracles and beside ODE's own collider? Half a minute; the tests judge its trials.
add_executable(contact_accuracy tests/bench/accuracy/main.cpp)
ode_ext_compile_options(contact_accuracy)
target_link_libraries(contact_accuracy PRIVATE
  ode_ext::ode_ext contact_accuracy_parts ode_ext_oracles CLI11::CLI11)

# Every kind of mesh against every other in random poses, and the same scene.
file(GLOB missed_pairs_sources CONFIGURE_DEPENDS tests/bench/audit/*.cpp)
list(FILTER missed_pairs_sources EXCLUDE REGEX "(_test|rigid_audit|search_audit)\\.cpp$")
add_executable(missed_pairs EXCLUDE_FROM_ALL ${missed_pairs_sources})
ode_ext_compile_options(missed_pairs)
target_link_libraries(missed_pairs PRIVATE ode_ext_core ode_ext_oracles demo_parts
                      CLI11::CLI11 nlohmann_json::nlohmann_json)

# What a mesh, a pair and a pass cost, beside ODE's own collider, FCL and Bullet's GImpact. Minutes.
find_package(PkgConfig REQUIRED)
pkg_check_modules(Bullet REQUIRED IMPORTED_TARGET bullet)
add_library(ode_ext_bench OBJECT EXCLUDE_FROM_ALL
  tests/bench/pair_cases.cpp tests/bench/captured_cases.cpp
  ode_ext/tools/replay/capture_file.cpp tests/bench/rivals.cpp)
ode_ext_compile_options(ode_ext_bench)
target_link_libraries(ode_ext_bench PUBLIC
  ode_ext_oracles PkgConfig::Bullet)
foreach(bench mesh_times pair_times pile_times)
  add_executable(${bench} tests/bench/${bench}.cpp)
  ode_ext_compile_options(${bench})
  target_link_libraries(${bench} PRIVATE
    ode_ext::ode_ext ode_ext_bench falling_objects_parts demo_parts CLI11::CLI11 GTest::gtest)
endforeach()

add_test(NAME bench_of_pairs COMMAND pair_times
         --pairs 4 --triangles 100 --repetitions 1 --only rocks --csv pair_times.csv)
add_test(NAME bench_of_a_pile COMMAND pile_times
         --bodies 6 --triangles 100 --steps 40 --first 36 --every 2 --csv pile_times.csv)
add_test(NAME bench_of_meshes COMMAND mesh_times
         --triangles 1000 --repetitions 1 --csv mesh_times.csv)
add_test(NAME tables_of_documents COMMAND ${PROJECT_SOURCE_DIR}/tests/bench/tables_test.sh)
set_tests_properties(bench_of_pairs bench_of_a_pile bench_of_meshes tables_of_documents PROPERTIES
                     TIMEOUT 120)

# Every check of the sources has a test that it fails where it should.
set(scripts ${PROJECT_SOURCE_DIR}/scripts)
add_test(NAME house_rules COMMAND ${scripts}/check-house)
add_test(NAME kernels_compile COMMAND ${scripts}/check-kernels)
add_test(NAME format COMMAND ${scripts}/check-format)
add_test(NAME checks_fail_on_violations COMMAND ${PROJECT_SOURCE_DIR}/tests/support/checks_test.sh)
set_tests_properties(house_rules kernels_compile format checks_fail_on_violations PROPERTIES
                     TIMEOUT 120)
# Those that take longest go first, so that no core waits for them.
set_tests_properties(checks_fail_on_violations PROPERTIES COST 20)

if(TARGET falling_objects)
  add_test(NAME same_contacts_in_every_run
           COMMAND ${PROJECT_SOURCE_DIR}/tests/demos/same_hash_test.sh $<TARGET_FILE:falling_objects>)
  set_tests_properties(same_contacts_in_every_run PROPERTIES TIMEOUT 120)
  add_test(NAME refusals_of_falling_objects
           COMMAND ${PROJECT_SOURCE_DIR}/tests/demos/refusals_test.sh $<TARGET_FILE:falling_objects>)
  add_test(NAME outputs_of_falling_objects
           COMMAND ${PROJECT_SOURCE_DIR}/tests/demos/outputs_test.sh $<TARGET_FILE:falling_objects>)
  set_tests_properties(refusals_of_falling_objects outputs_of_falling_objects
                       PROPERTIES TIMEOUT 120)
endif()

# What a work-group goes through together, which no processor's OpenCL can: compiled for the host.
find_program(CLANG_FOR_KERNELS NAMES clang-14)
if(TARGET falling_objects AND CLANG_FOR_KERNELS AND CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
  set(group_kernels ${CMAKE_CURRENT_BINARY_DIR}/group_kernels.o)
  file(GLOB_RECURSE kernel_sources CONFIGURE_DEPENDS kernels/*.h kernels/*.cl)
  # The warning takes a lane for a number without side effects that && would do for.
  add_custom_command(
    OUTPUT ${group_kernels}
    COMMAND ${CLANG_FOR_KERNELS} -x cl -cl-std=CL1.2 -target x86_64-linux-gnu -fPIC -O2 -mfma
            -ffp-contract=off -DOX_VECTOR_WIDTH=16 -DOX_LANES_ARE_GROUP -DOX_EMULATED_GROUP
            -Wall -Werror -Wno-bitwise-instead-of-logical -I${PROJECT_SOURCE_DIR}/kernels
            -c ${PROJECT_SOURCE_DIR}/tests/groups/group_kernels.cl -o ${group_kernels}
    DEPENDS tests/groups/group_kernels.cl ${kernel_sources})
  add_library(group_emulation MODULE tests/groups/group_emulation.cpp ${group_kernels})
  set_source_files_properties(${group_kernels} PROPERTIES EXTERNAL_OBJECT TRUE GENERATED TRUE)
  target_link_libraries(group_emulation PRIVATE OpenCL::OpenCL ${CMAKE_DL_LIBS})
  # What a kernel calls and is not there would be missed only where that is come to.
  target_link_options(group_emulation PRIVATE LINKER:-z,defs)
  add_test(NAME groups_agree COMMAND ${PROJECT_SOURCE_DIR}/tests/groups/agrees.sh
           $<TARGET_FILE:falling_objects> $<TARGET_FILE:group_emulation>)
  set_tests_properties(groups_agree PROPERTIES TIMEOUT 300 COST 15)
endif()

if(TARGET falling_objects AND TARGET ode_ext-replay)
  add_test(NAME captures_replay
           COMMAND ${PROJECT_SOURCE_DIR}/tests/tools/replay_test.sh $<TARGET_FILE:ode_ext-replay>
                   $<TARGET_FILE:falling_objects> $<TARGET_FILE:ode_ext_tests>
                   $<TARGET_FILE:pair_times>)
  set_tests_properties(captures_replay PROPERTIES TIMEOUT 300)
endif()

if(ODE_EXT_TOOLS)
  list(TRANSFORM ODE_EXT_TOOLS REPLACE "(.+)" "$<TARGET_FILE:ode_ext-\\1>" OUTPUT_VARIABLE tools)
  if(TARGET ode_ext_run)
    list(APPEND tools $<TARGET_FILE:ode_ext_run>)
  endif()
  add_test(NAME what_info_says COMMAND ${PROJECT_SOURCE_DIR}/tests/tools/info_test.sh
                                       $<TARGET_FILE:ode_ext-info>)
  add_test(NAME manual_pages COMMAND ${PROJECT_SOURCE_DIR}/tests/tools/man_test.sh ${tools})
endif()

# Pictures are drawn and looked at; a window is opened on a screen of no machine's and used.
if(view_missing)
  message(FATAL_ERROR "The tests of pictures need ${view_missing}: scripts/install-packages test "
                      "installs all, -DODE_EXT_BUILD_TESTS=OFF builds without tests")
elseif(TARGET view)
  file(GLOB view_test_sources CONFIGURE_DEPENDS tests/view/*.cpp)
  add_executable(view_tests ${view_test_sources})
  ode_ext_compile_options(view_tests)
  target_precompile_headers(view_tests PRIVATE <gtest/gtest.h>)
  target_compile_options(view_tests PRIVATE -O0)
  target_link_libraries(view_tests PRIVATE falling_objects_show falling_objects_parts
    demo_parts ode_ext_test_support ode_ext::ode_ext GTest::gtest_main GTest::gmock)
  gtest_discover_tests(view_tests NO_PRETTY_VALUES DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60
                       PROPERTIES TIMEOUT 120 LABELS gtest)
  if(TARGET falling_objects)
    foreach(shown pictures window)
      add_test(NAME ${shown}_of_falling_objects
               COMMAND ${PROJECT_SOURCE_DIR}/tests/view/${shown}_test.sh
                       $<TARGET_FILE:falling_objects>)
    endforeach()
    set_tests_properties(pictures_of_falling_objects PROPERTIES TIMEOUT 180)
    set_tests_properties(window_of_falling_objects PROPERTIES TIMEOUT 400 COST 30)
  endif()
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
  if(BUILD_SHARED_LIBS)
    add_test(NAME programs_built_before_fit
             COMMAND ${PROJECT_SOURCE_DIR}/tests/install/abi.py ${PROJECT_BINARY_DIR})
  endif()
  file(GLOB documents CONFIGURE_DEPENDS docs/*.md)
  add_test(NAME code_in_documentation
           COMMAND ${PROJECT_SOURCE_DIR}/tests/docs/code_blocks.py ${PROJECT_BINARY_DIR}
                   ${PROJECT_SOURCE_DIR}/README.md ${documents})
  set_tests_properties(code_in_documentation PROPERTIES TIMEOUT 120)
  add_test(NAME documentation_site COMMAND ${scripts}/docs)
  set_tests_properties(documentation_site PROPERTIES TIMEOUT 120)
  add_test(NAME package_recipes COMMAND ${PROJECT_SOURCE_DIR}/tests/install/recipes.sh)
  add_test(NAME part_of_another_project
           COMMAND ${PROJECT_SOURCE_DIR}/tests/install/subproject.sh ${PROJECT_BINARY_DIR})
  set_tests_properties(install_consumer package_recipes part_of_another_project
                       PROPERTIES TIMEOUT 300)
endif()

if(TARGET ode_ext_preload)
  include(PreloadTests)
endif()
