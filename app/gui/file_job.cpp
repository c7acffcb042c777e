#include "app/gui/file_job.h"

#include <QProgressDialog>

#include "app/gui/text_of.h"
#include "renderers/core/reason.h"

namespace ir::gui {

FileJob::FileJob(QWidget& window, Notices& notices, const QString& title, const char* name)
    : window_(window), notices_(notices), title_(title), name_(name) {}

FileJob::~FileJob() {
    cancel_.cancel();
    if (thread_.joinable()) thread_.join();
}

void FileJob::start(const QString& file, const Work& work) {
    if (is_running()) return;
    if (thread_.joinable()) thread_.join();
    cancel_.reset();
    clock_.start();
    remaining_.start(0);
    dialog_ = new QProgressDialog(tr("Starting …"), tr("Cancel"), 0, 1000, &window_);
    dialog_->setObjectName(QString::fromLatin1(name_) + QStringLiteral("-progress"));
    dialog_->setWindowTitle(title_);
    dialog_->setAutoClose(false);
    dialog_->setAutoReset(false);
    connect(dialog_, &QProgressDialog::canceled, this, [this] { cancel_.cancel(); });
    emit changed();
    thread_ = std::thread([this, file, work] { run(file, work); });
}

/// On the job's thread.
void FileJob::run(const QString& file, const Work& work) {
    QString error;
    bool cancelled = false;
    try {
        work(cancel_, [this](const std::string& what, double fraction) {
            QMetaObject::invokeMethod(this, [this, what, fraction] { show_progress(what, fraction); });
        });
    } catch (const Cancelled&) {
        cancelled = true;
    } catch (const std::exception& failure) {
        error = text_of(reason_of(failure));
    }
    QMetaObject::invokeMethod(this, [this, file, error, cancelled] { finish(file, error, cancelled); });
}

void FileJob::show_progress(const std::string& what, double fraction) {
    if (!dialog_ || dialog_->wasCanceled()) return;
    remaining_.report(double(clock_.elapsed()) / 1000, fraction);
    const auto left = remaining_.seconds();
    dialog_->setLabelText(left ? tr("%1, %2 left").arg(text_of(what), duration_text(*left)) : text_of(what));
    dialog_->setValue(int(1000 * fraction));
}

void FileJob::finish(const QString& file, const QString& error, bool cancelled) {
    dialog_->deleteLater();
    dialog_ = nullptr;
    emit changed();
    if (cancelled) return notices_.say(tr("Cancelled: %1").arg(title_));
    if (!error.isEmpty()) return notices_.fail(QStringLiteral("file"), name_, error);
    notices_.say(tr("Wrote %1").arg(file));
    emit written(file);
}

}  // namespace ir::gui
