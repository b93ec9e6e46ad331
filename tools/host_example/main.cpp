// A host application in a few hundred lines: two scene docks, a plot and live data on one time line.
#include <QApplication>
#include <cstring>

#include "host_window.h"
#include "self_check.h"
#include "viewer/widget/gl_format.h"

int main(int argc, char** argv) {
  stillframe::viewer::prepareApplication();
  QApplication app(argc, argv);
  host_example::HostWindow window;
  window.show();
  const bool is_check = argc > 1 && std::strcmp(argv[1], "--check") == 0;
  return is_check ? host_example::checkHost(window) : QApplication::exec();
}
