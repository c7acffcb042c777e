#include "renderers/passes/scene/light_data.h"
#include "renderers/passes/scene/material_data.h"
#include "renderers/passes/shadow/shadow_views.h"
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
        for (const auto& field : fields) {
            const bool known = field.name != "unused";
            EXPECT_EQ(known ? property(program, array + "[0]." + field.name, GL_OFFSET) : offset, offset)
                << field.name;
            offset += 4 * field.count;
        }
        EXPECT_EQ(offset, static_cast<int>(bytes));
        EXPECT_EQ(property(program, array + "[0]." + fields[0].name, GL_TOP_LEVEL_ARRAY_STRIDE), offset);
    }
};

const std::vector<std::string> lighting{"lib/full_screen.vert", "passes/direct/direct_light.frag"};

TEST_F(LayoutTest, Materials) {
    expect_layout(lighting, "materials", passes::material_fields(), sizeof(passes::MaterialData));
}

TEST_F(LayoutTest, Lights) {
    expect_layout(lighting, "lights", passes::light_fields(), sizeof(passes::LightData));
}

TEST_F(LayoutTest, ShadowViews) {
    expect_layout(lighting, "shadow_views", passes::shadow_view_fields(), sizeof(passes::ShadowViewData));
}

TEST_F(LayoutTest, OpacityBitmaps) {
    expect_layout({"passes/gbuffer/gbuffer.vert", "passes/gbuffer/gbuffer.frag"}, "opacity",
                  passes::opacity_fields(), sizeof(passes::OpacityData));
}

}  // namespace
}  // namespace ir::test
