#include <gtest/gtest.h>

#include <QApplication>
#include <QElapsedTimer>
#include <QMouseEvent>
#include <QTest>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <thread>
#include <vector>

#include "app/engine/execution.h"
#include "app/gui/main_window.h"

namespace ir::gui {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int events = 600;
constexpr auto pause_between = std::chrono::milliseconds(55);  // 33 s in all
constexpr int load_ms = 240000;
/// Fluent: what a hand feels as immediate.
constexpr double handled_limit_ms = 50;

double ms_between(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double, std::milli>(to - from).count();
}

double percentile(std::vector<double> values, double share) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    return values[std::min(values.size() - 1, std::size_t(share * double(values.size())))];
}

/// Notes when posted pointer events have been handled and when the view was next painted.
class Stopwatch : public QObject {
  public:
    explicit Stopwatch(widgets::ImageView& view) : view_(view) {
        view.installEventFilter(this);
        for (auto* child : view.findChildren<QWidget*>()) child->installEventFilter(this);
    }
    /// From any thread.
    void post(QPointF position) {
        const auto sent = Clock::now();
        QMetaObject::invokeMethod(
            this, [this, position, sent] { deliver(position, sent); }, Qt::QueuedConnection);
    }
    std::vector<double> handled_ms, presented_ms;
    Qt::MouseButton button = Qt::LeftButton;

  protected:
    bool eventFilter(QObject*, QEvent* event) override {
        if (event->type() == QEvent::Paint && waiting_) {
            presented_ms.push_back(ms_between(waiting_since_, Clock::now()));
            waiting_ = false;
        }
        return false;
    }

  private:
    void deliver(QPointF position, Clock::time_point sent) {
        QMouseEvent move(QEvent::MouseMove, position, view_.mapToGlobal(position), Qt::NoButton, button, {});
        QApplication::sendEvent(&view_, &move);
        handled_ms.push_back(ms_between(sent, Clock::now()));
        if (!waiting_) waiting_since_ = sent;
        waiting_ = true;
    }
    widgets::ImageView& view_;
    Clock::time_point waiting_since_;
    bool waiting_ = false;
};

std::string scene() {
    const char* folder = std::getenv("INTERREFLECT_SCENES");
    const auto file = std::filesystem::path(folder ? folder : "") / "sponza.glb";
    return folder && std::filesystem::exists(file) ? file.string() : "builtin:atrium";
}

/// The published setting of layered depth maps; drags of the camera and of the picture while it renders.
TEST(Interaction, TheWindowAnswersWhileItRenders) {
    const auto renderer = make_thread_renderer({});
    MainWindow window(*renderer, engine::registry(), {.remember = false});
    window.resize(1440, 900);
    window.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&window));
    ASSERT_TRUE(window.open_path(QString::fromStdString(scene())));
    auto& session = window.session();
    const auto id = session.experiment()->id;
    session.edit([&](const projects::Project& p) { return projects::edits::set_size(p, id, {800, 800}); });
    session.edit([&](const projects::Project& p) {
        return projects::edits::set_method(p, session.registry(), id, "ldm-ao");
    });
    session.edit([&](const projects::Project& p) {
        return projects::edits::set_values(
            p, session.registry(), id,
            {{"directions", std::int64_t{512}}, {"resolution", std::int64_t{200}}});
    });
    ASSERT_TRUE(QTest::qWaitFor([&] { return window.is_settled(); }, load_ms));
    ASSERT_EQ(window.live().state(id), LivePictures::State::done) << window.live().text(id);

    auto& view = window.view();
    Stopwatch watch(view);
    const QPointF middle(view.width() / 2.0, view.height() / 2.0);
    int rendering = 0, samples = 0;
    QElapsedTimer time;
    time.start();
    // Half of the events turn the camera, so that requests never end; half move the picture meanwhile.
    for (const bool turns : {true, false}) {
        window.workspace().tools().set_tool(turns ? widgets::ImageView::Tool::orbit
                                                  : widgets::ImageView::Tool::inspect);
        watch.button = turns ? Qt::LeftButton : Qt::MiddleButton;
        const auto wanted = watch.handled_ms.size() + events / 2;
        QTest::mousePress(&view, watch.button, {}, middle.toPoint());
        std::thread hand([&] {
            auto next = Clock::now();
            for (int i = 0; i < events / 2; ++i) {
                const double angle = 0.05 * i;
                watch.post(middle + QPointF(80 * std::sin(angle), 30 * std::sin(0.7 * angle)));
                std::this_thread::sleep_until(next += pause_between);
            }
        });
        while (watch.handled_ms.size() < wanted && time.elapsed() < load_ms) {
            QApplication::processEvents(QEventLoop::AllEvents, 20);
            ++samples;
            rendering += !window.live().is_settled();
        }
        hand.join();
        QTest::mouseRelease(&view, watch.button, {}, middle.toPoint());
        if (turns) window.live().render_again();
    }
    const double seconds = double(time.elapsed()) / 1000;
    const nlohmann::ordered_json figures = {
        {"benchmark", "interaction"},
        {"scene", scene()},
        {"events", watch.handled_ms.size()},
        {"seconds", seconds},
        {"rendering_share", double(rendering) / std::max(1, samples)},
        {"handled_ms",
         {{"median", percentile(watch.handled_ms, 0.5)}, {"p95", percentile(watch.handled_ms, 0.95)}}},
        {"presented_ms",
         {{"count", watch.presented_ms.size()},
          {"median", percentile(watch.presented_ms, 0.5)},
          {"p95", percentile(watch.presented_ms, 0.95)}}}};
    std::cout << figures.dump(2) << std::endl;
    EXPECT_GE(watch.handled_ms.size(), 500u);
    EXPECT_GE(seconds, 30);
    EXPECT_GT(rendering, samples / 2) << "nothing was being rendered meanwhile";
    EXPECT_LT(percentile(watch.handled_ms, 0.95), handled_limit_ms);
    EXPECT_GT(watch.presented_ms.size(), 50u);
    session.files().close();
}

}  // namespace
}  // namespace ir::gui
