#pragma once

#include <QDateTime>
#include <QImage>
#include <QString>
#include <QStringList>
#include <QWidget>
#include <vector>

class QBoxLayout;
class QLabel;
class QLineEdit;
class QScrollArea;
class QVBoxLayout;

namespace ir::widgets {

class SampleCard;

/// A project that was open before.
struct RecentProject {
    QString path, name;  ///< without a name that of the folder
    QDateTime when;      ///< last opened or saved; invalid: not known
    QImage thumbnail;    ///< null: none
    bool missing = false;
};

/// A project that comes with the program.
struct SampleProject {
    QString path, name, description;
    QImage thumbnail;
    QString group;       ///< heading that it stands under, such as its paper
    double seconds = 0;  ///< until its pictures are complete; 0: not known
};

/// What the window shows while no project is open.
class WelcomePage : public QWidget {
    Q_OBJECT
  public:
    explicit WelcomePage(QWidget* parent = nullptr);
    void set_samples(const std::vector<SampleProject>& samples);
    void set_recent(const std::vector<RecentProject>& projects);
    /// Paths alone; shown by name.
    void set_samples(const QStringList& paths);
    void set_recent(const QStringList& paths);

  signals:
    void new_chosen();
    void open_chosen();
    void project_chosen(const QString& path);
    void recent_removed(const QString& path);

  protected:
    void resizeEvent(QResizeEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;

  private:
    QWidget* make_start();
    /// Hides the samples that do not have all words of the search.
    void search(const QString& text);
    void move_focus(int key);

    struct Section {
        QLabel* heading;
        QWidget* cards;
        std::vector<std::pair<SampleCard*, QString>> samples;  ///< with the text that is searched
    };
    std::vector<Section> sections_;
    QBoxLayout* halves_;  ///< what begins and was begun beside the samples; in narrow windows above them
    QScrollArea* scroll_;
    QLineEdit* search_;
    QLabel* nothing_;
    QVBoxLayout *samples_, *recent_;
};

}  // namespace ir::widgets
