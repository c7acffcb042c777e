#include "app/gui/preferences.h"

#include <QAction>
#include <QApplication>
#include <QSettings>
#include <algorithm>

#include "app/gui/text_of.h"
#include "renderers/core/error.h"
#include "widgets/panels/preferences_dialog.h"

namespace ir::gui {
namespace {

struct Values {
    enum class Shade { system, dark, light };
    Shade theme = Shade::dark;
    int font_size = 0;
    engine::MachineSettings machine;
    bool drafts = true;
};

const ParameterTable<Values>& table() {
    static const auto all = [] {
        ParameterTable<Values> t;
        t.add(&Values::theme, {.key = "theme",
                               .label = "Theme",
                               .doc = "Ground of the window. Pictures stand on the same grey in all.",
                               .choices = {{"system", "System", "As the desktop was when the program began."},
                                           {"dark", "Dark", "Light letters on dark grey."},
                                           {"light", "Light", "Dark letters on light grey."}}});
        t.add(&Values::font_size, {.key = "font_size",
                                   .label = "Font size (0: the desktop's)",
                                   .doc = "Of the window's letters, 6 at least; 0: that of the desktop. "
                                          "Letters over pictures stay as they are.",
                                   .unit = "pt",
                                   .hard = {0, 32}});
        t.include(&Values::machine, engine::machine_settings());
        return t.add(&Values::drafts, {.key = "drafts",
                                       .label = "Coarse pictures first",
                                       .doc = "A preview and coarser pictures are shown, marked, until the "
                                              "full one is there."});
    }();
    return all;
}

QString entry_of(const std::string& key) {
    return QStringLiteral("preferences/") + text_of(key);
}

}  // namespace

Preferences::Preferences(bool remember, const engine::MachineFlags& flags, const std::string& theme)
    : remember_(remember), options_(engine::machine_options(flags)), settings_(defaults(descriptions())) {
    if (remember_) read();
    give(flags, theme);
}

const std::vector<ParameterDescription>& Preferences::descriptions() {
    static const auto all = table().descriptions();
    return all;
}

/// What another version or a hand has written and is not allowed counts as never chosen.
void Preferences::read() {
    const QSettings kept;
    for (const auto& each : descriptions()) {
        const auto text = kept.value(entry_of(each.key)).toString();
        if (text.isEmpty()) continue;
        try {
            settings_[each.key] = each.parse(text.toStdString());
        } catch (const UsageError&) {
        }
    }
}

void Preferences::give(const engine::MachineFlags& flags, const std::string& theme) {
    const auto give = [this](const char* key, const std::string& text, auto value) {
        settings_[key] = find(descriptions(), key)->checked(value);
        given_[key] = QStringLiteral("--%1 %2").arg(QLatin1String(key), text_of(text));
    };
    if (!theme.empty()) give("theme", theme, Value(theme));
    if (!flags.processor.empty()) give("processor", flags.processor, Value(flags.processor));
    if (flags.threads) give("threads", std::to_string(*flags.threads), Value(std::int64_t{*flags.threads}));
    if (!flags.memory.empty())
        give("memory", flags.memory, Value(engine::gigabytes(engine::parse_bytes(flags.memory))));
}

void Preferences::set(const std::string& key, const Value& value) {
    const auto checked = find(descriptions(), key)->checked(value);
    if (given_.count(key) || settings_.at(key) == checked) return;
    if (remember_) QSettings().setValue(entry_of(key), text_of(to_string(checked)));
    settings_[key] = checked;
    emit changed(key);
}

void Preferences::reset(const std::string& key) {
    set(key, find(descriptions(), key)->default_value);
    if (remember_ && !given_.count(key)) QSettings().remove(entry_of(key));
}

engine::MachineSettings Preferences::machine_settings() const {
    return table().typed(settings_).machine;
}

engine::MachineOptions Preferences::machine() const {
    auto machine = options_;
    const auto chosen = machine_settings();
    machine.processor = chosen.chosen_processor();
    machine.threads = chosen.threads;
    return machine;
}

widgets::Theme Preferences::theme() const {
    switch (table().typed(settings_).theme) {
        case Values::Shade::system:
            return widgets::system_theme();
        case Values::Shade::light:
            return widgets::Theme::light;
        default:
            return widgets::Theme::dark;
    }
}

int Preferences::font_size() const {
    constexpr int smallest = 6;  // that can be read, and changed back
    const int chosen = table().typed(settings_).font_size;
    return chosen > 0 ? std::max(chosen, smallest) : 0;
}

bool Preferences::drafts() const {
    return table().typed(settings_).drafts;
}

PreferencesController::PreferencesController(QWidget& window, Preferences& preferences, Renderer& renderer,
                                             LivePictures& live, Actions& actions, bool drafts)
    : window_(window), preferences_(preferences), renderer_(renderer), live_(live), drafts_(drafts) {
    actions
        .add("preferences", tr("&Preferences …"), nullptr, {QKeySequence(Qt::CTRL | Qt::Key_Comma)},
             [this] { show(); })
        ->setMenuRole(QAction::PreferencesRole);
    connect(&preferences_, &Preferences::changed, this, [this](const std::string& key) {
        apply();
        if (key == "processor" || key == "memory") live_.render_again();
    });
    apply();
}

void PreferencesController::apply() {
    widgets::apply_theme(*qApp, preferences_.theme());
    widgets::apply_font_size(*qApp, preferences_.font_size());
    const auto machine = preferences_.machine_settings();
    renderer_.set_machine(machine);
    live_.set_memory_budget(machine.memory_budget());
    live_.set_drafts(drafts_ && preferences_.drafts());
}

void PreferencesController::show() {
    using Dialog = widgets::PreferencesDialog;
    if (auto* open = window_.findChild<Dialog*>()) return open->raise(), open->activateWindow();
    auto* dialog = new Dialog(Preferences::descriptions(), &window_);
    const auto update = [this, dialog] { dialog->set_values(preferences_.settings(), preferences_.given()); };
    connect(&preferences_, &Preferences::changed, dialog, update);
    connect(dialog, &Dialog::value_chosen, &preferences_, &Preferences::set);
    connect(dialog, &Dialog::reset_chosen, &preferences_, &Preferences::reset);
    update();
    dialog->show();
}

}  // namespace ir::gui
