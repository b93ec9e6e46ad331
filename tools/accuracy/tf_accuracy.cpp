#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <random>
#include <string_view>

#include "tf/chain_accumulator.h"
#include "tf/wide_transform.h"
#include "tools/accuracy/rigid_reference.h"
#include "tools/accuracy/svg_plot.h"
#include "tools/accuracy/tf_accuracy.h"

namespace stillframe::accuracy {
namespace {

using tf::RigidTransform;

constexpr std::array<std::size_t, 11> kDepths{1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024};
constexpr std::array<double, 4> kOffsets{1.0, 1e3, 1e6, 1e9};
constexpr std::size_t kChains = 8;  // the worst of them counts

/// A chain in the form that each method starts from.
struct Chain {
  std::vector<RigidTransform> links;
  std::vector<const RigidTransform*> pointers;
  std::vector<glm::dmat4> matrices;
  std::vector<glm::mat4> float_matrices;
  RigidReference expected;
};

Chain randomChain(std::mt19937_64& random, std::size_t depth, double offset) {
  std::normal_distribution<double> gauss;
  std::uniform_real_distribution<double> length(0.1 * offset, offset);
  Chain chain;
  for (std::size_t i = 0; i < depth; ++i) {
    const glm::dquat rotation(gauss(random), gauss(random), gauss(random), gauss(random));
    const glm::dvec3 direction(gauss(random), gauss(random), gauss(random));
    const RigidTransform link{glm::normalize(rotation), glm::normalize(direction) * length(random)};
    chain.links.push_back(link);
    chain.matrices.push_back(tf::toMatrix(link));
    chain.float_matrices.emplace_back(chain.matrices.back());
    chain.expected = chain.expected * RigidReference(link);
  }
  for (const RigidTransform& link : chain.links) {
    chain.pointers.push_back(&link);
  }
  return chain;  // moved or elided: the pointers stay good
}

template <typename Matrix>
glm::dmat4 productOf(const std::vector<Matrix>& matrices) {
  Matrix product(1);
  for (const Matrix& matrix : matrices) {
    product = product * matrix;
  }
  return glm::dmat4(product);
}

RigidTransform plainProduct(const Chain& chain) {
  RigidTransform product;
  for (const RigidTransform& link : chain.links) {
    product = {product.rotation * link.rotation, product.rotation * link.translation + product.translation};
  }
  return product;
}

RigidTransform compensatedProduct(const Chain& chain) {
  tf::ChainAccumulator product;
  product.append(chain.pointers);
  return product.narrow();
}

RigidTransform extendedProduct(const Chain& chain) {
  tf::WideTransform product;
  for (const RigidTransform& link : chain.links) {
    product = tf::compose(product, tf::widen(link));
  }
  return tf::narrow(product);
}

struct Method {
  std::string_view name;
  std::function<RigidReference(const Chain&)> compose;
  std::function<double(const Chain&)> run;  // the same without the conversion; the value keeps it from vanishing
};

std::vector<Method> methods() {
  const auto ofMatrix = [](std::string_view name, auto product) {
    return Method{name, [=](const Chain& chain) { return RigidReference(product(chain)); },
                  [=](const Chain& chain) { return product(chain)[3][0]; }};
  };
  const auto ofTransform = [](std::string_view name, auto product) {
    return Method{name, [=](const Chain& chain) { return RigidReference(product(chain)); },
                  [=](const Chain& chain) { return product(chain).translation.x; }};
  };
  return {ofMatrix("float matrix", [](const Chain& chain) { return productOf(chain.float_matrices); }),
          ofMatrix("double matrix", [](const Chain& chain) { return productOf(chain.matrices); }),
          ofTransform("double quaternion", plainProduct), ofTransform("compensated (the buffer)", compensatedProduct),
          ofTransform("80-bit quaternion", extendedProduct)};
}

/// Shortest of repeated measurements, nanoseconds a call.
double nanosecondsOf(const Method& method, const Chain& chain, double budget) {
  using Clock = std::chrono::steady_clock;
  volatile double sink = 0.0;
  double best = std::numeric_limits<double>::infinity();
  const std::size_t calls = std::max<std::size_t>(1, 512 / chain.links.size());
  const auto start = Clock::now();
  do {
    const auto before = Clock::now();
    for (std::size_t i = 0; i < calls; ++i) {
      sink = method.run(chain);
    }
    const std::chrono::duration<double, std::nano> took = Clock::now() - before;
    best = std::min(best, took.count() / static_cast<double>(calls));
  } while (std::chrono::duration<double>(Clock::now() - start).count() < budget);
  (void)sink;
  return best;
}

std::string tableOf(const std::vector<TfAccuracyRow>& rows) {
  std::string table("| way | depth | offset (m) | error (m) | error (rad) | time (ns) |\n|---|--:|--:|--:|--:|--:|\n");
  for (const TfAccuracyRow& row : rows) {
    std::array<char, 160> line{};
    std::snprintf(line.data(), line.size(), "| %s | %zu | %.0e | %.1e | %.1e | %.0f |\n", row.method.c_str(), row.depth,
                  row.offset_m, row.error_m, row.error_rad, row.nanoseconds);
    table += line.data();
  }
  return table;
}

std::string plotOf(const std::vector<TfAccuracyRow>& rows, const std::vector<Method>& ways) {
  PlotFigure figure;
  figure.title = "Composing a chain of rigid transforms: error against run time";
  figure.caption =
      "Each curve: depths 1, 2, 4, ... 1024 from left to right; worst of 8 random chains against 113-bit "
      "arithmetic. Hollow: no error.";
  figure.x_label = "time to compose the chain (ns)";
  figure.y_label = "placement error (m)";
  for (const double offset : kOffsets) {
    PlotPanel panel;
    std::array<char, 64> title{};
    std::snprintf(title.data(), title.size(), "offsets of up to %g m an edge", offset);
    panel.title = title.data();
    for (const Method& way : ways) {
      PlotSeries series{std::string(way.name), {}};
      for (const TfAccuracyRow& row : rows) {
        if (row.method == way.name && row.offset_m == offset) {
          series.points.push_back({row.nanoseconds, row.error_m});
        }
      }
      panel.series.push_back(series);
    }
    figure.panels.push_back(panel);
  }
  return renderSvg(figure);
}

}  // namespace

TfAccuracy tfAccuracy(double seconds) {
  TfAccuracy accuracy;
  accuracy.report.name = "tf";
  const std::vector<Method> ways = methods();
  const double budget = seconds / static_cast<double>(ways.size() * kDepths.size() * kOffsets.size());
  for (const double offset : kOffsets) {
    for (const std::size_t depth : kDepths) {
      std::mt19937_64 random(depth);
      std::vector<Chain> chains;
      for (std::size_t i = 0; i < kChains; ++i) {
        chains.push_back(randomChain(random, depth, offset));
      }
      for (const Method& way : ways) {
        TfAccuracyRow row{std::string(way.name), depth, offset, 0.0, 0.0, nanosecondsOf(way, chains.front(), budget)};
        for (const Chain& chain : chains) {
          const RigidReference actual = way.compose(chain);
          row.error_m = std::max(row.error_m, placementError(actual, chain.expected));
          row.error_rad = std::max(row.error_rad, rotationError(actual, chain.expected));
        }
        accuracy.rows.push_back(row);
      }
    }
  }
  accuracy.report.table = tableOf(accuracy.rows);
  accuracy.report.svg = plotOf(accuracy.rows, ways);
  return accuracy;
}

}  // namespace stillframe::accuracy
