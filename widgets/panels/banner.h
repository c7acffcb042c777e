#pragma once

#include <QFrame>
#include <QStringList>
#include <functional>
#include <utility>
#include <vector>

class QVBoxLayout;

namespace ir::widgets {

/// Lines above the picture that ask for attention without stopping anybody. Each has a name; a new one with
/// the same name replaces the old.
class BannerStack : public QWidget {
    Q_OBJECT
  public:
    enum class Kind { note, warning, error };
    using Action = std::pair<QString, std::function<void()>>;

    explicit BannerStack(QWidget* parent = nullptr);
    void show_banner(const QString& name, Kind kind, const QString& text,
                     const std::vector<Action>& actions = {}, bool closable = true);
    void hide_banner(const QString& name);
    void clear();
    QStringList names() const;
    QString text(const QString& name) const;

  private:
    QWidget* find_banner(const QString& name) const;
    QVBoxLayout* layout_;
};

}  // namespace ir::widgets
