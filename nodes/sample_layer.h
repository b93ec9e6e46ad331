#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "nodes/topic_layer.h"
#include "scenegraph/sample_loader.h"
#include "scenegraph/settings.h"
#include "scenegraph/store/message_origin.h"

namespace stillframe::nodes {

/// A layer of a topic whose messages stand alone: the newest one at or before the tick is converted to a Product on a
/// worker and drawn. What derives from it says how a product is shown, drawn and counted, and where it lies.
///
/// Product has `byteSize()` and `releaseGlObjects()`; it is shared by all views. Settings is a plain struct with a
/// SettingsTable. GUI thread.
template <typename Product, typename Settings>
class SampleLayer : public TopicLayer {
 public:
  [[nodiscard]] std::vector<scenegraph::SettingSpec> settingSpecs() const override { return table_.specs(); }
  [[nodiscard]] scenegraph::SettingTexts settings() const override { return table_.texts(settings_); }

 protected:
  using Loader = scenegraph::SampleLoader<Product>;
  using Shown = std::shared_ptr<const Product>;
  /// How messages become products. The functions run on workers and capture values only.
  struct Source {
    scenegraph::ObjectType type = scenegraph::ObjectType::None;
    std::string tag;  ///< of the products in the cache
    /// Of what the store holds, never null, for the settings at that time.
    using Convert =
        std::function<std::expected<Product, scenegraph::Status>(const scenegraph::AnyObject&, const Settings&)>;
    Convert convert;
    typename Loader::IsReference is_reference;  ///< what reference() may be
    /// Makes beforehand what these settings will ask of the product; may be empty.
    std::function<void(const Product&, const Settings&)> prepare = nullptr;
    /// Last of all: lets go of what can be read again; may be empty.
    std::function<void(Product&, const scenegraph::MessageOrigin&)> settle = nullptr;
    bool takes_early = false;  ///< `convert` waits for its payload (Payload::arrival)
  };

  /// `table` outlives the layer.
  SampleLayer(std::string_view topic, Source source, const scenegraph::SettingsTable<Settings>& table,
              Settings defaults = {})
      : TopicLayer(topic), source_(std::move(source)), table_(table), settings_(std::move(defaults)) {}

  /// Puts product() into the nodes, nullptr being nothing; what was there before is off the GPU already.
  virtual void show() = 0;
  /// Where the product lies.
  [[nodiscard]] virtual Anchor anchorOf(const Product& product) const = 0;
  /// What is drawn of a loaded sample, by default the sample itself. Called every tick, nullptr included; may start
  /// work and return product() as long as it is under way.
  [[nodiscard]] virtual Shown drawnOf(const Shown& loaded) { return loaded; }

  std::expected<void, scenegraph::SettingError> changeSettings(const scenegraph::SettingTexts& texts) override {
    return table_.apply(texts, settings_);
  }
  void open(const scenegraph::LayerContext& context) override {
    loader_.emplace(
        context, source_.type, topic(), source_.tag,
        [source = source_, latest = latest_, topic = topic(), dataset = context.dataset.weak_from_this()](
            const scenegraph::AnyObject& object,
            const scenegraph::Entry& entry) -> std::expected<Product, scenegraph::Status> {
          const Settings settings = latest->get();
          auto product = source.convert(object, settings);
          if (product && source.prepare) {
            source.prepare(*product, settings);
          }
          if (product && source.settle) {
            source.settle(*product, {dataset, topic, source.type, entry});
          }
          return product;
        },
        source_.is_reference, source_.takes_early);
  }
  void close() override {
    loader_.reset();
    reference_ = nullptr;
  }
  void clear() override {
    present(nullptr);
    applied_.reset();
  }
  [[nodiscard]] std::optional<Anchor> load(const scenegraph::Tick& tick) override {
    loadSample(tick);
    if (auto drawn = drawnOf(loader_->product()); drawn != product_) {
      present(std::move(drawn));
    }
    if (product_ == nullptr) {
      return std::nullopt;
    }
    takeReference(product_);
    return anchorOf(*product_);
  }
  [[nodiscard]] const scenegraph::Status& sourceStatus() const override { return loader_->status(); }
  [[nodiscard]] bool isWorking() const override { return loader_->isPending(); }

  void loadSample(const scenegraph::Tick& tick) {
    latest_->set(settings_);
    (void)loader_->update(tick.time);
  }
  /// Takes the topic's first sample for reference(), or `shown` as long as there is none.
  void takeReference(const Shown& shown) {
    const auto first = loader_->reference();
    reference_ = first != nullptr ? first : shown;
  }
  /// Whether the settings are others than the last time, or reapply() was called since.
  [[nodiscard]] bool takeSettings() {
    const bool is_new = applied_ != settings_;
    applied_ = settings_;
    return is_new;
  }
  void reapply() { applied_.reset(); }

  [[nodiscard]] const Settings& chosen() const noexcept { return settings_; }
  [[nodiscard]] const Loader& loader() const { return *loader_; }
  /// What is shown, or nullptr.
  [[nodiscard]] const Shown& product() const noexcept { return product_; }
  /// What colour ranges held across time come from; once something was shown.
  [[nodiscard]] const Shown& reference() const noexcept { return reference_; }
  /// Of the sample that is loaded.
  [[nodiscard]] std::string loadedText() const { return sampleText(*loader_->entry()); }

 private:
  /// The settings in use, for the workers.
  class Latest {
   public:
    void set(const Settings& now) {
      const std::scoped_lock lock(mutex_);
      if (settings_ != now) {
        settings_ = now;
      }
    }
    [[nodiscard]] Settings get() const {
      const std::scoped_lock lock(mutex_);
      return settings_;
    }

   private:
    mutable std::mutex mutex_;  // guards settings_
    Settings settings_;
  };

  void present(Shown product) {
    if (product_ != nullptr) {
      product_->releaseGlObjects();
    }
    product_ = std::move(product);
    show();
  }

  Source source_;
  const scenegraph::SettingsTable<Settings>& table_;
  Settings settings_;
  std::optional<Settings> applied_;
  std::shared_ptr<Latest> latest_ = std::make_shared<Latest>();
  std::optional<Loader> loader_;
  Shown product_;
  Shown reference_;
};

}  // namespace stillframe::nodes
