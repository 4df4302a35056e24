# SPDX-License-Identifier: BSD-3-Clause
# The programs of ode_ext/tools, which are installed: each a folder there, ode_ext-<folder>. They link
# the library as any program does.

find_package(CLI11 REQUIRED)

# ode_ext_add_tool(<name> [<target to link>...])
function(ode_ext_add_tool name)
  file(GLOB sources CONFIGURE_DEPENDS ode_ext/tools/${name}/*.cpp)
  add_executable(ode_ext-${name} ${sources})
  ode_ext_compile_options(ode_ext-${name})
  target_include_directories(ode_ext-${name} PRIVATE ode_ext)
  target_link_libraries(ode_ext-${name} PRIVATE ode_ext::ode_ext CLI11::CLI11 ${ARGN})
endfunction()

set(ODE_EXT_TOOLS info replay)
foreach(tool IN LISTS ODE_EXT_TOOLS)
  ode_ext_add_tool(${tool})
endforeach()
