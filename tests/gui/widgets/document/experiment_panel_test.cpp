#include "widgets/document/experiment_panel.h"

#include <gtest/gtest.h>

#include <QSignalSpy>

#include "projects/document_fields.h"
#include "widgets/parameters/number_field.h"

namespace ir::widgets {
namespace {

using projects::experiment_fields, projects::field_of;

TEST(ExperimentPanelTest, HasTheLimitsOfTheDocument) {
    ExperimentPanel panel;
    const auto field = [&](const char* name) { return panel.findChild<NumberField*>(QLatin1String(name)); };
    const auto size = field_of(experiment_fields(), "size").text.range;
    const auto frames = field_of(experiment_fields(), "frames").text.range;
    const auto time = field_of(experiment_fields(), "time").text.range;
    for (const auto limit : {&projects::Range::min, &projects::Range::max}) {
        ExperimentFields fields;
        fields.size = {int(size.*limit), int(size.*limit)};
        fields.frames = int(frames.*limit);
        fields.time = time.*limit;
        panel.set_fields(fields);
        EXPECT_EQ(field("width")->value(), size.*limit);
        EXPECT_EQ(field("height")->value(), size.*limit);
        EXPECT_EQ(field("frames")->value(), frames.*limit);
        EXPECT_EQ(field("time")->value(), time.*limit);
    }
    EXPECT_EQ(field("frames")->minimum(), frames.min);
    EXPECT_EQ(field("frames")->maximum(), frames.max);
    QSignalSpy chosen(&panel, &ExperimentPanel::frames_chosen);
    emit field("frames")->chosen(frames.max);
    ASSERT_EQ(chosen.size(), 1);
    EXPECT_EQ(chosen[0][0].toInt(), frames.max);
}

}  // namespace
}  // namespace ir::widgets
