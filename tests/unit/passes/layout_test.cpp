#include "renderers/core/record.h"
#include "renderers/passes/scene/light_data.h"
#include "renderers/passes/scene/material_data.h"
#include "renderers/passes/shadow/shadow_maps.h"
#include "tests/unit/passes/pass_fixture.h"

namespace ir::test {
namespace {

/// Structs of the host against the driver's offsets of their twins in GLSL.
class LayoutTest : public PassTest {
  protected:
    GLint property(const gl::Program& program, const std::string& variable, GLenum what) {
        const auto index =
            api().GetProgramResourceIndex(program.name(), GL_BUFFER_VARIABLE, variable.c_str());
        if (index == GL_INVALID_INDEX) return -1;
        GLint value = -1;
        api().GetProgramResourceiv(program.name(), GL_BUFFER_VARIABLE, index, 1, &what, 1, nullptr, &value);
        return value;
    }
    void expect_layout(const std::vector<std::string>& files, const std::string& array,
                       const std::vector<graph::Field>& fields, std::size_t bytes) {
        const auto& program = programs().get({files});
        int offset = 0;
        const auto of_field = [&](const graph::Field& field, GLenum what) {
            const auto value = property(program, array + "[0]." + field.name, what);
            return value >= 0 ? value : property(program, array + "[0]." + field.name + "_ws", what);
        };
        for (const auto& field : fields) {
            if (field.name != "unused") {
                EXPECT_EQ(of_field(field, GL_OFFSET), offset) << field.name;
            }
            offset += 4 * field.count;
        }
        EXPECT_EQ(offset, static_cast<int>(bytes));
        EXPECT_EQ(of_field(fields[0], GL_TOP_LEVEL_ARRAY_STRIDE), offset);
    }
};

const std::vector<std::string> lighting{"lib/full_screen.vert", "passes/direct/direct_light.frag"};

TEST_F(LayoutTest, Materials) {
    expect_layout(lighting, "materials", record_fields<passes::MaterialData>(), sizeof(passes::MaterialData));
}

TEST_F(LayoutTest, Lights) {
    expect_layout(lighting, "lights", record_fields<passes::LightData>(), sizeof(passes::LightData));
}

TEST_F(LayoutTest, ShadowViews) {
    expect_layout(lighting, "shadow_views", record_fields<passes::ShadowViewData>(),
                  sizeof(passes::ShadowViewData));
}

TEST_F(LayoutTest, OpacityBitmaps) {
    expect_layout({"passes/scene/triangles.vert", "passes/gbuffer/gbuffer.frag"}, "opacity",
                  record_fields<passes::OpacityData>(), sizeof(passes::OpacityData));
}

}  // namespace
}  // namespace ir::test
