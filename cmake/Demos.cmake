# SPDX-License-Identifier: BSD-3-Clause
# The programs of demos/, and the measuring code they share with the tests.

find_package(CLI11 REQUIRED)
find_package(assimp REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(TinyGLTF REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(tomlplusplus REQUIRED IMPORTED_TARGET tomlplusplus)

# Worlds, meshes and poses, all that the tests of threads and the soak need: apart, so that
# ThreadSanitizer is not waited for longer.
add_library(ode_ext_test_world STATIC EXCLUDE_FROM_ALL tests/support/contacts.cpp
            tests/support/mesh_makers.cpp tests/support/ode_world.cpp tests/support/poses.cpp)
ode_ext_compile_options(ode_ext_test_world)

# The slow, obvious oracle and the measurements. Needs nothing that the library does not need.
file(GLOB support_sources CONFIGURE_DEPENDS tests/support/*.cpp tests/reference/*.cpp)
list(FILTER support_sources EXCLUDE REGEX "_test\\.cpp$")
list(FILTER support_sources EXCLUDE REGEX "/(fcl|ccd|cgal)_[a-z_]*\\.cpp$")  # in Tests.cmake
get_target_property(world_sources ode_ext_test_world SOURCES)
list(TRANSFORM world_sources PREPEND ${PROJECT_SOURCE_DIR}/)
list(REMOVE_ITEM support_sources ${world_sources} ${PROJECT_SOURCE_DIR}/tests/support/leak_check.cpp)
add_library(ode_ext_test_support STATIC EXCLUDE_FROM_ALL ${support_sources})
set_target_properties(ode_ext_test_support PROPERTIES LINKER_LANGUAGE CXX)
ode_ext_compile_options(ode_ext_test_support)
# Headers only: the objects of ode_ext_core come from whoever links this.
target_include_directories(ode_ext_test_world PUBLIC
  tests $<TARGET_PROPERTY:ode_ext_core,INTERFACE_INCLUDE_DIRECTORIES>)
target_compile_options(ode_ext_test_world PUBLIC ${public_options})
target_link_libraries(ode_ext_test_world PUBLIC ODE::ODE Threads::Threads)
target_link_libraries(ode_ext_test_support PUBLIC ode_ext_test_world)

# All of falling_objects but main, once for the program and once for its tests.
file(GLOB falling_objects_sources CONFIGURE_DEPENDS
     demos/falling_objects/*.cpp demos/makers/*.cpp demos/record/*.cpp)
list(FILTER falling_objects_sources EXCLUDE REGEX "/main\\.cpp$")
if(falling_objects_sources)
  add_library(falling_objects_parts OBJECT EXCLUDE_FROM_ALL ${falling_objects_sources})
  ode_ext_compile_options(falling_objects_parts)
  target_include_directories(falling_objects_parts PUBLIC demos tests ${public_includes})
  target_compile_options(falling_objects_parts PUBLIC ${public_options})
  target_link_libraries(falling_objects_parts PUBLIC
    CLI11::CLI11 assimp::assimp PkgConfig::tomlplusplus TinyGLTF::TinyGLTF ODE::ODE Threads::Threads)
  set_property(SOURCE demos/falling_objects/scene_file.cpp APPEND PROPERTY COMPILE_DEFINITIONS
               FALLING_OBJECTS_SCENES="${PROJECT_SOURCE_DIR}/demos/scenes")
endif()

# All of paper but main, in the same way. What it measured is to say which commit it was.
file(GLOB paper_sources CONFIGURE_DEPENDS demos/paper/*.cpp)
list(FILTER paper_sources EXCLUDE REGEX "/main\\.cpp$")
if(paper_sources)
  execute_process(COMMAND git describe --always --dirty WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
                  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(NOT commit)
    set(commit unknown)
  endif()
  set_property(SOURCE demos/paper/machine.cpp APPEND PROPERTY COMPILE_DEFINITIONS
               PAPER_COMMIT="${commit}" PAPER_BUILD_TYPE="$<CONFIG>")
  add_library(paper_parts OBJECT EXCLUDE_FROM_ALL ${paper_sources})
  ode_ext_compile_options(paper_parts)
  target_include_directories(paper_parts PUBLIC demos tests ${public_includes})
  target_compile_options(paper_parts PUBLIC ${public_options})
  target_link_libraries(paper_parts PUBLIC CLI11::CLI11 nlohmann_json::nlohmann_json ODE::ODE)
endif()

# add_demo(<name> <main source> [<target to link>...]): nothing where the source is not there.
function(add_demo name source)
  if(ODE_EXT_BUILD_DEMOS AND EXISTS ${PROJECT_SOURCE_DIR}/${source})
    add_executable(${name} ${source})
    ode_ext_compile_options(${name})
    target_link_libraries(${name} PRIVATE ode_ext::ode_ext ${ARGN})
  endif()
endfunction()

add_demo(hello demos/hello/hello.c)
# What falling_objects shows, or that it shows nothing.
include(View)
if(TARGET view)
  file(GLOB show_sources CONFIGURE_DEPENDS demos/falling_objects/show/*.cpp)
  list(FILTER show_sources EXCLUDE REGEX "/absent\\.cpp$")
else()
  set(show_sources demos/falling_objects/show/absent.cpp)
endif()
add_library(falling_objects_show OBJECT EXCLUDE_FROM_ALL ${show_sources})
ode_ext_compile_options(falling_objects_show)
target_link_libraries(falling_objects_show PUBLIC
  falling_objects_parts $<TARGET_NAME_IF_EXISTS:view>)
add_demo(falling_objects demos/falling_objects/main.cpp falling_objects_show falling_objects_parts
         ode_ext_test_support)
add_demo(paper demos/paper/main.cpp paper_parts falling_objects_parts ode_ext_test_support)

file(GLOB contacts_sources CONFIGURE_DEPENDS demos/contacts/*.cpp)
add_demo(contacts demos/contacts/main.cpp CLI11::CLI11 nlohmann_json::nlohmann_json)
if(TARGET contacts)
  list(FILTER contacts_sources EXCLUDE REGEX "/main\\.cpp$")
  target_sources(contacts PRIVATE ${contacts_sources})
  target_include_directories(contacts PRIVATE demos)
endif()
