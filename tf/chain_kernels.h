#pragma once

#include <array>
#include <span>

#include "tf/rigid_transform.h"

namespace stillframe::tf {

/// What ChainAccumulator keeps. Lanes: x, y, z, w of the quaternion high + low; x, y, z, 0 of the translation sum +
/// rest.
struct ChainParts {
  std::array<double, 4> high{0.0, 0.0, 0.0, 1.0};
  std::array<double, 4> low{};
  std::array<double, 4> sum{};
  std::array<double, 4> rest{};
};

/// One of many links to append: to = from * link. A later step may start from what an earlier one wrote.
struct ChainStep {
  const ChainParts* from = nullptr;
  const RigidTransform* link = nullptr;
  ChainParts* to = nullptr;
  RigidTransform rounded;  ///< of the result
};

/// The loops of ChainAccumulator for one instruction set. Every set gives the same bits. Pure; any thread.
struct ChainKernels {
  void (*append)(ChainParts& parts, std::span<const RigidTransform* const> links) noexcept;
  void (*append_each)(std::span<ChainStep> steps) noexcept;

  /// Plain C++.
  [[nodiscard]] static const ChainKernels& portable() noexcept;
  /// The fastest ones that this processor runs.
  [[nodiscard]] static const ChainKernels& best() noexcept;
};

}  // namespace stillframe::tf
