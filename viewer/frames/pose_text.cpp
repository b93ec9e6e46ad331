#include "viewer/frames/pose_text.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QStringList>
#include <glm/trigonometric.hpp>
#include <initializer_list>

namespace stillframe::viewer {
namespace {

QString digits(double value) { return QString::number(value, 'g', 17); }

/// Quoted and escaped as JSON has it.
QString quoted(const std::string& text) {
  const QByteArray array = QJsonDocument(QJsonArray{QString::fromStdString(text)}).toJson(QJsonDocument::Compact);
  return QString::fromUtf8(array.mid(1, array.size() - 2));
}

}  // namespace

QString poseText(const tf::RigidTransform& target_from_source) {
  const auto& at = target_from_source.translation;
  const auto& turn = target_from_source.rotation;
  const glm::dvec3 angles = glm::degrees(tf::rollPitchYaw(turn));
  const auto number = [](double value, int decimals) { return QString::number(value, 'f', decimals); };
  return QStringLiteral("x %1  y %2  z %3 m\nqx %4  qy %5  qz %6  qw %7\nroll %8  pitch %9  yaw %10 \u00b0")
      .arg(number(at.x, 4), number(at.y, 4), number(at.z, 4), number(turn.x, 5), number(turn.y, 5), number(turn.z, 5),
           number(turn.w, 5), number(angles.x, 3), number(angles.y, 3))
      .arg(number(angles.z, 3));
}

QString poseJson(const std::string& target, const std::string& source, const tf::RigidTransform& target_from_source) {
  const auto& at = target_from_source.translation;
  const auto& turn = target_from_source.rotation;
  const glm::dvec3 angles = tf::rollPitchYaw(turn);
  const auto list = [](std::initializer_list<double> values) {
    QStringList texts;
    for (const double value : values) {
      texts << digits(value);
    }
    return QLatin1Char('[') + texts.join(QStringLiteral(", ")) + QLatin1Char(']');
  };
  return QStringLiteral(
             "{\"target\": %1, \"source\": %2, \"translation\": %3, \"rotation_xyzw\": %4, \"roll_pitch_yaw\": %5}")
      .arg(quoted(target), quoted(source), list({at.x, at.y, at.z}), list({turn.x, turn.y, turn.z, turn.w}),
           list({angles.x, angles.y, angles.z}));
}

}  // namespace stillframe::viewer
