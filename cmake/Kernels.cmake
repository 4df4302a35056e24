# SPDX-License-Identifier: BSD-3-Clause
# Which files make up the device program, and the source that carries them in the library.

set(kernels_dir ${PROJECT_SOURCE_DIR}/kernels)
file(GLOB_RECURSE kernel_files CONFIGURE_DEPENDS RELATIVE ${kernels_dir} ${kernels_dir}/*.h
     ${kernels_dir}/*.cl)

# Adds a file to the program behind those it includes, which are named from kernels/ on.
function(ode_ext_add_kernel_file file)
  if(file IN_LIST ODE_EXT_KERNEL_FILES)
    return()
  endif()
  file(STRINGS ${kernels_dir}/${file} includes REGEX "^#include \"")
  foreach(include IN LISTS includes)
    string(REGEX REPLACE "^#include \"(.*)\".*" "\\1" include "${include}")
    if(NOT include IN_LIST kernel_files)
      message(FATAL_ERROR "kernels/${file} includes ${include}, which is not in kernels/")
    endif()
    ode_ext_add_kernel_file(${include})
  endforeach()
  list(APPEND ODE_EXT_KERNEL_FILES ${file})
  set(ODE_EXT_KERNEL_FILES ${ODE_EXT_KERNEL_FILES} PARENT_SCOPE)
endfunction()

set(ODE_EXT_KERNEL_FILES)
set(kernels ${kernel_files})
list(FILTER kernels INCLUDE REGEX "\\.cl$")
foreach(file IN LISTS kernels)
  ode_ext_add_kernel_file(${file})
endforeach()
set(unused ${kernel_files})
list(REMOVE_ITEM unused ${ODE_EXT_KERNEL_FILES})
if(unused)
  message(FATAL_ERROR "no kernel includes these files of kernels/: ${unused}")
endif()
list(TRANSFORM kernel_files PREPEND ${kernels_dir}/ OUTPUT_VARIABLE kernel_paths)
# What a file includes decides on the order.
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${kernel_paths})

set(ODE_EXT_EMBEDDED_KERNELS ${PROJECT_BINARY_DIR}/generated/embedded_kernels.cpp)
add_custom_command(
  OUTPUT ${ODE_EXT_EMBEDDED_KERNELS}
  COMMAND ${CMAKE_COMMAND} -DOUT=${ODE_EXT_EMBEDDED_KERNELS} -DROOT=${kernels_dir}
          "-DFILES=${ODE_EXT_KERNEL_FILES}" -P ${PROJECT_SOURCE_DIR}/cmake/EmbedKernels.cmake
  DEPENDS ${kernel_paths} ${PROJECT_SOURCE_DIR}/cmake/EmbedKernels.cmake
  COMMENT "Embedding the kernels"
  VERBATIM)
