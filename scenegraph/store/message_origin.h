#pragma once

#include <memory>
#include <string>
#include <utility>

#include "scenegraph/store/dataset.h"

namespace stillframe::scenegraph {

/// Where a message came from: so that what is made of it need not keep it.
struct MessageOrigin {
  std::weak_ptr<Dataset> dataset;  ///< which keeps what is made of the message
  std::string topic;
  ObjectType type = ObjectType::None;
  Entry entry;

  /// The message once more; an empty one when it cannot be read any longer. May block on the disk. Any thread.
  [[nodiscard]] AnyObject read() const {
    const auto owner = dataset.lock();
    const auto id = owner != nullptr ? owner->store().findTopic(topic, type) : std::nullopt;
    auto object = id ? owner->store().decode(*id, entry) : std::unexpected(DecodeError{});
    return object ? std::move(*object) : AnyObject();
  }
};

}  // namespace stillframe::scenegraph
