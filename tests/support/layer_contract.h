#pragma once

#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scenegraph/layer.h"
#include "tests/support/builders.h"

namespace stillframe::test {

/// How the contract test feeds one type of layer. The suite (layer_contract_test.cpp) is compiled into a test program
/// together with a source that defines layerCases() and typesUnderTest(); a type without a case fails it.
struct LayerCase {
  std::string_view type;  ///< LayerType::name
  /// Adds one message at `log_ns` to the topic the builder is at: drawable data in `frame`, different for every `seed`.
  /// nullptr for a built-in, which draws without a topic.
  void (*add)(DatasetBuilder& builder, std::int64_t log_ns, const std::string& frame, unsigned seed) = nullptr;
  /// Adds a message that is valid and has nothing to draw (no points).
  void (*addEmpty)(DatasetBuilder& builder, std::int64_t log_ns, const std::string& frame) = nullptr;
};

inline std::ostream& operator<<(std::ostream& out, const LayerCase& layer_case) { return out << layer_case.type; }

/// Defined by the test program.
[[nodiscard]] std::vector<LayerCase> layerCases();
[[nodiscard]] std::span<const scenegraph::LayerType> typesUnderTest();

}  // namespace stillframe::test
