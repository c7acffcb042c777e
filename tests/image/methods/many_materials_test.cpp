// The G-buffer holds a material's index in a half float: what scenes with more than it can tell apart get.
#include <gtest/gtest.h>

#include <algorithm>

#include "renderers/core/error.h"
#include "renderers/core/resources_path.h"
#include "renderers/graph/graph.h"
#include "renderers/methods/all_methods.h"
#include "renderers/passes/gbuffer/gbuffer.h"

namespace ir {
namespace {

class ManyMaterials : public testing::Test {
  protected:
    void SetUp() override {
        context_ = gl::Context::create_best({});
        device_ = gl::make_gl_device(*context_);
        programs_ = std::make_unique<gl::ProgramLibrary>(*context_, shader_directory());
        scene_ = scene::load_scene("builtin:cornell");
    }
    /// The scene with so many materials, of which its triangles have the last ones.
    void use(std::size_t count) {
        const auto before = static_cast<int>(scene_.materials.size());
        const auto added = static_cast<int>(count) - before;
        scene_.materials.insert(scene_.materials.begin(), static_cast<std::size_t>(added),
                                scene_.materials.front());
        for (auto& mesh : scene_.meshes) mesh.material += added;
        world_ = scene::flatten(scene_, 0, 0);
    }
    FrameReport render(const std::string& id, Settings settings = {}) {
        graph::Graph graph(*device_, context_.get(), programs_.get());
        graph::FrameInputs inputs;
        inputs.scene = &scene_;
        inputs.world = &world_;
        inputs.view = inputs.previous_view = scene::make_view(world_.cameras.front(), 16, 16, world_.bounds);
        const auto& methods = methods::all_methods();
        const auto method = std::find_if(methods.begin(), methods.end(),
                                         [&](const auto* m) { return m->description.id == id; });
        graph::FrameOptions options;
        options.wanted = {"*"};
        const auto report = graph.run(**method, settings, inputs, options);
        picture_ = graph.read_image(main_output((*method)->description, settings)->key);
        return report;
    }
    static bool speaks_of_materials(const FrameReport& report) {
        return std::any_of(report.messages.begin(), report.messages.end(), [](const Message& message) {
            return message.text.find("materials, of which") != std::string::npos;
        });
    }

    std::optional<Image> picture_;

  private:
    std::unique_ptr<gl::Context> context_;
    std::unique_ptr<gl::Device> device_;
    std::unique_ptr<gl::ProgramLibrary> programs_;
    scene::Scene scene_;
    scene::World world_;
};

Settings light(const std::string& primary) {
    return {{"paths", std::string("full")}, {"samples", std::int64_t(4)}, {"primary", primary}};
}

TEST_F(ManyMaterials, ReferenceRefusesTheGBufferAndNamesTheMend) {
    use(10);
    render("reference", light("gbuffer"));
    const auto few = picture_.value();
    use(passes::gbuffer_materials);
    render("reference", light("gbuffer"));
    EXPECT_EQ(picture_.value().pixels, few.pixels);
    use(passes::gbuffer_materials + 1);
    try {
        render("reference", light("gbuffer"));
        ADD_FAILURE() << "not refused";
    } catch (const UsageError& error) {
        EXPECT_NE(std::string(error.what()).find("primary=rays"), std::string::npos) << error.what();
    }
    EXPECT_NO_THROW(render("reference", light("rays")));
    EXPECT_NO_THROW(render("reference", {{"paths", std::string("ao")}}))
        << "rays of ambient occlusion read no material";
}

TEST_F(ManyMaterials, RasterisedLightSaysSo) {
    use(passes::gbuffer_materials);
    EXPECT_FALSE(speaks_of_materials(render("ldm-ao")));
    use(2 * passes::gbuffer_materials + 3);
    EXPECT_TRUE(speaks_of_materials(render("ldm-ao")));
}

}  // namespace
}  // namespace ir
