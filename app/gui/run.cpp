#include "app/gui/run.h"

#include <CLI/CLI.hpp>
#include <QApplication>
#include <QElapsedTimer>
#include <QLoggingCategory>
#include <QSocketNotifier>
#include <QTimer>
#include <csignal>
#include <filesystem>
#include <future>
#include <iostream>
#include <memory>

#include "app/engine/interruption.h"
#include "app/engine/version.h"
#include "app/gui/card_picture.h"
#include "app/gui/export_plot.h"
#include "app/gui/exports.h"
#include "app/gui/main_window.h"
#include "projects/light_spec.h"
#include "renderers/core/error.h"
#include "renderers/core/write_file.h"
#include "renderers/image/codecs/codecs.h"
#include "renderers/image/exr.h"
#include "widgets/style/icons.h"
#include "widgets/style/theme.h"

namespace ir::gui {
namespace {

/// Nothing was under way for so long before the window is grabbed; so often it is looked at.
constexpr int settle_ms = 400, look_ms = 50;
constexpr int failed = 1, bad_input = 3;

struct Arguments {
    std::string project, layout, set_up, theme, screenshot, thumbnail, size, plot, plot_file;
    engine::MachineFlags machine;
    int scale = 1;
    bool dark = false;

    bool exports() const { return !plot_file.empty(); }
    bool takes_picture() const { return !screenshot.empty() || !thumbnail.empty(); }
    bool needs_screen() const { return !takes_picture() && !exports(); }
};

/// Throws UsageError for one that no layout has or had.
void take_present_name(std::string& layout) {
    if (layout.empty()) return;
    const auto present = DockLayout::present_name(QString::fromStdString(layout)).toStdString();
    if (present != layout)
        std::cerr << "interreflect: the layout '" << layout << "' is called '" << present << "' now\n";
    layout = present;
}

void describe(CLI::App& command, Arguments& arguments) {
    command.set_version_flag("--version", "interreflect " + engine::version_and_commit());
    command.add_option("project", arguments.project,
                       "Project folder, scene file (.gltf, .glb) or builtin:NAME to open");
    command.add_option("--layout", arguments.layout,
                       "Arrangement of the docks: " + DockLayout::names().join(", ").toStdString());
    std::vector<std::string> set_ups;
    for (const auto& name : SetUpController::names()) set_ups.push_back(name.toStdString());
    command
        .add_option("--set-up", arguments.set_up,
                    "What the menu Set up does, once the first pictures are there")
        ->check(CLI::IsMember(set_ups));
    command.add_option("--theme", arguments.theme, "system, dark or light, for this run")
        ->check(CLI::IsMember({"system", "dark", "light"}));
    command.add_option("--screenshot", arguments.screenshot,
                       "Wait until everything shown is rendered, save the window as PNG and quit");
    command.add_option(
        "--thumbnail", arguments.thumbnail,
        "The same with the first view's picture alone, as a small JPEG for a card of the start page; "
        "prints how many seconds the window took");
    command.add_option("--size", arguments.size, "Size of the window, or of the exported plot, WxH");
    auto* plot = command.add_option("--plot", arguments.plot,
                                    "Show this plot of the project, and carry it out unless its numbers are "
                                    "kept and current");
    auto* file = command.add_option("--export", arguments.plot_file,
                                    "Write that plot to a .png or .csv file instead of opening a window");
    file->needs(plot);
    command.add_option("--scale", arguments.scale, "Pixels of the exported picture for one of its --size")
        ->check(CLI::Range(1, 8))
        ->needs(file);
    command.add_flag("--dark", arguments.dark, "Export the plot as the window shows it, not on white")
        ->needs(file);
    engine::add_machine_flags(command, arguments.machine);
}

std::string in_one_line(const std::string& text) {
    return QString::fromStdString(text).simplified().toStdString();
}

/// What the views lack, each reason once.
QStringList missing(MainWindow& window) {
    QStringList reasons;
    for (const int view : window.workspace().area().open_views()) reasons << window.workspace().missing(view);
    reasons.removeAll(QString());
    reasons.removeDuplicates();
    return reasons;
}

/// Once what the window shows has arrived, as some of what is set up depends on it. Says what cannot be.
void set_up(MainWindow& window, const Arguments& arguments, const std::function<void(bool was_done)>& then) {
    auto* looks = new QTimer(&window);
    QObject::connect(looks, &QTimer::timeout, &window, [&window, looks, then, name = arguments.set_up] {
        if (!window.is_settled()) return;
        looks->stop();
        looks->deleteLater();
        auto* action = window.action(SetUpController::action_of(QString::fromStdString(name)));
        const bool can = action->isEnabled();
        if (!can)
            std::cerr << "interreflect: --set-up " << name << ": "
                      << action->toolTip().section('\n', -1).toStdString() << "\n";
        action->trigger();  // nothing where it is disabled
        then(can);
    });
    looks->start(look_ms);
}

/// Saves the window once nothing has been under way for a while, and ends the program. The state is looked at
/// again and again: whatever forgot to say that it is done would be waited for in vain.
void take_screenshot(MainWindow& window, const Arguments& arguments) {
    auto* looks = new QTimer(&window);
    const auto reasons = std::make_shared<QStringList>();
    QElapsedTimer begun;
    begun.start();
    QObject::connect(&window.plots(), &PlotsDock::failed, looks,
                     [reasons](const QString& reason) { *reasons << reason; });
    QObject::connect(looks, &QTimer::timeout, &window,
                     [&window, arguments, reasons, begun, still = QElapsedTimer()]() mutable {
                         if (!still.isValid() || !window.is_settled()) still.start();
                         if (still.elapsed() < settle_ms) return;
                         *reasons << missing(window);
                         try {
                             if (!arguments.screenshot.empty())
                                 write_picture(QString::fromStdString(arguments.screenshot),
                                               window.grab().toImage());
                             if (!arguments.thumbnail.empty()) {
                                 const auto card = card_of(window.workspace(), !arguments.set_up.empty());
                                 write_file(arguments.thumbnail, card.toStdString());
                                 std::cout << double(begun.elapsed() - still.elapsed()) / 1000 << "\n";
                             }
                         } catch (const Error& error) {
                             *reasons << QString::fromStdString(error.what());
                         }
                         for (const auto& reason : *reasons)
                             std::cerr << "interreflect: " << in_one_line(reason.toStdString()) << "\n";
                         QApplication::exit(reasons->isEmpty() ? 0 : failed);
                     });
    looks->start(look_ms);
}

/// What is typed is there, or it is a slip of the hand; what the window opens by itself may have gone.
void check_project(const std::string& project) {
    std::error_code ignored;  // what cannot be looked at is told where it is opened
    const auto kind = std::filesystem::status(project, ignored).type();
    if (!project.empty() && !project.starts_with("builtin:") && kind == std::filesystem::file_type::not_found)
        throw InputError(project, "", "there is no such file or folder; check the path");
}

/// Qt aborts where it finds no display, so that is looked at first; a screenshot needs none.
void check_display(const Arguments& arguments) {
#ifdef Q_OS_LINUX
    for (const char* variable : {"DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"})
        if (!qEnvironmentVariableIsEmpty(variable)) return;
    if (arguments.needs_screen())
        throw Error("no display; start it in a desktop session, or use interreflect-cli");
    qputenv("QT_QPA_PLATFORM", "offscreen");
#else
    (void)arguments;
#endif
}

/// Nobody may be there to be asked. What a screenshot shows was changed by nobody.
void end_by_signal(MainWindow& window, bool puts_away) {
    QObject::connect(&window.session(), &Session::message, [](const Message& message) {
        std::cerr << "interreflect: " << in_one_line(message.text) << "\n";
    });
    if (puts_away) window.leave();
    std::cerr << "interreflect: interrupted\n";
    QApplication::exit(engine::interruption_status());
}

/// While a person looks at the start page: most scenes have textures. Where it fails whoever reads an image
/// says so.
std::future<void> load_image_codecs() {
    return std::async(std::launch::async, [] {
        try {
            image_codecs();
        } catch (const Error&) {
        }
    });
}

int run_window(const Arguments& arguments) {
    const auto renderer = make_thread_renderer(engine::machine_options(arguments.machine));
    const bool screenshot = arguments.takes_picture();
    MainWindow window(*renderer, engine::registry(),
                      {.remember = !screenshot,
                       .drafts = !screenshot,
                       .theme = arguments.theme,
                       .machine = arguments.machine});
    if (!arguments.size.empty()) {
        const auto size = projects::parse_size(arguments.size, "--size");
        window.resize(size.x, size.y);
        if (!screenshot) window.docks().fit_screen();
    }
    if (!arguments.layout.empty()) window.docks().apply(QString::fromStdString(arguments.layout));
    window.show();
    const auto codecs = load_image_codecs();
    const auto project = QString::fromStdString(arguments.project);
    if (screenshot && arguments.set_up.empty()) take_screenshot(window, arguments);
    if (!project.isEmpty() && !window.open_path(project) && screenshot) {
        std::cerr << "interreflect: "
                  << in_one_line(window.banners().text(QStringLiteral("file")).toStdString()) << "\n";
        return bad_input;
    }
    if (!arguments.plot.empty() && window.session().has_project()) {
        if (!projects::find_item(window.session().document().plots, arguments.plot))
            throw UsageError("--plot '" + arguments.plot + "': the project has no such plot");
        window.show_plot(arguments.plot);
        window.plots().run_if_needed();
    }
    if (!arguments.set_up.empty())
        set_up(window, arguments, [&](bool was_done) {
            if (screenshot && was_done) take_screenshot(window, arguments);
            if (screenshot && !was_done) QApplication::exit(failed);
        });
    QSocketNotifier notifier(engine::interruption_descriptor(), QSocketNotifier::Read);
    QObject::connect(&notifier, &QSocketNotifier::activated, &window, [&] {
        notifier.setEnabled(false);
        end_by_signal(window, !screenshot);
    });
    return QApplication::exec();
}

int run_export(const Arguments& arguments) {
    PlotExport job{arguments.project, arguments.plot, arguments.plot_file,
                   engine::machine_options(arguments.machine), engine::parse_bytes(arguments.machine.memory)};
    job.scale = arguments.scale;
    job.dark = arguments.dark;
    if (!arguments.size.empty()) {
        const auto size = projects::parse_size(arguments.size, "--size");
        job.size = {size.x, size.y};
    }
    export_plot(job);
    return 0;
}

}  // namespace

int run(int argc, char** argv) {
    std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large is an error with a line, as a full disk is
    CLI::App command{"Interreflect: a workbench for research on interactive global illumination."};
    Arguments arguments;
    describe(command, arguments);
    const auto fail = [](const std::string& line, int status) {
        std::cerr << "interreflect: " << line << "\n";
        return status;
    };
    try {
        command.parse(argc, argv);
        use_threads_for_exr();
        if (!arguments.machine.backend.empty()) gl::parse_backend(arguments.machine.backend);
        engine::machine_options(arguments.machine);
        engine::parse_bytes(arguments.machine.memory);
        if (!arguments.size.empty()) projects::parse_size(arguments.size, "--size");
        take_present_name(arguments.layout);
        if (!arguments.set_up.empty() && arguments.project.empty())
            throw UsageError("--set-up needs a project or a scene to begin with");
        if (!arguments.plot.empty() && arguments.project.empty())
            throw UsageError("--plot needs a project that has it");
        check_project(arguments.project);
        if (arguments.exports()) check_plot_file(arguments.plot_file);
        check_display(arguments);
        // Off screen Qt says what is no news to anybody; stderr is for the one line that says what failed.
        if (!arguments.needs_screen())
            QLoggingCategory::setFilterRules(QStringLiteral("default.warning=false\nqt.qpa.*=false"));
        QLocale::setDefault(QLocale::c());
        QApplication application(argc, argv);
        engine::watch_interruptions();
        QApplication::setOrganizationName("Interreflect");
        QApplication::setApplicationName("Interreflect");
        QApplication::setApplicationVersion(QString::fromStdString(engine::version()));
        widgets::apply_theme(application, widgets::Theme::dark);
        return arguments.exports() ? run_export(arguments) : run_window(arguments);
    } catch (const CLI::Success& shown) {
        return command.exit(shown);
    } catch (const CLI::ParseError& error) {
        return fail(std::string(error.what()) + " (--help lists what is allowed)", 2);
    } catch (const InputError& error) {
        return fail(in_one_line(error.what()), bad_input);
    } catch (const UsageError& error) {
        return fail(error.what(), 2);
    } catch (const Cancelled&) {
        return fail("interrupted", engine::interruption_status());
    } catch (const std::exception& error) {
        return fail(error.what(), 1);
    }
}

}  // namespace ir::gui
