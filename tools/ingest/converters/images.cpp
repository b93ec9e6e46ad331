#include "tools/ingest/converters/images.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

#include "tools/ingest/sentence.h"

namespace stillframe::ingest::converters {

namespace {

bool contains(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

}  // namespace

RowDecoder<ImageRow>::Result rawImage(ImageRow& row, const MessageView& payloads) {
  row.image.data = payloadOf(row.data, payloads);
  return finished(std::move(row.image));
}

RowDecoder<ImageRow>::Result compressedImage(ImageRow& row, const MessageView& payloads) {
  const std::string format = row.image.encoding;
  std::string lower = format;
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const std::size_t semicolon = format.find(';');
  row.image.compressed_encoding = semicolon == std::string::npos ? "" : format.substr(0, semicolon);
  if (contains(lower, "compresseddepth")) {
    row.image.encoding = "compressedDepth";
  } else if (contains(lower, "jpeg") || contains(lower, "jpg")) {
    row.image.encoding = "jpeg";
  } else if (contains(lower, "png")) {
    row.image.encoding = "png";
  } else {
    row.image.encoding = lower;
  }
  return rawImage(row, payloads);
}

void bindCamera(Shape& shape) {
  using scenegraph::CameraInfo;
  shape.field<&CameraRow::info, &CameraInfo::width>("width")
      .field<&CameraRow::info, &CameraInfo::height>("height")
      .field<&CameraRow::info, &CameraInfo::distortion_model>("distortion_model");
  for (const bool is_upper : {true, false}) {
    shape.field<&CameraRow::info, &CameraInfo::distortion>(is_upper ? "D" : "d")
        .optional()
        .field<&CameraRow::k>(is_upper ? "K" : "k")
        .optional()
        .field<&CameraRow::r>(is_upper ? "R" : "r")
        .optional()
        .field<&CameraRow::p>(is_upper ? "P" : "p")
        .optional();
  }
}

RowDecoder<CameraRow>::Result cameraInfo(CameraRow& row, const MessageView&) {
  const auto copy = [](const std::vector<double>& from, auto& to) {
    std::ranges::copy_n(from.begin(), static_cast<std::ptrdiff_t>(std::min(from.size(), to.size())), to.begin());
    return from.empty() || from.size() == to.size();
  };
  if (!copy(row.k, row.info.k) || !copy(row.r, row.info.r) || !copy(row.p, row.info.p)) {
    return std::unexpected(scenegraph::DecodeError{
        "BadCameraInfo", sentence("the matrices K, R, P have ", row.k.size(), ", ", row.r.size(), " and ", row.p.size(),
                                  " values, not 9, 9 and 12")});
  }
  return finished(std::move(row.info));
}

}  // namespace stillframe::ingest::converters
