// Pictures of what SceneWidget shows, for files.
#include <algorithm>

#include "nodes/legend/picture_overlay.h"
#include "scenegraph/pick/place_picks.h"
#include "scenegraph/pipeline/gl_context_info.h"
#include "viewer/pick/view_picks.h"
#include "viewer/widget/picture_request.h"
#include "viewer/widget/scene_widget.h"

namespace stillframe::viewer {

std::expected<scenegraph::Picture, scenegraph::Status> SceneWidget::takePicture(const PictureRequest& request) {
  if (!is_context_usable_ || pipeline_ == nullptr) {
    return std::unexpected(
        scenegraph::Status{scenegraph::StatusLevel::Error, "NotDrawn", "the view has not been drawn yet"});
  }
  makeCurrent();
  const auto info = scenegraph::inspectCurrentContext();
  scenegraph::RenderOptions options{.width = request.width_px,
                                    .height = request.height_px,
                                    .background = background_,
                                    .post = request.is_scene_linear ? effects_.linearChain() : effects_.chain()};
  if (request.is_transparent) {
    options.background.a = 0.0F;
  }
  const auto picture = [&]() -> std::expected<scenegraph::Picture, scenegraph::Status> {
    if (!info) {
      return std::unexpected(info.error());
    }
    if (const auto checked = scenegraph::checkPicture(options, info->max_texture_size); !checked) {
      return std::unexpected(checked.error());
    }
    const scenegraph::CameraView view = shownView();
    // Points, lines and names as large against the picture as they are against the view.
    const scenegraph::PictureSize size{static_cast<double>(request.width_px), static_cast<double>(request.height_px),
                                       static_cast<double>(request.height_px) / std::max(1, height())};
    if (scene_ != nullptr) {
      scene_->setView(view, size);
    }
    pipeline_->setView(view);
    if (const auto drawn = scenegraph::drawPicture(*pipeline_, options); !drawn) {
      return std::unexpected(drawn.error());
    }
    auto read = scenegraph::readPicture(*pipeline_, options);
    if (read && scene_ != nullptr && !request.is_scene_linear) {
      nodes::PictureOverlay overlay(read->rgba, read->width, read->height, size.pixel_ratio);
      if (request.has_picks) {
        overlay.addPicks(scenegraph::placePicks(*scene_, view, size, picks().marks()));
      }
      if (request.has_legend) {
        overlay.addLegends(nodes::legendEntries(*scene_));
      }
    }
    return read;
  }();
  pipeline_->setPostChain(effects_.chain());
  doneCurrent();
  update();  // the pipeline's targets are of the picture's size now
  return picture;
}

}  // namespace stillframe::viewer
