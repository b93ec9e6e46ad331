# stillframe_fuzzer(NAME SOURCES ... LINKS ... [SEEDS DIR] [MAX_BYTES N]): a libFuzzer target and its short run in CTest.
#
# The run is bounded by STILLFRAME_FUZZ_SECONDS and its seed is fixed; inputs found on the way land in the build folder. For a long run:
# `build-asan/bin/NAME CORPUS_DIR [SEEDS_DIR]`.
set(STILLFRAME_FUZZ_SECONDS 20 CACHE STRING "Seconds of each fuzz target's run under CTest")

function(stillframe_fuzzer name)
  cmake_parse_arguments(ARG "" "SEEDS;MAX_BYTES" "SOURCES;LINKS" ${ARGN})
  if(NOT ARG_MAX_BYTES)
    set(ARG_MAX_BYTES 65536)
  endif()
  add_executable(${name} ${ARG_SOURCES})
  add_dependencies(stillframe_tests ${name})
  target_link_libraries(${name} PRIVATE ${ARG_LINKS})
  target_link_options(${name} PRIVATE -fsanitize=fuzzer)
  set(corpus "${CMAKE_BINARY_DIR}/corpus/${name}")
  file(MAKE_DIRECTORY "${corpus}")
  if(ARG_SEEDS)
    get_filename_component(ARG_SEEDS "${ARG_SEEDS}" ABSOLUTE)
  endif()
  add_test(NAME fuzz.${name}
           COMMAND ${name} -seed=1 -max_total_time=${STILLFRAME_FUZZ_SECONDS} -max_len=${ARG_MAX_BYTES} -rss_limit_mb=2048
                   -timeout=10 "-artifact_prefix=${corpus}-" "${corpus}" ${ARG_SEEDS})
  set_tests_properties(fuzz.${name} PROPERTIES LABELS "sanitize" TIMEOUT 300)
endfunction()
