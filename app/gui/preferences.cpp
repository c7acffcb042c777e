#include "app/gui/preferences.h"

#include <QAction>
#include <QApplication>
#include <QSettings>
#include <algorithm>

#include "app/gui/notices.h"
#include "app/gui/text_of.h"
#include "renderers/core/error.h"
#include "renderers/image/colour_map.h"
#include "widgets/panels/preferences_dialog.h"

namespace ir::gui {
namespace {

constexpr int smallest_font = 6;  ///< points; that can be read, and changed back

constexpr const char* map_prefix = "map_";  ///< of keys

/// Of colour_map_names().
enum class Map : std::size_t {};
Map default_map(MappedKind kind) {
    const auto& names = colour_map_names();
    return Map(std::find(names.begin(), names.end(), default_colour_map(kind)) - names.begin());
}
std::string name_of(Map map) {
    return colour_map_names().at(std::size_t(map));
}

struct Maps {
    Map errors = default_map(MappedKind::errors);
    Map signed_errors = default_map(MappedKind::signed_errors);
    Map depths = default_map(MappedKind::depths);
    Map probabilities = default_map(MappedKind::probabilities);
    Map counts = default_map(MappedKind::counts);
    Map numbers = default_map(MappedKind::numbers);
};

struct Values {
    enum class Shade { system, dark, light };
    Shade theme = Shade::dark;
    int font_size = 0;
    engine::MachineSettings machine;
    bool drafts = true;
    Maps maps;
};

ParameterTable<Maps> map_table() {
    std::vector<Choice> choices;
    for (const auto& name : colour_map_names()) choices.push_back({name, name, ""});
    ParameterTable<Maps> t;
    const auto add = [&](Map Maps::*map, const char* key, const char* label, const char* doc) {
        t.add(map, {.key = std::string(map_prefix) + key, .label = label, .doc = doc, .choices = choices});
    };
    add(&Maps::errors, "errors", "Colours of errors",
        "Of absolute, relative and squared differences and of ꟻLIP.");
    add(&Maps::signed_errors, "signed", "Colours of signed differences",
        "The middle of the map is 0; one that goes two ways from there tells the signs apart.");
    add(&Maps::depths, "depths", "Colours of depths", "Of depths and distances.");
    add(&Maps::probabilities, "probabilities", "Colours of probabilities", "");
    add(&Maps::counts, "counts", "Colours of counts", "");
    add(&Maps::numbers, "numbers", "Colours of other numbers",
        "Of accessibility, masks and whatever else is one number a pixel.");
    return t;
}

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
                                   .label = "Font size",
                                   .doc = "Of the window's letters, 6 at least; 0: that of the desktop. "
                                          "Letters over pictures stay as they are.",
                                   .unit = "pt",
                                   .hard = {0, 32}});
        t.include(&Values::maps, map_table());
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
    widgets::prefer_maps(maps());
}

const std::vector<ParameterDescription>& Preferences::descriptions() {
    static const auto all = table().descriptions();
    return all;
}

/// One step below the smallest size of letters is the desktop's, one above that the smallest. Throws
/// UsageError.
Value Preferences::allowed(const std::string& key, const Value& value) const {
    const auto checked = find(descriptions(), key)->checked(value);
    const auto* size = std::get_if<std::int64_t>(&checked);
    if (key != "font_size" || !size || *size == 0 || *size >= smallest_font) return checked;
    const bool steps_down = *size == smallest_font - 1 && font_size() == smallest_font;
    return std::int64_t{steps_down ? 0 : smallest_font};
}

/// What another version or a hand has written and is not allowed counts as never chosen.
void Preferences::read() {
    const QSettings kept;
    for (const auto& each : descriptions()) {
        const auto text = kept.value(entry_of(each.key)).toString();
        if (text.isEmpty()) continue;
        try {
            settings_[each.key] = allowed(each.key, each.parse(text.toStdString()));
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
    const auto checked = allowed(key, value);
    if (given_.count(key) || settings_.at(key) == checked) return;
    if (remember_) QSettings().setValue(entry_of(key), text_of(to_string(checked)));
    settings_[key] = checked;
    emit changed(key);
    if (!key.starts_with(map_prefix)) return;
    widgets::prefer_maps(maps());
    emit maps_changed();
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
    return table().typed(settings_).font_size;
}

widgets::PreferredMaps Preferences::maps() const {
    const auto maps = table().typed(settings_).maps;
    return {
        {MappedKind::errors, name_of(maps.errors)}, {MappedKind::signed_errors, name_of(maps.signed_errors)},
        {MappedKind::depths, name_of(maps.depths)}, {MappedKind::probabilities, name_of(maps.probabilities)},
        {MappedKind::counts, name_of(maps.counts)}, {MappedKind::numbers, name_of(maps.numbers)}};
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

void PreferencesController::follow(const widgets::ShaderPanel& shaders, const widgets::ExplainPanel& explain,
                                   widgets::BannerStack& banners) {
    const auto use = [this, &banners] { use_opengl(banners); };
    connect(&shaders, &widgets::ShaderPanel::opengl_wanted, this, use);
    connect(&explain, &widgets::ExplainPanel::opengl_wanted, this, use);
}

void PreferencesController::use_opengl(widgets::BannerStack& banners) {
    const std::string key = "processor";
    const QString name = QLatin1String(processor_banner);
    const auto show = [&](const QString& text, const std::vector<widgets::BannerStack::Action>& actions) {
        banners.show_banner(name, widgets::BannerStack::Kind::note, text, actions);
    };
    if (const auto given = preferences_.given().find(key); given != preferences_.given().end())
        return show(tr("%1 of the command line stays for this run.").arg(given->second), {});
    const auto before = preferences_.settings().at(key);
    preferences_.set(key, to_string(Processor::gl));
    show(tr("Passes run on OpenGL now, in all projects. The preferences have the choice, too."),
         {{tr("Take it back"), [this, key, before, name, &banners] {
               preferences_.set(key, before);
               banners.hide_banner(name);
           }}});
}

void PreferencesController::show() {
    using Dialog = widgets::PreferencesDialog;
    if (auto* open = window_.findChild<Dialog*>()) return open->raise(), open->activateWindow();
    auto* dialog = new Dialog(
        Preferences::descriptions(),
        {{"font_size", tr("the desktop's")}, {"threads", tr("all")}, {"memory", tr("none")}}, &window_);
    const auto update = [this, dialog] { dialog->set_values(preferences_.settings(), preferences_.given()); };
    connect(&preferences_, &Preferences::changed, dialog, update);
    connect(dialog, &Dialog::value_chosen, &preferences_,
            [=, this](const std::string& key, const Value& value) {
                preferences_.set(key, value);
                update();  // another value may have been taken
            });
    connect(dialog, &Dialog::reset_chosen, &preferences_, &Preferences::reset);
    update();
    dialog->show();
}

}  // namespace ir::gui
