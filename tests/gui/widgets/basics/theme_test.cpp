#include <gtest/gtest.h>

#include <QApplication>
#include <QLabel>
#include <QListWidget>
#include <QPainter>
#include <QPalette>
#include <QStyleOption>
#include <algorithm>

#include "renderers/image/colour_map.h"
#include "tests/gui/events.h"
#include "widgets/document/ordered_list.h"
#include "widgets/panels/banner.h"
#include "widgets/plot/plot_view.h"
#include "widgets/style/icons.h"
#include "widgets/style/theme.h"

namespace ir::widgets {
namespace {

/// Relative luminance and contrast [WCAG 2.1].
double luminance_of(const QColor& colour) {
    const auto linear = [](double encoded) { return double(linear_from_srgb(float(encoded))); };
    return 0.2126 * linear(colour.redF()) + 0.7152 * linear(colour.greenF()) +
           0.0722 * linear(colour.blueF());
}

double contrast(const QColor& a, const QColor& b) {
    const double la = luminance_of(a), lb = luminance_of(b);
    return (std::max(la, lb) + 0.05) / (std::min(la, lb) + 0.05);
}

class ThemeTest : public testing::TestWithParam<Theme> {
  protected:
    void SetUp() override { apply_theme(*qApp, GetParam()); }
    void TearDown() override { apply_theme(*qApp, Theme::dark); }
};

TEST_P(ThemeTest, TextCanBeReadOnItsGround) {
    const auto palette = QApplication::palette();
    const auto colour = [&](QPalette::ColorRole role) { return palette.color(role); };
    for (const auto ground :
         {QPalette::Window, QPalette::Base, QPalette::AlternateBase, QPalette::Button, QPalette::ToolTipBase})
        EXPECT_GT(contrast(colour(QPalette::Text), colour(ground)), 7) << int(ground);
    const auto& themed = theme_colours();
    for (const auto ground : {QPalette::Window, QPalette::Base}) {
        EXPECT_GT(contrast(themed.dim, colour(ground)), 4) << int(ground);
        EXPECT_GT(contrast(colour(QPalette::PlaceholderText), colour(ground)), 3) << int(ground);
        for (const auto& each : {themed.warning, themed.error, themed.note, colour(QPalette::Link)})
            EXPECT_GT(contrast(each, colour(ground)), 3.5) << each.name().toStdString() << " " << int(ground);
    }
    for (const auto& number : {themed.nan, themed.infinite})
        EXPECT_GT(contrast(number, colour(QPalette::Base)), 4) << number.name().toStdString();
    for (const auto& ground :
         {themed.title, themed.active_title, themed.warning_ground, themed.error_ground, themed.note_ground})
        EXPECT_GT(contrast(colour(QPalette::WindowText), ground), 5) << ground.name().toStdString();
    EXPECT_GT(contrast(colour(QPalette::HighlightedText), colour(QPalette::Highlight)), 4);
    EXPECT_GT(contrast(colour(QPalette::ButtonText), themed.pressed), 3.5);
}

TEST_P(ThemeTest, EmptyBoxesAreSeen) {
    for (const auto box : {QStyle::PE_IndicatorCheckBox, QStyle::PE_IndicatorItemViewItemCheck,
                           QStyle::PE_IndicatorRadioButton})
        for (const auto ground : {QPalette::Window, QPalette::Base}) {
            QStyleOptionButton option;
            option.rect = {2, 2, 14, 14};
            option.palette = QApplication::palette();
            for (const auto enabled : {QStyle::State_Enabled, QStyle::State_None}) {
                option.state = enabled | QStyle::State_Off;
                QImage drawn(18, 18, QImage::Format_RGB32);
                const auto behind = option.palette.color(ground);
                drawn.fill(behind);
                QPainter painter(&drawn);
                QApplication::style()->drawPrimitive(box, &option, &painter);
                EXPECT_GT(contrast(drawn.pixelColor(9, 2), behind), enabled ? 2.5 : 1.5)
                    << int(box) << " " << int(ground);
            }
        }
}

TEST_P(ThemeTest, GroupsOfAMenuAreSeen) {
    QStyleOptionMenuItem option;
    option.rect = {0, 0, 60, 9};
    option.menuItemType = QStyleOptionMenuItem::Separator;
    option.palette = QApplication::palette();
    const auto behind = option.palette.color(QPalette::Base);
    QImage drawn(60, 9, QImage::Format_RGB32);
    drawn.fill(behind);
    QPainter painter(&drawn);
    QApplication::style()->drawControl(QStyle::CE_MenuItem, &option, &painter);
    EXPECT_GT(contrast(drawn.pixelColor(30, option.rect.center().y()), behind), 1.5);
}

/// Of lists that were made under the other one and are shown later.
TEST_P(ThemeTest, ListsFollowIt) {
    apply_theme(*qApp, GetParam() == Theme::dark ? Theme::light : Theme::dark);
    OrderedList list("parts", QStringLiteral("part"), 0, nullptr);
    list.show_lines({{QStringLiteral("one"), {}}}, 0);
    apply_theme(*qApp, GetParam());
    test::handle_events();
    list.resize(200, 120);
    const auto picture = list.grab().toImage();
    const QColor ground = picture.pixelColor(100, list.list()->height() - 8);
    EXPECT_NEAR(ground.lightness(), QApplication::palette().color(QPalette::Base).lightness(), 12);
}

/// Titles were grey on grey.
TEST_P(ThemeTest, BoldLettersFollowIt) {
    apply_theme(*qApp, GetParam() == Theme::dark ? Theme::light : Theme::dark);
    QLabel title("M");
    make_bold(&title, 2);
    apply_theme(*qApp, GetParam());
    test::handle_events();
    EXPECT_EQ(title.palette().color(QPalette::WindowText),
              QApplication::palette().color(QPalette::WindowText));
    EXPECT_TRUE(title.font().bold());
    EXPECT_TRUE(title.styleSheet().isEmpty());
}

TEST_P(ThemeTest, IconsOfChosenRowsStandOut) {
    const auto picture = icon("experiment").pixmap(QSize(32, 32), QIcon::Selected).toImage();
    double brightest = 0;
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x)
            if (picture.pixelColor(x, y).alpha() > 250)
                brightest = std::max(brightest, contrast(picture.pixelColor(x, y),
                                                         QApplication::palette().color(QPalette::Highlight)));
    EXPECT_GT(brightest, 4);
}

TEST_P(ThemeTest, GreysTintNoPicture) {
    const auto palette = QApplication::palette();
    for (const auto role : {QPalette::Window, QPalette::Base, QPalette::AlternateBase, QPalette::Button})
        EXPECT_EQ(palette.color(role).hsvSaturation(), 0) << int(role);
}

INSTANTIATE_TEST_SUITE_P(Both, ThemeTest, testing::Values(Theme::dark, Theme::light),
                         [](const auto& each) { return each.param == Theme::dark ? "dark" : "light"; });

TEST(ThemeChange, ReachesWhatIsOpen) {
    BannerStack banners;
    banners.show_banner(QStringLiteral("a"), BannerStack::Kind::warning, QStringLiteral("Text"));
    PlotView plot;
    plot.resize(300, 200);
    plot.set_data({});
    const auto corner = [&] { return plot.grab().toImage().pixelColor(1, 1); };
    const auto ground = [&] { return banners.findChild<QWidget*>(QStringLiteral("banner:a"))->styleSheet(); };
    const auto dark_corner = corner();
    const auto dark_ground = ground();
    const auto dark_icon = icon("open").pixmap(16, 16).toImage();
    apply_theme(*qApp, Theme::light);
    EXPECT_EQ(theme(), Theme::light);
    EXPECT_GT(corner().lightness(), 200);
    EXPECT_LT(dark_corner.lightness(), 60);
    EXPECT_NE(ground(), dark_ground);
    EXPECT_NE(icon("open").pixmap(16, 16).toImage(), dark_icon) << "drawn in the text's colour";
    apply_theme(*qApp, Theme::dark);
    EXPECT_EQ(corner(), dark_corner);
    EXPECT_EQ(ground(), dark_ground);
}

}  // namespace
}  // namespace ir::widgets
