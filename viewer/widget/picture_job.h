#pragma once

#include <expected>
#include <optional>
#include <utility>

#include "scenegraph/camera/camera.h"
#include "scenegraph/pipeline/picture.h"
#include "viewer/widget/picture_request.h"

namespace stillframe::viewer {

/// A picture that a SceneWidget is taking, a step at a time: drawn first, then read back. GUI thread, with the view's
/// context current.
class PictureJob {
 public:
  PictureJob(scenegraph::ViewPipeline& pipeline, const PictureRequest& request, scenegraph::RenderOptions options,
             const scenegraph::CameraView& view)
      : request_(request), view_(view), options_(std::move(options)), pipeline_(pipeline) {}

  std::expected<void, scenegraph::Status> step();
  /// Of the work, 0 to 1.
  [[nodiscard]] double share() const;
  [[nodiscard]] bool isDone() const { return reader_ && reader_->isDone(); }
  [[nodiscard]] const PictureRequest& request() const noexcept { return request_; }
  [[nodiscard]] const scenegraph::CameraView& view() const noexcept { return view_; }
  [[nodiscard]] scenegraph::Picture take() { return reader_ ? reader_->take() : scenegraph::Picture{}; }

 private:
  PictureRequest request_;
  scenegraph::CameraView view_;
  scenegraph::RenderOptions options_;
  scenegraph::ViewPipeline& pipeline_;
  std::optional<scenegraph::PictureReader> reader_;  // once it is drawn
};

}  // namespace stillframe::viewer
