#include "scenegraph/export/osgt_export.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <locale>
#include <osg/CopyOp>
#include <osg/Math>
#include <osg/Uniform>
#include <osgDB/Options>
#include <osgDB/ReaderWriter>
#include <osgDB/Registry>
#include <string>
#include <unordered_map>

#include "scenegraph/export/export_check.h"
#include "scenegraph/export/replace_file.h"

namespace stillframe::scenegraph {
namespace {

using Copies = std::unordered_map<const osg::Node*, osg::ref_ptr<osg::Node>>;

/// The visible part of `node`: groups are copied, since their children may be fewer; drawables and state are shared.
osg::ref_ptr<osg::Node> copyVisible(const osg::Node& node, Copies& copies) {
  const auto known = copies.find(&node);
  if (known != copies.end()) {
    return known->second;
  }
  osg::ref_ptr<osg::Node> copy;
  const osg::Group* group = node.asGroup();
  if (group == nullptr) {
    copy = const_cast<osg::Node*>(&node);  // NOLINT: the writer only reads it, but OSG has no const parents
  } else {
    copy = static_cast<osg::Node*>(node.clone(osg::CopyOp::SHALLOW_COPY));
    osg::Group& target = *copy->asGroup();
    target.removeChildren(0, target.getNumChildren());
    for (unsigned i = 0; i < group->getNumChildren(); ++i) {
      if (group->getChild(i)->getNodeMask() != 0U) {
        target.addChild(copyVisible(*group->getChild(i), copies));
      }
    }
  }
  copies[&node] = copy;
  return copy;
}

std::string layerText(const std::string& topic, const SettingTexts& settings) {
  std::string text = "layer=" + topic;
  char separator = ':';
  for (const auto& [key, value] : settings) {
    text += separator + key + "=" + value;
    separator = ',';
  }
  return text;
}

/// Writes a double so that stock OSG reads the same bits. Its reader (osg::asciiToDouble, 3.6.5) sums digits in double
/// and is wrong by up to 5 ulp for 17 digits; so the text is tried, and where it reads as a neighbour, a mantissa and
/// exponent are looked for that its own rounding turns into the value.
class ReadableNumbers : public std::num_put<char> {
 protected:
  iter_type do_put(iter_type out, std::ios_base& /*stream*/, char /*fill*/, double value) const override {
    const std::string text = readableText(value);
    return std::copy(text.begin(), text.end(), out);
  }

 private:
  static std::string readableText(double value) {
    std::string best;
    double best_error = std::numeric_limits<double>::infinity();
    const auto reads = [&](const std::string& text) {
      const double error = std::abs(osg::asciiToDouble(text.c_str()) - value);
      if (best.empty() || error < best_error) {
        best = text;
        best_error = error;
      }
      return best_error == 0.0;
    };
    const auto print = [](double number, auto... how) {
      std::array<char, 400> buffer{};
      return std::string(buffer.data(),
                         std::to_chars(buffer.data(), buffer.data() + buffer.size(), number, how...).ptr);
    };
    if (value == 0.0 || reads(print(value))) {
      return value == 0.0 ? "0" : best;
    }
    const double magnitude = std::abs(value);
    const int most = 18 - static_cast<int>(std::floor(std::log10(magnitude)));
    for (int exponent = most; exponent > most - 3; --exponent) {
      for (int step = 0; step < 13; ++step) {
        const double mantissa = neighbour(magnitude * std::pow(10.0, exponent), step);
        if (mantissa < 1.8e19 && reads((value < 0.0 ? "-" : "") + std::to_string(static_cast<std::uint64_t>(mantissa)) +
                                       "e" + std::to_string(-exponent))) {
          return best;
        }
      }
    }
    for (int step = 0; step < 13; ++step) {
      for (int digits = 15; digits < 22; ++digits) {
        if (reads(print(neighbour(value, step), std::chars_format::scientific, digits)) ||
            reads(print(neighbour(value, step), std::chars_format::fixed, digits))) {
          return best;
        }
      }
    }
    return best;
  }
  /// The double `step` / 2 places away, to either side in turn.
  static double neighbour(double value, int step) {
    for (int i = 0; i < (step + 1) / 2; ++i) {
      value = std::nextafter(value, step % 2 == 1 ? 1e308 : -1e308);
    }
    return value;
  }
};

std::expected<void, std::string> writeNode(const osg::Node& node, bool is_text, const std::filesystem::path& path) {
  osgDB::ReaderWriter* writer = osgDB::Registry::instance()->getReaderWriterForExtension("osgt");
  if (writer == nullptr) {
    return std::unexpected(std::string("OpenSceneGraph's own format plugin (osgdb_osg) is not installed"));
  }
  errno = 0;
  std::ofstream file{path, std::ios::binary};
  if (!file) {
    return std::unexpected(lastSystemError());
  }
  file.imbue(std::locale(std::locale::classic(), new ReadableNumbers));
  osg::ref_ptr<osgDB::Options> options = new osgDB::Options{"precision 17 WriteImageHint=IncludeData"};
  if (is_text) {
    options->setPluginStringData("fileType", "Ascii");
  }
  const auto written = writer->writeNode(node, file, options);
  // OSG reports success for a stream that has failed.
  file.close();
  if (!file) {
    return std::unexpected(lastSystemError());
  }
  return written.success() ? std::expected<void, std::string>() : std::unexpected(written.message());
}

}  // namespace

osg::ref_ptr<osg::Node> makeExportGraph(const osg::Group& root, const ExportInfo& info) {
  Copies copies;
  osg::ref_ptr<osg::Node> copy = copyVisible(root, copies);
  // The root's own state and descriptions are shared with the copy so far: the file's are made from copies of them.
  osg::ref_ptr<osg::StateSet> state =
      root.getStateSet() == nullptr ? new osg::StateSet
                                    : static_cast<osg::StateSet*>(root.getStateSet()->clone(osg::CopyOp::SHALLOW_COPY));
  state->addUniform(new osg::Uniform{"u_viewport_height_px", static_cast<float>(info.viewport_height_px)});
  copy->setStateSet(state);
  copy->setUserDataContainer(nullptr);
  for (const std::string& description : root.getDescriptions()) {
    copy->addDescription(description);
  }
  copy->addDescription("time_ns=" + std::to_string(info.time.ns));
  copy->addDescription("fixed_frame=" + info.fixed_frame);
  copy->addDescription("source=" + info.source);
  for (const auto& [topic, settings] : info.layers) {
    copy->addDescription(layerText(topic, settings));
  }
  return copy;
}

std::expected<void, Status> exportGraph(const osg::Group& root, const ExportInfo& info,
                                        const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  if (extension != ".osgt" && extension != ".osgb") {
    return std::unexpected(Status{StatusLevel::Error, "UnknownFormat",
                                  "cannot write " + path.string() + ": the name must end in .osgt or .osgb"});
  }
  // The graph itself is checked, since a copy of a foreign subclass may be a stock class already.
  if (const auto exportable = checkExportable(root); !exportable) {
    Status status = exportable.error();
    status.message = "cannot export to " + path.string() + ": " + status.message;
    return std::unexpected(status);
  }
  const osg::ref_ptr<osg::Node> copy = makeExportGraph(root, info);
  return replaceFile(
      path, [&](const std::filesystem::path& beside) { return writeNode(*copy, extension == ".osgt", beside); });
}

}  // namespace stillframe::scenegraph
