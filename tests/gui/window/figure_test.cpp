#include <QClipboard>
#include <QComboBox>
#include <QFile>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QTemporaryDir>

#include "tests/gui/window/window_fixture.h"

namespace ir::gui {
namespace {

/// Two views, of experiments with different values.
class FigureTest : public WindowTest {
  protected:
    void SetUp() override {
        WindowTest::SetUp();
        open_scene();
        add_second_experiment(0.75);
        trigger("views-2");
        window.workspace().area().set_active(1);
        choose(header("owner-a"), QString::fromStdString(window.session().document().experiments[1].name));
        window.workspace().area().set_active(0);
    }
    FigureDialog& dialog() { return *window.findChild<FigureDialog*>(); }
    template <class T>
    T* find(const char* name) {
        return dialog().findChild<T*>(name);
    }
    bool drawn() {
        QApplication::processEvents();
        return QTest::qWaitFor([&] { return !dialog().is_drawing(); }, 60000);
    }
    QSize preview() { return find<QLabel>("preview")->pixmap().size(); }
    QString problem() { return find<QLabel>("problem")->text(); }
    void set_rectangle(const QRect& rectangle) {
        window.workspace().tools().set_region(window.view().picture()->size(), rectangle);
    }
};

TEST_F(FigureTest, ShowsThePicturesOfTheViewsAndWritesThem) {
    const QTemporaryDir folder;
    trigger("figure");
    ASSERT_TRUE(dialog().isVisible() && drawn());
    auto* pictures = find<QListWidget>("pictures");
    ASSERT_EQ(pictures->count(), 2);
    EXPECT_FALSE(find<QLabel>("preview")->pixmap().isNull());
    EXPECT_EQ(problem(), "");
    auto now = dialog().figure();
    ASSERT_EQ(now.pictures.size(), 2u);
    EXPECT_EQ(now.reference, 1u) << "the last one";
    EXPECT_EQ(now.metrics, std::vector<std::string>{"rmse"});
    // What is seen is what the view shows.
    const auto& raster = *now.pictures[0].raster;
    const auto& view = window.workspace().pane(0)->compare().main_view();
    const auto shown = widgets::to_qimage(view.image(), view.display());
    EXPECT_EQ(QColor(raster.bytes[0], raster.bytes[1], raster.bytes[2]), QColor(shown.pixel(0, 0)));
    // A name is changed, a picture left out.
    pictures->item(0)->setText("Ours");
    EXPECT_EQ(dialog().figure().pictures[0].label, "Ours");
    for (const char* name : {"f.pdf", "f.png", "f.svg"}) {
        const QString file = folder.path() + "/" + name;
        dialog().save_to(file);
        for (const char* button : {"save", "copy"})
            EXPECT_FALSE(find<QPushButton>(button)->isEnabled()) << "one at a time";
        ASSERT_TRUE(drawn());
        EXPECT_TRUE(find<QPushButton>("save")->isEnabled());
        EXPECT_GT(QFile(file).size(), 1000) << name;
    }
    EXPECT_EQ(QImage(folder.path() + "/f.png").width(), 2103);
    dialog().save_to(folder.path() + "/f.gif");
    ASSERT_TRUE(drawn());
    EXPECT_FALSE(QFile::exists(folder.path() + "/f.gif"));
    QTest::mouseClick(find<QPushButton>("copy"), Qt::LeftButton);
    ASSERT_TRUE(drawn());
    EXPECT_EQ(QApplication::clipboard()->image().width(), 2103);
}

TEST_F(FigureTest, RectanglesOfThePicturesBecomeInsets) {
    trigger("figure");
    ASSERT_TRUE(drawn());
    auto* add = find<QPushButton>("add-inset");
    EXPECT_FALSE(add->isEnabled());
    EXPECT_TRUE(add->toolTip().contains("Draw a rectangle"));
    window.workspace().tools().set_region({8, 8}, {1, 1, 4, 4});
    EXPECT_FALSE(add->isEnabled());
    EXPECT_TRUE(add->toolTip().contains("another size"));
    const auto before = preview();
    set_rectangle({4, 6, 12, 8});
    ASSERT_TRUE(add->isEnabled());
    QTest::mouseClick(add, Qt::LeftButton);
    set_rectangle({20, 6, 12, 8});
    QTest::mouseClick(add, Qt::LeftButton);
    ASSERT_TRUE(drawn());
    EXPECT_EQ(find<QListWidget>("insets")->item(0)->text(), QStringLiteral("12 × 8 at 4, 6"));
    ASSERT_EQ(dialog().figure().insets.size(), 2u);
    EXPECT_EQ(dialog().figure().insets[1], (Rectangle{20, 6, 12, 8}));
    EXPECT_GT(preview().height() * before.width(), before.height() * preview().width()) << "it is higher";
    find<QListWidget>("insets")->setCurrentRow(0);
    QTest::mouseClick(find<QPushButton>("remove-inset"), Qt::LeftButton);
    ASSERT_EQ(dialog().figure().insets.size(), 1u);
    EXPECT_EQ(dialog().figure().insets[0].x, 20);
}

TEST_F(FigureTest, WhatCannotBeDrawnIsSaidAndNotSaved) {
    trigger("figure");
    ASSERT_TRUE(drawn());
    auto* pictures = find<QListWidget>("pictures");
    for (int i = 0; i < pictures->count(); ++i) pictures->item(i)->setCheckState(Qt::Unchecked);
    ASSERT_TRUE(drawn());
    EXPECT_TRUE(problem().contains("needs a picture")) << problem().toStdString();
    EXPECT_FALSE(find<QPushButton>("save")->isEnabled());
    pictures->item(1)->setCheckState(Qt::Checked);
    ASSERT_TRUE(drawn());
    EXPECT_EQ(problem(), "");
    EXPECT_TRUE(find<QPushButton>("save")->isEnabled());
}

TEST_F(FigureTest, PicturesThatComeAnewKeepOrderTicksAndNames) {
    trigger("figure");
    ASSERT_TRUE(drawn());
    auto* list = find<QListWidget>("pictures");
    auto offered = dialog().figure().pictures;
    ASSERT_EQ(offered.size(), 2u);
    list->insertItem(1, list->takeItem(0));
    list->item(0)->setCheckState(Qt::Unchecked);
    list->setCurrentRow(1);
    list->editItem(list->item(1));
    auto* name = list->findChild<QLineEdit*>();
    ASSERT_TRUE(name);
    name->setText("Ours");
    dialog().set_pictures(offered);
    ASSERT_EQ(list->findChild<QLineEdit*>(), name) << "it is still being changed";
    list->setCurrentRow(0);
    EXPECT_EQ(list->item(1)->text(), "Ours");
    ASSERT_EQ(dialog().figure().pictures.size(), 1u);
    EXPECT_EQ(dialog().figure().pictures[0].side, offered[0].side);
    auto third = offered[1];
    third.label = "Third";
    offered.insert(offered.begin(), third);
    dialog().set_pictures(offered);
    ASSERT_EQ(list->count(), 3);
    EXPECT_EQ(list->item(0)->text().toStdString(), offered[2].label);
    EXPECT_EQ(list->item(0)->checkState(), Qt::Unchecked);
    const auto now = dialog().figure().pictures;
    ASSERT_EQ(now.size(), 2u);
    EXPECT_EQ(now[0].label, "Ours");
    EXPECT_EQ(now[0].side, offered[1].side);
    EXPECT_EQ(now[1].label, "Third") << "new ones come last";
}

TEST_F(FigureTest, ViewsAreFollowedAndChoicesKept) {
    const QTemporaryDir folder;
    trigger("figure");
    find<QListWidget>("pictures")->item(0)->setText("Ours");
    find<QListWidget>("pictures")->item(1)->setCheckState(Qt::Unchecked);
    set_rectangle({4, 6, 12, 8});
    QTest::mouseClick(find<QPushButton>("add-inset"), Qt::LeftButton);
    type_level("0.5");
    auto now = dialog().figure();
    ASSERT_EQ(now.pictures.size(), 1u);
    EXPECT_EQ(now.pictures[0].label, "Ours");
    EXPECT_FLOAT_EQ(now.pictures[0].side->image.at(0, 0), 0.5f) << "the new picture";
    window.session().files().save_as((folder.path() + "/kept.interreflect").toStdString());
    QTest::keyClick(&window, Qt::Key_S, Qt::ControlModifier);
    trigger("close");
    EXPECT_FALSE(dialog().isVisible());
    ASSERT_TRUE(window.open_path(folder.path() + "/kept.interreflect"));
    ASSERT_TRUE(settle());
    trigger("figure");
    ASSERT_EQ(dialog().figure().insets.size(), 1u);
    EXPECT_EQ(dialog().figure().insets[0], (Rectangle{4, 6, 12, 8}));
    // A session file is free text.
    dialog().load(projects::Json::parse(R"({"width":"x","metrics":[3,{}],"insets":[{"x":1e300},7]})"));
    EXPECT_TRUE(drawn());
}

}  // namespace
}  // namespace ir::gui
