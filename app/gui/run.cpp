#include "app/gui/run.h"

#include <CLI/CLI.hpp>
#include <QApplication>
#include <QLoggingCategory>
#include <QTimer>
#include <algorithm>
#include <iostream>
#include <memory>

#include "app/engine/version.h"
#include "app/gui/export_plot.h"
#include "app/gui/main_window.h"
#include "projects/light_spec.h"
#include "projects/scene_files.h"
#include "renderers/core/error.h"
#include "widgets/style/icons.h"
#include "widgets/style/theme.h"

namespace ir::gui {
namespace {

/// After the last change the window is left alone for so long before it is grabbed.
constexpr int settle_ms = 400;
constexpr int failed = 1, bad_input = 3;

struct Arguments {
    std::string project, layout, screenshot, size, backend, plot, plot_file;
    int scale = 1;
    bool dark = false;

    bool exports() const { return !plot_file.empty(); }
    bool needs_screen() const { return screenshot.empty() && !exports(); }
};

void describe(CLI::App& command, Arguments& arguments) {
    command.set_version_flag("--version", "interreflect " + engine::version());
    command.add_option("project", arguments.project,
                       "Project folder, scene file (.gltf, .glb) or builtin:NAME to open");
    command.add_option("--layout", arguments.layout,
                       "Arrangement of the docks: " + MainWindow::layout_names().join(", ").toStdString());
    command.add_option("--screenshot", arguments.screenshot,
                       "Wait until everything shown is rendered, save the window as PNG and quit");
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
    command.add_option("--backend", arguments.backend,
                       "OpenGL through egl or osmesa (default: the best that works)");
}

/// Experiments that the open views show, every one once.
std::vector<std::string> shown_experiments(MainWindow& window) {
    std::vector<std::string> ids;
    const auto add = [&](const widgets::ViewSource& source) {
        if (window.session().experiment(source.owner) &&
            std::find(ids.begin(), ids.end(), source.owner) == ids.end())
            ids.push_back(source.owner);
    };
    for (const int view : window.workspace().area().open_views()) {
        const auto& state = window.workspace().state(view);
        add(state.a);
        if (widgets::compares(state.mode)) add(state.b);
        if (widgets::takes_many(state.mode))
            for (const auto& each : state.more) add(each);
    }
    return ids;
}

bool lacks_a_file(const Session& session, const std::string& experiment) {
    const auto* chosen = session.experiment(experiment);
    const auto& open = session.open_project();
    const auto* scene = projects::find_item(session.document().scenes, projects::effective(*chosen).scene);
    return scene && std::any_of(scene->parts.begin(), scene->parts.end(), [&](const auto& part) {
               return projects::status(part, open.folder(), &open.contents()).state ==
                      projects::FileState::missing;
           });
}

/// What kept a shown experiment from its picture.
struct Outcome {
    int status = 0;
    std::string line;
};

/// The worst of all shown experiments. Where a scene could not be loaded, that is the input's fault.
Outcome outcome(MainWindow& window, const std::string& scene_error) {
    Outcome worst;
    for (const auto& id : shown_experiments(window)) {
        const auto state = window.live().state(id);
        if (state != LivePictures::State::failed && state != LivePictures::State::blocked) continue;
        const auto& reason = window.live().text(id);
        const bool input = reason == scene_error || lacks_a_file(window.session(), id);
        if (worst.line.empty() || (input && worst.status != bad_input))
            worst = {input ? bad_input : failed, reason};
    }
    return worst;
}

std::string in_one_line(const std::string& text) {
    return QString::fromStdString(text).simplified().toStdString();
}

/// Saves the window once nothing has changed for a while, and ends the program.
void take_screenshot(MainWindow& window, const Renderer& renderer, const QString& file) {
    auto* timer = new QTimer(&window);
    timer->setSingleShot(true);
    timer->setInterval(settle_ms);
    const auto scene_error = std::make_shared<std::string>();
    QObject::connect(&renderer, &Renderer::failed, &window,
                     [scene_error](const std::string& tag, const std::string& error, bool cancelled) {
                         if (tag == "scene" && !cancelled) *scene_error = error;
                     });
    QObject::connect(&window, &MainWindow::settled, timer, [timer] { timer->start(); });
    QObject::connect(timer, &QTimer::timeout, &window, [&window, file, scene_error] {
        if (!window.is_settled()) return;
        Outcome end = outcome(window, *scene_error);
        if (!window.grab().save(file)) end = {failed, "cannot write " + file.toStdString()};
        if (!end.line.empty()) std::cerr << "interreflect: " << in_one_line(end.line) << "\n";
        QApplication::exit(end.status);
    });
    if (window.is_settled()) timer->start();
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

int run_window(const Arguments& arguments) {
    engine::Machine::Options machine;
    machine.backend = arguments.backend;
    const auto renderer = make_thread_renderer(machine);
    const bool screenshot = !arguments.screenshot.empty();
    MainWindow window(*renderer, engine::registry(), {.remember = !screenshot, .machine = machine});
    if (!arguments.size.empty()) {
        const auto size = projects::parse_size(arguments.size, "--size");
        window.resize(size.x, size.y);
    }
    if (!arguments.layout.empty()) window.apply_layout(QString::fromStdString(arguments.layout));
    window.show();
    const auto project = QString::fromStdString(arguments.project);
    if (screenshot) take_screenshot(window, *renderer, QString::fromStdString(arguments.screenshot));
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
    return QApplication::exec();
}

int run_export(const Arguments& arguments) {
    PlotExport job{arguments.project, arguments.plot, arguments.plot_file, arguments.backend};
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
    CLI::App command{"Interreflect: a workbench for research on interactive global illumination."};
    Arguments arguments;
    describe(command, arguments);
    const auto fail = [](const std::string& line, int status) {
        std::cerr << "interreflect: " << line << "\n";
        return status;
    };
    try {
        command.parse(argc, argv);
        if (!arguments.backend.empty()) gl::parse_backend(arguments.backend);
        if (!arguments.size.empty()) projects::parse_size(arguments.size, "--size");
        if (!arguments.layout.empty() &&
            !MainWindow::layout_names().contains(QString::fromStdString(arguments.layout)))
            throw UsageError("unknown layout '" + arguments.layout + "'; known are " +
                             MainWindow::layout_names().join(", ").toStdString());
        if (arguments.exports()) check_plot_file(arguments.plot_file);
        check_display(arguments);
        // Off screen Qt says what is no news to anybody; stderr is for the one line that says what failed.
        if (!arguments.needs_screen())
            QLoggingCategory::setFilterRules(QStringLiteral("default.warning=false\nqt.qpa.*=false"));
        QLocale::setDefault(QLocale::c());
        QApplication application(argc, argv);
        QApplication::setOrganizationName("Interreflect");
        QApplication::setApplicationName("Interreflect");
        QApplication::setApplicationVersion(QString::fromStdString(engine::version()));
        widgets::apply_theme(application);
        return arguments.exports() ? run_export(arguments) : run_window(arguments);
    } catch (const CLI::Success& shown) {
        return command.exit(shown);
    } catch (const CLI::ParseError& error) {
        return fail(std::string(error.what()) + " (--help lists what is allowed)", 2);
    } catch (const InputError& error) {
        return fail(in_one_line(error.what()), bad_input);
    } catch (const UsageError& error) {
        return fail(error.what(), 2);
    } catch (const std::exception& error) {
        return fail(error.what(), 1);
    }
}

}  // namespace ir::gui
