#include <QSignalSpy>
#include <set>

#include "tests/gui/widgets/compare/pictures.h"
#include "tests/processor_time.h"

namespace ir::widgets {
namespace {

using Mode = CompareView::Mode;

TEST(Differences, KindsAndSwapping) {
    CompareView view;
    view.set_pictures({flat(1, "ours"), flat(3, "reference")});
    view.set_mode(Mode::difference);
    show(view);
    EXPECT_FLOAT_EQ(shown_difference(view).at(3, 3), -2);
    EXPECT_DOUBLE_EQ(view.difference_display().low, -2);  // symmetric, so that 0 is in the middle
    EXPECT_DOUBLE_EQ(view.difference_display().high, 2);
    EXPECT_EQ(view.main_view().state().label, "A − B");
    EXPECT_TRUE(view.main_view().state().legend);
    QSignalSpy swapped(&view, &CompareView::swapped);
    QTest::keyClick(&view.main_view(), Qt::Key_X);
    EXPECT_EQ(swapped.count(), 1);
    EXPECT_EQ(view.compared().pictures[0]->label, "reference");
    EXPECT_FLOAT_EQ(shown_difference(view).at(3, 3), 2);
    view.set_difference(DifferenceKind::absolute);
    EXPECT_FLOAT_EQ(shown_difference(view).at(3, 3), 2);
    EXPECT_DOUBLE_EQ(view.difference_display().low, 0);
    view.set_difference(DifferenceKind::relative);
    EXPECT_NEAR(shown_difference(view).at(3, 3), 2 / 1.01, 1e-6);
    EXPECT_EQ(view.main_view().state().label, "|A − B| / (|B| + 0.01)");
}

TEST(Differences, ZoomAndOtherModesComputeNothing) {
    CompareView view;
    view.set_pictures({flat(1), flat(3)});
    view.set_mode(Mode::difference);
    show(view);
    const Image* before = &shown_difference(view);
    view.main_view().grab();
    QSignalSpy shown(&view, &CompareView::difference_shown);
    const int uploads = view.main_view().canvas().upload_count();
    turn_wheel(&view.main_view(), {100, 100}, 2);
    view.main_view().grab();
    EXPECT_FALSE(view.is_computing());
    EXPECT_EQ(view.main_view().canvas().upload_count(), uploads);
    view.set_mode(Mode::wipe);
    view.set_mode(Mode::difference);
    EXPECT_FALSE(view.is_computing());
    EXPECT_EQ(&shown_difference(view), before);
    EXPECT_EQ(shown.count(), 0);
}

TEST(Differences, OfLargePicturesDoNotHoldTheWindowUp) {
    const int width = 2048, height = 2048;
    CompareView view;
    const PicturePtr reference = make_picture(Image(width, height, 3, 1), Semantic::radiance, "reference");
    const auto ours = [&](float value) {
        return make_picture(Image(width, height, 3, value), Semantic::radiance, "ours");
    };
    const PicturePtr first = ours(2), second = ours(3), third = ours(4);
    view.set_pictures({first, reference});
    const double before = thread_seconds();
    difference(*first->image, *reference->image, DifferenceKind::signed_);
    const double begin = thread_seconds();
    view.set_mode(Mode::difference);
    view.set_pictures({second, reference});
    view.set_pictures({third, reference});
    const double end = thread_seconds();
    EXPECT_TRUE(view.is_computing());
    EXPECT_LT(end - begin, begin - before) << "three questions cost more than one answer";
    EXPECT_FLOAT_EQ(shown_difference(view).at(7, 7), 3);  // the newest wins
    view.set_pictures({first, reference});
    ASSERT_TRUE(view.difference_picture());  // the old one stays until the new one is there …
    EXPECT_FLOAT_EQ(view.difference_picture()->image->at(7, 7), 3);
    EXPECT_TRUE(view.main_view().picture()->stale);  // … and says so
    EXPECT_FLOAT_EQ(shown_difference(view).at(7, 7), 1);
    EXPECT_FALSE(view.main_view().picture()->stale);
}

TEST(Differences, ExcludedPixelsAreNoZeros) {
    Picture masked = *flat(1);
    auto valid = std::make_shared<Image>(16, 12, 1, 1.0f);
    for (int y = 0; y < 6; ++y)
        for (int x = 0; x < 16; ++x) valid->at(x, y) = 0;
    masked.valid = valid;
    CompareView view;
    view.set_pictures({std::make_shared<const Picture>(masked), flat(1)});
    view.panes().set_pixel_grid(false);
    view.set_mode(Mode::difference);
    show(view);
    shown_difference(view);
    const QImage shot = view.main_view().grab().toImage();
    const auto colours_in = [&](double y) {
        std::set<QRgb> colours;
        for (double x = 2; x < 4; x += 0.05)
            colours.insert(shot.pixel(view.main_view().transform().view_from_image({x, y}).toPoint()));
        return colours;
    };
    EXPECT_EQ(colours_in(3).size(), 2u);  // a chequer
    EXPECT_EQ(colours_in(9).size(), 1u);
    EXPECT_FALSE(colours_in(3).count(*colours_in(9).begin()));
    EXPECT_FALSE(colours_in(3).count(qRgb(255, 0, 255)));  // and no NaN either
}

TEST(Differences, PicturesOfOtherChannelsSayWhy) {
    CompareView view;
    view.set_pictures({flat(1), make_picture(Image(16, 12, 3), Semantic::radiance)});
    view.set_mode(Mode::difference);
    wait_for_differences(view);
    EXPECT_TRUE(view.main_view().state().note.startsWith("Channels differ: A has 1, B has 3."))
        << view.main_view().state().note.toStdString();
    EXPECT_FALSE(view.difference_picture());
}

TEST(Differences, ARowOfStagesSharesItsRange) {
    CompareView view;
    view.set_pictures({flat(0), flat(1), flat(5)});
    view.set_mode(Mode::stages);
    wait_for_differences(view);
    ASSERT_EQ(view.difference_views().size(), 2u);
    for (auto* each : view.difference_views()) EXPECT_DOUBLE_EQ(each->display().high, 4);
}

}  // namespace
}  // namespace ir::widgets
