// Errors in shaders: a panel that comes with them and goes when they are mended.
#include <QClipboard>
#include <QDockWidget>
#include <QTemporaryDir>
#include <QTextBrowser>
#include <fstream>

#include "tests/gui/window/window_fixture.h"

namespace ir::gui {
namespace {

class ShadersWindowTest : public WindowTest {
  protected:
    void SetUp() override {
        WindowTest::SetUp();
        open_scene();
    }
    void TearDown() override {
        qunsetenv(ShaderDock::editor_variable);
        WindowTest::TearDown();
    }
    ShaderDock& dock() { return *window.findChild<ShaderDock*>(); }
    QDockWidget& frame() { return *window.findChild<QDockWidget*>("shaders"); }
    QString text() { return dock().panel().list().toPlainText(); }
    void tell(const std::vector<ShaderFault>& faults) {
        emit renderer.shader_faults_changed(faults);
        QApplication::processEvents();
    }
    /// The link of the first error, with the keyboard.
    void follow_link() {
        auto& list = dock().panel().list();
        list.setFocus();
        if (!list.textCursor().hasSelection()) QTest::keyClick(&list, Qt::Key_Tab);
        QTest::keyClick(&list, Qt::Key_Return);
    }
    const ShaderFault fault{"lib/light.glsl", 12, "`a' <undeclared>", "float x = a < b;",
                            "/s/lib/light.glsl"};
};

TEST_F(ShadersWindowTest, ThePanelComesWithErrorsAndGoesWithThem) {
    EXPECT_TRUE(frame().isHidden());
    const float before = pixel();
    tell({fault});
    EXPECT_FALSE(frame().isHidden());
    EXPECT_TRUE(dock().panel().title().contains("One error")) << dock().panel().title().toStdString();
    EXPECT_TRUE(text().contains("lib/light.glsl:12 `a' <undeclared>")) << text().toStdString();
    EXPECT_TRUE(text().contains("float x = a < b;")) << text().toStdString();
    EXPECT_EQ(pixel(), before) << "the last good picture stays";
    tell({fault, {"lib/glass.glsl", 0, "odd"}});
    EXPECT_TRUE(dock().panel().title().contains("2 errors"));
    tell({});
    EXPECT_TRUE(frame().isHidden());
    EXPECT_EQ(text(), "");
}

TEST_F(ShadersWindowTest, APanelThatAPersonOpenedStays) {
    trigger("dock-shaders");
    EXPECT_FALSE(frame().isHidden());
    tell({fault});
    tell({});
    EXPECT_FALSE(frame().isHidden());
}

TEST_F(ShadersWindowTest, ALinkCopiesThePlaceOrOpensTheEditor) {
    tell({fault});
    QApplication::clipboard()->clear();
    follow_link();
    EXPECT_EQ(QApplication::clipboard()->text(), "/s/lib/light.glsl:12");

    const QTemporaryDir folder;
    const auto script = folder.filePath("edit it"), said = folder.filePath("said");
    std::ofstream(script.toStdString()) << "#!/bin/sh\necho \"$1 at $2\" > '" << said.toStdString() << "'\n";
    QFile::setPermissions(script, QFile::ReadOwner | QFile::ExeOwner);
    qputenv(ShaderDock::editor_variable, ('"' + script + "\" {file} {line}").toUtf8());
    follow_link();
    const auto words = [&] {
        QFile file(said);
        return file.open(QIODevice::ReadOnly) ? file.readAll().trimmed() : QByteArray();
    };
    ASSERT_TRUE(QTest::qWaitFor([&] { return !words().isEmpty(); }));
    EXPECT_EQ(words(), "/s/lib/light.glsl at 12");

    qputenv(ShaderDock::editor_variable, "/no/such/editor {file}");
    follow_link();
    EXPECT_TRUE(window.banners().text("shaders").contains("/no/such/editor"));
}

TEST_F(ShadersWindowTest, AMessageOfAShaderLeadsToThePanel) {
    emit window.messages().go_to({Severity::error, "shader", "lib/light.glsl:12: odd", "lib/light.glsl:12"});
    QApplication::processEvents();
    EXPECT_FALSE(frame().isHidden());
}

TEST_F(ShadersWindowTest, WhatShadersPrintStandsInThePanelAndBesideThePixel) {
    renderer.can_print = true;
    window.live().render_again();
    ASSERT_TRUE(settle());
    const auto* printed = window.inspector().explain_panel().findChild<QLabel*>("printed");
    EXPECT_TRUE(printed->isHidden()) << "no pixel is picked";
    const auto said = [&] { return window.workspace().pane(0)->compare().main_view().state().marks.said; };
    EXPECT_EQ(said(), widgets::SaidMark());
    window.inspector().explain({20, 10});
    ASSERT_TRUE(settle());
    EXPECT_FALSE(printed->isHidden());
    EXPECT_TRUE(printed->text().contains("a &lt; b = <b>20</b>")) << printed->text().toStdString();
    EXPECT_TRUE(printed->text().contains("paint.comp:3")) << printed->text().toStdString();
    EXPECT_EQ(said(), (widgets::SaidMark{{20, 10}, "a < b = 20\ndepth = 20"}));
    const auto has_layer = [&] {
        for (const int view : window.workspace().area().open_views())
            for (const auto& layer : window.views().state(view).space.layers)
                if (layer.key == "debug.lines") return true;
        return false;
    };
    EXPECT_TRUE(has_layer()) << "what they draw is a layer";
    window.inspector().explain({4, 2});
    ASSERT_TRUE(settle());
    EXPECT_EQ(said(), (widgets::SaidMark{{4, 2}, "a < b = 4\ndepth = 4"}));
    window.inspector().explain_nothing();
    ASSERT_TRUE(settle());
    EXPECT_TRUE(printed->isHidden());
    EXPECT_EQ(said(), widgets::SaidMark());
}

}  // namespace
}  // namespace ir::gui
