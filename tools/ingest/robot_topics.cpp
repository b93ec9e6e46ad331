#include "tools/ingest/robot_topics.h"

#include <array>
#include <functional>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "scenegraph/objects/robot_description.h"
#include "tools/ingest/converters/robot_text.h"
#include "tools/ingest/file.h"
#include "tools/ingest/sentence.h"

namespace stillframe::ingest {
namespace {

using scenegraph::AnyObject;
using scenegraph::Dataset;
using scenegraph::DecodeError;
using scenegraph::ObjectType;
using scenegraph::RobotDescription;
using scenegraph::Status;
using scenegraph::StatusLevel;

constexpr std::uint64_t kMaxRobotBytes = std::uint64_t{16} << 20U;

/// The one message of a topic that no recording holds.
class RobotSource final : public scenegraph::EntrySource {
 public:
  using Read = std::function<std::expected<std::string, DecodeError>()>;
  RobotSource(Read read, std::string file) : read_(std::move(read)), file_(std::move(file)) {}
  [[nodiscard]] std::expected<AnyObject, DecodeError> decode(const scenegraph::TopicInfo& /*topic*/,
                                                             const scenegraph::Entry& /*entry*/) const override {
    auto text = read_();
    if (!text) {
      return std::unexpected(text.error());
    }
    RobotDescription robot{
        .format = std::string(converters::robotFormat(*text)), .text = std::move(*text), .file = file_};
    return AnyObject::make(std::move(robot));
  }

 private:
  Read read_;
  std::string file_;
};

void addTopic(Dataset& dataset, const std::string& name, std::uint64_t bytes, RobotSource::Read read,
              std::string file) {
  const auto range = dataset.timeRange();
  if (!range) {
    return;
  }
  const scenegraph::TopicId topic =
      dataset.store().addTopic({.name = name,
                                .type = ObjectType::RobotDescription,
                                .schema = "urdf",
                                .encoding = "xml",
                                .unsupported_reason = "",
                                .is_static = false},
                               std::make_shared<const RobotSource>(std::move(read), std::move(file)));
  const std::array entries{scenegraph::Entry{.log_time = range->first, .payload_bytes = bytes}};
  dataset.store().append(topic, entries);
}

bool isRobot(const scenegraph::Resources::Attachment& attachment) {
  return attachment.name.ends_with(".urdf") || attachment.media_type.find("urdf") != std::string::npos ||
         attachment.name == "robot_description" || attachment.name.ends_with("/robot_description");
}

}  // namespace

std::expected<void, Status> addRobotFile(Dataset& dataset, const std::filesystem::path& file) {
  std::error_code error;
  const auto path = std::filesystem::absolute(file, error).lexically_normal();
  const auto opened = File::open(path);
  if (!opened) {
    return std::unexpected(opened.error());
  }
  const std::uint64_t size = (*opened)->size();
  if (size > kMaxRobotBytes) {
    return std::unexpected(
        Status{StatusLevel::Error, "TooLarge",
               sentence("'", file.string(), "' has ", size, " bytes, a robot description at most ", kMaxRobotBytes)});
  }
  addTopic(
      dataset, "robot:" + file.filename().string(), size,
      [opened = *opened, size]() -> std::expected<std::string, DecodeError> {
        std::string text(size, '\0');
        text.resize(opened->read(0, std::as_writable_bytes(std::span(text))));
        return text;
      },
      path.string());
  return {};
}

void addAttachedRobots(Dataset& dataset) {
  for (const auto& attachment : dataset.resources().attachments()) {
    if (!isRobot(attachment) || attachment.bytes > kMaxRobotBytes) {
      continue;
    }
    addTopic(dataset, "attachment:" + attachment.name, attachment.bytes,
             [read = attachment.read]() -> std::expected<std::string, DecodeError> {
               const auto payload = read();
               if (!payload) {
                 return std::unexpected(DecodeError{"BadAttachment", payload.error()});
               }
               return std::string(reinterpret_cast<const char*>(payload->bytes.data()), payload->bytes.size());
             },
             {});
  }
}

}  // namespace stillframe::ingest
