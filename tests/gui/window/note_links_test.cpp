#include <QDesktopServices>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTextBrowser>

#include "tests/gui/window/window_fixture.h"

namespace ir::gui {
namespace {

class NoteLinksTest : public WindowTest {
  protected:
    void SetUp() override {
        WindowTest::SetUp();
        open_scene();
        write("[words](view:1)");
    }
    void write(const QString& notes) {
        window.session().edit([&](const projects::Project& project) {
            return projects::edits::set_notes(project, notes.toStdString());
        });
        ASSERT_TRUE(settle());
    }
    QTextBrowser& notes() { return *window.findChild<widgets::NotesStrip*>()->findChild<QTextBrowser*>(); }
    void follow(const char* link) {
        emit notes().anchorClicked(QUrl(link));
        ASSERT_TRUE(settle());
    }
    bool says(const char* text) {
        for (const auto* each : window.findChild<StatusLine*>()->findChildren<QLabel*>())
            if (each->text().contains(text)) return true;
        return false;
    }
};

TEST_F(NoteLinksTest, AClickLeadsToAView) {
    trigger("views-2");
    window.workspace().area().set_active(0);
    write("What is **new** stands [on the right](view:2).");
    EXPECT_EQ(notes().toPlainText(), "What is new stands on the right.");
    const auto link = notes().document()->find("right");
    ASSERT_FALSE(link.isNull());
    const auto place = notes().cursorRect(link).center() - QPoint(6, 0);
    QTest::mouseMove(notes().viewport(), place);
    QTest::mouseClick(notes().viewport(), Qt::LeftButton, {}, place);
    EXPECT_EQ(window.workspace().area().active(), 1);
    follow("view:1");
    EXPECT_EQ(window.workspace().area().active(), 0);
    for (const char* none : {"view:3", "view:0", "view:9", "view:x"}) {
        follow(none);
        EXPECT_TRUE(says(none)) << none;
        EXPECT_TRUE(says("not open")) << none;
        EXPECT_EQ(window.workspace().area().active(), 0);
    }
}

TEST_F(NoteLinksTest, AViewIsCountedAsItsTitleDoes) {
    auto& area = window.workspace().area();
    trigger("views-2");
    trigger("view-close");
    const int left = area.open_views().front();
    ASSERT_EQ(left, 1) << "the first was closed";
    follow("view:2");
    EXPECT_TRUE(says("not open"));
    trigger("view-open");
    ASSERT_EQ(area.open_views(), (std::vector{0, 1}));
    follow("view:1");
    EXPECT_EQ(area.active(), left);
    follow("view:2");
    EXPECT_EQ(area.active(), 0);
}

TEST_F(NoteLinksTest, LeadToParametersBuffersAndExperiments) {
    follow("parameter:max_distance");
    EXPECT_TRUE(window.docks().is_seen("parameters"));
    auto* editor = window.findChild<QWidget*>("editor:max_distance");
    EXPECT_TRUE(QTest::qWaitFor([&] { return editor->isAncestorOf(QApplication::focusWidget()); }));
    follow("buffer:depth");
    EXPECT_EQ(window.views().shown_key(), "depth");
    add_second_experiment(0.75);
    const auto second = window.session().document().experiments.back().id;
    follow(("experiment:" + second + "/levels").c_str());
    EXPECT_EQ(window.session().experiment()->id, second);
    EXPECT_EQ(window.views().active_state().a.owner, second);
    EXPECT_EQ(window.views().active_state().a.output, "levels");
    const auto before = window.views().active_state();
    const std::pair<const char*, const char*> nowhere[] = {{"parameter:none", "no such parameter"},
                                                           {"buffer:none", "no such buffer"},
                                                           {"experiment:none/depth", "no such experiment"},
                                                           {"pin:1", "no such pin"}};
    for (const auto& [link, why] : nowhere) {
        follow(link);
        EXPECT_TRUE(says(why)) << link;
        EXPECT_EQ(window.views().active_state(), before) << link;
    }
}

TEST_F(NoteLinksTest, APinGoesToTheMiddleOfThePictureAndNoCameraMoves) {
    window.inspector().pin({1, 1});
    window.inspector().pin({3, 2});
    const auto before = steps();
    follow("pin:2");
    const auto off = window.view().transform().centre() - QPointF(3.5, 2.5);
    EXPECT_LE(off.manhattanLength(), 1 / window.view().transform().zoom()) << "to a pixel of the screen";
    EXPECT_GE(window.view().transform().zoom(), 8);
    EXPECT_TRUE(window.docks().is_seen("inspector"));
    EXPECT_EQ(steps(), before);
    window.views().show_output("cloud");
    ASSERT_TRUE(settle());
    follow("pin:2");
    EXPECT_TRUE(says("no picture with that pixel"));
}

TEST_F(NoteLinksTest, HostileNotesLoadNothingAndLeadNowhere) {
    const QTemporaryDir folder;
    const QString file = folder.filePath("secret.png");
    QImage picture(90, 70, QImage::Format_RGB32);
    picture.fill(Qt::red);
    ASSERT_TRUE(picture.save(file));
    const auto address = QUrl::fromLocalFile(file);
    write("<img src='" + address.toString() + "'><script>x</script>\n\n![a](" + file + ")\n\n![b](" +
          address.toString() + ")");
    EXPECT_TRUE(notes().toPlainText().contains("<img src=")) << "HTML is text";
    EXPECT_TRUE(notes().toPlainText().contains("<script>"));
    EXPECT_LT(notes().document()->size().height(), picture.height()) << "no picture has room";
    for (const auto& each : {address, QUrl(file)})
        EXPECT_EQ(notes().document()->resource(QTextDocument::ImageResource, each).value<QImage>().size(),
                  QSize(1, 1));
    QTextBrowser desktop;
    const QSignalSpy opened(&desktop, &QTextBrowser::anchorClicked);
    const char* schemes[] = {"file", "javascript", "data", "https"};
    for (const auto* scheme : schemes) QDesktopServices::setUrlHandler(scheme, &desktop, "anchorClicked");
    for (const auto& link : {address.toString(), QString("javascript:alert(1)"), QString("data:text/html,x"),
                             QString("secret.md"), QString("ftp://a.b/c"), QString("action:quit")}) {
        follow(link.toUtf8().constData());
        EXPECT_TRUE(says("names no place") && says(QUrl(link).toEncoded().constData())) << link.toStdString();
    }
    EXPECT_EQ(opened.count(), 0);
    follow("https://example.org/paper");
    EXPECT_EQ(opened.count(), 1) << "a web page opens where the desktop opens them, after a click";
    for (const auto* scheme : schemes) QDesktopServices::unsetUrlHandler(scheme);
}

}  // namespace
}  // namespace ir::gui
