#pragma once

#include <optional>
#include <string>

namespace stillframe::viewer {

/// The fixed frame that was last chosen by hand, by the name of the source: what new views of it begin with
/// (REQUIREMENTS E3). Shared by the views of a window. Kept in QSettings across restarts; a source without a name only
/// as long as this object. GUI thread.
class FrameMemory {
 public:
  [[nodiscard]] std::optional<std::string> recall(const std::string& source) const;
  /// nullopt forgets: automatic choice was asked for by hand.
  void remember(const std::string& source, const std::optional<std::string>& frame);

 private:
  std::optional<std::string> unnamed_;
};

}  // namespace stillframe::viewer
