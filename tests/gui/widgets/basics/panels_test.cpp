#include <gtest/gtest.h>

#include <QAbstractItemModelTester>
#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QScrollBar>
#include <QSignalSpy>
#include <QStyleOption>
#include <QTableView>
#include <QTest>
#include <QTextBlock>
#include <QTextBrowser>
#include <QToolButton>
#include <QTreeWidget>
#include <set>

#include "widgets/image/picture.h"
#include "widgets/panels/cards.h"
#include "widgets/panels/messages_panel.h"
#include "widgets/panels/notes_strip.h"
#include "widgets/panels/rows_panel.h"
#include "widgets/panels/shortcuts_dialog.h"
#include "widgets/panels/value_strip.h"
#include "widgets/panels/welcome_page.h"
#include "widgets/views/view_header.h"

namespace ir::widgets {
namespace {

class MessagesPanelTest : public testing::Test {
  protected:
    void SetUp() override {
        panel.resize(700, 200);
        panel.show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(&panel));
        panel.add({Severity::warning, "scene", "a texture is missing", {}});
        panel.add({Severity::error, "shader", "syntax error", "shaders/lib/brdf.glsl:12"});
        panel.add({Severity::note, "graph", "grew", "ldm.nodes"});
        panel.add({Severity::note, "graph", "grew", "ldm.nodes"});
    }
    QPoint place_of(int row) {
        return panel.view().visualRect(panel.filter().index(row, MessagesModel::text_column)).center();
    }
    QComboBox* sources() { return panel.findChild<QComboBox*>("sources"); }
    MessagesPanel panel;
};

TEST_F(MessagesPanelTest, CountsSources) {
    ASSERT_EQ(sources()->count(), 4);
    EXPECT_EQ(sources()->itemText(0), "All sources (4)");
    EXPECT_EQ(sources()->itemText(3), "graph (2)");
    EXPECT_FALSE(sources()->itemIcon(2).isNull());
    sources()->setFocus();
    QTest::keyClick(sources(), Qt::Key_Down);
    QTest::keyClick(sources(), Qt::Key_Down);
    ASSERT_EQ(panel.filter().rowCount(), 1);
    EXPECT_EQ(panel.filter().index(0, MessagesModel::source_column).data().toString(), "shader");
    panel.add({Severity::error, "gl", "lost", {}});
    EXPECT_EQ(sources()->currentIndex(), 2) << "the choice stays";
    EXPECT_EQ(panel.filter().rowCount(), 1);
    panel.clear();
    EXPECT_EQ(sources()->count(), 1);
    panel.add({Severity::note, "scene", "loaded", {}});
    EXPECT_EQ(panel.filter().rowCount(), 1) << "a source that is gone hides nothing";
}

TEST_F(MessagesPanelTest, DoubleClickAndEnterGoThere) {
    std::vector<Message> gone;
    QObject::connect(&panel, &MessagesPanel::go_to, [&](const Message& message) { gone.push_back(message); });
    QTest::mouseClick(panel.view().viewport(), Qt::LeftButton, {}, place_of(0));
    QTest::keyClick(&panel.view(), Qt::Key_Return);
    EXPECT_TRUE(gone.empty()) << "it has no place";
    QTest::mouseClick(panel.view().viewport(), Qt::LeftButton, {}, place_of(1));
    QTest::mouseDClick(panel.view().viewport(), Qt::LeftButton, {}, place_of(1));
    ASSERT_EQ(gone.size(), 1u);
    EXPECT_EQ(gone[0].place, "shaders/lib/brdf.glsl:12");
    QTest::keyClick(&panel.view(), Qt::Key_Down);
    QTest::keyClick(&panel.view(), Qt::Key_Return);
    ASSERT_EQ(gone.size(), 2u);
    EXPECT_EQ(gone[1].place, "ldm.nodes");
}

TEST_F(MessagesPanelTest, CopiesTheChosenLinesWithTheirPlaces) {
    QTest::mouseClick(panel.view().viewport(), Qt::LeftButton, {}, place_of(1));
    for (auto* action : panel.view().actions())
        if (action->shortcut() == QKeySequence(QKeySequence::Copy)) action->trigger();
    const QString text = QApplication::clipboard()->text();
    EXPECT_TRUE(text.contains("Error: shader: syntax error [shaders/lib/brdf.glsl:12]"))
        << text.toStdString();
    EXPECT_FALSE(text.contains('\n'));
}

TEST(MessagesModelPlaces, MessagesAboutOtherPlacesAreOthers) {
    MessagesModel model;
    const QAbstractItemModelTester tester(&model, QAbstractItemModelTester::FailureReportingMode::Fatal);
    model.add({Severity::error, "shader", "syntax error", "a.glsl:1"});
    model.add({Severity::error, "shader", "syntax error", "b.glsl:1"});
    EXPECT_EQ(model.rowCount(), 2);
}

class WelcomeTest : public testing::Test {
  protected:
    void SetUp() override {
        page.resize(900, 700);
        page.show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(&page));
    }
    QAbstractButton* card(const QString& name) {
        for (auto* card : page.findChildren<QAbstractButton*>())
            if (card->text() == name && card->isVisible()) return card;
        return nullptr;
    }
    WelcomePage page;
};

TEST_F(WelcomeTest, OpensSamplesAndRecentProjects) {
    page.set_samples({{"/samples/atrium.interreflect", "Atrium", "Figure 7", QImage(), "Paper", 2}});
    page.set_recent({{"/home/kitchen.interreflect", "", QDateTime::currentDateTime(), QImage(), false},
                     {"/home/lost.interreflect", "Lost", QDateTime(), QImage(), true}});
    QApplication::processEvents();
    const QSignalSpy chosen(&page, &WelcomePage::project_chosen);
    ASSERT_NE(card("Atrium"), nullptr);
    QTest::mouseClick(card("Atrium"), Qt::LeftButton);
    ASSERT_NE(card("kitchen"), nullptr) << "named after its folder";
    card("kitchen")->setFocus();
    QTest::keyClick(card("kitchen"), Qt::Key_Return);
    QTest::keyClick(card("kitchen"), Qt::Key_Space);
    QTest::mouseClick(card("Lost"), Qt::LeftButton);
    ASSERT_EQ(chosen.count(), 3) << "what is missing opens nothing";
    EXPECT_EQ(chosen[0][0].toString(), "/samples/atrium.interreflect");
    EXPECT_EQ(chosen[1][0].toString(), "/home/kitchen.interreflect");
    EXPECT_FALSE(card("Lost")->isEnabled());
}

TEST_F(WelcomeTest, TakesAProjectOffTheListEvenFromItsOwnClick) {
    const std::vector<RecentProject> all = {{"/a.interreflect", "A", QDateTime(), QImage(), true},
                                            {"/b.interreflect", "B", QDateTime(), QImage(), false}};
    page.set_recent(all);
    QApplication::processEvents();
    QString removed;
    QObject::connect(&page, &WelcomePage::recent_removed, [&](const QString& path) {
        removed = path;
        page.set_recent({all[1]});
    });
    for (auto* button : page.findChildren<QToolButton*>("remove"))
        if (button->accessibleName().contains("A")) {
            QTest::mouseClick(button, Qt::LeftButton);
            break;
        }
    EXPECT_EQ(removed, "/a.interreflect");
    QApplication::processEvents();
    EXPECT_EQ(card("A"), nullptr);
    EXPECT_NE(card("B"), nullptr);
}

TEST_F(WelcomeTest, StartsByButtonAndKeyboard) {
    const QSignalSpy fresh(&page, &WelcomePage::new_chosen), open(&page, &WelcomePage::open_chosen);
    QTest::mouseClick(page.findChild<QAbstractButton*>("new"), Qt::LeftButton);
    page.activateWindow();
    page.findChild<QAbstractButton*>("new")->setFocus();
    QTest::keyClick(page.focusWidget(), Qt::Key_Tab);
    QTest::keyClick(page.focusWidget(), Qt::Key_Space);
    EXPECT_EQ(fresh.count(), 1);
    EXPECT_EQ(open.count(), 1);
}

TEST_F(WelcomeTest, FindsSamplesByTheirWordsAndWalksThemByArrows) {
    page.set_samples({{"/ao.interreflect", "Occlusion", "of a hairball", QImage(), "Maps", 1.2},
                      {"/gi.interreflect", "Indirect light", "of an atrium", QImage(), "Maps", 0},
                      {"/photons.interreflect", "Photons", "in an atrium", QImage(), "Photons", 70}});
    auto* search = page.findChild<QLineEdit*>("search");
    QTest::keyClicks(search, "atrium");
    EXPECT_EQ(card("Occlusion"), nullptr);
    EXPECT_NE(card("Indirect light"), nullptr);
    QTest::keyClicks(search, " photons");
    EXPECT_EQ(card("Indirect light"), nullptr) << "all words, also of the heading";
    const QSignalSpy chosen(&page, &WelcomePage::project_chosen);
    QTest::keyClick(search, Qt::Key_Return);
    ASSERT_EQ(chosen.count(), 1);
    EXPECT_EQ(chosen[0][0].toString(), "/photons.interreflect");
    search->clear();
    QApplication::processEvents();
    page.activateWindow();
    search->setFocus();
    QTest::keyClick(search, Qt::Key_Down);
    EXPECT_EQ(page.focusWidget(), card("Occlusion"));
    QTest::keyClick(page.focusWidget(), Qt::Key_Right);
    EXPECT_EQ(page.focusWidget(), card("Indirect light"));
    QTest::keyClick(page.focusWidget(), Qt::Key_Down);
    EXPECT_EQ(page.focusWidget(), card("Photons"));
    QTest::keyClick(page.focusWidget(), Qt::Key_Up);
    QTest::keyClick(page.focusWidget(), Qt::Key_Return);
    ASSERT_EQ(chosen.count(), 2);
    EXPECT_EQ(chosen[1][0].toString(), "/ao.interreflect");
}

TEST(NotesStrip, AHeadingKeepsItsSizeBehindLinks) {
    NotesStrip strip;
    strip.set_notes("# Look [the blur](parameter:blur) and [normal](buffer:normal)\n\nWords");
    const auto* document = strip.findChild<QTextBrowser*>()->document();
    std::set<int> sizes;
    int pieces = 0;
    for (auto it = document->firstBlock().begin(); !it.atEnd(); ++it, ++pieces)
        sizes.insert(it.fragment().charFormat().property(QTextFormat::FontSizeAdjustment).toInt());
    EXPECT_EQ(pieces, 4);
    EXPECT_EQ(sizes, std::set{3});
}

TEST(NotesStrip, FoldsIntoOneLineAndTakesNoRoomWithoutNotes) {
    NotesStrip strip;
    strip.resize(600, 200);
    EXPECT_TRUE(strip.isHidden());
    strip.set_notes(QString("What the figure shows, and with which settings it was made. ").repeated(8));
    strip.show();
    const int open = strip.sizeHint().height();
    const QSignalSpy folded(&strip, &NotesStrip::folded_changed);
    QTest::mouseClick(strip.findChild<QAbstractButton*>("fold-notes"), Qt::LeftButton);
    EXPECT_EQ(folded.count(), 1);
    EXPECT_TRUE(strip.is_folded());
    EXPECT_LT(strip.sizeHint().height(), open);
}

TEST(NotesStrip, ShowsTheFirstParagraphWholeAndNoLineCut) {
    NotesStrip strip;
    strip.resize(600, 200);
    const auto height_of = [&strip](const QString& notes) {
        strip.set_notes(notes);
        return strip.findChild<QTextBrowser*>()->height();
    };
    const int line = height_of("One line.");
    EXPECT_NEAR(line, strip.fontMetrics().lineSpacing(), 1);
    EXPECT_EQ(height_of("One line.\n\n" + QString("What the paper says. ").repeated(50)), line);
    const auto long_text = QString("What the figure shows. ").repeated(12);
    EXPECT_GT(height_of(long_text), 2 * line);
    EXPECT_EQ(height_of(long_text) % line, 0);
    EXPECT_EQ(height_of(long_text.repeated(9)), 4 * line);
    EXPECT_GT(height_of("## Heading\n\nOne line.\n\nMore."), 2 * line) << "and what stands below it";
    strip.show();
    EXPECT_EQ(strip.findChild<QTextBrowser*>()->verticalScrollBar()->value(), 0) << "it begins at the top";
}

TEST(ShortcutsDialog, ListsEveryActionByMenuAndFindsThem) {
    QWidget window;
    QMenu file("&File", &window), view("&View", &window);
    auto* recent = file.addMenu("&Recent");
    QAction open("&Open …", &window), fit("&Fit", &window), bare("&Nothing", &window),
        loose("L&oose", &window);
    QAction separator(&window), ampersand("Cut && paste", &window), last("a project", &window);
    separator.setSeparator(true);
    open.setShortcuts({QKeySequence("Ctrl+O"), QKeySequence("Ctrl+Shift+O")});
    fit.setShortcut(QKeySequence("F"));
    file.addActions({&open, &separator, &ampersand});
    recent->addAction(&last);
    view.addActions({&fit, &bare});
    ShortcutsDialog dialog({&open, &separator, &ampersand, &last, &fit, &bare, &loose, &fit},
                           {{"Zoom", "Wheel"}}, nullptr);
    auto* tree = dialog.findChild<QTreeWidget*>();
    QStringList lines;
    for (int g = 0; g < tree->topLevelItemCount(); ++g)
        for (int i = 0; i < tree->topLevelItem(g)->childCount(); ++i)
            lines << tree->topLevelItem(g)->text(0) + "|" + tree->topLevelItem(g)->child(i)->text(0) + "|" +
                         tree->topLevelItem(g)->child(i)->text(1);
    EXPECT_EQ(lines, (QStringList{"File|Open …|Ctrl+O or Ctrl+Shift+O", "File|Cut & paste|",
                                  "File › Recent|a project|", "View|Fit|F", "View|Nothing|", "Other|Loose|",
                                  "Mouse and held keys|Zoom|Wheel"}))
        << lines.join('\n').toStdString();
    dialog.show();
    QTest::keyClicks(dialog.findChild<QLineEdit*>(), "ctrl+");
    QStringList shown;
    for (int g = 0; g < tree->topLevelItemCount(); ++g)
        for (int i = 0; i < tree->topLevelItem(g)->childCount(); ++i)
            if (!tree->topLevelItem(g)->isHidden() && !tree->topLevelItem(g)->child(i)->isHidden())
                shown << tree->topLevelItem(g)->child(i)->text(0);
    EXPECT_EQ(shown, QStringList{"Open …"});
}

/// A project with a table opened with its view active: what is shown counted as chosen by a person.
TEST(ViewHeader, ShowingATableChoosesNothing) {
    ViewHeader header;
    const QSignalSpy chosen(&header, &ViewHeader::state_chosen), linked(&header, &ViewHeader::link_chosen);
    ViewFields fields;
    fields.owners = {{"a", "A", {}}};
    fields.outputs_a = {{"counts", "Counts", {}, {}, OutputKind::table}};
    fields.state.a = {"a", "counts"};
    fields.linked = false;
    header.set_fields(fields);
    EXPECT_TRUE(header.findChild<QToolButton*>("table")->isChecked());
    EXPECT_EQ(chosen.count(), 0);
    EXPECT_EQ(linked.count(), 0);
}

TEST(Theme, ListsCutTheirTextBetweenLettersAndSaySo) {
    const QString text = QStringLiteral("Ambient occlusion from layered depth maps");
    QComboBox combo;
    combo.addItem(text);
    combo.resize(140, combo.sizeHint().height());
    const auto cut = combo.grab().toImage();
    QStyleOptionComboBox option;
    option.initFrom(&combo);
    const int room = combo.style()
                         ->subControlRect(QStyle::CC_ComboBox, &option, QStyle::SC_ComboBoxEditField, &combo)
                         .width() -
                     2;
    combo.setItemText(0, combo.fontMetrics().elidedText(text, Qt::ElideRight, room));
    ASSERT_TRUE(combo.currentText().endsWith(QChar(0x2026)));
    EXPECT_EQ(cut, combo.grab().toImage());
}

/// Alpha is 1 in a black picture; four numbers of another meaning are four.
TEST(ValueStrip, StatisticsLeaveAlphaOut) {
    Image black(4, 4, 4);
    for (std::size_t i = 3; i < black.pixels.size(); i += 4) black.pixels[i] = 1;
    ValueStrip strip;
    strip.set_picture(black, Semantic::radiance, "black", {});
    EXPECT_TRUE(strip.text().contains("max 0  mean 0")) << strip.text().toStdString();
    strip.set_picture(black, Semantic::count, "counts", {});
    EXPECT_TRUE(strip.text().contains("max 1  mean 0.25")) << strip.text().toStdString();
    EXPECT_EQ(display_for(Semantic::normal, "", black).high, 1);
    EXPECT_EQ(display_for(Semantic::position, "", black).high, 0) << "the range is that of the values";
}

TEST(ValueStrip, LeavesItsNameOutBeforeNumbers) {
    Image picture(4, 4, 1);
    picture.pixels[0] = 0.25f;
    ValueStrip strip;
    strip.resize(2000, strip.sizeHint().height());
    strip.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&strip));
    strip.set_picture(picture, Semantic::accessibility, "A long name of an experiment · Accessibility", {});
    const auto full = strip.text();
    const auto* shown = strip.findChild<QLabel*>("values");
    EXPECT_EQ(shown->text(), full);
    ASSERT_TRUE(full.startsWith("A long name")) << full.toStdString();
    strip.resize(420, strip.height());
    EXPECT_LT(shown->text().size(), full.size()) << shown->text().toStdString();
    EXPECT_TRUE(shown->text().startsWith("4×4×1")) << shown->text().toStdString();
    EXPECT_TRUE(shown->text().contains("max 0.25")) << shown->text().toStdString();
}

TEST(ValueStrip, SaysNothingOfPixelsThatASmallerPictureLacks) {
    const auto shown = make_picture(Image(8, 8, 3), Semantic::radiance);
    const auto& picture = *shown;
    const int width = picture.image->width, height = picture.image->height;
    ValueStrip strip;
    strip.set_picture(*picture.image, Semantic::radiance, "black", {});
    const auto summary = strip.text();
    strip.show_pixel(picture, {width - 1, height - 1});
    EXPECT_TRUE(strip.text().startsWith("x")) << strip.text().toStdString();
    for (const QPoint outside : {QPoint(-1, -1), QPoint(width, 0)}) {
        strip.show_pixel(picture, outside);
        EXPECT_EQ(strip.text(), summary);
    }
}

TEST(RowsPanelTest, ValuesStandBesideTheirNamesInAWidePanel) {
    RowsPanel panel({"Pass", "Time"}, {});
    panel.resize(900, 200);
    panel.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&panel));
    Row row{"a", {}};
    row.cells = {{"G-buffer"}, {"0.5 ms"}};
    panel.set_rows({row});
    const int wide = panel.view()->columnWidth(0);
    EXPECT_LT(wide, 200);
    row.cells = {{"a pass whose name is longer than others"}, {"0.5 ms"}};
    panel.set_rows({row});
    EXPECT_GT(panel.view()->columnWidth(0), wide);
    panel.resize(180, 200);
    ASSERT_TRUE(QTest::qWaitFor([&] { return panel.view()->viewport()->width() <= 180; }));
    EXPECT_LE(panel.view()->columnWidth(0) + panel.view()->columnWidth(1), 180) << "long names are cut";
}

TEST(RowsPanelTest, SearchesAsTheFinderDoes) {
    RowsPanel panel({"Buffer"}, "Nothing is here.");
    panel.set_searchable("Search");
    const auto row = [](const char* key, const char* name) { return Row{key, {{name}}}; };
    Row first{"pass:g", {{"G-buffer"}}}, second{"pass:t", {{"Tracing"}}};
    first.children = {row("g.depth", "Depth"), row("g.depths", "All depths")};
    second.children = {row("t.hits", "Hit points")};
    panel.set_rows({first, second});
    auto* line = panel.findChild<QLineEdit*>("search");
    const auto shown = [&](const char* query) {
        line->setText(query);
        QStringList keys;
        for (const char* key : {"g.depth", "g.depths", "t.hits"}) {
            const auto at = panel.model().index_of(key);
            const bool is_hidden = panel.view()->isRowHidden(at.row(), at.parent()) ||
                                   panel.view()->isRowHidden(at.parent().row(), {});
            if (!is_hidden) keys << key;
        }
        return keys;
    };
    EXPECT_EQ(shown("tracing hit"), QStringList("t.hits")) << "words of the group, too";
    EXPECT_EQ(shown("dpth"), QStringList({"g.depth", "g.depths"})) << "letters may be left out";
    EXPECT_EQ(shown("t.h"), QStringList("t.hits")) << "not also with letters left out";
    EXPECT_EQ(shown("xyzzy"), QStringList());
    EXPECT_EQ(panel.view()->empty_text(), nothing_fits());
    QSignalSpy clicked(&panel, &RowsPanel::row_clicked);
    EXPECT_EQ(shown("depths").size(), 1);
    EXPECT_EQ(shown("depth").size(), 2);
    QTest::keyClick(line, Qt::Key_Return);
    ASSERT_EQ(clicked.count(), 1);
    EXPECT_EQ(clicked.last()[0].toString(), "g.depth") << "it fits best";
    EXPECT_EQ(shown("").size(), 3);
    EXPECT_EQ(panel.view()->empty_text(), "Nothing is here.");
}

/// Lines of numbers, such as headings of columns, give way before names do.
TEST(RowsPanelTest, NamesHaveTheRoomFirst) {
    RowsPanel panel({"Buffer", "Size", "Memory", "Format"}, {});
    panel.set_name_width(60);
    Row row{"a", {}};
    row.cells = {{"Own entry found or missing"}, {"512×512"}, {"1.00 MiB"}, {"RGBA, 16 bit float"}};
    panel.set_rows({row});
    panel.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&panel));
    const auto* view = panel.view();
    const int named = QFontMetrics(view->font()).horizontalAdvance(row.cells[0].text);
    panel.resize(named + 200, 200);
    EXPECT_TRUE(QTest::qWaitFor([&] { return view->columnWidth(0) > named; }))
        << view->columnWidth(0) << " of " << view->viewport()->width() << " for " << named;
    // Columns beside it are seen whole, or not at all, but for the first.
    const auto edge = [&](int column) { return view->header()->sectionViewportPosition(column + 1); };
    for (int width = named / 2; width < 3 * named; width += 20) {
        panel.resize(width, 200);
        const bool is_whole = QTest::qWaitFor([&] {
            const int room = view->viewport()->width();
            for (int c = 1; c < 4; ++c)
                if (edge(c - 1) < room - 1 && edge(c) > room && c > 1) return false;
            return true;
        });
        EXPECT_TRUE(is_whole) << width;
    }
}

}  // namespace
}  // namespace ir::widgets
