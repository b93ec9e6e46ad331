# Headers of other libraries, compiled once for each kind of target: they are half of what a source costs.
#
# Never the project's own headers: what changes would compile everything anew. And nothing that a target does not include
# anyway: GCC instantiates what a precompiled header left pending in every source, 1.1 s of it for osg/Geometry. So there
# are four sets, libraries and tests with and without OSG; the Qt room and its test name their own.
set(STILLFRAME_COMMON_HEADERS
    <algorithm> <array> <bit> <charconv> <cmath> <cstddef> <cstdint> <cstring> <expected> <functional> <glm/common.hpp>
    <glm/geometric.hpp> <glm/gtc/quaternion.hpp> <glm/mat3x3.hpp> <glm/mat4x4.hpp> <glm/vec2.hpp> <glm/vec3.hpp>
    <glm/vec4.hpp> <limits> <map> <memory> <numbers> <optional> <set> <span> <string> <string_view> <tuple>
    <unordered_map> <utility> <vector>)
set(STILLFRAME_OSG_HEADERS <osg/BoundingBox> <osg/Geometry> <osg/Group> <osg/MatrixTransform> <osg/StateSet> <osg/ref_ptr>)
set(STILLFRAME_TEST_HEADERS <gmock/gmock.h> <gtest/gtest.h>)
set(STILLFRAME_QT_HEADERS
    <QApplication> <QComboBox> <QHBoxLayout> <QHeaderView> <QKeyEvent> <QLabel> <QLineEdit> <QMainWindow> <QMenu>
    <QMouseEvent> <QPainter> <QSignalBlocker> <QTimer> <QToolButton> <QTreeWidget> <QVBoxLayout> <QWidget>)

# stillframe_precompiled_owner(NAME HEADERS...): an empty target that precompiles HEADERS for others to use.
function(stillframe_precompiled_owner name)
  if(name MATCHES "test")
    file(CONFIGURE OUTPUT "${CMAKE_BINARY_DIR}/generated/precompiled_main.cpp" CONTENT "int main() {}\n")
    add_executable(${name} EXCLUDE_FROM_ALL "${CMAKE_BINARY_DIR}/generated/precompiled_main.cpp")
    target_compile_options(${name} PRIVATE ${STILLFRAME_TEST_OPTIONS})
    target_link_libraries(${name} PRIVATE GTest::gtest GTest::gmock)
  else()
    file(CONFIGURE OUTPUT "${CMAKE_BINARY_DIR}/generated/precompiled.cpp" CONTENT "")
    add_library(${name} STATIC EXCLUDE_FROM_ALL "${CMAKE_BINARY_DIR}/generated/precompiled.cpp")
  endif()
  target_link_libraries(${name} PRIVATE stillframe_options glm::glm)
  if(name MATCHES "osg")
    target_link_libraries(${name} PRIVATE stillframe_osg)
  endif()
  target_precompile_headers(${name} PRIVATE ${ARGN})
endfunction()

stillframe_precompiled_owner(stillframe_pch ${STILLFRAME_COMMON_HEADERS})
if(STILLFRAME_GL)
  stillframe_precompiled_owner(stillframe_osg_pch ${STILLFRAME_COMMON_HEADERS} ${STILLFRAME_OSG_HEADERS})
endif()
if(BUILD_TESTING)
  find_package(GTest REQUIRED)
  stillframe_precompiled_owner(stillframe_test_pch ${STILLFRAME_COMMON_HEADERS} ${STILLFRAME_TEST_HEADERS})
  if(STILLFRAME_GL)
    stillframe_precompiled_owner(stillframe_osg_test_pch ${STILLFRAME_COMMON_HEADERS} ${STILLFRAME_TEST_HEADERS}
                                 ${STILLFRAME_OSG_HEADERS})
  endif()
endif()
