// A layout from the fuzzer: refused with one line, or read; and what is read and written once stays byte for byte.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "scenegraph/layout/window_layout.h"

namespace {

using namespace stillframe::scenegraph;

void require(bool holds) {
  if (!holds) {
    std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto layout = parseLayout({reinterpret_cast<const char*>(data), size});
  if (!layout) {
    require(!layout.error().code.empty() && !layout.error().message.empty() &&
            layout.error().message.find('\n') == std::string::npos);
    return 0;
  }
  require(!viewsOf(*layout).empty());
  const std::string once = writeXml(toXml(*layout));
  const auto again = parseLayout(once);
  require(again.has_value() && writeXml(toXml(*again)) == once);
  return 0;
}
