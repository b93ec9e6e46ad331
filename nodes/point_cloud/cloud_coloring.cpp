#include "nodes/point_cloud/cloud_coloring.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace stillframe::nodes {
namespace {

bool hasChannel(const CloudPoints& cloud, std::string_view name) {
  return std::ranges::find(cloud.channels(), name, &ChannelInfo::name) != cloud.channels().end();
}

std::string automaticField(const CloudPoints& cloud) {
  if (cloud.hasColors()) {
    return "rgb";
  }
  for (const char* name : {"intensity", "intensities", "Intensity", "i"}) {
    if (hasChannel(cloud, name)) {
      return name;
    }
  }
  return "z";
}

std::optional<ColorChoice> choiceOf(const std::string& field, const CloudPoints& cloud) {
  if (field == "x" || field == "y" || field == "z") {
    return ColorChoice{.mode = ColorMode::Axis, .axis = field[0] - 'x', .channel = ""};
  }
  if (field == "flat") {
    return ColorChoice{};
  }
  if (field == "rgb" && cloud.hasColors()) {
    return ColorChoice{.mode = ColorMode::Rgb, .channel = ""};
  }
  if (hasChannel(cloud, field)) {
    return ColorChoice{.mode = ColorMode::Value, .channel = field};
  }
  return std::nullopt;
}

/// All that the work for colours depends on beside the cloud.
std::string workOf(const ColorChoice& choice, const PointCloudSettings& settings) {
  std::string work = std::to_string(static_cast<int>(choice.mode)) + " " + choice.channel;
  if (settings.range_mode == "percentile") {
    work += " " + scenegraph::settingText(settings.percentile_low) + " " +
            scenegraph::settingText(settings.percentile_high);
  }
  return work;
}

}  // namespace

void prepareColors(const CloudPoints& cloud, const ColorChoice& choice, const PointCloudSettings& settings) {
  if (choice.mode == ColorMode::Rgb) {
    (void)cloud.colors();
  } else if (choice.mode == ColorMode::Value) {
    (void)cloud.channel(choice.channel);
    (void)channelRange(settings, choice.channel, cloud, cloud);
  } else if (choice.mode == ColorMode::Axis) {
    (void)axisRange(settings, choice.axis, cloud, {});
  }
  cloud.notePrepared(workOf(choice, settings));
}

bool areColorsPrepared(const CloudPoints& cloud, const ColorChoice& choice, const PointCloudSettings& settings) {
  return choice.mode == ColorMode::Flat || cloud.isPrepared(workOf(choice, settings));
}

ColorChoice chooseColor(const std::string& color_field, const CloudPoints& reference, const CloudPoints& cloud) {
  const bool is_auto = color_field == "auto";
  if (const auto choice = choiceOf(is_auto ? automaticField(reference) : color_field, cloud)) {
    return *choice;
  }
  if (is_auto) {
    return *choiceOf(automaticField(cloud), cloud);
  }
  return ColorChoice{.mode = ColorMode::Flat, .channel = "", .is_missing = true};
}

CloudPoints::WantedChannel wantedChannel(const PointCloudSettings& settings) {
  return [field = settings.color_field](const CloudPoints& cloud) -> std::optional<std::string> {
    ColorChoice choice = chooseColor(field, cloud, cloud);
    return choice.mode == ColorMode::Value ? std::optional(std::move(choice.channel)) : std::nullopt;
  };
}

ValueRange channelRange(const PointCloudSettings& settings, const std::string& channel, const CloudPoints& reference,
                        const CloudPoints& cloud) {
  const auto held = [&]() -> const CloudPoints* {
    for (const CloudPoints* from : {&reference, &cloud}) {
      if (const CloudChannel* const values = from->channel(channel); values != nullptr && values->limits.finite > 0) {
        return from;
      }
    }
    return nullptr;
  };
  return settings.range(
      [&] {
        const CloudPoints* const from = held();
        return from == nullptr ? ValueRange{0.0, 0.0}
                               : ValueRange{from->channel(channel)->limits.low, from->channel(channel)->limits.high};
      },
      [&](double low, double high) {
        const CloudPoints* const from = held();
        return from == nullptr ? ValueRange{0.0, 0.0} : from->channelPercentiles(channel, low, high);
      });
}

ValueRange axisRange(const PointCloudSettings& settings, int axis, const CloudPoints& cloud,
                     const tf::RigidTransform& fixed_from_points) {
  return settings.range(
      [&] { return extentAlong(axis, fixed_from_points, cloud.converted().box_min, cloud.converted().box_max); },
      [&](double low_percent, double high_percent) {
        glm::dvec3 low;
        glm::dvec3 high;
        for (int i = 0; i < 3; ++i) {
          const ValueRange range = cloud.axisPercentiles(i, low_percent, high_percent);
          low[i] = range.low;
          high[i] = range.high;
        }
        return extentAlong(axis, fixed_from_points, low, high);
      });
}

}  // namespace stillframe::nodes
