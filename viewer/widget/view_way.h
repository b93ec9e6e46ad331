#pragma once

#include <cstdint>

namespace stillframe::viewer {

/// What brings the pictures of views to the screen.
enum class ViewWay : std::uint8_t {
  Auto,      ///< Image where OpenGL is software, else Composed
  Composed,  ///< Qt puts them into their window by OpenGL, with all that the window shows
  Image,     ///< they are read back and painted
};

}  // namespace stillframe::viewer
