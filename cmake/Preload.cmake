# SPDX-License-Identifier: BSD-3-Clause
# libode_ext_preload.so, which links no ODE, and the library behind it in either precision: the
# objects of the library, of which only those that know ODE are compiled once more.

set(preload_dir ${CMAKE_INSTALL_LIBDIR}/ode_ext)
# In the build tree as it is installed: ode_ext-run looks for it relative to itself.
set(preload_output ${PROJECT_BINARY_DIR}/${preload_dir})
set(ode_includes $<TARGET_PROPERTY:ODE::ODE,INTERFACE_INCLUDE_DIRECTORIES>)

# preload_library(<name> <version script> <source>...): hides all else, and links only if no function
# is missing.
function(preload_library name exports)
  add_library(${name} MODULE ${ARGN})
  ode_ext_compile_options(${name})
  set_target_properties(${name} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${preload_output})
  target_link_options(${name} PRIVATE
    LINKER:--version-script=${PROJECT_SOURCE_DIR}/cmake/${exports} LINKER:-z,defs LINKER:-z,now)
  set_property(TARGET ${name} APPEND PROPERTY
               LINK_DEPENDS ${PROJECT_SOURCE_DIR}/cmake/${exports})
  if(PROJECT_IS_TOP_LEVEL)
    install(TARGETS ${name} LIBRARY DESTINATION ${preload_dir} COMPONENT tools)
  endif()
endfunction()

file(GLOB shim_sources CONFIGURE_DEPENDS ode_ext/preload/*.c)
preload_library(ode_ext_preload preload.map ${shim_sources})
# For quotes only: <ode/rotation.h> is ODE's.
target_compile_options(ode_ext_preload PRIVATE
  "SHELL:-iquote \"${PROJECT_SOURCE_DIR}/ode_ext\""
  -fexceptions)  # a program's callback may throw through the preload, as through ODE
target_include_directories(ode_ext_preload PRIVATE ${ode_includes})
target_compile_definitions(ode_ext_preload PRIVATE _GNU_SOURCE)
target_link_libraries(ode_ext_preload PRIVATE ${CMAKE_DL_LIBS} Threads::Threads)

file(GLOB preload_core_sources CONFIGURE_DEPENDS ode_ext/preload/*.cpp)
file(GLOB ode_room_sources CONFIGURE_DEPENDS ode_ext/api/*.cpp ode_ext/ode/*.cpp)
set(core_objects $<TARGET_OBJECTS:ode_ext_core>)
set(without_ode_room "$<FILTER:${core_objects},EXCLUDE,/ode_ext/(api|ode)/>")
foreach(precision double single)
  string(TOUPPER ${precision} PRECISION)
  set(name ode_ext_preload_${precision})
  if(precision STREQUAL "double")
    preload_library(${name} preload_core.map ${preload_core_sources} ${core_objects})
  else()
    preload_library(${name} preload_core.map
                    ${preload_core_sources} ${ode_room_sources} ${without_ode_room})
  endif()
  target_compile_definitions(${name} PRIVATE dIDE${PRECISION})
  target_include_directories(${name} PRIVATE ${public_includes} ode_ext kernels ${ode_includes})
  target_compile_options(${name} PRIVATE ${public_options})
  target_link_libraries(${name} PRIVATE OpenCL::OpenCL Threads::Threads)
  ode_ext_whole_rooms(${name})
  set_target_properties(${name} PROPERTIES LINKER_LANGUAGE CXX)
  add_dependencies(ode_ext_preload ${name})
endforeach()

# --- ode_ext-run ---------------------------------------------------------------------------------

file(RELATIVE_PATH bin_to_preload
     ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBDIR}/ode_ext)
add_executable(ode_ext_run ode_ext/tools/run/main.cpp ode_ext/tools/run/elf_program.cpp)
ode_ext_compile_options(ode_ext_run)
set_target_properties(ode_ext_run PROPERTIES OUTPUT_NAME ode_ext-run)
target_include_directories(ode_ext_run PRIVATE ode_ext ${ode_includes})
target_link_libraries(ode_ext_run PRIVATE ${CMAKE_DL_LIBS})
target_compile_definitions(ode_ext_run PRIVATE
  ODE_EXT_BIN_TO_PRELOAD="${bin_to_preload}" ODE_EXT_VERSION="${PROJECT_VERSION}")
add_dependencies(ode_ext_run ode_ext_preload)
if(PROJECT_IS_TOP_LEVEL)
  install(TARGETS ode_ext_run RUNTIME COMPONENT tools)
endif()
