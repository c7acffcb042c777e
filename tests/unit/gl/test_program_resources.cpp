#include <algorithm>

#include "context_fixture.h"
#include "renderers/gl/program.h"

namespace ir::gl {
namespace {

using Kind = ProgramResource::Kind;

constexpr const char* many_resources = R"(
#define NAMED(name) readonly buffer name
// layout(r8) uniform image2D commented;
layout(local_size_x = 1) in;
layout(std430) readonly buffer Given { uint given[]; };
layout(std430) coherent buffer Result { float result[]; };
layout(std430) buffer Removed { float removed[]; };
layout(r32f) uniform image2D both;
layout(rgba16f) writeonly uniform image2DArray stored;
layout(r32ui) readonly uniform uimage2D loaded;
uniform sampler2D levels[3];
uniform usampler2DArray ids;
uniform float factor;
/* uniform sampler2D also_commented; */
void main() {
    result[0] = factor * float(given[0]) + imageLoad(both, ivec2(0)).x + float(imageLoad(loaded, ivec2(0)).x) +
                texelFetch(levels[0], ivec2(0), 0).x + texelFetch(levels[2], ivec2(0), 0).x +
                float(texelFetch(ids, ivec3(0), 0).x);
    imageStore(both, ivec2(0), vec4(1));
    imageStore(stored, ivec3(0), vec4(1));
}
)";

class ProgramResourcesTest : public ContextTest {
  protected:
    const ProgramResource* find(const Program& program, const std::string& name) {
        for (const auto& resource : program.resources())
            if (resource.name == name) return &resource;
        return nullptr;
    }
    ShaderFolder folder;
};
INSTANTIATE_ON_BOTH_BACKENDS(ProgramResourcesTest);

TEST_P(ProgramResourcesTest, KnowsKindsFormatsAndAccess) {
    folder.write("main.comp", many_resources);
    ProgramLibrary library(*context, folder.path());
    const auto& program = library.get({{"main.comp"}});
    const auto expect = [&](const char* name, Kind kind, bool written, const char* format, int count = 1) {
        const auto* resource = find(program, name);
        ASSERT_TRUE(resource) << name;
        EXPECT_EQ(resource->kind, kind) << name;
        EXPECT_EQ(resource->written, written) << name;
        EXPECT_EQ(resource->format, format) << name;
        EXPECT_EQ(resource->count, count) << name;
    };
    expect("Given", Kind::buffer, false, "");
    expect("Result", Kind::buffer, true, "");
    expect("both", Kind::image, true, "r32f");
    expect("stored", Kind::image, true, "rgba16f");
    expect("loaded", Kind::image, false, "r32ui");
    expect("levels", Kind::texture, false, "", 3);
    expect("ids", Kind::texture, false, "");
    EXPECT_TRUE(find(program, "stored")->is_array_texture());
    EXPECT_FALSE(find(program, "both")->is_array_texture());
    EXPECT_TRUE(find(program, "ids")->is_integer());
    EXPECT_FALSE(find(program, "levels")->is_integer());
    EXPECT_EQ(find(program, "levels")->element(2), "levels[2]");
    EXPECT_FALSE(find(program, "factor"));
    EXPECT_TRUE(program.declares("Removed"));
    EXPECT_FALSE(program.declares("commented"));
    EXPECT_FALSE(program.declares("also_commented"));
}

TEST_P(ProgramResourcesTest, GivesEachAUnitOfItsOwn) {
    folder.write("main.comp", many_resources);
    ProgramLibrary library(*context, folder.path());
    for (const auto kind : {Kind::buffer, Kind::texture, Kind::image}) {
        std::vector<GLuint> units;
        for (const auto& resource : library.get({{"main.comp"}}).resources())
            for (int i = 0; resource.kind == kind && i < resource.count; ++i)
                units.push_back(resource.unit + static_cast<GLuint>(i));
        std::sort(units.begin(), units.end());
        for (std::size_t i = 0; i < units.size(); ++i) EXPECT_EQ(units[i], i);
    }
}

TEST_P(ProgramResourcesTest, RefusesToBindWhatTheSourceNeverDeclares) {
    folder.write("main.comp", many_resources);
    ProgramLibrary library(*context, folder.path());
    const auto& program = library.get({{"main.comp"}});
    EXPECT_NO_THROW(program.bind_buffer("Removed", 0));
    try {
        program.bind_buffer("Gievn", 0);
        FAIL();
    } catch (const Error& error) {
        EXPECT_STREQ(error.what(),
                     "main.comp: the source has no block, sampler or image 'Gievn'; check its name");
    }
}

}  // namespace
}  // namespace ir::gl
