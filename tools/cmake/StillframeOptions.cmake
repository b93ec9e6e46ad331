# Language level, warnings and sanitizers of every target of the project.
set(CMAKE_CXX_STANDARD 23)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release)
endif()

# A batch parses the headers of its sources, and instantiates the same templates, once: half of the work of a build from nothing.
set(CMAKE_UNITY_BUILD "${STILLFRAME_UNITY}")
set(CMAKE_UNITY_BUILD_BATCH_SIZE 8)

find_program(STILLFRAME_CCACHE ccache)
if(STILLFRAME_CCACHE)
  # Depend mode spares a run of the preprocessor; the sloppiness is what ccache asks for with precompiled headers.
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CMAKE_COMMAND}" -E env CCACHE_DEPEND=1 CCACHE_SLOPPINESS=pch_defines,time_macros
                                  "${STILLFRAME_CCACHE}")
  if(STILLFRAME_PCH)
    add_compile_options("$<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>" "$<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>")
  endif()
endif()

add_library(stillframe_options INTERFACE)
target_include_directories(stillframe_options INTERFACE "$<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}>"
                                                        "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/stillframe>")
target_compile_features(stillframe_options INTERFACE cxx_std_23)
target_compile_options(stillframe_options INTERFACE "$<BUILD_INTERFACE:-Wall;-Wextra;-Wpedantic;-Wshadow;-Wconversion>")
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC bug 105329: false -Wrestrict on `"literal" + std::string`; with precompiled headers, two more for the same line.
  target_compile_options(stillframe_options INTERFACE "$<BUILD_INTERFACE:-Wno-restrict>")
  if(STILLFRAME_PCH)
    target_compile_options(stillframe_options INTERFACE "$<BUILD_INTERFACE:-Wno-array-bounds;-Wno-stringop-overflow>")
  endif()
endif()
# Whether a target uses threads or OpenGL's functions or not: all share precompiled headers, which must mean one thing.
target_compile_options(stillframe_options INTERFACE "$<BUILD_INTERFACE:-pthread>")
target_compile_definitions(stillframe_options INTERFACE "$<BUILD_INTERFACE:GL_GLEXT_PROTOTYPES>")
if(STILLFRAME_WERROR)
  target_compile_options(stillframe_options INTERFACE "$<BUILD_INTERFACE:-Werror>")
endif()
if(STILLFRAME_SANITIZE)
  target_compile_options(stillframe_options INTERFACE "-fsanitize=${STILLFRAME_SANITIZE}" -fno-omit-frame-pointer
                         -fno-sanitize-recover=all)
  target_link_options(stillframe_options INTERFACE "-fsanitize=${STILLFRAME_SANITIZE}")
endif()
if(STILLFRAME_FUZZ)
  target_compile_options(stillframe_options INTERFACE -fsanitize=fuzzer-no-link)
endif()

# A test runs about once for each time it is compiled.
if(NOT STILLFRAME_SANITIZE)
  set(STILLFRAME_TEST_OPTIONS -O1)
endif()

# stillframe_library(NAME SOURCES ... LINKS ... [PRECOMPILED HEADERS...]): a static library of one room.
function(stillframe_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS;PRIVATE_LINKS;PRECOMPILED" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_link_libraries(${name} PUBLIC stillframe_options ${ARG_LINKS} PRIVATE ${ARG_PRIVATE_LINKS})
  stillframe_precompile(${name} "" ${ARG_PRECOMPILED})
  # The rooms, and what reads recordings, are for hosts too (StillframePackage.cmake).
  cmake_path(RELATIVE_PATH CMAKE_CURRENT_SOURCE_DIR BASE_DIRECTORY "${CMAKE_SOURCE_DIR}" OUTPUT_VARIABLE room)
  if(room MATCHES "^(tf|scenegraph|nodes|viewer|tools/ingest)")
    set_property(GLOBAL APPEND PROPERTY STILLFRAME_PACKAGE_LIBRARIES ${name})
  endif()
endfunction()

# stillframe_precompile(NAME KIND [HEADERS...]): gives a target precompiled headers (StillframePrecompiled.cmake): those
# named, else the set of its KIND: "" for libraries, "test_" for tests, with OSG's where it links OSG. No target has headers
# that it does not link.
function(stillframe_precompile name kind)
  get_target_property(links ${name} LINK_LIBRARIES)
  set(uses_osg FALSE)
  foreach(link IN LISTS links)
    if(link STREQUAL "stillframe_osg")
      set(uses_osg TRUE)
    elseif(TARGET ${link})
      get_target_property(link_uses_osg ${link} STILLFRAME_USES_OSG)
      if(link_uses_osg)
        set(uses_osg TRUE)
      endif()
    endif()
  endforeach()
  set_target_properties(${name} PROPERTIES STILLFRAME_USES_OSG ${uses_osg})
  if(NOT STILLFRAME_PCH)
    return()
  elseif(ARGN)
    target_precompile_headers(${name} PRIVATE ${ARGN})
  elseif(uses_osg)
    target_precompile_headers(${name} REUSE_FROM stillframe_osg_${kind}pch)
  else()
    target_precompile_headers(${name} REUSE_FROM stillframe_${kind}pch)
  endif()
endfunction()
