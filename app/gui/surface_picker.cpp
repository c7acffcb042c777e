#include "app/gui/surface_picker.h"

#include <QAction>
#include <utility>

#include "app/engine/camera_pose.h"
#include "app/gui/actions.h"
#include "app/gui/text_of.h"
#include "widgets/document/project_nodes.h"
#include "widgets/models/report_rows.h"

namespace ir::gui {
namespace {

const char* const picker = "picker ";

QString in_short(const QString& name) {
    constexpr int max_length = 40;
    return in_menu(name.size() > max_length ? name.left(max_length - 1) + QStringLiteral("…") : name);
}

}  // namespace

SurfacePicker::SurfacePicker(Session& session, LivePictures& live, Renderer& renderer, Workspace& workspace,
                             PixelInspector& inspector, DocumentDock& document, DockLayout& docks,
                             Notices& notices, Actions& actions)
    : session_(session),
      live_(live),
      renderer_(renderer),
      workspace_(workspace),
      inspector_(inspector),
      document_(document),
      docks_(docks),
      notices_(notices) {
    const auto add = [&](const char* name, Qt::Key key, const QString& help, Purpose purpose) {
        const QKeySequence keys(Qt::SHIFT | key);
        auto* action =
            actions.add(name, {}, "scene", {keys}, [this, purpose] { find(inspector_.pointed(), purpose); });
        action->setData(QStringLiteral("%1 (%2)").arg(help, keys.toString(QKeySequence::NativeText)));
        return action;
    };
    material_ = add("edit-material", Qt::Key_M, tr("What the surface under the cursor is made of"),
                    Purpose::material);
    object_ =
        add("edit-object", Qt::Key_O,
            tr("The file that the surface under the cursor is from: where it stands, and its materials"),
            Purpose::object);
    connect(&renderer_, &Renderer::surface_arrived, this, &SurfacePicker::on_surface);
    connect(&workspace_, &Workspace::picked, this, &SurfacePicker::on_picked);
    // Menus name what was clicked.
    connect(&workspace_, &Workspace::menu_wanted, this,
            [this] { find(inspector_.pointed(), Purpose::tell); });
    connect(&docks_, &DockLayout::seen_changed, this, &SurfacePicker::tell);
    connect(&workspace_, &Workspace::cursor_moved, this, &SurfacePicker::update_actions);
    connect(&workspace_.views(), &ViewModel::active_changed, this, &SurfacePicker::update_actions);
    connect(&live_, &LivePictures::state_changed, this, &SurfacePicker::on_state);
    connect(&document_.editor(), &widgets::ItemEditor::pick_wanted, this, &SurfacePicker::pick);
    connect(&session_, &Session::project_replaced, this, [this] {
        picked_ = {-1, -1};
        pixel_.reset();
        found_.reset();
        pick(false);
    });
    follow(session_, this, &SurfacePicker::update_actions);
    follow(session_, this, &SurfacePicker::update_form);
    update_actions();
    update_form();
}

/// As the picture shows it that is there; absent: there is none, or the pixel is no one place of it.
std::optional<SurfacePicker::Pixel> SurfacePicker::pixel_at(QPoint pixel) const {
    const auto owner = workspace_.views().active_state().a.owner;
    const auto result = session_.experiment(owner) ? live_.result(owner) : nullptr;
    const auto size = workspace_.views().rules().main_size(owner);
    if (!result || live_.past().is_elsewhere() || !QRect(QPoint(0, 0), size).contains(pixel)) return {};
    return Pixel{owner, engine::pose_of(result->camera), pixel};
}

void SurfacePicker::find(QPoint at, Purpose purpose) {
    const auto pixel = pixel_at(at);
    if (!pixel) {
        const auto why_not = live_.past().why_not_now();
        if (purpose != Purpose::tell)
            notices_.say(!why_not.isEmpty() ? why_not : tr("Point at a surface in a picture, or click it."));
        return update_actions();
    }
    const bool is_known = pixel == pixel_;
    if (purpose != Purpose::tell || !is_known) purpose_ = purpose;
    if (is_known && found_) return act(std::exchange(purpose_, Purpose::tell));
    if (is_known) return;  // the answer is under way
    pixel_ = pixel;
    found_.reset();
    const auto size = workspace_.views().rules().main_size(pixel->experiment);
    const auto sight =
        widgets::sight_through(pixel->camera, double(size.width()) / size.height(),
                               {(at.x() + 0.5) / size.width(), (at.y() + 0.5) / size.height()});
    renderer_.find_surface(
        {pixel->experiment, sight.origin, sight.direction, picker + std::to_string(++asked_)});
    update_actions();
}

void SurfacePicker::on_surface(const engine::SurfaceResult& result) {
    if (!pixel_ || result.asker != picker + std::to_string(asked_)) return;
    found_ = result;
    act(std::exchange(purpose_, Purpose::tell));
    if (!result.error.empty()) pixel_.reset(), found_.reset();  // asked again later
}

void SurfacePicker::act(Purpose purpose) {
    inspector_.panel().set_surface(text());
    update_actions();
    if (purpose == Purpose::tell) return;
    if (!found_->error.empty()) return notices_.say(tr("No surface yet: %1.").arg(text_of(found_->error)));
    if (!found_->point) return notices_.say(tr("There is no surface under the cursor."));
    const auto* experiment = session_.experiment(pixel_->experiment);
    if (!experiment) return;
    docks_.raise("project");
    if (purpose == Purpose::object)
        notices_.say(
            tr("“%1” is moved with its whole file. Of the object alone only its materials are changed "
               "here; the rest is changed in the file itself.")
                .arg(object_text()));
    document_.show_surface({widgets::ItemKind::part, text_of(experiment->scene), found_->point->part},
                           purpose == Purpose::material ? text_of(found_->point->material) : QString());
}

void SurfacePicker::on_picked(QPoint pixel) {
    picked_ = pixel;
    if (picks_ && pixel.x() >= 0) {
        pick(false);
        return find(pixel, Purpose::material);
    }
    tell();
}

void SurfacePicker::tell() {
    if (docks_.is_seen("inspector") && picked_.x() >= 0) find(picked_, Purpose::tell);
}

/// Another picture of the same camera shows what was changed. What a moving camera sees is not asked for: in
/// large scenes that takes long.
void SurfacePicker::on_state(const std::string& experiment) {
    if (!found_ || pixel_->experiment != experiment || live_.state(experiment) != LivePictures::State::done)
        return;
    const auto before = std::exchange(pixel_, std::nullopt);
    if (before == pixel_at(before->at) && docks_.is_seen("inspector")) {
        find(before->at, Purpose::tell);
    } else {
        found_.reset();
        inspector_.panel().set_surface(text());
        update_actions();
    }
}

void SurfacePicker::pick(bool on) {
    if (on && !picks_) notices_.say(tr("Click a surface in a picture."));
    picks_ = on;
    update_form();
}

void SurfacePicker::update_form() {
    document_.editor().set_picking(picks_,
                                   session_.experiment() ? QString() : tr("There is no picture to pick in."));
}

QString SurfacePicker::object_text() const {
    return widgets::node_name(found_->point->object, found_->point->node);
}

QString SurfacePicker::text() const {
    if (!found_ || !found_->error.empty()) return {};
    const auto pixel = tr("Pixel %1, %2: ").arg(pixel_->at.x()).arg(pixel_->at.y());
    if (!found_->point) return pixel + tr("no surface");
    const auto text =
        pixel + tr("material “%1” of object “%2”").arg(text_of(found_->point->material), object_text());
    const auto* chosen = session_.experiment(pixel_->experiment);
    const auto* scene = chosen ? projects::find_item(session_.document().scenes, chosen->scene) : nullptr;
    const auto part = std::size_t(found_->point->part);
    if (!scene || scene->parts.size() < 2 || part >= scene->parts.size()) return text;
    return text + tr(", file %1").arg(widgets::source_name(scene->parts[part].source));
}

void SurfacePicker::update_actions() {
    const auto at = inspector_.pointed();
    const auto pixel = pixel_at(at);
    const bool is_known = pixel && pixel == pixel_ && found_;
    const auto* point = is_known && found_->point ? &*found_->point : nullptr;
    QString why_not = session_.experiment() ? QString() : tr("There is no picture to pick in.");
    if (why_not.isEmpty() && !pixel) why_not = live_.past().why_not_now();
    if (why_not.isEmpty() && !pixel) why_not = tr("Point at a surface in a picture, or click it.");
    if (why_not.isEmpty() && is_known && !point) why_not = tr("There is no surface under the cursor.");
    QString material = tr("&Edit material"), object = tr("Edit ob&ject");
    if (point) {
        material = tr("&Edit material “%1”").arg(in_short(text_of(point->material)));
        object = tr("Edit ob&ject “%1”").arg(in_short(object_text()));
    }
    material_->setText(material);
    object_->setText(object);
    for (auto* action : {material_, object_}) set_reason(*action, why_not);
}

}  // namespace ir::gui
