#pragma once

#include <QDockWidget>

#include "tests/gui/window/window_fixture.h"

namespace ir::gui {

/// A window whose pixels are pointed at.
class InspectWindowTest : public WindowTest {
  protected:
    void SetUp() override {
        WindowTest::SetUp();
        open_scene();
        window.workspace().active_pane().compare().active_view().look_at({15, 10}, 8);  // a pixel can be hit
    }
    /// A dock that stands behind a tab comes to the front.
    void raise(const char* name) {
        auto* dock = window.findChild<QDockWidget*>(name);
        dock->show();
        dock->raise();
        ASSERT_TRUE(QTest::qWaitFor([&] { return window.docks().is_seen(name); }));
    }
    QPoint place_of(QPoint pixel) {
        auto& view = window.view();
        const QPointF device = view.transform().view_from_pixel(pixel);
        return (device / view.devicePixelRatioF()).toPoint();
    }
    void move_to(QPoint pixel) {
        QTest::mouseMove(&window.view(), place_of(pixel) + QPoint(1, 1));
        QTest::mouseMove(&window.view(), place_of(pixel));
    }
    /// The screen may tell late where the cursor was before.
    void pin(QPoint pixel) {
        const auto before = window.inspector().pins().size();
        EXPECT_TRUE(QTest::qWaitFor([&] {
            move_to(pixel);
            QTest::keyClick(&window.view(), Qt::Key_P);
            return window.inspector().pins().size() > before;
        }));
    }
};

}  // namespace ir::gui
