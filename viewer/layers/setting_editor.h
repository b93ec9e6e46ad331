#pragma once

#include <QString>
#include <QWidget>
#include <functional>
#include <string>

#include "scenegraph/settings.h"

namespace stillframe::viewer {

/// Keeps what is within an editor from three surprises: a wheel that scrolls the panel does not change what happens to
/// pass beneath it, where no text is half typed, undo is that of the view, and Escape forgets what is half typed and
/// goes back to the tree that the editor is in. Belongs to the editor. GUI thread.
class EditorFilter : public QObject {
  Q_OBJECT

 public:
  explicit EditorFilter(QWidget& editor);

 Q_SIGNALS:
  /// What is half typed is to be as it was; the focus moves on next.
  void cancelled();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
};

/// A widget for one setting, built from its spec alone: check box, number box (with a slider when the range is short),
/// combo box (with search when the choices are many), line edit or colour button. GUI thread.
class SettingEditor : public QWidget {
  Q_OBJECT

 public:
  SettingEditor(const scenegraph::SettingSpec& spec, const std::string& text, QWidget* parent = nullptr);

  [[nodiscard]] const scenegraph::SettingSpec& spec() const noexcept { return spec_; }
  /// Shows `text` without telling anybody; leaves a widget alone that the user is typing in.
  void setText(const std::string& text);

 Q_SIGNALS:
  /// The user has chosen `text`.
  void edited(const QString& key, const QString& text);

 private:
  QWidget* makeBool();
  QWidget* makeInt();
  QWidget* makeDouble();
  QWidget* makeChoice();
  QWidget* makeText();
  QWidget* makeColor();
  void emitEdited(const std::string& text);
  void forgetTyped();

  scenegraph::SettingSpec spec_;
  std::string text_;
  std::function<void(const std::string&)> show_;
};

/// Whether two lists of specs need the same widgets.
[[nodiscard]] bool isSameSpecs(const std::vector<scenegraph::SettingSpec>& a,
                               const std::vector<scenegraph::SettingSpec>& b);

}  // namespace stillframe::viewer
