#include "tools/ingest/recording.h"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "tools/ingest/mcap_file.h"
#include "tools/ingest/mcap_source.h"
#include "tools/ingest/robot_topics.h"
#include "tools/ingest/sentence.h"

namespace stillframe::ingest {

namespace {

using scenegraph::Dataset;
using scenegraph::Entry;
using scenegraph::Status;
using scenegraph::TopicId;

constexpr std::size_t kEntriesPerAppend = 1 << 16;
constexpr double kIndexShare = 0.3;  // of the progress; the transforms have the rest

/// Counts and times of a topic as messages are found.
struct Tally {
  std::uint64_t count = 0;
  std::uint64_t first = 0;
  std::uint64_t last = 0;
  void add(std::uint64_t log_time) {
    first = count == 0 ? log_time : std::min(first, log_time);
    last = count == 0 ? log_time : std::max(last, log_time);
    ++count;
  }
};

class McapRecording final : public Recording {
 public:
  McapRecording(std::vector<std::shared_ptr<McapFile>> files, const std::string& name, scenegraph::TfClock clock)
      : files_(std::move(files)),
        source_(
            std::make_shared<McapSource>(std::vector<std::shared_ptr<const McapFile>>(files_.begin(), files_.end()))),
        dataset_(std::make_shared<Dataset>(name)) {
    dataset_->setTfClock(clock);
    addTopics();
    summarize();
    addAttachments();
    reportProblems();
  }

  [[nodiscard]] const std::shared_ptr<Dataset>& dataset() const override { return dataset_; }

  void load(const std::function<bool(double)>& progress) override {
    const auto isWanted = [&](double fraction) { return !progress || progress(fraction); };
    for (; next_file_ < files_.size(); ++next_file_, next_chunk_ = 0, file_tally_ = 0) {
      McapFile& file = *files_[next_file_];
      std::vector<FoundMessage> found;
      if (file.isScanned()) {
        found = file.scannedMessages();
      } else {
        for (; next_chunk_ < file.chunks().size(); ++next_chunk_) {
          file.listMessages(next_chunk_, found);
          if (found.size() >= kEntriesPerAppend) {
            append(found);
            const double done = static_cast<double>(next_chunk_ + 1) / static_cast<double>(file.chunks().size());
            if (!isWanted(kIndexShare * (static_cast<double>(next_file_) + done) /
                          static_cast<double>(files_.size()))) {
              ++next_chunk_;
              return;
            }
          }
        }
      }
      append(found);
      compareWithStatistics(file);
      reportProblems();
    }
    is_indexed_ = true;
    dataset_->takeTransforms([&](std::uint64_t done, std::uint64_t all) {
      const double part = all == 0 ? 1.0 : static_cast<double>(done) / static_cast<double>(all);
      return isWanted(kIndexShare + (1.0 - kIndexShare) * part);
    });
    static_cast<void>(isWanted(1.0));
  }

  [[nodiscard]] std::vector<TopicSummary> topics() const override {
    std::vector<TopicSummary> topics;
    for (const auto& [key, topic] : topics_) {
      TopicSummary summary = topic.summary;
      if (is_indexed_) {
        summary.count = topic.tally.count;
        summary.first = toTimePoint(topic.tally.first);
        summary.last = toTimePoint(topic.tally.last);
      }
      topics.push_back(std::move(summary));
    }
    return topics;
  }

  [[nodiscard]] std::vector<Attachment> attachments() const override {
    std::vector<Attachment> attachments;
    for (const auto& file : files_) {
      for (const AttachmentIndexRecord& record : file->attachments()) {
        attachments.push_back({record.name, record.media_type, record.data_size, toTimePoint(record.log_time)});
      }
    }
    return attachments;
  }

  [[nodiscard]] std::vector<std::string> metadataNames() const override {
    std::vector<std::string> names;
    for (const auto& file : files_) {
      names.insert(names.end(), file->metadataNames().begin(), file->metadataNames().end());
    }
    return names;
  }

 private:
  struct Topic {
    TopicSummary summary;
    Tally tally;  ///< exact, of what load() has seen so far
    TopicId id = 0;
    std::vector<Entry> pending;
  };

  void addTopics() {
    for (std::size_t file = 0; file < files_.size(); ++file) {
      auto& of_channel = topic_of_channel_.emplace_back();
      for (const auto& [id, channel] : source_->channels(file)) {
        const ChannelRecord& record = files_[file]->channels().at(id);
        const auto [known, is_new] = topics_.try_emplace({channel.topic, channel.schema, record.message_encoding});
        Topic& topic = known->second;
        if (is_new) {
          const bool is_static = channel.topic.ends_with("tf_static");
          topic.summary.name = channel.topic;
          topic.summary.schema = channel.schema;
          topic.summary.encoding = record.message_encoding;
          topic.summary.type = channel.decoder.type;
          topic.summary.unsupported_reason = channel.decoder.unsupported_reason;
          topic.id =
              dataset_->store().addTopic({channel.topic, channel.decoder.type, channel.schema, record.message_encoding,
                                          channel.decoder.unsupported_reason, is_static},
                                         source_);
        }
        of_channel[id] = &topic;
      }
    }
  }

  /// Counts and times before the messages are known: from statistics, chunk indexes, or the scan that has been done.
  void summarize() {
    std::optional<std::pair<std::uint64_t, std::uint64_t>> range;
    const auto widen = [](auto& span, std::uint64_t first, std::uint64_t last) {
      span = span ? std::pair(std::min(span->first, first), std::max(span->second, last)) : std::pair(first, last);
    };
    for (std::size_t file = 0; file < files_.size(); ++file) {
      std::map<Topic*, std::optional<std::pair<std::uint64_t, std::uint64_t>>> spans;
      const auto topicOf = [&](std::uint16_t channel) {
        const auto found = topic_of_channel_[file].find(channel);
        return found == topic_of_channel_[file].end() ? nullptr : found->second;
      };
      for (const FoundMessage& message : files_[file]->scannedMessages()) {
        widen(range, message.log_time, message.log_time);
        if (Topic* topic = topicOf(message.channel)) {
          widen(spans[topic], message.log_time, message.log_time);
          ++topic->summary.count;
        }
      }
      if (const auto& statistics = files_[file]->statistics(); statistics && statistics->message_count > 0) {
        widen(range, statistics->start_time, statistics->end_time);
        for (const auto& [channel, count] : statistics->channel_counts) {
          if (Topic* topic = topicOf(channel)) {
            topic->summary.count += count;
          }
        }
      }
      for (const ChunkPlace& chunk : files_[file]->chunks()) {
        if (!files_[file]->isScanned() && !chunk.channels.empty()) {
          widen(range, chunk.start_time, chunk.end_time);
        }
        for (const std::uint16_t channel : chunk.channels) {
          widen(spans[topicOf(channel)], chunk.start_time, chunk.end_time);
        }
      }
      for (const auto& [topic, span] : spans) {
        if (topic != nullptr && span) {
          const bool is_first = topic->summary.first.ns == 0 && topic->summary.last.ns == 0;
          topic->summary.first =
              is_first ? toTimePoint(span->first) : std::min(topic->summary.first, toTimePoint(span->first));
          topic->summary.last = std::max(topic->summary.last, toTimePoint(span->second));
        }
      }
    }
    if (range) {
      dataset_->setTimeRange(toTimePoint(range->first), toTimePoint(range->second));
    }
  }

  /// Makes the attachments' files known to those who look for them.
  void addAttachments() {
    for (const auto& file : files_) {
      for (const AttachmentIndexRecord& record : file->attachments()) {
        dataset_->resources().addAttachment(
            {.name = record.name,
             .media_type = record.media_type,
             .bytes = record.data_size,
             .read = [opened = file->sharedFile(), record]() -> std::expected<scenegraph::Payload, std::string> {
               auto bytes = McapFile::readAttachment(*opened, record);
               if (!bytes) {
                 return std::unexpected(bytes.error());
               }
               const auto held = std::make_shared<const std::vector<std::byte>>(std::move(*bytes));
               return scenegraph::Payload{*held, held};
             }});
      }
    }
    addAttachedRobots(*dataset_);
  }

  /// Hands messages of the present file to the store, and clears them.
  void append(std::vector<FoundMessage>& found) {
    const std::string& path = files_[next_file_]->file().path();
    ProblemLog& problems = files_[next_file_]->problems();
    file_tally_ += found.size();
    for (const FoundMessage& message : found) {
      const auto channel = topic_of_channel_[next_file_].find(message.channel);
      if (channel == topic_of_channel_[next_file_].end()) {
        dataset_->addProblem(
            {"UnknownChannel",
             sentence("messages of '", path, "' name the channel ", message.channel, ", which it does not describe"),
             1});
        continue;
      }
      Topic& topic = *channel->second;
      topic.tally.add(message.log_time);
      const auto locator = Locator{next_file_, message.chunk, message.offset}.pack();
      if (!locator) {
        problems.add("TooLarge", sentence("the message at offset ", message.offset, " of '", path,
                                          "' lies beyond what can be addressed"));
      } else if (topic.summary.type != scenegraph::ObjectType::None) {
        topic.pending.push_back({toTimePoint(message.log_time), message.bytes, *locator, 0});
      }
    }
    found.clear();
    for (auto& [key, topic] : topics_) {
      if (!topic.pending.empty()) {
        dataset_->store().append(topic.id, topic.pending);
        topic.pending.clear();
      }
    }
  }

  void compareWithStatistics(const McapFile& file) {
    if (const auto& statistics = file.statistics(); statistics && statistics->message_count != file_tally_) {
      dataset_->addProblem({"StatisticsMismatch",
                            sentence("the statistics of '", file.file().path(), "' count ", statistics->message_count,
                                     " messages, its chunks hold ", file_tally_),
                            1});
    }
  }

  void reportProblems() {
    for (const auto& file : files_) {
      for (const scenegraph::Problem& problem : file->problems().take()) {
        dataset_->addProblem(problem);
      }
    }
  }

  std::vector<std::shared_ptr<McapFile>> files_;
  std::shared_ptr<const McapSource> source_;
  std::shared_ptr<Dataset> dataset_;
  std::map<std::tuple<std::string, std::string, std::string>, Topic> topics_;  // by name, schema, encoding
  std::vector<std::map<std::uint16_t, Topic*>> topic_of_channel_;              // per file
  std::size_t next_file_ = 0;                                                  // where load() goes on
  std::size_t next_chunk_ = 0;
  std::uint64_t file_tally_ = 0;
  bool is_indexed_ = false;
};

}  // namespace

std::expected<std::unique_ptr<Recording>, Status> Recording::open(std::span<const std::filesystem::path> files,
                                                                  scenegraph::TfClock clock) {
  if (files.empty() || files.size() > Locator::kMaxFiles) {
    return std::unexpected(Status{scenegraph::StatusLevel::Error, "CannotOpen",
                                  sentence("a recording has 1 to ", Locator::kMaxFiles, " files, not ", files.size())});
  }
  std::vector<std::shared_ptr<McapFile>> opened;
  for (const std::filesystem::path& path : files) {
    auto file = McapFile::open(path);
    if (!file) {
      return std::unexpected(std::move(file).error());
    }
    opened.push_back(*std::move(file));
  }
  return std::make_unique<McapRecording>(std::move(opened), files[0].filename().string(), clock);
}

}  // namespace stillframe::ingest
