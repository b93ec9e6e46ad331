#include "scenegraph/status.h"

namespace stillframe::scenegraph {

std::string_view toString(StatusLevel level) noexcept {
  switch (level) {
    case StatusLevel::Ok:
      return "ok";
    case StatusLevel::Info:
      return "info";
    case StatusLevel::Warn:
      return "warn";
    case StatusLevel::Error:
      return "error";
  }
  return "?";
}

}  // namespace stillframe::scenegraph
