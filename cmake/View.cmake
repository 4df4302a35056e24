# SPDX-License-Identifier: BSD-3-Clause
# What draws: demos/view. Without its packages there is no target `view`, and demos draw nothing.

find_package(PkgConfig)
find_package(glm QUIET)
find_package(glfw3 QUIET)
find_package(meshoptimizer QUIET)
if(PKG_CONFIG_FOUND)
  pkg_check_modules(epoxy QUIET IMPORTED_TARGET epoxy)
  pkg_check_modules(imgui QUIET IMPORTED_TARGET imgui)
endif()
find_path(stb_include stb/stb_image_write.h)

set(view_missing "")
foreach(needed IN ITEMS epoxy:libepoxy-dev imgui:libimgui-dev glfw3:libglfw3-dev glm:libglm-dev
                        meshoptimizer:libmeshoptimizer-dev)
  string(REPLACE ":" ";" needed ${needed})
  list(GET needed 0 found)
  if(NOT ${found}_FOUND)
    list(GET needed 1 package)
    list(APPEND view_missing ${package})
  endif()
endforeach()
if(NOT stb_include)
  list(APPEND view_missing libstb-dev)
endif()

if(view_missing)
  list(JOIN view_missing ", " view_missing)
  message(STATUS "The demos draw no pictures: ${view_missing} not found")
else()
  file(GLOB view_sources CONFIGURE_DEPENDS demos/view/*.cpp)
  add_library(view STATIC EXCLUDE_FROM_ALL ${view_sources})
  ode_ext_compile_options(view)
  target_include_directories(view PUBLIC demos)
  target_compile_definitions(view PUBLIC GLFW_INCLUDE_NONE)  # OpenGL's declarations are libepoxy's
  target_include_directories(view SYSTEM PRIVATE ${stb_include})
  target_link_libraries(view PUBLIC PkgConfig::epoxy PkgConfig::imgui glm::glm glfw
                        PRIVATE meshoptimizer::meshoptimizer ${CMAKE_DL_LIBS})
endif()
