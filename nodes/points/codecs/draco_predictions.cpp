#include <draco/compression/attributes/sequential_attribute_decoders_controller.h>
#include <draco/compression/attributes/sequential_quantization_attribute_decoder.h>

#include <cstdint>
#include <memory>
#include <typeinfo>
#include <utility>
#include <vector>

#include "nodes/points/codecs/draco_bounded.h"

namespace stillframe::nodes {
namespace {

using draco::PointAttribute;
using Controller = draco::SequentialAttributeDecodersController;
using AttributeDecoders = std::vector<std::unique_ptr<draco::SequentialAttributeDecoder>>;
using Scheme = draco::PredictionSchemeTypedDecoderInterface<std::int32_t>;

/// The decoders of a controller. libdraco 1.5.5 reads as many bits of a texture prediction as a stream claims, from
/// behind its end too: up to 2^31, which takes seconds. Nothing that it lets one override stands before that loop but
/// the decoders that a controller keeps to itself; an explicit instantiation may name private members.
template <AttributeDecoders Controller::* kMember>
struct PrivateDecoders {
  friend AttributeDecoders& decodersOf(Controller& controller) { return controller.*kMember; }
};
AttributeDecoders& decodersOf(Controller& controller);
template struct PrivateDecoders<&Controller::sequential_decoders_>;

/// A prediction of libdraco that asks before it reads its bits.
class BoundedScheme final : public Scheme {
 public:
  BoundedScheme(std::unique_ptr<Scheme> scheme, DracoBudget& budget, std::uint64_t faces)
      : scheme_(std::move(scheme)), budget_(budget), faces_(faces) {}

  bool DecodePredictionData(draco::DecoderBuffer* buffer) override {
    return budget_.allowsOrientations(GetPredictionMethod(), *buffer, faces_) && scheme_->DecodePredictionData(buffer);
  }
  draco::PredictionSchemeMethod GetPredictionMethod() const override { return scheme_->GetPredictionMethod(); }
  const PointAttribute* GetAttribute() const override { return scheme_->GetAttribute(); }
  bool IsInitialized() const override { return scheme_->IsInitialized(); }
  int GetNumParentAttributes() const override { return scheme_->GetNumParentAttributes(); }
  draco::GeometryAttribute::Type GetParentAttributeType(int i) const override {
    return scheme_->GetParentAttributeType(i);
  }
  bool SetParentAttribute(const PointAttribute* attribute) override { return scheme_->SetParentAttribute(attribute); }
  bool AreCorrectionsPositive() override { return scheme_->AreCorrectionsPositive(); }
  draco::PredictionSchemeTransformType GetTransformType() const override { return scheme_->GetTransformType(); }
  bool ComputeOriginalValues(const std::int32_t* corrections, std::int32_t* values, int size, int components,
                             const draco::PointIndex* points) override {
    return scheme_->ComputeOriginalValues(corrections, values, size, components, points);
  }

 private:
  std::unique_ptr<Scheme> scheme_;
  DracoBudget& budget_;
  std::uint64_t faces_;
};

template <typename Base>
class BoundedAttribute final : public Base {
 public:
  BoundedAttribute(DracoBudget& budget, std::uint64_t faces) : budget_(budget), faces_(faces) {}

 protected:
  // libdraco hands over whatever the stream says, and judges it inside.
  __attribute__((no_sanitize("enum"))) std::unique_ptr<Scheme> CreateIntPredictionScheme(
      draco::PredictionSchemeMethod method, draco::PredictionSchemeTransformType transform) override {
    auto scheme = Base::CreateIntPredictionScheme(method, transform);
    return scheme != nullptr ? std::make_unique<BoundedScheme>(std::move(scheme), budget_, faces_) : nullptr;
  }

 private:
  DracoBudget& budget_;
  std::uint64_t faces_;
};

/// Replaces `decoder` when it is just a Base.
template <typename Base>
bool replace(std::unique_ptr<draco::SequentialAttributeDecoder>& decoder, DracoBudget& budget, std::uint64_t faces) {
  const draco::SequentialAttributeDecoder& known = *decoder;
  if (typeid(known) != typeid(Base)) {
    return false;
  }
  auto bounded = std::make_unique<BoundedAttribute<Base>>(budget, faces);
  if (bounded->Init(decoder->decoder(), decoder->attribute_id())) {  // as it took the same attribute before
    decoder = std::move(bounded);
  }
  return true;
}

}  // namespace

void boundPredictions(draco::MeshDecoder& decoder, DracoBudget& budget) {
  const std::uint64_t faces = decoder.mesh()->num_faces();
  for (std::int32_t i = 0; i < decoder.num_attributes_decoders(); ++i) {
    // Const for callers who only look; the object is the decoder's own, which is not.
    auto* const attributes = const_cast<draco::AttributesDecoderInterface*>(decoder.attributes_decoder(i));
    if (auto* const controller = dynamic_cast<Controller*>(attributes)) {
      for (auto& values : decodersOf(*controller)) {
        if (!replace<draco::SequentialIntegerAttributeDecoder>(values, budget, faces)) {
          replace<draco::SequentialQuantizationAttributeDecoder>(values, budget, faces);  // normals take other ones
        }
      }
    }
  }
}

}  // namespace stillframe::nodes
