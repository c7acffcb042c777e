#include <QContextMenuEvent>
#include <QDockWidget>
#include <QLineEdit>
#include <QMenu>
#include <QRegularExpression>
#include <QScrollBar>
#include <QSlider>
#include <QTextBlock>
#include <QTextBrowser>
#include <QTreeWidget>
#include <map>

#include "app/engine/execution.h"
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

TEST_F(FinderTest, AppliesALayoutOfOnesOwn) {
    open_scene();
    window.docks().apply("picture");
    window.findChild<LayoutController*>()->keep("My bare pictures");
    window.docks().restore_default();
    ASSERT_TRUE(settle());
    find("bare pict");
    EXPECT_EQ(first(), "My bare pictures");
    enter();
    EXPECT_TRUE(QTest::qWaitFor([&] { return window.findChild<QDockWidget*>("display")->isHidden(); }));
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

TEST_F(FinderTest, LooksThroughTheCamerasOfTheScenesFile) {
    open_scene();
    const auto before = steps();
    find("side camera");
    EXPECT_EQ(first(0), "Camera");
    EXPECT_EQ(first(), "side");
    EXPECT_EQ(first(2), "the scene's file");
    enter();
    const auto& cameras = window.session().document().cameras;
    const auto* used = projects::find_item(cameras, window.session().experiment()->camera);
    ASSERT_TRUE(used);
    EXPECT_EQ(used->scene_camera, "side");
    EXPECT_EQ(steps(), before + 1);
    find("side camera");
    int found = 0;
    for (int i = 0; i < list().topLevelItemCount(); ++i)
        if (list().topLevelItem(i)->text(0) == "Camera" && list().topLevelItem(i)->text(1) == "side") ++found;
    EXPECT_EQ(found, 1) << "the project's stands for it";
    EXPECT_NE(first(2), "the scene's file");
    escape();
}

TEST_F(FinderTest, DoesWhatPanelsDo) {
    find("new sweep");
    EXPECT_NE(first(), "New sweep") << "there is no project";
    escape();
    open_scene();
    find("new sweep");
    EXPECT_EQ(first(), "New sweep");
    EXPECT_EQ(first(2), "Sweeps");
    enter();
    EXPECT_TRUE(QTest::qWaitFor([this] { return window.session().document().sweeps.size() == 1; }, 60000));
    EXPECT_TRUE(window.docks().is_seen("sweeps"));
    find("new analysis sensitivity");
    EXPECT_EQ(first(), "New analysis: Sensitivity") << first();
    enter();
    ASSERT_TRUE(QTest::qWaitFor([this] { return window.session().document().analyses.size() == 1; }, 60000));
    EXPECT_TRUE(window.docks().is_seen("analyses"));
    for (const char* panel : {"Sweeps", "Analyses", "Benchmarks"}) {
        find((std::string("run ") + panel).c_str());
        EXPECT_EQ(first(), "Run") << panel;
        escape();
    }
}

TEST_F(FinderTest, EverythingHasAnIcon) {
    open_scene();
    QPixmap empty(16, 16);
    empty.fill(Qt::transparent);
    for (const char* words :
         {"parameter", "action", "sample", "manual", "buffer", "scene", "experiment", "camera"}) {
        find(words);
        ASSERT_GT(list().topLevelItemCount(), 0) << words;
        for (int i = 0; i < list().topLevelItemCount(); ++i)
            EXPECT_NE(list().topLevelItem(i)->icon(0).pixmap(16, 16).toImage().convertToFormat(
                          QImage::Format_ARGB32),
                      empty.toImage().convertToFormat(QImage::Format_ARGB32))
                << words << ": " << list().topLevelItem(i)->text(1).toStdString();
        escape();
    }
}

TEST_F(FinderTest, CarriesActionsOutAndShowsTheirKeys) {
    find("full screen");
    EXPECT_EQ(first(), "Full screen");
    EXPECT_EQ(first(3), "Shift+F11");
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

class ExplainedTest : public FinderTest {
  protected:
    void SetUp() override {
        FinderTest::SetUp();
        open_scene();
        window.docks().raise("parameters");
    }
    void TearDown() override {
        if (auto* page = manual()) page->close();
        FinderTest::TearDown();
    }
    widgets::ParameterPanel& panel() { return *window.findChild<widgets::ParameterPanel*>(); }
    widgets::ManualWindow* manual() { return window.findChild<widgets::ManualWindow*>(); }
    /// As a right click there, or the key for menus, asks for it.
    QMenu* menu_of(QWidget& part) {
        QContextMenuEvent event(QContextMenuEvent::Mouse, part.rect().center(),
                                part.mapToGlobal(part.rect().center()));
        QApplication::sendEvent(&part, &event);
        return panel().findChild<QMenu*>("parameter-menu");
    }
    template <class Control>
    Control& control(const char* key) {
        return *window.findChild<QWidget*>(QStringLiteral("editor:%1").arg(key))->findChild<Control*>();
    }
    bool says(const QString& words) {
        const auto labels = window.findChild<StatusLine*>()->findChildren<QLabel*>();
        return std::ranges::any_of(labels, [&](const auto* label) { return label->text().contains(words); });
    }
};

TEST_F(ExplainedTest, EveryPartOfARowLeadsToTheManual) {
    auto& number = control<widgets::NumberField>("max_distance");
    const auto labels = panel().findChildren<QLabel*>();
    const auto label =
        std::ranges::find_if(labels, [](const auto* each) { return each->text() == "Maximum distance"; });
    ASSERT_NE(label, labels.end());
    for (QWidget* part : {static_cast<QWidget*>(*label), static_cast<QWidget*>(&number),
                          static_cast<QWidget*>(number.findChild<QLineEdit*>()),
                          static_cast<QWidget*>(&control<QSlider>("max_distance"))}) {
        auto* menu = menu_of(*part);
        ASSERT_TRUE(menu) << part->metaObject()->className();
        EXPECT_EQ(menu->actions().front()->text(), "What it is");
        const bool is_text = qobject_cast<QLineEdit*>(part) || part == &number;
        EXPECT_EQ(menu->actions().size() > 4, is_text) << "what can be done with a text stays";
        menu->actions().front()->trigger();
        menu->close();
        delete menu;
        ASSERT_TRUE(manual());
        EXPECT_EQ(manual()->page().fileName(), "parameters.md");
        EXPECT_EQ(manual()->findChild<QTextBrowser*>()->textCursor().selectedText(), "max_distance");
        manual()->show_page(SOURCE_ROOT "/README.md");
    }
}

TEST_F(ExplainedTest, AKeyLeadsThereFromTheParameterThatHasTheKeyboard) {
    auto& number = control<widgets::NumberField>("max_distance");
    EXPECT_TRUE(number.parentWidget()->toolTip().contains("Shift+F1"));
    number.setFocus();
    QTest::keyClick(&number, Qt::Key_F1, Qt::ShiftModifier);
    ASSERT_TRUE(manual());
    EXPECT_EQ(manual()->findChild<QTextBrowser*>()->textCursor().selectedText(), "max_distance");
    manual()->close();
    give_back();
    level()->setFocus();
    QTest::keyClick(level(), Qt::Key_F1, Qt::ShiftModifier);
    EXPECT_FALSE(manual()->isVisible());
    EXPECT_TRUE(says("The manual does not name level"));
    window.setFocus();
    QTest::keyClick(&window, Qt::Key_F1, Qt::ShiftModifier);
    EXPECT_EQ(manual()->page().fileName(), "README.md") << "no parameter has it";
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

/// What a person finds who asks what a parameter is.
TEST(Manual, NamesEveryParameterOfEveryMethod) {
    const QString shared = SOURCE_ROOT "/docs/parameters.md";
    widgets::ManualWindow manual(nullptr);
    std::map<std::string, int> methods_with;
    for (const auto* method : engine::registry().methods()) {
        const auto own = QStringLiteral(SOURCE_ROOT "/docs/methods/%1.md").arg(method->id.c_str());
        ASSERT_TRUE(QFile::exists(own)) << method->id;
        std::map<QString, QStringList> keys;
        for (const auto& parameter : method->parameters) {
            const auto key = QString::fromStdString(parameter.key);
            ++methods_with[parameter.key];
            const auto page = widgets::page_with({own, shared}, key);
            EXPECT_FALSE(page.isEmpty()) << method->id << ": " << parameter.key;
            if (!page.isEmpty()) keys[page] << key;
        }
        for (const auto& [page, named] : keys) {
            manual.show_page(page);
            for (const auto& key : named)
                EXPECT_TRUE(manual.go_to_key(key)) << page.toStdString() << ": " << key.toStdString();
        }
    }
    QFile page(shared);
    ASSERT_TRUE(page.open(QIODevice::ReadOnly));
    static const QRegularExpression row("^\\| `(\\w+)`", QRegularExpression::MultilineOption);
    int rows = 0;
    const auto text = QString::fromUtf8(page.readAll());
    for (auto match = row.globalMatch(text); match.hasNext(); ++rows) {
        const auto key = match.next().captured(1).toStdString();
        EXPECT_GE(methods_with[key], 2) << key << " is shared by no methods: its own page has it";
    }
    EXPECT_GT(rows, 20);
}

TEST(Manual, ARowSaysMoreThanAWordInAText) {
    const QString own = SOURCE_ROOT "/docs/methods/ldm-indirect.md",
                  shared = SOURCE_ROOT "/docs/parameters.md";
    EXPECT_EQ(widgets::page_with({own, shared}, "gloss"), own);
    EXPECT_EQ(widgets::page_with({own, shared}, "max_bounces"), own) << "both have a row";
    EXPECT_EQ(widgets::page_with({own, shared}, "radius_decay"), shared) << "it stands in a text of its own";
    EXPECT_EQ(widgets::page_with({own, shared}, "max_axis"), own);
    EXPECT_EQ(widgets::page_with({own, shared}, "no_such_key"), "");
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
