#include "app/gui/main_window.h"

/// Time in the window.
namespace ir::gui {

void MainWindow::make_timeline_actions() {
    add_action("play", tr("&Play or pause"), "play", {QKeySequence(Qt::Key_K)},
               [this] { playback_.play(!playback_.is_playing()); });
    add_action("step-forward", tr("One frame &on"), "step-forward", {QKeySequence(Qt::Key_Period)},
               [this] { playback_.step(1); });
    add_action("step-back", tr("One frame &back"), "step-back", {QKeySequence(Qt::Key_Comma)},
               [this] { playback_.step(-1); });
}

void MainWindow::connect_timeline() {
    connect(&playback_, &Playback::changed, this, [this] {
        for (const char* name : {"play", "step-forward", "step-back"})
            action(QLatin1String(name))->setEnabled(playback_.can_play());
        update_camera();
        update_result_actions();
    });
}

}  // namespace ir::gui
