#include "app/gui/set_up_controller.h"

#include <QAction>

#include "app/gui/beside.h"
#include "projects/set_up.h"
#include "renderers/core/resources_path.h"
#include "widgets/panels/action_cards.h"

namespace ir::gui {
namespace {

constexpr std::pair<const char*, const char*> set_ups[] = {{"occlusion", "set-up-occlusion"},
                                                           {"light", "set-up-light"},
                                                           {"truth", "match"},
                                                           {"space", "set-up-space"},
                                                           {"stages", "stages"}};

/// One that comes with the program; null: an installation without.
QImage picture_of(const QString& name) {
    const auto file = samples_directory() / "set-ups" / (name.toStdString() + ".jpg");
    return QImage(QString::fromStdString(file.string()));
}

}  // namespace

SetUpController::SetUpController(QWidget& window, Session& session, LivePictures& live, Workspace& workspace,
                                 Actions& actions)
    : window_(window), actions_(actions), session_(session), live_(live), workspace_(workspace) {
    using K = QKeySequence;
    const auto add = [&](const char* name, const QString& text, Qt::Key key, const char* paths,
                         const QString& doc) {
        adding_.push_back(actions.add(name, text, nullptr, {K(Qt::CTRL | Qt::ALT | key)},
                                      [this, paths] { show_methods(paths); }));
        adding_.back()->setData(doc);
    };
    add("set-up-occlusion", tr("&Occlusion: all methods and the truth"), Qt::Key_O, "ao",
        tr("An experiment of each method at its defaults, and their reference, side by side"));
    add("set-up-light", tr("&Light: all methods and the truth"), Qt::Key_G, "full",
        tr("An experiment of each method at its defaults, and their reference, side by side"));
    space_ = actions.add("set-up-space", tr("&What stands in space"), nullptr,
                         {K(Qt::CTRL | Qt::ALT | Qt::Key_P)}, [this] { show_space(); });
    space_->setData(tr("The method's points, lines and directions over its scene, beside the picture"));
    actions.add("set-ups", tr("&Choose by a picture …"), nullptr, {K(Qt::CTRL | Qt::ALT | Qt::Key_C)},
                [this] { show_cards(); });
    follow(session_, this, &SetUpController::update);
    update();
}

QStringList SetUpController::names() {
    QStringList result;
    for (const auto& each : set_ups) result << QLatin1String(each.first);
    return result;
}

QString SetUpController::action_of(const QString& name) {
    for (const auto& [known, action] : set_ups)
        if (name == QLatin1String(known)) return QLatin1String(action);
    return {};
}

void SetUpController::show_cards() {
    std::vector<widgets::ActionCards::Content> cards;
    for (const auto& name : names()) cards.push_back({actions_.find(action_of(name)), picture_of(name)});
    auto* dialog = new widgets::ActionCards(tr("Set up"), cards, &window_);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->open();
}

void SetUpController::update() {
    const bool has_experiment = session_.has_project() && session_.experiment();
    const auto none = has_experiment ? QString() : tr("There is no experiment to begin with.");
    const bool is_fixed = has_experiment && session_.open_project().is_read_only();
    for (auto* action : adding_)
        set_reason(*action, is_fixed ? read_only_text(session_.open_project()) : none);
    set_reason(*space_, none);
}

void SetUpController::show_methods(const std::string& paths) {
    std::vector<std::string> shown;
    session_.edit([&](const projects::Project& project) {
        auto made = projects::methods_beside_truth(
            project, session_.experiment()->id, paths, session_.registry(),
            [this](const std::string& scene) { return live_.scene_end(scene) > 0; });
        shown = std::move(made.experiments);
        return std::move(made.edit);
    });
    session_.end_gesture();
    if (shown.empty() || !session_.experiment(shown.back())) return;
    auto& area = workspace_.area();
    area.arrange(widgets::ViewArea::Arrangement::one);
    widgets::ViewState state;
    state.mode = widgets::ViewMode::stages;
    state.a.owner = shown.front();
    for (std::size_t i = 1; i < shown.size(); ++i) state.more.push_back({shown[i], {}});
    state.pair.b = widgets::StagePair::reference;  // those that see less far than others have another truth
    workspace_.views().set_active_state(state);
}

void SetUpController::show_space() {
    const std::string owner = session_.experiment()->id;
    auto& views = workspace_.views();
    std::vector<std::string> keys;
    for (const auto& buffer : views.rules().spatial_buffers(owner))
        if (!views.rules().is_explanation({owner, buffer.key})) keys.push_back(buffer.key);
    workspace_.area().arrange(widgets::ViewArea::Arrangement::one);
    views.show_owner(owner);
    show_in_space(views, workspace_.area(), owner, keys);
}

}  // namespace ir::gui
