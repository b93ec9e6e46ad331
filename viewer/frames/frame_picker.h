#pragma once

#include <QComboBox>
#include <optional>
#include <string>
#include <vector>

namespace stillframe::viewer {

/// Frame picker: "auto (map)" first, then every frame ever seen, with search; a name that does not exist (yet)
/// may be typed and is shown as missing. GUI thread.
class FramePicker : public QComboBox {
  Q_OBJECT

 public:
  /// `what` names it in its tool tip ("Fixed frame"), `meaning` says what the frame is for.
  FramePicker(QString what, QString meaning, QWidget* parent = nullptr);

  /// All frames in order of first appearance. Cheap when the count is the one already shown.
  void setFrames(const std::vector<std::string>& frames);
  /// What the view uses now: the frame chosen by hand, if any, and the frame automatic choice gives.
  void setCurrent(const std::optional<std::string>& chosen, const std::string& automatic);
  [[nodiscard]] bool isMissing() const noexcept { return is_missing_; }
  /// Whether that frame has a place at the time shown; one without is dimmed, and the tool tip says so.
  void setPlaced(bool placed);
  [[nodiscard]] int frameCount() const { return count() - 1; }

 Q_SIGNALS:
  /// The user chose a frame by hand, or automatic choice (nullopt).
  void picked(const std::optional<std::string>& frame);

 protected:
  void focusOutEvent(QFocusEvent* event) override;

 private:
  void pickText();
  void showCurrent();

  QString what_;
  QString meaning_;
  std::optional<std::string> chosen_;
  std::string automatic_;
  bool is_missing_ = false;
  bool is_placed_ = true;
};

}  // namespace stillframe::viewer
