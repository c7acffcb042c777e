#pragma once

#include <QTest>
#include <QTimer>

namespace ir::test {

/// Handles all that is queued and what follows from it at once, as timers without delay do. Tests wait for
/// this, or for what they want to see, and never for time.
inline void handle_events() {
    constexpr int rounds = 4;  // a layout asks for another, a timer starts a timer
    for (int round = 0; round < rounds; ++round) {
        bool is_done = false;
        QTimer::singleShot(0, [&] { is_done = true; });
        while (!is_done) QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
    }
}

}  // namespace ir::test
