#include <gtest/gtest.h>

#include <QDockWidget>
#include <QMainWindow>
#include <QTest>

#include "tests/gui/events.h"
#include "tests/gui/widgets/space/fake_space.h"
#include "tests/gui/widgets/surfaces.h"

namespace ir::widgets {
namespace {

using test::FakeSpace;

class DockedSpace : public SurfaceTest {};
INSTANTIATE_TEST_SUITE_P(Surfaces, DockedSpace, testing::Values(true, false), surface_name);

TEST_P(DockedSpace, FloatingAndDockingKeepThePicture) {
    QMainWindow window;
    window.setCentralWidget(new QWidget);
    auto* dock = new QDockWidget(QStringLiteral("3D"));
    auto* view = new SpaceView(nullptr, surface());
    dock->setWidget(view);
    window.addDockWidget(Qt::RightDockWidgetArea, dock);
    FakeSpace space;
    bool answers = true;
    QObject::connect(view, &SpaceView::view_wanted, view, [&](const SpaceScene& scene, QSize size) {
        if (answers) view->set_picture(space.draw(scene, size));
    });
    SpaceScene scene;
    scene.layers = {FakeSpace::layer()};
    scene.layers[0].size_px = 8;
    view->set_scene(scene);
    window.resize(900, 500);
    window.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&window));
    ir::test::handle_events();
    answers = false;  // what is seen from now on is the old picture
    const auto shown = [&] {
        const QImage seen = view->grab().toImage();
        int coloured = 0;
        for (int y = 60; y < seen.height(); y += 2)
            for (int x = 0; x < seen.width(); x += 2) {
                const QColor c = seen.pixelColor(x, y);
                coloured +=
                    std::max({c.red(), c.green(), c.blue()}) - std::min({c.red(), c.green(), c.blue()}) > 60;
            }
        return coloured;
    };
    const int docked = shown();
    EXPECT_GT(docked, 100);
    for (const bool floating : {true, false, true, false}) {
        dock->setFloating(floating);
        ASSERT_TRUE(QTest::qWaitForWindowExposed(floating ? static_cast<QWidget*>(dock) : &window));
        ir::test::handle_events();
        EXPECT_GT(shown(), docked / 4) << (floating ? "floating" : "docked");
    }
}

}  // namespace
}  // namespace ir::widgets
