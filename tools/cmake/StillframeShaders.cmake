# stillframe_embed_shaders(TARGET FILES ... [INCLUDES ...]): compiles GLSL files into TARGET as string constants.
#
# Each file NAME.vert becomes `extern const char* const kNAME_vert` in "<dir>/shaders.h" (include it as
# "generated/TARGET/shaders.h"). A line `#include "common.glsl"` is replaced at build time by
# scenegraph/shaders/common.glsl, and `#include "X"` by the file X of INCLUDES (by its name alone); there is no file
# lookup at run time.
function(stillframe_embed_shaders target)
  cmake_parse_arguments(ARG "" "" "FILES;INCLUDES" ${ARGN})
  set(out_dir "${CMAKE_BINARY_DIR}/generated/generated/${target}")
  set(files "")
  foreach(file IN LISTS ARG_FILES)
    list(APPEND files "${CMAKE_CURRENT_SOURCE_DIR}/${file}")
  endforeach()
  set(includes "${CMAKE_SOURCE_DIR}/scenegraph/shaders/common.glsl")
  foreach(file IN LISTS ARG_INCLUDES)
    list(APPEND includes "${CMAKE_CURRENT_SOURCE_DIR}/${file}")
  endforeach()
  add_custom_command(
    OUTPUT "${out_dir}/shaders.h" "${out_dir}/shaders.cpp"
    COMMAND ${CMAKE_COMMAND} "-DOUT=${out_dir}" "-DINCLUDES=${includes}" "-DNAMESPACE=${target}" "-DFILES=${files}" -P
            "${CMAKE_SOURCE_DIR}/tools/cmake/EmbedShaders.cmake"
    DEPENDS ${files} ${includes} "${CMAKE_SOURCE_DIR}/tools/cmake/EmbedShaders.cmake"
    COMMENT "Embedding the shaders of ${target}"
    VERBATIM)
  target_sources(${target} PRIVATE "${out_dir}/shaders.cpp" "${out_dir}/shaders.h")
  target_include_directories(${target} PRIVATE "${CMAKE_BINARY_DIR}/generated")
endfunction()
