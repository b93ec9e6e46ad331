#pragma once

#include <cstdint>
#include <expected>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "scenegraph/objects/object.h"
#include "scenegraph/store/dataset.h"

namespace stillframe::bench {

/// Messages in memory; the locator is their number.
class MessagesInMemory final : public scenegraph::EntrySource {
 public:
  explicit MessagesInMemory(std::vector<scenegraph::AnyObject> messages) : messages_(std::move(messages)) {}
  [[nodiscard]] std::expected<scenegraph::AnyObject, scenegraph::DecodeError> decode(
      const scenegraph::TopicInfo& /*topic*/, const scenegraph::Entry& entry) const override {
    return messages_.at(entry.locator);
  }

 private:
  std::vector<scenegraph::AnyObject> messages_;
};

/// Adds a topic of these messages, `spacing_ns` apart from 0 on.
inline void addTopic(scenegraph::Dataset& dataset, const std::string& name, scenegraph::ObjectType type,
                     std::vector<scenegraph::AnyObject> messages, std::int64_t spacing_ns = 1) {
  std::vector<scenegraph::Entry> entries;
  for (std::size_t i = 0; i < messages.size(); ++i) {
    entries.push_back({.log_time = {static_cast<std::int64_t>(i) * spacing_ns}, .payload_bytes = 1, .locator = i});
  }
  scenegraph::TopicInfo info;
  info.name = name;
  info.type = type;
  const auto topic = dataset.store().addTopic(std::move(info), std::make_shared<MessagesInMemory>(std::move(messages)));
  dataset.store().append(topic, entries);
}

}  // namespace stillframe::bench
