#include "app/gui/report_controller.h"

#include <QAction>
#include <QDesktopServices>
#include <QUrl>

#include "app/gui/dialog_folder.h"
#include "app/gui/text_of.h"
#include "app/report/write_html.h"

namespace ir::gui {
namespace {

/// Of the work, from that fraction on.
report::Work half(const report::Work& work, double from) {
    return {work.cancel, [&work, from](const std::string& what, double fraction) {
                work.progress(what, from + fraction / 2);
            }};
}

}  // namespace

ReportController::ReportController(QWidget& window, Session& session, Notices& notices, Actions& actions)
    : window_(window), session_(session), notices_(notices), job_(window, notices, tr("Report"), "report") {
    action_ = actions.add("report", tr("&Report …"), nullptr, {QKeySequence(Qt::CTRL | Qt::ALT | Qt::Key_R)},
                          [this] {
                              const auto file = ask_for_file(text_of(session_.document().name));
                              if (!file.isEmpty()) write_to(file);
                          });
    action_->setData(
        tr("One HTML file of the kept results: pictures to wipe and flip, metrics, plots, settings"));
    follow(session_, this, &ReportController::update);
    connect(&job_, &FileJob::changed, this, &ReportController::update);
    connect(&job_, &FileJob::written, this,
            [](const QString& file) { QDesktopServices::openUrl(QUrl::fromLocalFile(file)); });
    update();
}

void ReportController::update() {
    set_reason(*action_, is_writing()              ? tr("A report is being written.")
                         : !session_.has_project() ? tr("No project is open.")
                         : session_.open_project().folder().empty()
                             ? tr("Save the project first: results are kept in its folder.")
                             : QString());
}

QString ReportController::ask_for_file(const QString& title) {
    return ask_for_export(&window_, tr("Report"), title, tr("Web page (*.html)"), {QStringLiteral(".html")});
}

void ReportController::ask_for_sweep(const std::filesystem::path& folder, const QString& title) {
    if (is_writing()) return notices_.say(tr("A report is being written."));
    const auto file = ask_for_file(title);
    if (!file.isEmpty()) write_to(file, of_sweep(folder));
}

void ReportController::write_to(const QString& file) {
    write_to(file, [project = session_.document(), folder = session_.open_project().folder()](
                       const std::string& path, const report::Work& work) {
        report::write_html(path, report::report_of(project, folder, half(work, 0)), {}, half(work, 0.5));
    });
}

ReportController::Maker ReportController::of_sweep(const std::filesystem::path& folder) {
    return [folder](const std::string& path, const report::Work& work) {
        const auto made = report::report_of_sweep(folder, report::usual_sweep_pictures, half(work, 0));
        report::write_html(path, made, {}, half(work, 0.5));
    };
}

void ReportController::write_to(const QString& file, const Maker& make) {
    job_.start(file, [file, make](const CancelToken& cancel, const ProgressCallback& progress) {
        make(file.toStdString(), {&cancel, progress});
    });
}

}  // namespace ir::gui
