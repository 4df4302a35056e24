# SPDX-License-Identifier: BSD-3-Clause
# The programs of demos/, and what they share with one another and with the tests.

find_package(CLI11 REQUIRED)
find_package(assimp REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(TinyGLTF REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(tomlplusplus REQUIRED IMPORTED_TARGET tomlplusplus)

# Where points and meshes are to one another. Needs nothing, so that whoever judges can have it.
file(GLOB geometry_sources CONFIGURE_DEPENDS demos/geometry/*.cpp)
add_library(demo_geometry STATIC EXCLUDE_FROM_ALL ${geometry_sources})
ode_ext_compile_options(demo_geometry)
target_include_directories(demo_geometry PUBLIC demos)

# What the programs of demos/ are made of: rooms of which each knows those before it.
set(demo_sources "")
foreach(demo_room meshes makers scene_file cloth simulation judging record)
  file(GLOB demo_room_sources CONFIGURE_DEPENDS demos/${demo_room}/*.cpp)
  list(APPEND demo_sources ${demo_room_sources})
endforeach()
add_library(demo_parts OBJECT EXCLUDE_FROM_ALL ${demo_sources})
ode_ext_compile_options(demo_parts)
target_include_directories(demo_parts PUBLIC demos ${public_includes})
target_compile_options(demo_parts PUBLIC ${public_options})
target_link_libraries(demo_parts PUBLIC
  demo_geometry assimp::assimp PkgConfig::tomlplusplus TinyGLTF::TinyGLTF ODE::ODE
  Threads::Threads)
set_property(SOURCE demos/scene_file/scene_file.cpp APPEND PROPERTY COMPILE_DEFINITIONS
             FALLING_OBJECTS_SCENES="${PROJECT_SOURCE_DIR}/demos/scenes")

# All of falling_objects but main, once for the program and once for its tests.
file(GLOB falling_objects_sources CONFIGURE_DEPENDS demos/falling_objects/*.cpp)
list(FILTER falling_objects_sources EXCLUDE REGEX "/main\\.cpp$")
add_library(falling_objects_parts OBJECT EXCLUDE_FROM_ALL ${falling_objects_sources})
ode_ext_compile_options(falling_objects_parts)
target_link_libraries(falling_objects_parts PUBLIC demo_parts CLI11::CLI11)

# All of paper but main, in the same way. What it measured is to say which commit it was.
file(GLOB paper_sources CONFIGURE_DEPENDS demos/paper/*.cpp)
list(FILTER paper_sources EXCLUDE REGEX "/main\\.cpp$")
execute_process(COMMAND git describe --always --dirty WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT commit)
  set(commit unknown)
endif()
set_property(SOURCE demos/paper/machine.cpp APPEND PROPERTY COMPILE_DEFINITIONS
             PAPER_COMMIT="${commit}" PAPER_BUILD_TYPE="$<CONFIG>")
add_library(paper_parts OBJECT EXCLUDE_FROM_ALL ${paper_sources})
ode_ext_compile_options(paper_parts)
target_link_libraries(paper_parts PUBLIC demo_parts CLI11::CLI11 nlohmann_json::nlohmann_json)

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
add_demo(falling_objects demos/falling_objects/main.cpp
         falling_objects_show falling_objects_parts demo_parts)
add_demo(paper demos/paper/main.cpp paper_parts demo_parts)

file(GLOB contacts_sources CONFIGURE_DEPENDS demos/contacts/*.cpp)
add_demo(contacts demos/contacts/main.cpp CLI11::CLI11 nlohmann_json::nlohmann_json)
if(TARGET contacts)
  list(FILTER contacts_sources EXCLUDE REGEX "/main\\.cpp$")
  target_sources(contacts PRIVATE ${contacts_sources})
  target_include_directories(contacts PRIVATE demos)
endif()
