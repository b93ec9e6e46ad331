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
target_include_directories(stillframe_options INTERFACE "${CMAKE_SOURCE_DIR}")
target_compile_options(stillframe_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion)
if(STILLFRAME_WERROR)
  target_compile_options(stillframe_options INTERFACE -Werror)
endif()
if(STILLFRAME_SANITIZE)
  target_compile_options(stillframe_options INTERFACE "-fsanitize=${STILLFRAME_SANITIZE}" -fno-omit-frame-pointer
                         -fno-sanitize-recover=all)
  target_link_options(stillframe_options INTERFACE "-fsanitize=${STILLFRAME_SANITIZE}")
endif()

# stillframe_library(NAME SOURCES ... LINKS ...): a static library of one room.
function(stillframe_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS;PRIVATE_LINKS" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_link_libraries(${name} PUBLIC stillframe_options ${ARG_LINKS} PRIVATE ${ARG_PRIVATE_LINKS})
endfunction()
