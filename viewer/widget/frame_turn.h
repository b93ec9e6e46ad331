#pragma once

#include <cstdint>
#include <functional>

namespace stillframe::viewer {

/// The turn of one view among all that draw their frames in steps: an event of the loop is one step of one view.
///
/// A frame that has been begun goes on until it is whole, so that the views come whole one after the other; while it
/// waits for others to do their part there are no steps at all. Then whichever is favoured comes next, else who has
/// asked first; nobody has two frames in a row while another waits. GUI thread; made and destroyed on it.
class FrameTurn {
 public:
  /// What a step came to.
  enum class Step : std::uint8_t {
    Over,    ///< the frame is whole, or given up
    GoesOn,  ///< it needs another one
    Waits,   ///< the same, from the next ask() on
  };
  /// `step` draws one. `is_favoured`: somebody looks at this view just now.
  FrameTurn(std::function<Step()> step, std::function<bool()> is_favoured);
  ~FrameTurn();
  FrameTurn(const FrameTurn&) = delete;
  FrameTurn& operator=(const FrameTurn&) = delete;

  /// For a step, soon; once for all that ask before it.
  void ask();

 private:
  friend class FrameTurns;
  std::function<Step()> step_;
  std::function<bool()> is_favoured_;
};

}  // namespace stillframe::viewer
