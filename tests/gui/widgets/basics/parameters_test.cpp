#include <gtest/gtest.h>

#include <QAction>
#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QContextMenuEvent>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QSignalSpy>
#include <QSlider>
#include <QTest>
#include <QToolButton>

#include "widgets/parameters/number_field.h"
#include "widgets/parameters/parameter_panel.h"
#include "widgets/parameters/row_state.h"

namespace ir::widgets {
namespace {

struct Sample {
    enum class Mode { plain, fancy };
    Mode mode = Mode::plain;
    int count = 4;
    float radius = 0.1f;
    bool jitter = true;
};

std::vector<ParameterDescription> sample_parameters() {
    ParameterTable<Sample> table;
    table
        .add(&Sample::mode, {.key = "mode",
                             .label = "Mode",
                             .doc = "Which one.",
                             .choices = {{"plain", "Plain", "Nothing more."}, {"fancy", "Fancy", "More."}}})
        .add(&Sample::count,
             {.key = "count", .label = "Count", .doc = "How many.", .hard = {1, 100}, .soft = {1, 16}})
        .add(&Sample::radius, {.key = "radius",
                               .label = "Radius",
                               .doc = "How far.",
                               .unit = "m",
                               .citation = "Someone20 eq. 3",
                               .hard = {0, 50},
                               .soft = {0, 2},
                               .active_when = {"mode", {std::string("fancy")}}})
        .add(&Sample::jitter, {.key = "jitter", .label = "Jitter", .doc = "Whether."});
    return table.descriptions();
}

/// A panel with a document behind it, as a window has.
class ParameterPanelTest : public testing::Test {
  protected:
    void SetUp() override {
        panel.set_parameters("sample", parameters);
        panel.set_values(values);
        QObject::connect(&panel, &ParameterPanel::value_chosen, &panel,
                         [this](const std::string& key, const Value& value) {
                             values[key] = value;
                             ++edits;
                             panel.set_values(values);
                         });
        QObject::connect(&panel, &ParameterPanel::reset_chosen, &panel, [this](const std::string& key) {
            values[key] = find(parameters, key)->default_value;
            panel.set_values(values);
        });
        panel.resize(340, 300);
        panel.show();
        ASSERT_TRUE(QTest::qWaitForWindowExposed(&panel));
    }
    template <class Widget>
    Widget* in(const char* key) {
        return panel.findChild<QWidget*>(QStringLiteral("editor:") + key)->findChild<Widget*>();
    }
    QToolButton* reset(const char* key) {
        return panel.findChild<QToolButton*>(QStringLiteral("reset:") + key);
    }

    std::vector<ParameterDescription> parameters = sample_parameters();
    Settings values = defaults(parameters);
    ParameterPanel panel{nullptr, Qt::SHIFT | Qt::Key_F1};
    int edits = 0;
};

void type(QAbstractSpinBox* field, const char* text) {
    field->setFocus();
    field->selectAll();
    QTest::keyClicks(field, text);
    QTest::keyClick(field, Qt::Key_Return);
}

TEST_F(ParameterPanelTest, TypedNumbersArriveOnEnter) {
    type(in<NumberField>("count"), "7");
    EXPECT_EQ(values["count"], Value(std::int64_t(7)));
    EXPECT_EQ(edits, 1);
}

TEST_F(ParameterPanelTest, HardLimitsAreKept) {
    type(in<NumberField>("count"), "9000");
    EXPECT_EQ(values["count"], Value(std::int64_t(100)));
    EXPECT_NO_THROW(find(parameters, "count")->checked(values["count"]));
}

TEST(NumberField, LeavesUndoToTheDocument) {
    QWidget window;
    auto* field = new NumberField(&window);
    QAction undo(&window);
    undo.setShortcut(QKeySequence::Undo);
    window.addAction(&undo);
    int undone = 0;
    QObject::connect(&undo, &QAction::triggered, &window, [&] { ++undone; });
    window.show();
    ASSERT_TRUE(QTest::qWaitForWindowExposed(&window));
    QApplication::setActiveWindow(&window);
    type(field, "7");
    QTest::keyClick(field, Qt::Key_Z, Qt::ControlModifier);
    EXPECT_EQ(undone, 1);
    EXPECT_EQ(field->value(), 7);
}

TEST_F(ParameterPanelTest, TypedValuesMayLeaveTheSoftRange) {
    type(in<NumberField>("count"), "60");
    EXPECT_EQ(values["count"], Value(std::int64_t(60)));
    EXPECT_EQ(in<QSlider>("count")->value(), in<QSlider>("count")->maximum());
    EXPECT_EQ(edits, 1);  // the slider's following is no edit
}

TEST_F(ParameterPanelTest, SliderKeysStepWithinTheSoftRange) {
    auto* slider = in<QSlider>("count");
    slider->setFocus();
    QTest::keyClick(slider, Qt::Key_End);
    EXPECT_EQ(values["count"], Value(std::int64_t(16)));
    QTest::keyClick(slider, Qt::Key_Left);
    EXPECT_EQ(values["count"], Value(std::int64_t(15)));
}

TEST_F(ParameterPanelTest, ClickTogglesAndResetGoesBack) {
    auto* box = in<QCheckBox>("jitter");
    EXPECT_FALSE(reset("jitter")->isVisible());
    QTest::mouseClick(box, Qt::LeftButton, {}, {8, box->height() / 2});
    EXPECT_EQ(values["jitter"], Value(false));
    ASSERT_TRUE(reset("jitter")->isVisible());
    QTest::mouseClick(reset("jitter"), Qt::LeftButton);
    EXPECT_EQ(values["jitter"], Value(true));
    EXPECT_FALSE(reset("jitter")->isVisible());
}

TEST_F(ParameterPanelTest, InactiveRowsSayWhyAndWakeUp) {
    auto* field = in<NumberField>("radius");
    EXPECT_FALSE(field->isEnabled());
    EXPECT_TRUE(panel.findChild<QWidget*>("editor:radius")->toolTip().contains("Fancy"));
    auto* mode = in<QComboBox>("mode");
    mode->setFocus();
    QTest::keyClick(mode, Qt::Key_Down);
    EXPECT_EQ(values["mode"], Value(std::string("fancy")));
    EXPECT_TRUE(field->isEnabled());
    EXPECT_FALSE(panel.findChild<QWidget*>("editor:radius")->toolTip().contains("no effect"));
}

TEST_F(ParameterPanelTest, EnterWithoutTypingKeepsHiddenDigits) {
    values["mode"] = std::string("fancy");
    values["radius"] = 0.123456789;
    panel.set_values(values);
    auto* field = in<NumberField>("radius");
    EXPECT_EQ(field->text(), "0.123457 m");
    field->setFocus();
    QTest::keyClick(field, Qt::Key_Return);
    EXPECT_EQ(edits, 0);
    EXPECT_EQ(values["radius"], Value(0.123456789));
}

TEST_F(ParameterPanelTest, ReadOnlyDisablesEverything) {
    panel.set_read_only(true, "because");
    for (const char* key : {"mode", "count", "jitter"})
        EXPECT_FALSE(panel.findChild<QWidget*>(QStringLiteral("editor:") + key)->isEnabled()) << key;
}

TEST_F(ParameterPanelTest, FilterHidesOtherRows) {
    panel.set_filter("how many");
    EXPECT_TRUE(panel.findChild<QWidget*>("editor:count")->isVisible());
    EXPECT_FALSE(panel.findChild<QWidget*>("editor:jitter")->isVisible());
}

TEST_F(ParameterPanelTest, TheMenuOfARowAsksWhatItIsAlsoOfAnIdleOne) {
    std::vector<std::string> keys;
    QObject::connect(&panel, &ParameterPanel::explanation_wanted, &panel,
                     [&](const std::string& key) { keys.push_back(key); });
    const auto ask_at = [&](QWidget& part, QPoint place) {
        QContextMenuEvent event(QContextMenuEvent::Mouse, place, part.mapToGlobal(place));
        QApplication::sendEvent(&part, &event);
        auto* menu = panel.findChild<QMenu*>("parameter-menu");
        if (!menu) return 0;
        const int actions = int(menu->actions().size());
        menu->actions().front()->trigger();
        menu->close();
        delete menu;
        return actions;
    };
    const auto ask = [&](QWidget& part) { return ask_at(part, part.rect().center()); };
    EXPECT_EQ(ask(*in<QComboBox>("mode")), 2);
    EXPECT_GT(ask(*in<NumberField>("count")), 4) << "and what its text can do";
    EXPECT_EQ(ask(*in<QSlider>("count")), 2);
    EXPECT_EQ(ask(*in<QCheckBox>("jitter")), 2);
    EXPECT_FALSE(in<NumberField>("radius")->isEnabled());
    EXPECT_GT(ask(*in<NumberField>("radius")), 0);
    EXPECT_EQ(keys, (std::vector<std::string>{"mode", "count", "count", "jitter", "radius"}));
    EXPECT_EQ(ask_at(panel, {5, panel.height() + 50}), 0) << "below the rows";
    for (const char* key : {"mode", "count", "jitter"}) {
        panel.show_row(key);
        EXPECT_EQ(panel.focused_key(), key);
    }
    EXPECT_TRUE(panel.findChild<QWidget*>("editor:mode")->toolTip().contains("Shift+F1"));
}

TEST_F(ParameterPanelTest, OneIsSaidInTheSingular) {
    for (auto& each : parameters)
        if (each.key == "count") each.unit = "texels";
    panel.set_parameters("in texels", parameters);
    panel.set_values(values);
    auto* field = in<NumberField>("count");
    type(field, "1");
    EXPECT_EQ(field->text(), "1 texel");
    type(field, "3");
    EXPECT_EQ(field->text(), "3 texels");
    const auto& count = *find(parameters, "count");
    EXPECT_EQ(value_text(count, Value(std::int64_t(1))), "1 texel");
    EXPECT_EQ(value_text(count, Value(std::int64_t(0))), "0 texels");
}

TEST(RowState, TooltipNamesKeyRangeDefaultAndSource) {
    const auto parameters = sample_parameters();
    const auto state = row_state(*find(parameters, "radius"), parameters, defaults(parameters));
    for (const char* part : {"radius", "0 … 50", "0.1 m", "Someone20 eq. 3", "How far."})
        EXPECT_TRUE(state.tooltip.contains(QString::fromUtf8(part))) << part;
    EXPECT_FALSE(state.changed);
    EXPECT_FALSE(state.enabled);
    const auto changed = [&](double radius) {
        return row_state(*find(parameters, "radius"), parameters, {{"radius", radius}}).changed;
    };
    EXPECT_FALSE(changed(double(0.1f)));  // as older files hold it
    EXPECT_TRUE(changed(0.11));
}

TEST(SliderMapping, IsInverseForLinearAndLogarithmicRanges) {
    for (const Range range : {Range{0, 20}, Range{-1, 1}, Range{0.001, 1000}})
        for (double position : {0.0, 0.25, 0.5, 1.0})
            EXPECT_NEAR(slider_position(range, slider_value(range, position)), position, 1e-12);
    EXPECT_TRUE(is_logarithmic({0.001, 1000}));
    EXPECT_FALSE(is_logarithmic({0, 1000}));
}

}  // namespace
}  // namespace ir::widgets
