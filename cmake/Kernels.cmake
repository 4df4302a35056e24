# SPDX-License-Identifier: BSD-3-Clause
# Which files make up the device program, and the source that carries them in the library.
#
# Shared headers come first, in an order in which each needs only earlier ones; then the kernels.

set(kernels_dir ${PROJECT_SOURCE_DIR}/kernels)
file(GLOB headers CONFIGURE_DEPENDS RELATIVE ${kernels_dir} ${kernels_dir}/shared/*.h
     ${kernels_dir}/paper/*.h ${kernels_dir}/contacts/*.h)
file(GLOB kernels CONFIGURE_DEPENDS RELATIVE ${kernels_dir} ${kernels_dir}/*.cl
     ${kernels_dir}/paper/*.cl ${kernels_dir}/contacts/*.cl)

set(ODE_EXT_KERNEL_FILES)
foreach(header shared/types shared/scene shared/transform shared/append shared/flooded
               shared/general_position shared/cull shared/lanes shared/ray_triangle
               shared/ray_meshlet shared/meshlet_tree shared/nearest shared/closest shared/full_ray
               shared/vertex_ray paper/types paper/iterative_ray paper/choose paper/cast
               paper/note_work shared/meshlet shared/exact_sign shared/intersect contacts/types
               contacts/fields contacts/candidate_list contacts/border contacts/cross
               contacts/feature
               contacts/feature_table contacts/chord contacts/mate contacts/face_table contacts/plane
               contacts/region_fields contacts/region contacts/ways contacts/whole_region
               contacts/units contacts/candidates shared/deform shared/moves)
  set(header ${header}.h)
  if(header IN_LIST headers)
    list(APPEND ODE_EXT_KERNEL_FILES ${header})
    list(REMOVE_ITEM headers ${header})
  endif()
endforeach()
list(REMOVE_ITEM kernels whole_step.cl)  # it calls the others
list(APPEND ODE_EXT_KERNEL_FILES ${headers} ${kernels} whole_step.cl)

set(ODE_EXT_EMBEDDED_KERNELS ${PROJECT_BINARY_DIR}/generated/embedded_kernels.cpp)
list(TRANSFORM ODE_EXT_KERNEL_FILES PREPEND ${kernels_dir}/ OUTPUT_VARIABLE kernel_paths)
add_custom_command(
  OUTPUT ${ODE_EXT_EMBEDDED_KERNELS}
  COMMAND ${CMAKE_COMMAND} -DOUT=${ODE_EXT_EMBEDDED_KERNELS} -DROOT=${kernels_dir}
          "-DFILES=${ODE_EXT_KERNEL_FILES}" -P ${PROJECT_SOURCE_DIR}/cmake/EmbedKernels.cmake
  DEPENDS ${kernel_paths} ${PROJECT_SOURCE_DIR}/cmake/EmbedKernels.cmake
  COMMENT "Embedding the kernels"
  VERBATIM)
