#include <QAction>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QProgressDialog>
#include <QPushButton>
#include <QRadioButton>
#include <atomic>
#include <chrono>
#include <thread>

#include "app/gui/film_dialog.h"
#include "tests/gui/window/window_fixture.h"

namespace ir::gui {
namespace {

class FilmTest : public WindowTest {
  protected:
    void SetUp() override {
        WindowTest::SetUp();
        open_scene();
    }
    FilmController& films() { return *window.findChild<FilmController*>(); }
    bool wait() {
        return QTest::qWaitFor([this] { return !films().is_making(); }, 60000);
    }
};

TEST_F(FilmTest, IsMadeOfTheDocumentAsItIs) {
    std::atomic<bool> is_let_go = false;
    std::vector<std::uint64_t> seeds;
    films().set_maker(
        [&](const FilmController::Request& request, const CancelToken&, const ProgressCallback& progress) {
            progress("picture 1 of 2", 0.5);
            while (!is_let_go) std::this_thread::yield();
            seeds.push_back(request.experiment.seed);
            EXPECT_EQ(request.film.out, "film.mp4");
            return std::vector<Message>{{Severity::warning, "scene", "a texture is missing"}};
        });
    const auto before = window.session().experiment()->seed;
    films().make({.out = "film.mp4", .turntable = 1});
    EXPECT_TRUE(window.findChild<QProgressDialog*>("film-progress"));
    EXPECT_FALSE(window.action("film")->isEnabled());
    is_let_go = true;
    ASSERT_TRUE(wait());
    EXPECT_EQ(seeds, std::vector{before});
    EXPECT_TRUE(window.action("film")->isEnabled());
    EXPECT_TRUE(QTest::qWaitFor([&] { return window.messages().model().rowCount() > 0; }));
}

TEST_F(FilmTest, IsCancelled) {
    std::atomic<bool> has_ended = false;
    films().set_maker([&](const FilmController::Request&, const CancelToken& cancel,
                          const ProgressCallback&) -> std::vector<Message> {
        while (!cancel.is_cancelled()) std::this_thread::yield();
        has_ended = true;
        throw Cancelled();
    });
    films().make({.out = "film.mp4", .turntable = 1});
    window.findChild<QProgressDialog*>("film-progress")->findChild<QPushButton*>()->click();
    ASSERT_TRUE(wait());
    EXPECT_TRUE(has_ended);
    EXPECT_TRUE(window.action("film")->isEnabled());
}

TEST_F(FilmTest, AsksWhatItShows) {
    trigger("film");
    auto* dialog = window.findChild<FilmDialog*>("film");
    ASSERT_TRUE(dialog);
    const auto what = dialog->findChild<QLabel*>("film-what")->text();
    EXPECT_TRUE(what.contains(" · Picture, ") && what.endsWith(" pixels")) << what.toStdString();
    EXPECT_GT(dialog->film().turntable, 0) << "nothing moves in the box, so the camera turns";
    EXPECT_EQ(dialog->findChild<QDoubleSpinBox*>("film-turn")->text(), "4 s");
    auto* count = dialog->findChild<QLabel*>("film-count");
    dialog->findChild<QDoubleSpinBox*>("film-turn")->setValue(2);
    EXPECT_TRUE(count->text().contains("60")) << count->text().toStdString();
    dialog->findChildren<QRadioButton*>().front()->click();
    dialog->findChild<QDoubleSpinBox*>("film-until")->setValue(1);
    EXPECT_TRUE(count->text().contains("31")) << count->text().toStdString();
    EXPECT_EQ(dialog->film().until, 1);
    EXPECT_EQ(dialog->film().turntable, 0);
    for (const double nothing_or_too_much : {0.0, 1e6}) {
        dialog->findChild<QDoubleSpinBox*>("film-until")->setValue(nothing_or_too_much);
        EXPECT_FALSE(dialog->findChild<QPushButton*>("film-video")->isEnabled()) << nothing_or_too_much;
    }
    QTest::keyClick(dialog, Qt::Key_Escape);
    EXPECT_TRUE(QTest::qWaitFor([&] { return !window.findChild<FilmDialog*>("film"); }));
}

}  // namespace
}  // namespace ir::gui
