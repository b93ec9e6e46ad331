# stillframe_test(NAME [ALONE] SOURCES ... LINKS ... LABELS ... [ENV ...] [PRECOMPILED HEADERS...]): a GoogleTest program, run by CTest;
# ALONE: while nothing else runs, for what takes times.
# Labels: unit (no GL), gl (surfaceless EGL), golden, qt (needs an X display), data (needs ../shared/data), lint.
#
# Suites of label unit are listed test by test; those that bring up GL or Qt run as one CTest test a program, since
# starting the driver costs more than most tests do. In a sanitizer build every program is one test named after the
# sanitizer and labelled `sanitize`; tools/test counts those in with the rest (see tests/sanitized.cmake).
find_package(GTest REQUIRED)
include(GoogleTest)
set(STILLFRAME_TEST_DATA "${CMAKE_SOURCE_DIR}/../shared/data" CACHE PATH "Recordings that data tests read")
set(STILLFRAME_TEST_ROOMS "" CACHE STRING "Folders of tests/ to build, all when empty")

# Everything that CTest runs, and nothing else.
add_custom_target(stillframe_tests)
if(STILLFRAME_SANITIZE MATCHES "thread")
  set(STILLFRAME_TEST_PREFIX "tsan.")
elseif(STILLFRAME_SANITIZE)
  set(STILLFRAME_TEST_PREFIX "asan.")
endif()

function(stillframe_test name)
  cmake_parse_arguments(ARG "ALONE" "" "SOURCES;LINKS;LABELS;ENV;PRECOMPILED" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  add_dependencies(stillframe_tests ${name})
  target_link_libraries(${name} PRIVATE ${ARG_LINKS} GTest::gtest_main GTest::gmock)
  target_compile_options(${name} PRIVATE ${STILLFRAME_TEST_OPTIONS})
  target_compile_definitions(${name} PRIVATE "STILLFRAME_TEST_DATA=\"${STILLFRAME_TEST_DATA}\""
                             "STILLFRAME_SOURCE_DIR=\"${CMAKE_SOURCE_DIR}\"" "STILLFRAME_BINARY_DIR=\"${CMAKE_BINARY_DIR}\"")
  stillframe_precompile(${name} "test_" ${ARG_PRECOMPILED})
  if(STILLFRAME_SANITIZE)
    set(ARG_LABELS sanitize)
  endif()
  if(STILLFRAME_SANITIZE OR ARG_LABELS MATCHES "gl|golden|qt")
    add_test(NAME ${STILLFRAME_TEST_PREFIX}${name} COMMAND ${name})
    set_tests_properties(${STILLFRAME_TEST_PREFIX}${name} PROPERTIES LABELS "${ARG_LABELS}" ENVIRONMENT "${ARG_ENV}" TIMEOUT 600
                         RUN_SERIAL ${ARG_ALONE})
  else()
    gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60 NO_PRETTY_VALUES
                         PROPERTIES LABELS "${ARG_LABELS}" ENVIRONMENT "${ARG_ENV}" TIMEOUT 300 RUN_SERIAL ${ARG_ALONE})
  endif()
endfunction()
