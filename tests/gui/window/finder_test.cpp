#include <QLineEdit>
#include <QMenu>
#include <QScrollBar>
#include <QTextBlock>
#include <QTextBrowser>
#include <QTreeWidget>

#include "app/gui/parameter_dock.h"
#include "app/gui/status_line.h"
#include "tests/gui/window/window_fixture.h"
#include "widgets/panels/finder_dialog.h"
#include "widgets/panels/manual_window.h"

namespace ir::gui {
namespace {

class FinderTest : public WindowTest {
  protected:
    widgets::FinderDialog* box() {
        for (auto* each : window.findChildren<widgets::FinderDialog*>())
            if (each->isVisible()) return each;
        return nullptr;
    }
    /// By its key, then the words. The key is pressed until the window has the keyboard: the X server may
    /// tell late that the last box took it along.
    void find(const char* words) {
        ASSERT_TRUE(QTest::qWaitFor([this] {
            window.activateWindow();
            QTest::keyClick(&window, Qt::Key_P, Qt::ControlModifier);
            return box() != nullptr;
        }));
        ASSERT_TRUE(QTest::qWaitForWindowExposed(box()));
        QTest::keyClicks(box()->findChild<QLineEdit*>(), words);
    }
    QTreeWidget& list() { return *box()->findChild<QTreeWidget*>(); }
    std::string first(int column = 1) {
        const auto* item = list().topLevelItem(0);
        return item ? item->text(column).toStdString() : "nothing";
    }
    void enter() {
        QTest::keyClick(box()->findChild<QLineEdit*>(), Qt::Key_Return);
        EXPECT_FALSE(box());
        give_back();
    }
    void escape() {
        QTest::keyClick(box(), Qt::Key_Escape);
        EXPECT_FALSE(box());
        give_back();
    }
    void give_back() {
        ASSERT_TRUE(activate(window));
        ASSERT_TRUE(settle());
    }
};

TEST_F(FinderTest, GoesToABufferInTheActiveView) {
    open_scene();
    find("dep buf");
    EXPECT_EQ(first(), "Depth");
    EXPECT_FALSE(list().topLevelItem(0)->icon(0).isNull());
    enter();
    EXPECT_EQ(window.views().shown_key(), "depth");
}

TEST_F(FinderTest, GivesAParameterTheKeyboard) {
    open_scene();
    window.docks().raise("project");
    window.findChild<QLineEdit*>("parameter-filter")->setText("items");
    find("maxdist");
    EXPECT_EQ(first(), "Maximum distance") << "with letters left out";
    enter();
    EXPECT_TRUE(window.docks().is_seen("parameters"));
    auto* editor = window.findChild<QWidget*>("editor:max_distance");
    EXPECT_TRUE(QTest::qWaitFor([&] { return editor->isAncestorOf(QApplication::focusWidget()); }));
    EXPECT_TRUE(editor->isVisible()) << "the filter does not hide it";
}

TEST_F(FinderTest, LooksAtExperimentsAndThroughCameras) {
    open_scene();
    add_second_experiment(0.75);
    const auto second = window.session().document().experiments.back();
    const auto name = QString::fromStdString(second.name);
    trigger("bookmark");
    find((name + " experiment").toUtf8().constData());
    EXPECT_EQ(first(0), "Experiment");
    EXPECT_EQ(first(), second.name);
    enter();
    EXPECT_EQ(window.session().experiment()->id, second.id);
    EXPECT_EQ(window.views().active_state().a.owner, second.id);
    const auto camera = window.session().document().cameras.back();
    find((camera.name + " camera").c_str());
    while (list().currentItem() && list().currentItem()->text(0) != "Camera")
        QTest::keyClick(box()->findChild<QLineEdit*>(), Qt::Key_Down);
    ASSERT_EQ(list().currentItem()->text(1).toStdString(), camera.name);
    enter();
    EXPECT_EQ(window.session().experiment()->camera, camera.id);
    EXPECT_TRUE(window.docks().is_seen("project"));
}

TEST_F(FinderTest, CarriesActionsOutAndShowsTheirKeys) {
    find("full screen");
    EXPECT_EQ(first(), "Full screen");
    EXPECT_EQ(first(3), "F11");
    EXPECT_EQ(first(2), "Window");
    escape();
    find("duplicate experiment");
    ASSERT_NE(first(), "nothing");
    QTest::keyClick(box()->findChild<QLineEdit*>(), Qt::Key_Return);
    EXPECT_TRUE(box()) << "without a project it cannot be done, and the line says so";
    EXPECT_EQ(first(2), "cannot be done now");
    escape();
    open_scene();
    find("duplicate experiment");
    enter();
    EXPECT_EQ(window.session().document().experiments.size(), 2u);
}

TEST_F(FinderTest, NoNameIsCutOnASmallScreen) {
    window.resize(1280, 770);
    open_scene();
    for (const char* words : {"", "sample", "parameter", "action", "manual"}) {
        find(words);
        ASSERT_GT(list().topLevelItemCount(), 3) << words;
        for (int i = 0; i < list().topLevelItemCount(); ++i) {
            const auto text = list().topLevelItem(i)->text(1);
            EXPECT_LE(list().fontMetrics().horizontalAdvance(text) + 6, list().columnWidth(1))
                << text.toStdString();
        }
        int columns = 0;
        for (int c = 0; c < list().columnCount(); ++c) columns += list().columnWidth(c);
        EXPECT_LE(columns, list().viewport()->width()) << words << ": keys are seen, too";
        escape();
    }
}

TEST_F(FinderTest, ArrowsAndTheMouseChoose) {
    open_scene();
    find("");
    ASSERT_GT(list().topLevelItemCount(), 3);
    auto* line = box()->findChild<QLineEdit*>();
    QTest::keyClick(line, Qt::Key_Down);
    QTest::keyClick(line, Qt::Key_Down);
    QTest::keyClick(line, Qt::Key_Up);
    EXPECT_EQ(list().currentItem(), list().topLevelItem(1));
    auto* chosen = list().topLevelItem(2);
    const auto name = chosen->text(1);
    QTest::mouseClick(list().viewport(), Qt::LeftButton, {}, list().visualItemRect(chosen).center());
    EXPECT_FALSE(box());
    give_back();
    const auto outputs = window.views().pictures().outputs(window.session().experiment()->id);
    const auto* shown = window.views().pictures().find(outputs, window.views().active_state().a.output);
    ASSERT_TRUE(shown);
    EXPECT_EQ(shown->label, name);
}

TEST_F(FinderTest, OpensSamplesAndPagesOfTheManual) {
    find("sample conference room");
    EXPECT_EQ(first(0), "Sample");
    escape();
    find("scene cornell");
    EXPECT_EQ(first(), "builtin:cornell");
    enter();
    EXPECT_TRUE(window.session().has_project());
    find("manual metrics");
    EXPECT_EQ(first(), "Metrics and differences");
    enter();
    auto* manual = window.findChild<widgets::ManualWindow*>();
    ASSERT_TRUE(manual);
    EXPECT_TRUE(manual->isVisible());
    EXPECT_EQ(manual->page().fileName(), "metrics.md");
    EXPECT_TRUE(manual->findChild<QTextBrowser*>()->toPlainText().contains("RMSE"));
    manual->close();
}

TEST_F(FinderTest, AParameterLeadsToItsPlaceInTheManual) {
    open_scene();
    window.docks().raise("parameters");
    auto* panel = window.findChild<widgets::ParameterPanel*>();
    emit panel->customContextMenuRequested(level()->mapTo(panel, level()->rect().center()));
    auto* menu = panel->findChild<QMenu*>("parameter-menu");
    ASSERT_TRUE(menu);
    ASSERT_EQ(menu->actions().size(), 1);
    EXPECT_FALSE(menu->actions().front()->isEnabled()) << "the manual has no page of the fake method";
    menu->close();
    const auto want = [&](const char* key) {
        emit window.findChild<ParameterDock*>()->page_wanted(SOURCE_ROOT "/docs/methods/hbao.md", key);
        return window.findChild<widgets::ManualWindow*>();
    };
    EXPECT_EQ(want("steps")->findChild<QTextBrowser*>()->textCursor().selectedText(), "steps");
    auto* manual = want("blur_normal_power");
    EXPECT_EQ(manual->page().fileName(), "hbao.md");
    EXPECT_FALSE(manual->findChild<QTextBrowser*>()->textCursor().hasSelection());
    const auto labels = window.findChild<StatusLine*>()->findChildren<QLabel*>();
    EXPECT_TRUE(std::ranges::any_of(
        labels, [](const auto* each) { return each->text().contains("does not name blur_normal_power"); }));
    manual->close();
}

TEST_F(FinderTest, NothingFitsIsSaid) {
    find("xyzzy qqq");
    EXPECT_EQ(list().topLevelItemCount(), 0);
    QTest::keyClick(box()->findChild<QLineEdit*>(), Qt::Key_Return);
    ASSERT_TRUE(box());
    escape();
}

TEST(Manual, LinksLeadFromPageToPage) {
    const auto pages = widgets::manual_pages(SOURCE_ROOT);
    ASSERT_GT(pages.size(), 20u);
    EXPECT_EQ(pages.front().title, "Interreflect");
    for (const auto& page : pages) EXPECT_FALSE(page.title.isEmpty()) << page.file.toStdString();
    widgets::ManualWindow manual(nullptr);
    manual.show_page(pages.front().file);
    auto* browser = manual.findChild<QTextBrowser*>();
    EXPECT_TRUE(QTest::qWaitForWindowExposed(&manual));
    EXPECT_EQ(browser->horizontalScrollBar()->maximum(), 0) << "pictures fit";
    emit browser->anchorClicked(QUrl("docs/methods/ldm-ao.md"));
    EXPECT_EQ(manual.page().fileName(), "ldm-ao.md");
    emit browser->anchorClicked(QUrl("../accuracy.md#light-of-whole-rooms"));
    EXPECT_EQ(manual.page().fileName(), "accuracy.md");
    EXPECT_EQ(browser->textCursor().block().text(), "Light of whole rooms");
    browser->backward();
    EXPECT_EQ(manual.page().fileName(), "ldm-ao.md");
}

TEST(Manual, MarksAParameterWhereItsPageDescribesIt) {
    widgets::ManualWindow manual(nullptr);
    auto* browser = manual.findChild<QTextBrowser*>();
    const auto page = [](const char* method) {
        return QStringLiteral(SOURCE_ROOT "/docs/methods/%1.md").arg(method);
    };
    manual.show_page(page("hbao"));
    EXPECT_TRUE(manual.go_to_key("blur_radius"));
    EXPECT_EQ(browser->textCursor().selectedText(), "blur_radius");
    EXPECT_EQ(browser->textCursor().block().text(), "blur, blur_radius") << "a row of the table";
    const auto place = browser->cursorRect();
    EXPECT_TRUE(browser->viewport()->rect().contains(place)) << place.top();
    EXPECT_TRUE(manual.go_to_key("max_distance")) << "the command above names it, too";
    EXPECT_EQ(browser->textCursor().block().text(), "max_distance, falloff");
    EXPECT_FALSE(manual.go_to_key("blur_normal_power"));
    EXPECT_EQ(browser->verticalScrollBar()->value(), 0);
    manual.show_page(page("ambient-occlusion-volumes"));
    EXPECT_TRUE(manual.go_to_key("spread")) << "in a text, with a value";
    EXPECT_EQ(browser->textCursor().selectedText(), "spread");
}

TEST(Finder, OrdersWhatFitsByHowWell) {
    const std::vector<widgets::Findable> all{
        {"Buffer", "Shading normal", "G-buffer", "gbuffer.normal"},
        {"Buffer", "Normals of photons", "splatting"},
        {"Action", "Abnormal", "View"},
        {"Parameter", "Nominal resolution", "size", "of maps"},
        {"Sample", "Fig. 9", "normal maps"},
    };
    const auto names = [&](const char* query) {
        QStringList list;
        for (const auto i : widgets::found(query, all)) list << all[i].name;
        return list;
    };
    EXPECT_EQ(names("normal"), QStringList({"Normals of photons", "Shading normal", "Abnormal", "Fig. 9"}));
    EXPECT_EQ(names("normal buffer"), QStringList({"Normals of photons", "Shading normal"}));
    EXPECT_EQ(names("GBUFFER.N"), QStringList({"Shading normal"})) << "by its key";
    EXPECT_EQ(names("nomres"), QStringList({"Nominal resolution"}));
    EXPECT_EQ(names("").size(), 5);
    EXPECT_EQ(names("normal x").size(), 0);
}

}  // namespace
}  // namespace ir::gui
