#include <gtest/gtest.h>

#include <QApplication>

#include "viewer/gl_format.h"

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  stillframe::viewer::prepareApplication();
  const QApplication app(argc, argv);
  return RUN_ALL_TESTS();
}
