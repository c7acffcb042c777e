#include <sys/stat.h>

#include <QDir>
#include <QDirIterator>
#include <QFile>
#include <QFileInfo>
#include <QPushButton>
#include <QSettings>
#include <QTemporaryDir>
#include <algorithm>
#include <chrono>
#include <map>

#include "app/gui/card_picture.h"
#include "app/gui/dialog_folder.h"
#include "app/gui/known_projects.h"
#include "tests/gui/window/window_fixture.h"
#include "widgets/panels/cards.h"

namespace ir::gui {
namespace {

/// An installation of its own with one sample.
class SamplesTest : public WindowTest {
  protected:
    void SetUp() override {
        WindowTest::SetUp();
        before_ = qgetenv("INTERREFLECT_DATA");
        qputenv("INTERREFLECT_DATA", installation.path().toLocal8Bit());
        open_scene();
        window.session().files().save_as(sample.toStdString());
        window.session().files().close();
    }
    void TearDown() override {
        before_.isNull() ? qunsetenv("INTERREFLECT_DATA") : qputenv("INTERREFLECT_DATA", before_);
        WindowTest::TearDown();
    }
    /// Everything in the installation, hidden files as well.
    std::map<QString, QByteArray> installed() const {
        std::map<QString, QByteArray> files;
        QDirIterator at(installation.path(), QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot,
                        QDirIterator::Subdirectories);
        while (at.hasNext()) {
            QFile file(at.next());
            files[at.filePath()] = file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
        }
        return files;
    }
    QString opened() { return QString::fromStdString(window.session().open_project().folder().string()); }
    void open_sample() {
        ASSERT_TRUE(window.open_path(sample)) << window.banners().text("file").toStdString();
        ASSERT_TRUE(settle());
    }

    QTemporaryDir installation;
    QString sample = installation.path() + "/samples/a.interreflect";

  private:
    QByteArray before_;
};

TEST_F(SamplesTest, OpeningAndSavingOneWritesNothingIntoTheInstallation) {
    const auto before = installed();
    open_sample();
    EXPECT_FALSE(opened().startsWith(installation.path())) << opened().toStdString();
    EXPECT_FALSE(window.session().open_project().is_read_only());
    type_level("0.75");
    trigger("save");
    EXPECT_FALSE(window.isWindowModified());
    window.session().files().autosave();
    EXPECT_EQ(installed(), before) << "while it is open";
    window.session().files().close();
    EXPECT_EQ(installed(), before);
}

TEST_F(SamplesTest, AChangedCopyComesBackAndAFreshOneIsOffered) {
    open_sample();
    EXPECT_TRUE(window.banners().text("sample").isEmpty());
    const auto copy = opened();
    type_level("0.75");
    trigger("save");
    open_sample();  // while it is open
    EXPECT_FALSE(window.session().open_project().is_read_only());
    EXPECT_EQ(opened(), copy);
    EXPECT_FLOAT_EQ(pixel(), 0.75f);
    EXPECT_TRUE(window.banners().text("sample").contains(copy));
    auto* banner = window.banners().findChild<QWidget*>("banner:sample");
    ASSERT_TRUE(banner);
    banner->findChild<QPushButton*>()->click();
    ASSERT_TRUE(QTest::qWaitFor([&] { return window.banners().text("sample").isEmpty(); }, 60000));
    ASSERT_TRUE(settle());
    EXPECT_EQ(opened(), copy);
    EXPECT_FLOAT_EQ(pixel(), 0.25f);
    const auto aside = QFileInfo(copy).path() + "/a-2.interreflect";
    ASSERT_TRUE(window.open_path(aside));
    ASSERT_TRUE(settle());
    EXPECT_FLOAT_EQ(pixel(), 0.75f);
}

TEST_F(SamplesTest, BeginningAfreshLosesNothingWhereItFails) {
    const auto begin_afresh = [&] {
        window.banners().findChild<QWidget*>("banner:sample")->findChild<QPushButton*>()->click();
        ASSERT_TRUE(settle());
    };
    open_sample();
    const auto copy = opened();
    type_level("0.75");
    trigger("save");
    open_sample();
    QFile::rename(sample + "/project.json", sample + "/away");
    begin_afresh();  // it is put aside and nothing comes in its place
    ASSERT_TRUE(window.session().has_project());
    EXPECT_EQ(opened(), QFileInfo(copy).path() + "/a-2.interreflect");
    EXPECT_FALSE(window.banners().text("file").isEmpty());
    type_level("0.5");
    trigger("save");
    EXPECT_FALSE(window.isWindowModified());
    QFile::rename(sample + "/away", sample + "/project.json");

    open_sample();
    type_level("0.625");
    trigger("save");
    window.session().files().close();
    auto elsewhere = std::make_unique<projects::OpenProject>(copy.toStdString(), fake_registry());
    open_sample();
    ASSERT_TRUE(window.session().open_project().is_read_only());
    begin_afresh();
    ASSERT_TRUE(window.session().has_project());
    EXPECT_EQ(opened(), copy);
    EXPECT_FLOAT_EQ(pixel(), 0.625f);
    elsewhere.reset();
}

TEST_F(SamplesTest, AreKnownThroughLinksAndRelativePaths) {
    QTemporaryDir elsewhere;
    QFile::link(installation.path() + "/samples", elsewhere.path() + "/link");
    EXPECT_TRUE(Samples::contains(sample.toStdString()));
    EXPECT_TRUE(Samples::contains((elsewhere.path() + "/link/a.interreflect/").toStdString()));
    EXPECT_FALSE(Samples::contains((installation.path() + "/samples").toStdString()));
    EXPECT_FALSE(Samples::contains((installation.path() + "/samples-of-mine/a").toStdString()));
    const auto here = QDir::currentPath();
    QDir::setCurrent(installation.path());
    EXPECT_TRUE(Samples::contains("samples/a.interreflect"));
    QDir::setCurrent(here);
}

TEST_F(WindowTest, ARecentProjectIsFoundFromAnotherFolder) {
    QSettings().remove("recent");
    const QTemporaryDir folder;
    open_scene();
    window.session().files().save_as((folder.path() + "/kept.interreflect").toStdString());
    window.session().files().close();
    std::filesystem::last_write_time(
        (folder.path() + "/kept.interreflect/project.json").toStdString(),
        std::filesystem::file_time_type::clock::now() - std::chrono::hours(9000));
    FakeRenderer other_renderer;
    MainWindow other(other_renderer, fake_registry(), {.remember = true, .surface = painted});
    const auto here = QDir::currentPath();
    QDir::setCurrent(folder.path());
    const bool opened = other.open_path("./kept.interreflect/");
    QDir::setCurrent(here);
    ASSERT_TRUE(opened);
    EXPECT_TRUE(other.session().open_project().folder().is_absolute());
    const auto all = RecentProjects(true).all();
    const auto recent = std::find_if(all.begin(), all.end(), [&](const auto& project) {
        return project.path == folder.path() + "/kept.interreflect";
    });
    ASSERT_NE(recent, all.end());
    EXPECT_FALSE(recent->missing);
    // The start page says when it was saved, not when it was opened.
    const auto is_of_today = [&] {
        return std::ranges::any_of(other.findChildren<widgets::ProjectCard*>(), [&](const auto* card) {
            return card->toolTip() == recent->path && card->accessibleName() == "New" &&
                   card->accessibleDescription().startsWith("today");
        });
    };
    EXPECT_FALSE(is_of_today());
    other.session().edit(
        [](const projects::Project& project) { return projects::edits::set_project_name(project, "New"); });
    other.action("save")->trigger();
    EXPECT_TRUE(is_of_today());
    other.session().files().close();
    QSettings().remove("recent");
}

void write_bytes(const QString& name, const QByteArray& bytes) {
    QFile file(name);
    ASSERT_TRUE(file.open(QIODevice::WriteOnly));
    file.write(bytes);
}

TEST_F(WindowTest, SavingFollowsNoLinksOfAProject) {
    const QTemporaryDir folder;
    const auto project = folder.path() + "/p.interreflect", precious = folder.path() + "/precious";
    const auto view = thumbnail_file(project);
    open_scene();
    window.session().files().save_as(project.toStdString());
    type_level("0.75");
    trigger("save");
    ASSERT_TRUE(QFile::remove(view));
    write_bytes(precious, "precious");
    ASSERT_TRUE(QFile::link(precious, view));
    type_level("0.6");
    trigger("save");
    EXPECT_FALSE(QFileInfo(view).isSymLink());
    EXPECT_FALSE(thumbnail_of(project).isNull());
    QFile kept(precious);
    ASSERT_TRUE(kept.open(QIODevice::ReadOnly));
    EXPECT_EQ(kept.readAll(), "precious");

    ASSERT_TRUE(QDir(project + "/thumbnails").removeRecursively());
    QDir(folder.path()).mkdir("elsewhere");
    ASSERT_TRUE(QFile::link(folder.path() + "/elsewhere", project + "/thumbnails"));
    type_level("0.5");
    trigger("save");
    EXPECT_FALSE(window.isWindowModified());
    EXPECT_TRUE(QDir(folder.path() + "/elsewhere").isEmpty());
}

TEST(Thumbnails, AreSmallPicturesInTheirProject) {
    const QTemporaryDir folder;
    const auto project = folder.path() + "/p.interreflect", view = thumbnail_file(project);
    const auto card = project + "/thumbnails/card.jpg", elsewhere = folder.path() + "/elsewhere.png";
    QDir(project).mkpath("thumbnails");
    QImage picture(40, 30, QImage::Format_RGB32);
    picture.fill(Qt::red);
    const auto is_there = [&] { return !thumbnail_of(project).isNull(); };
    ASSERT_TRUE(picture.save(view));
    EXPECT_TRUE(is_there());
    ASSERT_TRUE(QFile::rename(view, elsewhere));
    EXPECT_FALSE(is_there());
    for (const auto& target : {elsewhere, QStringLiteral("/dev/zero"), QStringLiteral("/dev/tty")}) {
        ASSERT_TRUE(QFile::link(target, view));
        EXPECT_FALSE(is_there()) << target.toStdString();
        QFile::remove(view);
    }
    ASSERT_EQ(::mkfifo(view.toLocal8Bit().constData(), 0600), 0);
    EXPECT_FALSE(is_there());
    ASSERT_TRUE(picture.save(card));
    EXPECT_TRUE(is_there()) << "the one that a sample came with";
    QFile::remove(card);
    ASSERT_EQ(::mkfifo(card.toLocal8Bit().constData(), 0600), 0);
    EXPECT_FALSE(is_there());
    QFile::remove(view);
    ASSERT_TRUE(picture.scaled(2000, 1).save(view));
    EXPECT_FALSE(is_there()) << "larger than such pictures are";
}

TEST(RecentProjects, ArePeekedAtWithoutWaiting) {
    const QTemporaryDir folder;
    ASSERT_EQ(::mkfifo((folder.path() + "/project.json").toLocal8Bit().constData(), 0600), 0);
    QSettings().setValue("recent", QStringList{folder.path()});
    const auto all = RecentProjects(true).all();
    QSettings().remove("recent");
    EXPECT_TRUE(std::ranges::any_of(all, [&](const auto& each) { return each.path == folder.path(); }));
}

TEST(DialogFolder, NamesOfExportsAreClean) {
    EXPECT_EQ(clean_file_name("(a) LDMs: ldm.accessibility").toStdString(), "a-LDMs-ldm-accessibility");
    EXPECT_EQ(clean_file_name("Höhle 2 / nah").toStdString(), "Höhle-2-nah");
    EXPECT_EQ(clean_file_name(" ../.. ").toStdString(), "untitled");
    EXPECT_EQ(clean_file_name(QString(300, 'x')).size(), 100);
}

TEST(DialogFolder, ExportsGoWhereTheLastOneWent) {
    const QTemporaryDir last;
    QSettings().remove("export/folder");
    EXPECT_FALSE(export_proposal("a", ".png").startsWith(QDir::currentPath() + "/a"));
    EXPECT_TRUE(export_proposal("a", ".png").endsWith("/a.png"));
    remember_export(last.path() + "/b.png");
    EXPECT_EQ(export_proposal("(a) LDMs", ".csv"), last.path() + "/a-LDMs.csv");
    QSettings().remove("export/folder");
}

TEST(CardPicture, IsTheWidePartWhereMostIsSeen) {
    QImage picture(40, 80, QImage::Format_RGB32);
    picture.fill(Qt::yellow);
    const auto row_of = [&](int y) {
        auto drawn = picture;
        for (int x = 0; x < 40; x += 2) drawn.setPixelColor(x, y, Qt::blue);
        const auto card = with_shape(drawn, {40, 20});
        EXPECT_EQ(card.size(), QSize(40, 20));
        for (int row = 0; row < 20; ++row)
            if (card.pixelColor(0, row) == Qt::blue) return row;
        return -1;
    };
    EXPECT_EQ(row_of(40), 10) << "the middle, where it will do";
    EXPECT_GE(row_of(75), 0);
    EXPECT_GE(row_of(3), 0);
    EXPECT_EQ(with_shape(picture, {40, 10}).size(), QSize(40, 10));
}

TEST_F(WindowTest, ACardHasThePictureAndNothingAroundIt) {
    open_scene();
    window.view().set_legend(true);
    const auto picture = picture_of(window.workspace().active_pane());
    EXPECT_EQ(picture.size(), QSize(window.view().image().width, window.view().image().height));
    EXPECT_FALSE(card_of(window.workspace()).isEmpty());
}

}  // namespace
}  // namespace ir::gui
