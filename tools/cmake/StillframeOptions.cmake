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

find_program(STILLFRAME_CCACHE ccache)
if(STILLFRAME_CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${STILLFRAME_CCACHE}")
endif()

add_library(stillframe_options INTERFACE)
target_include_directories(stillframe_options INTERFACE "$<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}>"
                                                        "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/stillframe>")
target_compile_features(stillframe_options INTERFACE cxx_std_23)
target_compile_options(stillframe_options INTERFACE "$<BUILD_INTERFACE:-Wall;-Wextra;-Wpedantic;-Wshadow;-Wconversion>")
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC bug 105329: false -Wrestrict on `"literal" + std::string`.
  target_compile_options(stillframe_options INTERFACE "$<BUILD_INTERFACE:-Wno-restrict>")
endif()
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

# stillframe_library(NAME SOURCES ... LINKS ...): a static library of one room.
function(stillframe_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS;PRIVATE_LINKS" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_link_libraries(${name} PUBLIC stillframe_options ${ARG_LINKS} PRIVATE ${ARG_PRIVATE_LINKS})
  # The rooms, and what reads recordings, are for hosts too (StillframePackage.cmake).
  cmake_path(RELATIVE_PATH CMAKE_CURRENT_SOURCE_DIR BASE_DIRECTORY "${CMAKE_SOURCE_DIR}" OUTPUT_VARIABLE room)
  if(room MATCHES "^(tf|scenegraph|nodes|viewer|tools/ingest)")
    set_property(GLOBAL APPEND PROPERTY STILLFRAME_PACKAGE_LIBRARIES ${name})
  endif()
endfunction()
