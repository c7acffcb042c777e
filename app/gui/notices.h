#pragma once

#include <QObject>
#include <functional>
#include <string>

#include "app/gui/status_line.h"
#include "widgets/panels/banner.h"
#include "widgets/panels/messages_panel.h"

namespace ir::gui {

/// That passes run on another processor now.
inline constexpr const char* processor_banner = "processor";

/// Says what has happened: in the status line, in the list of messages and in banners.
class Notices : public QObject {
    Q_OBJECT
  public:
    Notices(StatusLine& status, widgets::MessagesPanel& messages, widgets::BannerStack& banners)
        : status_(status), messages_(messages), banners_(banners) {}

    void say(const QString& text) { status_.say(text); }  ///< for a moment
    void add(const Message& message) { messages_.add(message); }
    /// An error in the list, under that source, and in a banner.
    void fail(const QString& banner, const std::string& source, const QString& error);
    /// Whether `work` went through; what it throws becomes the banner "file" and begins with `what`.
    bool attempt(const std::function<void()>& work, const QString& what);
    /// Takes over what a dock says and what it fails at; `name` is its banner's and its source.
    template <class Dock>
    void follow(const Dock& dock, const char* name) {
        docks_ << QLatin1String(name);
        connect(&dock, &Dock::said, this, &Notices::say);
        connect(&dock, &Dock::failed, this,
                [this, name](const QString& error) { fail(QLatin1String(name), name, error); });
    }
    /// The banner of a dock goes.
    void forget(const char* name) { banners_.hide_banner(QLatin1String(name)); }
    /// What was said of a project that is gone: of its docks, and of the processor that it began to use.
    void forget_project();
    widgets::BannerStack& banners() { return banners_; }

  private:
    StatusLine& status_;
    widgets::MessagesPanel& messages_;
    widgets::BannerStack& banners_;
    QStringList docks_;  ///< names of their banners
};

}  // namespace ir::gui
