// Opens the input as a recording, loads it and decodes every message of it.
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "tools/ingest/recording.h"

using namespace stillframe;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const int descriptor = ::memfd_create("recording", MFD_CLOEXEC);
  if (descriptor < 0 || ::write(descriptor, data, size) != static_cast<ssize_t>(size)) {
    return 0;
  }
  const std::filesystem::path path = "/proc/self/fd/" + std::to_string(descriptor);
  if (auto recording = ingest::Recording::open(std::span(&path, 1))) {
    (*recording)->load();
    static_cast<void>((*recording)->topics());
    const auto& store = (*recording)->dataset()->store();
    for (scenegraph::TopicId topic = 0; topic < store.topicCount(); ++topic) {
      for (std::size_t i = 0; i < store.entryCount(topic); ++i) {
        static_cast<void>(store.decode(topic, *store.at(topic, i)));
      }
    }
  }
  ::close(descriptor);
  return 0;
}
