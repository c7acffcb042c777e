#include "app/gui/figure_controller.h"

#include <QAction>

#include "app/gui/dialog_folder.h"
#include "app/gui/json_fields.h"
#include "app/gui/shown_pictures.h"
#include "app/gui/text_of.h"
#include "projects/text.h"

namespace ir::gui {
namespace {

report::FigurePicture figure_picture(const SeenPicture& seen) {
    const auto& picture = *seen.shown.picture;
    engine::Side side;
    side.file = seen.shown.name.toStdString();
    side.image = *picture.image;
    side.semantic = picture.semantic;
    if (picture.valid) side.valid = *picture.valid;
    const QImage shown =
        widgets::to_qimage(widgets::shown_channels(*picture.image, seen.display.channel), seen.display)
            .convertToFormat(QImage::Format_RGB888);
    report::Raster raster{shown.width(), shown.height(), {}};
    for (int y = 0; y < shown.height(); ++y)
        raster.bytes.insert(raster.bytes.end(), shown.constScanLine(y),
                            shown.constScanLine(y) + 3 * shown.width());
    return {projects::printable(side.file, 300), std::make_shared<const engine::Side>(std::move(side)),
            std::make_shared<const report::Raster>(std::move(raster))};
}

}  // namespace

FigureController::FigureController(QWidget& window, Session& session, Workspace& workspace, Notices& notices,
                                   Actions& actions)
    : window_(window), session_(session), workspace_(workspace), notices_(notices) {
    auto* action = actions.add("figure", tr("&Figure …"), nullptr,
                               {QKeySequence(Qt::CTRL | Qt::ALT | Qt::Key_F)}, [this] { open(); });
    action->setData(tr("The shown pictures for a paper, with zoomed rectangles and numbers: PDF, SVG, PNG"));
    const auto update = [this, action] {
        set_reason(*action, session_.experiment() ? QString() : tr("There is no experiment to show."));
    };
    follow(session_, this, update);
    update();
    connect(&workspace_.tools(), &PictureTools::region_changed, this, &FigureController::offer_rectangle);
    connect(&workspace_, &Workspace::picture_shown, this, &FigureController::offer_pictures);
    connect(&workspace_.views(), &ViewModel::shown_changed, this, &FigureController::offer_pictures);
}

void FigureController::make_dialog() {
    dialog_ = new FigureDialog(&window_);
    connect(dialog_, &FigureDialog::file_wanted, this, &FigureController::ask);
    connect(dialog_, &FigureDialog::written, this,
            [this](const QString& file) { notices_.say(tr("Wrote %1").arg(file)); });
    connect(dialog_, &FigureDialog::failed, this,
            [this](const QString& error) { notices_.fail(QStringLiteral("file"), "figure", error); });
    dialog_->load(memory_);
}

void FigureController::open() {
    if (!dialog_) make_dialog();
    dialog_->show();
    dialog_->raise();
    offer_rectangle();
    offer_pictures();
}

void FigureController::offer_pictures() {
    if (!dialog_ || !dialog_->isVisible()) return;
    bool awaits = false;
    const auto shown = shown_pictures(workspace_, awaits);
    if (awaits) return;  // they come soon; until then those before keep their places and names
    std::vector<report::FigurePicture> pictures;
    for (const auto& seen : shown) {
        if (pictures.size() == report::Figure::max_pictures) break;
        pictures.push_back(figure_picture(seen));
    }
    dialog_->set_pictures(std::move(pictures));
}

void FigureController::offer_rectangle() {
    if (!dialog_ || !dialog_->isVisible()) return;
    const auto& tools = workspace_.tools();
    dialog_->set_rectangle(tools.region_size(), tools.region(tools.region_size()));
}

void FigureController::ask() {
    const auto file =
        ask_for_export(&window_, tr("Figure"), text_of(session_.document().name) + tr(" figure"),
                       tr("Figure (*.pdf *.svg *.png)"), {".pdf", ".svg", ".png"});
    if (file.isEmpty()) return;
    dialog_->save_to(file);
}

void FigureController::save(projects::Json& memory) const {
    memory["figure"] = dialog_ ? dialog_->save() : memory_;
}

void FigureController::load(const projects::Json& memory) {
    memory_ = member_or_null(memory, "figure");
    if (!dialog_) return;
    dialog_->close();
    dialog_->set_pictures({});
    dialog_->load(memory_);
}

}  // namespace ir::gui
