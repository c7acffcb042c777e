#include <cmath>

#include "tests/gui/widgets/compare/pictures.h"
#include "widgets/compare/difference_worker.h"
#include "widgets/compare/significance.h"

namespace ir::widgets {
namespace {

using Mode = CompareView::Mode;
using Kind = DifferenceKind;

PicturePtr noisy(float value, float variance, const QString& label = {}) {
    Picture picture = *flat(value, label);
    picture.variance = std::make_shared<const Image>(16, 12, 1, variance);
    return std::make_shared<const Picture>(std::move(picture));
}

TEST(DifferenceKinds, AutomaticDisplaysFitTheKind) {
    Image values(2, 1, 1);
    values.pixels = {-0.5f, 0.25f};
    const auto signed_ = display_for_difference(Kind::signed_, values);
    EXPECT_EQ(signed_.colour_map, "coolwarm");
    EXPECT_DOUBLE_EQ(signed_.low, -0.5);
    EXPECT_DOUBLE_EQ(signed_.high, 0.5);
    EXPECT_FALSE(signed_.grey_zero);
    const auto significant = display_for_difference(Kind::significant, values);
    EXPECT_DOUBLE_EQ(significant.low, -0.5);
    EXPECT_TRUE(significant.grey_zero);
    values.pixels = {0.0f, 0.25f};
    for (const Kind kind : {Kind::flip, Kind::hdr_flip}) {
        EXPECT_EQ(display_for_difference(kind, values).colour_map, "magma");
        EXPECT_DOUBLE_EQ(display_for_difference(kind, values).low, 0);
        EXPECT_DOUBLE_EQ(display_for_difference(kind, values).high, 1);  // whatever the largest error is
    }
    EXPECT_DOUBLE_EQ(display_for_difference(Kind::squared, values).low, 0);
    EXPECT_DOUBLE_EQ(display_for_difference(Kind::squared, values).high, 0.25);
}

TEST(DifferenceKinds, OutliersDoNotMakeTheRestPale) {
    Image values(300, 1, 1);
    for (int i = 0; i < 300; ++i) values.pixels[std::size_t(i)] = i % 2 ? 0.01f : -0.01f;
    values.pixels[7] = 0.1f;
    const auto shown = display_for_difference(Kind::signed_, values);
    EXPECT_FLOAT_EQ(float(shown.high), 0.01f);
    EXPECT_FLOAT_EQ(float(shown.low), -0.01f);
    // But rounding beside an error does not look like one, and few errors among equal pixels are seen.
    values.pixels[7] = 10;
    EXPECT_FLOAT_EQ(float(display_for_difference(Kind::absolute, values).high), 0.5f);
    values.pixels.assign(300, 0);
    EXPECT_EQ(display_for_difference(Kind::absolute, values).high, 1);
    // A hundredth of the pixels, not of the values: an error in one channel of 2 % of them is seen.
    Image colours(100, 1, 3);
    colours.pixels[0] = colours.pixels[30] = 0.5f;
    EXPECT_FLOAT_EQ(float(display_for_difference(Kind::absolute, colours).high), 0.5f);
}

TEST(DifferenceKinds, SquaredAndPerceptualOnesAreComputed) {
    CompareView view;
    view.set_pictures({flat(1, "ours"), flat(3, "reference")});
    view.set_mode(Mode::difference);
    show(view);
    view.set_difference(Kind::squared);
    EXPECT_FLOAT_EQ(shown_difference(view).at(3, 3), 4);
    EXPECT_EQ(view.main_view().state().label, "(A − B)²");
    for (const Kind kind : {Kind::flip, Kind::hdr_flip}) {
        view.set_pictures({flat(0.1f), flat(0.9f)});
        view.set_difference(kind);
        const Image& error = shown_difference(view);
        ASSERT_EQ(error.channels, 1);
        EXPECT_GT(error.at(8, 6), 0.2f);
        EXPECT_LE(error.at(8, 6), 1);
        EXPECT_DOUBLE_EQ(view.difference_display().high, 1);
        EXPECT_TRUE(view.main_view().state().label.contains("ꟻLIP"));
        EXPECT_TRUE(view.main_view().state().legend);
    }
}

TEST(DifferenceKinds, SignificanceNeedsAVariance) {
    CompareView view;
    view.set_pictures({flat(1), flat(3)});
    view.set_difference(Kind::significant);
    view.set_mode(Mode::difference);
    view.set_noise_hint("These have one: truth.");
    show(view);
    EXPECT_TRUE(view.compared().refusal().contains("Neither A nor B"));
    EXPECT_TRUE(view.compared().refusal().contains("truth"));
    EXPECT_FALSE(view.compared().refusal().contains('\n'));
    EXPECT_EQ(view.main_view().state().note, view.compared().refusal());
    EXPECT_FALSE(view.is_computing());
    Picture coming = *flat(3);
    coming.awaits_variance = true;
    view.set_pictures({flat(1), std::make_shared<const Picture>(coming)});
    EXPECT_TRUE(view.compared().refusal().contains("Waiting"));
    view.set_pictures({flat(1), noisy(3, 0.01f)});
    EXPECT_TRUE(view.compared().refusal().isEmpty());
    EXPECT_FLOAT_EQ(shown_difference(view).at(8, 6), -2);
    view.set_difference(Kind::signed_);  // asks for none
    view.set_pictures({flat(1), flat(3)});
    EXPECT_TRUE(view.compared().refusal().isEmpty());
}

TEST(DifferenceKinds, NoiseExplainsWhatItExplains) {
    CompareView view;
    view.set_pictures({noisy(1, 0.04f), noisy(1.1f, 0.05f)});  // 0.1 at a standard error of 0.3
    view.set_difference(Kind::significant);
    view.set_mode(Mode::difference);
    show(view);
    EXPECT_EQ(shown_difference(view).at(8, 6), 0);
    const QString quiet = view.compared().difference_text(view.difference_picture().get(), {8, 6});
    EXPECT_TRUE(quiet.contains("A − B = -0.1")) << quiet.toStdString();  // and not the 0 that is drawn
    EXPECT_TRUE(quiet.contains("z = -0.3333")) << quiet.toStdString();
    EXPECT_TRUE(quiet.contains("within noise"));
    const QColor grey = view.main_view().grab().toImage().pixelColor(point(view.main_view(), 8.5, 6.5));
    EXPECT_EQ(grey.red(), grey.green());
    EXPECT_NEAR(grey.red(), zero_grey[0], 2);
    view.set_pictures({noisy(1, 1e-4f), noisy(1.1f, 1e-4f)});
    EXPECT_NEAR(shown_difference(view).at(8, 6), -0.1, 1e-6);
    EXPECT_TRUE(
        view.compared().difference_text(view.difference_picture().get(), {8, 6}).contains("significant"));
    EXPECT_TRUE(view.compared().difference_text(view.difference_picture().get(), {99, 6}).isEmpty());
    view.set_difference(Kind::signed_);
    shown_difference(view);
    EXPECT_TRUE(view.compared().difference_text(view.difference_picture().get(), {8, 6}).isEmpty());
}

TEST(DifferenceKinds, NewVariancesAreNewQuestions) {
    const auto image = flat(1), other = flat(1.1f);
    const auto with = [](const PicturePtr& picture, float variance) {
        Picture changed = *picture;
        changed.variance = std::make_shared<const Image>(16, 12, 1, variance);
        return std::make_shared<const Picture>(changed);
    };
    const DifferenceRequest loud{with(image, 1), other, Kind::significant},
        quiet{with(image, 0), other, Kind::significant};
    EXPECT_FALSE(loud.same_as(quiet));
    EXPECT_TRUE(loud.continues(quiet));
}

TEST(DifferenceKinds, ZValuesOfExactPictures) {
    const auto exact = flat(1), other = flat(2);
    EXPECT_EQ(z_value(*exact, *exact, {0, 0}, 0), 0);
    EXPECT_TRUE(std::isinf(z_value(*other, *exact, {0, 0}, 0)));
    EXPECT_DOUBLE_EQ(z_value(*other, *noisy(1, 0.25f), {0, 0}, 0), 2);
}

}  // namespace
}  // namespace ir::widgets
