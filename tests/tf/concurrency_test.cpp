// Bounded, so that it says the same on every machine; its teeth are in the ThreadSanitizer build.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <thread>

#include "tf/reader_gate.h"
#include "tf/transform_buffer.h"
#include "tf_builders.h"

namespace stillframe::tf {
namespace {

constexpr int kReaders = 8;

TEST(ReaderGate, KeepsReadersOutWhileClosed) {
  ReaderGate gate;
  std::array<std::int64_t, 4> guarded{};
  std::atomic<int> torn{0};
  {
    std::vector<std::jthread> threads;
    for (int reader = 0; reader < kReaders; ++reader) {
      threads.emplace_back([&] {
        for (int i = 0; i < 5000; ++i) {
          gate.lock_shared();
          torn += guarded.front() == guarded.back() ? 0 : 1;
          gate.unlock_shared();
        }
      });
    }
    for (std::int64_t i = 0; i < 2000; ++i) {
      const GateClosure closure(gate);
      guarded.fill(i);
    }
  }
  EXPECT_EQ(torn, 0);
}

/// Every pose carries its stamp, so that a reader can tell whether an answer belongs to its question.
RigidTransform stamped(std::int64_t stamp) { return translate(static_cast<double>(stamp), 0, 0); }

TEST(TransformBufferThreads, EightReadersAndTwoWritersSeeOnlyWholeAnswers) {
  constexpr std::int64_t kSamples = 3000;
  TransformBuffer buffer;
  ASSERT_TRUE(buffer.insert(sample("map", "single", 0, stamped(0))));
  ASSERT_TRUE(buffer.insert(sample("map", "bulk", 0, stamped(0))));
  std::atomic<int> wrong{0};
  {
    std::vector<std::jthread> threads;
    threads.emplace_back([&] {
      for (std::int64_t i = 1; i <= kSamples; ++i) {
        wrong += buffer.insert(sample("map", "single", i * 10, stamped(i * 10))) ? 0 : 1;
      }
    });
    threads.emplace_back([&] {
      std::vector<std::string> names;
      for (std::size_t i = 0; i < 50; ++i) {
        names.push_back(numbered("new_", i));
      }
      for (std::int64_t first = kSamples - 100; first >= 0; first -= 100) {  // blocks come newest first
        std::vector<TransformSample> samples;
        for (std::int64_t i = first; i < first + 100; ++i) {
          samples.push_back(sample("map", "bulk", i * 10, stamped(i * 10)));
        }
        samples.push_back(sample("bulk", names[static_cast<std::size_t>(first / 100) % names.size()], 0));
        wrong += static_cast<int>(buffer.insertBulk(samples).refused);
        buffer.pack();
      }
    });
    for (int reader = 0; reader < kReaders; ++reader) {
      threads.emplace_back([&, reader] {
        std::mt19937_64 random(static_cast<unsigned>(reader));
        Snapshot snapshot;
        for (int i = 0; i < 1500; ++i) {
          const TimePoint time{static_cast<std::int64_t>(random() % (kSamples * 10))};
          for (const char* frame : {"single", "bulk"}) {
            const auto found = buffer.tryLookupTransform("map", frame, time);
            const double stamp = found ? found->translation.x : -1.0;
            wrong += stamp >= 0.0 && stamp <= static_cast<double>(time.ns) && std::fmod(stamp, 10.0) == 0.0 ? 0 : 1;
          }
          if (i % 50 == reader) {
            buffer.snapshot(0, time, snapshot);
            wrong += snapshot.root_from_frame.size() >= 3 && snapshot.revision <= buffer.revision() ? 0 : 1;
            wrong += buffer.frames().size() >= snapshot.root_from_frame.size() ? 0 : 1;
            wrong += buffer.edge(1)->samples > 0 && buffer.roots().size() == 1 ? 0 : 1;
          }
        }
      });
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(buffer.edge(*buffer.findFrame("single"))->samples, static_cast<std::size_t>(kSamples) + 1);
  EXPECT_EQ(buffer.edge(*buffer.findFrame("bulk"))->samples, static_cast<std::size_t>(kSamples));
}

TEST(TransformBufferThreads, ReadersGetThroughWhileAWriterNeverRests) {
  TransformBuffer buffer;
  std::vector<TransformSample> samples;
  for (std::int64_t i = 0; i < 2000; ++i) {
    samples.push_back(sample("map", "base", i, stamped(i)));
  }
  buffer.insertBulk(samples);
  std::jthread writer([&](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      buffer.insertBulk(samples);
    }
  });
  int found = 0;
  for (int i = 0; i < 2000; ++i) {
    found += buffer.tryLookupTransform("map", "base", TimePoint{i}) ? 1 : 0;
  }
  EXPECT_EQ(found, 2000);
}

}  // namespace
}  // namespace stillframe::tf
