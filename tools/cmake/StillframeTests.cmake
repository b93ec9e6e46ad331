# stillframe_test(NAME SOURCES ... LINKS ... LABELS ... [ENV ...]): a GoogleTest program whose tests CTest lists one by one.
# Labels: unit (no GL), gl (surfaceless EGL), golden, qt (needs an X display), data (needs ../shared/data), lint.
find_package(GTest REQUIRED)
include(GoogleTest)
set(STILLFRAME_TEST_DATA "${CMAKE_SOURCE_DIR}/../shared/data" CACHE PATH "Recordings that data tests read")

function(stillframe_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINKS;LABELS;ENV" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LINKS} GTest::gtest_main GTest::gmock)
  target_compile_definitions(${name} PRIVATE "STILLFRAME_TEST_DATA=\"${STILLFRAME_TEST_DATA}\""
                             "STILLFRAME_SOURCE_DIR=\"${CMAKE_SOURCE_DIR}\"" "STILLFRAME_BINARY_DIR=\"${CMAKE_BINARY_DIR}\"")
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60
                       PROPERTIES LABELS "${ARG_LABELS}" ENVIRONMENT "${ARG_ENV}" TIMEOUT 300)
endfunction()
