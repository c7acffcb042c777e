#include "app/gui/run.h"

#include <CLI/CLI.hpp>
#include <QApplication>
#include <QTimer>
#include <iostream>

#include "app/engine/version.h"
#include "app/gui/main_window.h"
#include "projects/light_spec.h"
#include "renderers/core/error.h"
#include "widgets/style/icons.h"
#include "widgets/style/theme.h"

namespace ir::gui {
namespace {

/// After the last change the window is left alone for so long before it is grabbed.
constexpr int settle_ms = 400;

struct Arguments {
    std::string project, layout, screenshot, size, backend;
};

void describe(CLI::App& command, Arguments& arguments) {
    command.set_version_flag("--version", "interreflect " + engine::version());
    command.add_option("project", arguments.project,
                       "Project folder, scene file (.gltf, .glb) or builtin:NAME to open");
    command.add_option("--layout", arguments.layout,
                       "Arrangement of the docks: " + MainWindow::layout_names().join(", ").toStdString());
    command.add_option("--screenshot", arguments.screenshot,
                       "Wait until everything shown is rendered, save the window as PNG and quit");
    command.add_option("--size", arguments.size, "Size of the window, WxH");
    command.add_option("--backend", arguments.backend,
                       "OpenGL through egl or osmesa (default: the best that works)");
}

/// Saves the window once nothing has changed for a while.
void take_screenshot(MainWindow& window, const QString& file) {
    auto* timer = new QTimer(&window);
    timer->setSingleShot(true);
    timer->setInterval(settle_ms);
    QObject::connect(&window, &MainWindow::settled, timer, [timer] { timer->start(); });
    QObject::connect(timer, &QTimer::timeout, &window, [&window, timer, file] {
        if (!window.is_settled()) return;
        const bool saved = window.grab().save(file);
        if (!saved) std::cerr << "interreflect: cannot write " << file.toStdString() << "\n";
        const auto* shown = window.session().experiment();
        const bool failed = shown && window.live().state(shown->id) == LivePictures::State::failed;
        QApplication::exit(saved && !failed ? 0 : 1);
    });
    if (window.is_settled()) timer->start();
}

/// Qt aborts where it finds no display, so that is looked at first; a screenshot needs none.
void check_display(const Arguments& arguments) {
#ifdef Q_OS_LINUX
    for (const char* variable : {"DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"})
        if (!qEnvironmentVariableIsEmpty(variable)) return;
    if (arguments.screenshot.empty())
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
    MainWindow window(*renderer, engine::registry(), {.remember = !screenshot});
    if (!arguments.size.empty()) {
        const auto size = projects::parse_size(arguments.size, "--size");
        window.resize(size.x, size.y);
    }
    if (!arguments.layout.empty()) window.apply_layout(QString::fromStdString(arguments.layout));
    window.show();
    const bool opened =
        arguments.project.empty() || window.open_path(QString::fromStdString(arguments.project));
    if (screenshot) take_screenshot(window, QString::fromStdString(arguments.screenshot));
    const int status = QApplication::exec();
    return !opened && screenshot ? 3 : status;
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
        check_display(arguments);
        QLocale::setDefault(QLocale::c());
        QApplication application(argc, argv);
        QApplication::setOrganizationName("Interreflect");
        QApplication::setApplicationName("Interreflect");
        QApplication::setApplicationVersion(QString::fromStdString(engine::version()));
        widgets::apply_theme(application);
        return run_window(arguments);
    } catch (const CLI::Success& shown) {
        return command.exit(shown);
    } catch (const CLI::ParseError& error) {
        return fail(std::string(error.what()) + " (--help lists what is allowed)", 2);
    } catch (const UsageError& error) {
        return fail(error.what(), 2);
    } catch (const std::exception& error) {
        return fail(error.what(), 1);
    }
}

}  // namespace ir::gui
