#pragma once

#include <QObject>
#include <QString>
#include <map>
#include <string>
#include <vector>

#include "app/engine/machine_settings.h"
#include "app/gui/actions.h"
#include "app/gui/live_pictures.h"
#include "widgets/image/preferred_maps.h"
#include "widgets/inspect/explain_panel.h"
#include "widgets/panels/banner.h"
#include "widgets/panels/shader_panel.h"
#include "widgets/style/theme.h"

namespace ir::gui {

/// What a person chooses once for all projects, kept between runs. What the command line gives comes before
/// it, for this run.
class Preferences : public QObject {
    Q_OBJECT
  public:
    /// Without `remember` they begin with their defaults and are not kept.
    /// `theme`: of the command line, empty: not given.
    Preferences(bool remember, const engine::MachineFlags& flags, const std::string& theme = {});

    static const std::vector<ParameterDescription>& descriptions();
    /// In force, all of them.
    const Settings& settings() const { return settings_; }
    /// Options of the command line by the key of what they set: "--processor host".
    const std::map<std::string, QString>& given() const { return given_; }
    /// Throws UsageError. A given one stays.
    void set(const std::string& key, const Value& value);
    void reset(const std::string& key);

    engine::MachineSettings machine_settings() const;
    engine::MachineOptions machine() const;
    widgets::Theme theme() const;
    int font_size() const;  ///< points; 0: the desktop's
    bool drafts() const;    ///< coarser pictures are shown before the full ones
    widgets::PreferredMaps maps() const;

  signals:
    void changed(const std::string& key);
    void maps_changed();  ///< other colour maps are preferred

  private:
    Value allowed(const std::string& key, const Value& value) const;
    void read();
    void give(const engine::MachineFlags& flags, const std::string& theme);

    bool remember_;
    engine::MachineOptions options_;  ///< of the command line
    Settings settings_;
    std::map<std::string, QString> given_;
};

/// Shows the preferences and applies them at once: pictures that would be made in another way are made anew.
class PreferencesController : public QObject {
    Q_OBJECT
  public:
    /// `drafts`: whether the window has them at all.
    PreferencesController(QWidget& window, Preferences& preferences, Renderer& renderer, LivePictures& live,
                          Actions& actions, bool drafts);
    /// Both have a link by which passes run on OpenGL; a banner then says so and takes it back.
    void follow(const widgets::ShaderPanel& shaders, const widgets::ExplainPanel& explain,
                widgets::BannerStack& banners);

  private:
    void apply();
    void show();
    void use_opengl(widgets::BannerStack& banners);

    QWidget& window_;
    Preferences& preferences_;
    Renderer& renderer_;
    LivePictures& live_;
    bool drafts_;
};

}  // namespace ir::gui
