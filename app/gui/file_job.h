#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <functional>
#include <string>
#include <thread>

#include "app/gui/notices.h"
#include "app/gui/remaining_time.h"
#include "renderers/core/progress.h"

class QProgressDialog;

namespace ir::gui {

/// Writes files on a thread of its own, with progress, the time left and a way to stop, and says what became
/// of them.
class FileJob : public QObject {
    Q_OBJECT
  public:
    /// On the job's thread.
    using Work = std::function<void(const CancelToken& cancel, const ProgressCallback& progress)>;
    /// `title` for people; `name` is the source of its messages, and the dialog is "NAME-progress".
    FileJob(QWidget& window, Notices& notices, const QString& title, const char* name);
    ~FileJob() override;  ///< cancels and waits

    /// Nothing while it runs.
    void start(const QString& file, const Work& work);
    bool is_running() const { return dialog_ != nullptr; }

  signals:
    void changed();  ///< is_running()
    void written(const QString& file);

  private:
    void run(const QString& file, const Work& work);
    void show_progress(const std::string& what, double fraction);
    void finish(const QString& file, const QString& error, bool cancelled);

    QWidget& window_;
    Notices& notices_;
    const QString title_;
    const char* const name_;
    CancelToken cancel_;
    RemainingTime remaining_;
    QElapsedTimer clock_;
    QProgressDialog* dialog_ = nullptr;  ///< while it runs
    std::thread thread_;
};

}  // namespace ir::gui
