#pragma once

#include <cstdint>
#include <expected>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>

#include "scenegraph/status.h"
#include "scenegraph/store/dataset.h"

namespace stillframe::ingest {

/// An MCAP recording (or the several files of a split one) on its way into a Dataset.
///
/// open() reads only headers and summaries, so that the time range and the topics are known at once however large the
/// file is; load() reads the message indexes and the transforms. Files without a summary are scanned by open().
class Recording {
 public:
  /// Fails when a file cannot be opened or is no MCAP at all; damage inside is a problem of the dataset instead.
  [[nodiscard]] static std::expected<std::unique_ptr<Recording>, scenegraph::Status> open(
      std::span<const std::filesystem::path> files, scenegraph::TfClock clock = scenegraph::TfClock::Auto);
  virtual ~Recording() = default;

  [[nodiscard]] virtual const std::shared_ptr<scenegraph::Dataset>& dataset() const = 0;
  /// Fills the dataset: message indexes of every drawable topic, then transforms in bulk. Blocks: a worker's job for a
  /// window. `progress` is called with a fraction 0..1; returning false stops early (and load() may be called again).
  virtual void load(const std::function<bool(double)>& progress = {}) = 0;
  /// What the file says of its topics, for `info`: counts and times come from the file's statistics or its index.
  struct TopicSummary {
    std::string name;
    std::string schema;
    std::string encoding;
    scenegraph::ObjectType type = scenegraph::ObjectType::None;
    std::string unsupported_reason;
    std::uint64_t count = 0;
    tf::TimePoint first;  ///< meaningful when count > 0
    tf::TimePoint last;
  };
  /// In order of name. Exact after load().
  [[nodiscard]] virtual std::vector<TopicSummary> topics() const = 0;
  struct Attachment {
    std::string name;
    std::string media_type;
    std::uint64_t bytes = 0;
    tf::TimePoint log_time;
  };
  [[nodiscard]] virtual std::vector<Attachment> attachments() const = 0;
  /// Metadata records by name.
  [[nodiscard]] virtual std::vector<std::string> metadataNames() const = 0;
};

}  // namespace stillframe::ingest
