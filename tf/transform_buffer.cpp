#include "tf/transform_buffer.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <mutex>
#include <shared_mutex>

#include "tf/reader_gate.h"
#include "tf/transform_tree.h"

namespace stillframe::tf {

struct TransformBuffer::Impl {
  /// Samples that a bulk insert checks at a time, with the gate open, and stores per closing of the gate: a few
  /// microseconds, about as long as a lookup takes.
  static constexpr std::size_t kBatch = 256;
  static constexpr std::size_t kClosing = 32;

  std::mutex writer_mutex;  // one writer at a time; a writer may read the tree without the gate
  mutable ReaderGate gate;  // guards tree: readers inside, or the writer alone
  TransformTree tree;
  std::atomic<std::uint64_t> revision{0};
  std::optional<std::int64_t> retention_ns;

  using Checked = std::expected<TransformTree::CheckedSample, InsertError>;

  /// Stores a checked sample. Needs the gate closed.
  std::expected<void, InsertError> store(const TransformSample& sample, TransformTree::CheckedSample& checked) {
    if (checked.child == kNoFrame) {
      const auto child = tree.addEdge(sample.parent, sample.child);
      if (!child) {
        return std::unexpected(child.error());
      }
      checked.child = *child;
    }
    tree.store(checked, retention_ns);
    return {};
  }

  /// Stores those of some samples that were found sound, under one closing of the gate; `checked` learns what is
  /// refused only now. Returns how many were stored.
  std::size_t storeSound(std::span<const TransformSample> samples, std::span<Checked> checked) {
    if (std::none_of(checked.begin(), checked.end(), [](const Checked& each) { return each.has_value(); })) {
      return 0;
    }
    std::size_t stored = 0;
    {
      const GateClosure closure(gate);
      for (std::size_t i = 0; i < samples.size(); ++i) {
        if (!checked[i]) {
          continue;
        }
        if (const auto done = store(samples[i], *checked[i])) {
          ++stored;
        } else {
          checked[i] = std::unexpected(done.error());
        }
      }
      revision += stored > 0 ? 1 : 0;
    }
    gate.letReadersIn();
    return stored;
  }
};

namespace {

void countRefusal(BulkInsertReport& report, InsertError error, const TransformSample& sample) {
  ++report.refused;
  const std::string_view parent = stripLeadingSlashes(sample.parent);
  const std::string_view child = stripLeadingSlashes(sample.child);
  const auto same = [&](const BulkInsertReport::Refusal& known) {
    return known.error == error && known.child == child && known.parent == parent;
  };
  // Newest first: a refused edge tends to be refused again soon.
  const auto known = std::find_if(report.refusals.rbegin(), report.refusals.rend(), same);
  if (known != report.refusals.rend()) {
    ++known->count;
    known->first_stamp = std::min(known->first_stamp, sample.stamp);
  } else if (report.refusals.size() < BulkInsertReport::kMaxRefusals) {
    report.refusals.push_back({error, std::string(parent), std::string(child), 1, sample.stamp});
  }
}

}  // namespace

TransformBuffer::TransformBuffer(std::optional<std::int64_t> retention_ns) : impl_(std::make_unique<Impl>()) {
  if (retention_ns) {
    impl_->retention_ns = std::max<std::int64_t>(*retention_ns, 0);
  }
}

TransformBuffer::~TransformBuffer() = default;

std::expected<void, InsertError> TransformBuffer::insert(const TransformSample& sample) {
  const std::lock_guard writer(impl_->writer_mutex);
  auto checked = impl_->tree.check(sample);
  if (!checked) {
    return std::unexpected(checked.error());
  }
  const GateClosure closure(impl_->gate);
  auto stored = impl_->store(sample, *checked);
  if (stored) {
    ++impl_->revision;
  }
  return stored;
}

BulkInsertReport TransformBuffer::insertBulk(std::span<const TransformSample> samples) {
  BulkInsertReport report;
  std::array<Impl::Checked, Impl::kBatch> checked;
  while (!samples.empty()) {
    const auto batch = samples.first(std::min(samples.size(), Impl::kBatch));
    samples = samples.subspan(batch.size());
    const std::lock_guard writer(impl_->writer_mutex);
    // The greater part of the work needs the tree as it is, and lets readers go on.
    for (std::size_t i = 0; i < batch.size(); ++i) {
      checked[i] = impl_->tree.check(batch[i]);
    }
    for (std::size_t begin = 0; begin < batch.size(); begin += Impl::kClosing) {
      const std::size_t count = std::min(batch.size() - begin, Impl::kClosing);
      report.inserted += impl_->storeSound(batch.subspan(begin, count), std::span(checked).subspan(begin, count));
    }
    for (std::size_t i = 0; i < batch.size(); ++i) {
      if (!checked[i]) {
        countRefusal(report, checked[i].error(), batch[i]);
      }
    }
  }
  return report;
}

void TransformBuffer::pack() {
  const std::lock_guard writer(impl_->writer_mutex);
  for (FrameId frame = 0; frame < impl_->tree.names().size(); ++frame) {
    if (!impl_->tree.samples(frame).isLoose()) {
      continue;
    }
    EdgeCache packed = impl_->tree.samples(frame).packed();
    {
      const GateClosure closure(impl_->gate);
      impl_->tree.swapSamples(frame, packed);
    }
    impl_->gate.letReadersIn();
  }
}

void TransformBuffer::clear() {
  const std::lock_guard writer(impl_->writer_mutex);
  TransformTree old;
  old.static_for_all_time = impl_->tree.static_for_all_time;
  const GateClosure closure(impl_->gate);
  std::swap(impl_->tree, old);
  ++impl_->revision;
}

void TransformBuffer::setStaticForAllTime(bool enabled) {
  const std::lock_guard writer(impl_->writer_mutex);
  if (impl_->tree.static_for_all_time == enabled) {
    return;
  }
  const GateClosure closure(impl_->gate);
  impl_->tree.static_for_all_time = enabled;
  ++impl_->revision;
}

bool TransformBuffer::isStaticForAllTime() const {
  const std::shared_lock reader(impl_->gate);
  return impl_->tree.static_for_all_time;
}

std::expected<RigidTransform, LookupFailure> TransformBuffer::tryLookupTransform(std::string_view target,
                                                                                 std::string_view source,
                                                                                 TimePoint time) const noexcept {
  const std::shared_lock reader(impl_->gate);
  const FrameNames& names = impl_->tree.names();
  const auto target_frame = names.find(stripLeadingSlashes(target));
  const auto source_frame = names.find(stripLeadingSlashes(source));
  return impl_->tree.lookup(target_frame.value_or(kNoFrame), source_frame.value_or(kNoFrame), time);
}

std::expected<RigidTransform, LookupFailure> TransformBuffer::tryLookupTransform(FrameId target, FrameId source,
                                                                                 TimePoint time) const noexcept {
  const std::shared_lock reader(impl_->gate);
  return impl_->tree.lookup(target, source, time);
}

RigidTransform TransformBuffer::lookupTransform(std::string_view target, std::string_view source,
                                                TimePoint time) const {
  const auto found = tryLookupTransform(target, source, time);
  if (!found) {
    const bool unknown_target = found.error().code == LookupError::UnknownTarget;
    if (unknown_target || found.error().code == LookupError::UnknownSource) {
      std::string message("no frame \"");
      message.append(unknown_target ? target : source).append("\": ").append(describe(found.error()));
      throw TransformException(message, found.error());
    }
    throw TransformException(describe(found.error()), found.error());
  }
  return *found;
}

void TransformBuffer::snapshot(FrameId root, TimePoint time, Snapshot& out) const {
  const std::shared_lock reader(impl_->gate);
  impl_->tree.snapshot(root, time, out);
  out.revision = impl_->revision.load();
}

std::size_t TransformBuffer::frameCount() const {
  const std::shared_lock reader(impl_->gate);
  return impl_->tree.names().size();
}

std::vector<std::string> TransformBuffer::frames() const {
  const std::shared_lock reader(impl_->gate);
  const FrameNames& names = impl_->tree.names();
  std::vector<std::string> result;
  result.reserve(names.size());
  for (FrameId frame = 0; frame < names.size(); ++frame) {
    result.push_back(names.name(frame));
  }
  return result;
}

std::optional<FrameId> TransformBuffer::findFrame(std::string_view name) const noexcept {
  const std::shared_lock reader(impl_->gate);
  return impl_->tree.names().find(stripLeadingSlashes(name));
}

std::string TransformBuffer::frameName(FrameId frame) const {
  const std::shared_lock reader(impl_->gate);
  return impl_->tree.contains(frame) ? impl_->tree.names().name(frame) : "?";
}

FrameId TransformBuffer::parent(FrameId frame) const noexcept {
  const std::shared_lock reader(impl_->gate);
  return impl_->tree.parent(frame);
}

std::vector<FrameId> TransformBuffer::roots() const {
  const std::shared_lock reader(impl_->gate);
  std::vector<FrameId> result;
  for (FrameId frame = 0; frame < impl_->tree.names().size(); ++frame) {
    if (impl_->tree.parent(frame) == kNoFrame) {
      result.push_back(frame);
    }
  }
  return result;
}

std::optional<EdgeInfo> TransformBuffer::edge(FrameId child) const {
  const std::shared_lock reader(impl_->gate);
  const TransformTree& tree = impl_->tree;
  const FrameId parent = tree.parent(child);
  if (parent == kNoFrame) {
    return std::nullopt;
  }
  const EdgeCache& samples = tree.samples(child);
  return EdgeInfo{tree.names().name(parent), tree.names().name(child), samples.size(),
                  samples.first(),           samples.last(),           tree.isStatic(child)};
}

std::vector<StampedTransform> TransformBuffer::samples(FrameId child) const {
  const std::shared_lock reader(impl_->gate);
  std::vector<StampedTransform> samples;
  if (impl_->tree.parent(child) != kNoFrame) {
    const EdgeCache& edge = impl_->tree.samples(child);
    samples.reserve(edge.size());
    edge.visit([&](const EdgeCache::Sample& sample) {
      samples.push_back({TimePoint{sample.stamp_ns}, sample.parent_from_child});
    });
  }
  return samples;
}

std::optional<TimePoint> TransformBuffer::stampInForce(FrameId child, TimePoint time) const noexcept {
  const std::shared_lock reader(impl_->gate);
  return impl_->tree.stampInForce(child, time);
}

std::uint64_t TransformBuffer::revision() const noexcept { return impl_->revision.load(); }

std::size_t TransformBuffer::sampleBytes() const {
  const std::shared_lock reader(impl_->gate);
  return impl_->tree.sampleBytes();
}

std::string TransformBuffer::describe(const LookupFailure& failure) const {
  const auto quoted = [this](FrameId frame) { return std::string(1, '"').append(frameName(frame)).append(1, '"'); };
  switch (failure.code) {
    case LookupError::UnknownTarget:
      return "the target frame has never been seen";
    case LookupError::UnknownSource:
      return "the source frame has never been seen; the target is " + quoted(failure.target);
    case LookupError::Disconnected:
      return "frames " + quoted(failure.target) + " and " + quoted(failure.source) + " are in different trees";
    case LookupError::NoSampleAtTime:
      return "no transform from " + quoted(failure.source) + " to " + quoted(failure.target) + " at " +
             std::to_string(failure.time.ns) + " ns: the edge " + quoted(parent(failure.edge_child)) + " -> " +
             quoted(failure.edge_child) + " has samples from " + std::to_string(failure.edge_first.ns) + " to " +
             std::to_string(failure.edge_last.ns) + " ns only";
  }
  return "?";
}

std::string_view stripLeadingSlashes(std::string_view name) noexcept {
  const auto first = name.find_first_not_of('/');
  return first == std::string_view::npos ? std::string_view() : name.substr(first);
}

}  // namespace stillframe::tf
