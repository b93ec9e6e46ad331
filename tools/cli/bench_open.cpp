#include <algorithm>
#include <array>
#include <atomic>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "scenegraph/stopwatch.h"
#include "scenegraph/thread_priority.h"
#include "tools/cli/bench_results.h"
#include "tools/cli/bench_view.h"
#include "tools/ingest/mcap_file.h"
#include "tools/ingest/mcap_source.h"

namespace stillframe::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kOpenings = 5;  // each beside reading; the shortest of both counts

/// The chunks that the clouds of that instant lie in, largest first.
std::vector<ingest::ChunkPlace> chunksOfClouds(const ingest::McapFile& file, const scenegraph::ObjectStore& store,
                                               tf::TimePoint time) {
  std::set<std::uint32_t> numbers;
  for (scenegraph::TopicId topic = 0; topic < store.topicCount(); ++topic) {
    const auto entry = isCloud(store, topic) ? store.newestAtOrBefore(topic, time) : std::nullopt;
    if (entry) {
      numbers.insert(ingest::Locator::unpack(entry->locator).chunk);
    }
  }
  std::vector<ingest::ChunkPlace> chunks;
  for (const std::uint32_t number : numbers) {
    if (number < file.chunks().size()) {
      chunks.push_back(file.chunks()[number]);
    }
  }
  std::ranges::sort(chunks, std::ranges::greater{}, &ingest::ChunkPlace::length);
  return chunks;
}

/// What any reader has to do for them: each read piece by piece and unpacked, as many at a time as there are cores. No
/// index is read, no sum is checked, nothing is parsed.
double readingMs(const ingest::McapFile& file, const std::vector<ingest::ChunkPlace>& chunks) {
  const auto executor = scenegraph::makeThreadPoolExecutor(std::thread::hardware_concurrency());
  const Clock::time_point start = Clock::now();
  for (const ingest::ChunkPlace& place : chunks) {
    executor->submit([&file, &place] {
      constexpr std::size_t kHead = 128;  // bytes of record and chunk header, and more
      std::array<std::byte, kHead> head{};
      (void)file.file().read(place.offset, head);
      if (const auto header = ingest::parseChunkHeader(std::span(head).subspan(ingest::kRecordHeaderBytes))) {
        const std::uint64_t from = place.offset + ingest::kRecordHeaderBytes + header->header_bytes;
        const ingest::PackedBytes packed{
            static_cast<std::size_t>(header->packed_size),
            [&](std::size_t position, std::span<std::byte> into) { return file.file().read(from + position, into); }};
        (void)ingest::decompress(ingest::compressionFromName(header->compression).value_or(ingest::Compression::None),
                                 packed, header->uncompressed_size);
      }
    });
  }
  executor->drain();
  return scenegraph::millisecondsSince(start);
}

/// What there is to see, once everything is loaded.
struct FirstPicture {
  tf::TimePoint time;
  std::vector<ingest::ChunkPlace> chunks;  ///< that the clouds lie in
  std::vector<std::string> status_codes;   ///< of the layers
};

Result<FirstPicture> findFirstPicture(const RecordingOptions& options, const ingest::McapFile& file) {
  const auto recording = openRecording(options);
  if (!recording) {
    return std::unexpected(recording.error());
  }
  const auto& dataset = (*recording)->dataset();
  const auto time = firstCloudInstant(dataset->store());
  if (!time) {
    return failure(options.file + ": the recording holds no clouds");
  }
  auto renderer = scenegraph::OffscreenRenderer::create();
  if (!renderer) {
    return failure(renderer.error().message);
  }
  BenchView view(dataset, std::move(*renderer));
  if (const auto shown = view.go(*time); !shown) {
    return std::unexpected(shown.error());
  }
  return FirstPicture{*time, chunksOfClouds(file, dataset->store(), *time), view.statusCodes()};
}

/// What one opening took, from the file's name on.
struct Opening {
  double picture_ms = 0.0;  ///< to the first picture of the clouds, at their places
  double loaded_ms = 0.0;   ///< to the last transform of the recording
};

/// As the window does it: the recording is loaded on a thread of its own, and the view looks each time that grew.
Result<Opening> openOnce(const RecordingOptions& options, const FirstPicture& first) {
  auto renderer = scenegraph::OffscreenRenderer::create();  // the window is there, and painted
  if (!renderer) {
    return failure(renderer.error().message);
  }
  const osg::ref_ptr<osg::Group> nothing = new osg::Group;
  if (const auto painted = (*renderer)->show(*nothing, {}, {}); !painted) {
    return failure(painted.error().message);
  }
  const Clock::time_point start = Clock::now();
  const std::array files{std::filesystem::path(options.file)};
  const auto recording = ingest::Recording::open(files, options.clock);
  if (!recording) {
    return std::unexpected(fileError(options.file, recording.error()));
  }
  Opening opening;
  BenchView view((*recording)->dataset(), std::move(*renderer));
  std::atomic<bool> is_loaded = false;
  std::jthread loader([&, wake = view.requester()] {
    scenegraph::standBack(scenegraph::StandBack::Loading);
    (*recording)->load([&](double) {
      wake();
      return true;
    });
    opening.loaded_ms = scenegraph::millisecondsSince(start);
    is_loaded = true;
    wake();
  });
  const auto begun = view.draw();  // of nothing: the view is there before the data
  const double begun_ms = scenegraph::millisecondsSince(start);
  const auto shown = view.go(first.time, [&] { return view.statusCodes() == first.status_codes || is_loaded; });
  loader.join();
  if (!begun || !shown) {
    return std::unexpected(!begun ? begun.error() : shown.error());
  }
  opening.picture_ms = begun_ms + shown->picture_ms;
  return opening;
}

}  // namespace

Result<void> benchOpen(const RecordingOptions& options, std::vector<BenchResult>& results) {
  const auto file = ingest::McapFile::open(options.file);
  if (!file) {
    return std::unexpected(fileError(options.file, file.error()));
  }
  const auto first = findFirstPicture(options, **file);
  if (!first) {
    return std::unexpected(first.error());
  }
  std::uint64_t packed = 0;
  std::uint64_t unpacked = 0;
  for (const ingest::ChunkPlace& chunk : first->chunks) {
    packed += chunk.length;
    unpacked += chunk.size;
  }
  double reading_ms = std::numeric_limits<double>::infinity();
  Opening best{reading_ms, reading_ms};
  for (int i = 0; i < kOpenings; ++i) {
    reading_ms = std::min(reading_ms, readingMs(**file, first->chunks));
    const auto opening = openOnce(options, *first);
    if (!opening) {
      return std::unexpected(opening.error());
    }
    best.picture_ms = std::min(best.picture_ms, opening->picture_ms);
    best.loaded_ms = std::min(best.loaded_ms, opening->loaded_ms);
  }
  const std::string name = "open " + std::to_string(((*file)->file().size() + 500'000) / 1'000'000) + " MB, ";
  results.push_back({name + "read for the first picture", static_cast<double>(packed) * 1e-6, "MB"});
  results.push_back({name + "the same unpacked", static_cast<double>(unpacked) * 1e-6, "MB"});
  results.push_back({name + "reading and unpacking that alone", reading_ms, "ms"});
  results.push_back({name + "to the first picture", best.picture_ms, "ms"});
  results.push_back({name + "first picture / reading", best.picture_ms / reading_ms, "", 1.3});
  results.push_back({name + "to the last transform", best.loaded_ms, "ms"});
  return {};
}

}  // namespace stillframe::cli
