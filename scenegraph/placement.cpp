#include "scenegraph/placement.h"

#include <string>
#include <vector>

#include "scenegraph/near_names.h"
#include "scenegraph/store/tf_clock.h"

namespace stillframe::scenegraph {
namespace {

std::string unknownTarget(const FrameGraph& frames, std::string_view frame) {
  const tf::TransformBuffer& buffer = frames.buffer();
  if (buffer.frameCount() == 0) {
    return "there are no transforms, so that '" + std::string(frame) + "' has no place in '" + frames.fixedFrame() +
           "'; choose '" + std::string(frame) + "' as fixed frame to see its data alone";
  }
  std::string message = "the fixed frame '" + frames.fixedFrame() + "' does not exist";
  if (const auto near = nearNames(frames.fixedFrame(), buffer.frames()); !near.empty()) {
    return message + "; did you mean " + quotedList(near) + "?";
  }
  std::vector<std::string> roots;
  for (const tf::FrameId root : buffer.roots()) {
    roots.push_back(buffer.frameName(root));
  }
  return message + (roots.size() == 1 ? "; the root is " : "; the roots are ") + quotedList(roots);
}

std::string noSample(const tf::TransformBuffer& buffer, const tf::LookupFailure& failure) {
  std::string message = buffer.describe(failure);
  const auto edge = buffer.edge(failure.edge_child);
  if (!edge || (edge->is_static && buffer.isStaticForAllTime())) {
    return message;
  }
  message += std::string("; the ") + (edge->is_static ? "static " : "") + "transform '" + edge->parent + "' -> '" +
             edge->child + "' comes first at " + timeText(edge->first) + ": ";
  message += edge->is_static ? "switch on 'static transforms hold for all time'" : "go there, or to a later time";
  return message;
}

std::string rootOf(const tf::TransformBuffer& buffer, std::string_view frame) {
  const auto found = buffer.findFrame(frame);
  tf::FrameId root = found.value_or(tf::kNoFrame);
  for (std::size_t steps = buffer.frameCount(); found && steps > 0 && buffer.parent(root) != tf::kNoFrame; --steps) {
    root = buffer.parent(root);
  }
  return found ? buffer.frameName(root) : std::string(frame);
}

std::string reason(const FrameGraph& frames, std::string_view frame, const tf::LookupFailure& failure) {
  switch (failure.code) {
    case tf::LookupError::UnknownTarget:
      return unknownTarget(frames, frame);
    case tf::LookupError::UnknownSource:
      return frame.empty() ? "the data names no frame (its frame_id is empty)"
                           : "no transform names the frame '" + std::string(frame) + "' of the data; choose '" +
                                 std::string(frame) + "' as fixed frame to see it alone";
    case tf::LookupError::Disconnected:
      return frames.buffer().describe(failure) + "; choose '" + rootOf(frames.buffer(), frame) +
             "' as fixed frame to see the tree of the data";
    case tf::LookupError::NoSampleAtTime:
      return noSample(frames.buffer(), failure);
  }
  return {};
}

}  // namespace

Status placementStatus(const FrameGraph& frames, std::string_view frame, const tf::LookupFailure& failure) {
  return {StatusLevel::Warn, std::string(tf::toString(failure.code)), reason(frames, frame, failure)};
}

}  // namespace stillframe::scenegraph
