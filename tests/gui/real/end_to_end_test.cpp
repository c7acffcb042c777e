#include <gtest/gtest.h>

#include <QApplication>
#include <QSlider>
#include <QTemporaryDir>
#include <QTest>

#include "app/engine/execution.h"
#include "app/gui/main_window.h"
#include "tests/small_sample.h"
#include "widgets/parameters/number_field.h"
#include "widgets/parameters/parameter_editor.h"

namespace ir::gui {
namespace {

constexpr int patience_ms = 120000;

/// The real renderer and a real window. What OpenGL calls an error fails the test.
struct RealWindow {
    std::unique_ptr<Renderer> renderer = make_thread_renderer({.backend = {}, .device = {}, .debug = true});
    MainWindow window{*renderer, engine::registry(), {.remember = false}};

    RealWindow() {
        QObject::connect(renderer.get(), &Renderer::messages_arrived,
                         [](const std::vector<Message>& messages) {
                             for (const auto& message : messages)
                                 EXPECT_NE(message.severity, Severity::error) << message.text;
                         });
        window.show();
        EXPECT_TRUE(QTest::qWaitForWindowExposed(&window));
        QApplication::setActiveWindow(&window);  // a bare X server has no window manager to do it
    }
    ~RealWindow() {
        if (window.session().has_project()) window.session().files().close();
    }
    LivePictures::State state() {
        const auto* chosen = window.session().experiment();
        return chosen ? window.live().state(chosen->id) : LivePictures::State::absent;
    }
    std::string reason() { return window.live().text(window.session().experiment()->id); }
    bool wait() {
        QApplication::processEvents();
        return QTest::qWaitFor([this] { return window.is_settled(); }, patience_ms);
    }
};

/// The first number among the method's parameters that can be edited now and changes the picture.
widgets::NumberField* editable_number(MainWindow& window) {
    for (const auto& parameter : window.session().method()->parameters) {
        if (parameter.type != ParameterType::number && parameter.type != ParameterType::integer) continue;
        if (parameter.effect != Effect::image) continue;
        auto* editor = window.findChild<QWidget*>("editor:" + QString::fromStdString(parameter.key));
        if (editor && editor->isEnabled()) return editor->findChild<widgets::NumberField*>();
    }
    return nullptr;
}

TEST(EndToEnd, ChangeSaveReopenFindsTheSameStateAndPicture) {
    const QTemporaryDir folder;
    const auto path = test::small_sample("corner-closed-form", folder.path().toStdString());
    projects::Project saved;
    Image picture;
    {
        RealWindow real;
        ASSERT_TRUE(real.window.open_path(QString::fromStdString(path.string())));
        ASSERT_TRUE(real.wait());
        ASSERT_EQ(real.state(), LivePictures::State::done) << real.reason();
        const Image before = real.window.view().image();
        auto* field = editable_number(real.window);
        ASSERT_NE(field, nullptr) << "the sample's method has no number to edit";
        const double old_value = field->value();
        field->setFocus();
        field->selectAll();
        QTest::keyClicks(field, QString::number(old_value == 0 ? 1 : old_value * 2));
        QTest::keyClick(field, Qt::Key_Return);
        EXPECT_NE(field->value(), old_value);
        EXPECT_TRUE(real.window.isWindowModified());
        EXPECT_EQ(real.state(), LivePictures::State::rendering);
        ASSERT_TRUE(real.wait());
        ASSERT_EQ(real.state(), LivePictures::State::done) << real.reason();
        picture = real.window.view().image();
        EXPECT_NE(picture.pixels, before.pixels);
        QTest::keyClick(&real.window, Qt::Key_S, Qt::ControlModifier);
        ASSERT_TRUE(QTest::qWaitFor([&] { return !real.window.isWindowModified(); }, 60000));
        saved = real.window.session().document();
    }
    RealWindow again;
    ASSERT_TRUE(again.window.open_path(QString::fromStdString(path.string())));
    ASSERT_TRUE(again.wait());
    ASSERT_EQ(again.state(), LivePictures::State::done) << again.reason();
    EXPECT_EQ(again.window.session().document(), saved);
    EXPECT_EQ(again.window.view().image().width, picture.width);
    EXPECT_EQ(again.window.view().image().pixels, picture.pixels);
}

TEST(EndToEnd, EveryBufferOfTheExperimentCanBeShown) {
    const QTemporaryDir folder;
    const auto path = test::small_sample("corner-closed-form", folder.path().toStdString());
    RealWindow real;
    ASSERT_TRUE(real.window.open_path(QString::fromStdString(path.string())));
    ASSERT_TRUE(real.wait());
    const auto id = real.window.session().experiment()->id;
    ASSERT_NE(real.window.live().result(id), nullptr);
    const auto resources = real.window.live().result(id)->report.resources;
    ASSERT_FALSE(resources.empty());
    using Content = widgets::ViewPane::Content;
    for (const auto& resource : resources) {
        real.window.views().show_output(resource.key);
        ASSERT_TRUE(real.wait()) << resource.key;
        EXPECT_EQ(real.state(), LivePictures::State::done) << resource.key << real.reason();
        EXPECT_EQ(real.window.views().shown_key(), resource.key);
        auto& pane = real.window.workspace().active_pane();
        const bool image = resource.width > 0;
        EXPECT_EQ(pane.content() == Content::picture, image) << resource.key;
        // Explanations may want a pixel first.
        if (image && !resource.explains) {
            EXPECT_FALSE(real.window.view().image().empty()) << resource.key;
        }
    }
}

}  // namespace
}  // namespace ir::gui
