#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <sstream>
#include <stdexcept>

#include "renderers/core/resources_path.h"
#include "renderers/graph/graph.h"
#include "renderers/graph/pass_context.h"
#include "renderers/passes/gbuffer/gbuffer.h"
#include "renderers/passes/scene/scene_buffers.h"

namespace ir::test {

/// A scene at one time with the views of this frame and the last.
struct Shot {
    scene::Scene scene;
    scene::World world;
    scene::View view, previous_view;

    Shot(scene::Scene s, const scene::Camera& camera, int width, int height, double time = 0,
         double previous_time = 0)
        : scene(std::move(s)), world(scene::flatten(scene, time, previous_time)) {
        view = previous_view = scene::make_view(camera, width, height, world.bounds);
    }
    Shot(const std::string& name, const std::string& camera, int width, int height)
        : scene(scene::load_scene(name)), world(scene::flatten(scene, 0, 0)) {
        const auto& cameras = world.cameras;
        const auto found =
            std::find_if(cameras.begin(), cameras.end(), [&](const auto& c) { return c.name == camera; });
        const auto& chosen = found == cameras.end() ? cameras.at(0) : *found;
        view = previous_view = scene::make_view(chosen, width, height, world.bounds);
    }

    graph::FrameInputs inputs() const {
        graph::FrameInputs inputs;
        inputs.scene = &scene;
        inputs.world = &world;
        inputs.view = view;
        inputs.previous_view = previous_view;
        return inputs;
    }
};

inline scene::Camera looking(glm::vec3 eye, glm::vec3 target, glm::vec3 up = {0, 1, 0}) {
    scene::Camera camera;
    camera.eye = eye;
    camera.target = target;
    camera.up = up;
    return camera;
}

/// Constants of set_count.comp.
struct SetCount {
    unsigned amount;
    IR_FIELDS(amount)
};

/// For a pass that `.counts("Counter", …)`.
inline void add_to_counter(const graph::PassContext& context, std::uint32_t amount) {
    const auto& program = context.use({{SOURCE_ROOT "/tests/data/shaders/set_count.comp"}});
    program.set(SetCount{amount});
    program.dispatch(1);
}

/// Runs passes on the best device; any error that OpenGL reports fails the test.
class PassTest : public testing::Test {
  protected:
    using Setup = std::function<void(graph::GraphBuilder&)>;

    /// Those of the method that run() runs.
    virtual std::vector<OutputDescription> outputs() const { return {}; }
    static std::vector<OutputDescription> joined(
        std::initializer_list<std::vector<OutputDescription>> parts) {
        std::vector<OutputDescription> all;
        for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
        return all;
    }

    void SetUp() override {
        gl::ContextOptions options;
        options.debug = true;
        context_ = gl::Context::create_best(options);
        device_ = gl::make_gl_device(*context_);
        use_shaders(shader_directory());
    }
    /// From here on `right` reads `wrong` in a shader: what a test asserts must fail then.
    void break_shader(const std::string& file, const std::string& right, const std::string& wrong) {
        const auto copy = broken_shaders();
        std::filesystem::remove_all(copy);
        std::filesystem::copy(shader_directory(), copy, std::filesystem::copy_options::recursive);
        std::stringstream text;
        text << std::ifstream(copy / file).rdbuf();
        auto source = text.str();
        const auto place = source.find(right);
        ASSERT_NE(place, std::string::npos) << file << " has no " << right;
        std::ofstream(copy / file) << source.replace(place, right.size(), wrong);
        use_shaders(copy);
    }
    void mend_shaders() { use_shaders(shader_directory()); }
    void TearDown() override {
        if (!context_) return;
        std::filesystem::remove_all(broken_shaders());
        for (const auto& message : context_->take_messages())
            EXPECT_NE(message.severity, Severity::error) << message.text;
        graph_.reset();
        programs_.reset();
        device_.reset();
        context_->release();
    }

    /// On which the passes of a shot run that have two bodies.
    virtual Processor processor() const { return Processor::gl; }

    FrameReport run(const Shot& shot, const Setup& setup) {
        auto inputs = shot.inputs();
        inputs.processor = processor();
        return run(inputs, setup);
    }
    FrameReport run(const graph::FrameInputs& inputs, const Setup& setup) {
        graph::Method method;
        method.description.id = "test";
        method.description.outputs = outputs();
        method.setup = [&](graph::GraphBuilder& builder, const Settings&) { setup(builder); };
        graph::FrameOptions options;
        options.wanted = {"*"};
        const auto report = graph_->run(method, {}, inputs, options);
        for (const auto& message : report.messages)
            EXPECT_NE(message.severity, Severity::error) << message.text;
        return report;
    }
    void run_gbuffer(const Shot& shot, const passes::GBufferOptions& options = {}) {
        run(shot, [&](graph::GraphBuilder& builder) {
            passes::gbuffer(builder, passes::upload_scene(builder), options);
        });
    }

    /// Throws where the image does not exist.
    Image read(const std::string& key, int layer = 0) const {
        auto image = graph_->read_image(key, 0, layer);
        if (!image) throw std::runtime_error("no image " + key);
        return std::move(*image);
    }
    static glm::vec3 rgb(const Image& image, int x, int y) {
        return {image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)};
    }

    graph::Graph& graph() { return *graph_; }
    const gl::Api& api() const { return context_->api(); }
    gl::ProgramLibrary& programs() { return *programs_; }

  private:
    static std::filesystem::path broken_shaders() {
        return std::filesystem::path(testing::TempDir()) / ("shaders" + std::to_string(getpid()));
    }
    void use_shaders(const std::filesystem::path& folder) {
        graph_.reset();
        programs_ = std::make_unique<gl::ProgramLibrary>(*context_, folder);
        graph_ = std::make_unique<graph::Graph>(*device_, context_.get(), programs_.get());
    }

    std::unique_ptr<gl::Context> context_;
    std::unique_ptr<gl::Device> device_;
    std::unique_ptr<gl::ProgramLibrary> programs_;
    std::unique_ptr<graph::Graph> graph_;
};

/// The file of a scene that the project does not ship, or empty.
inline std::string scene_file(const std::string& path) {
    const char* folder = std::getenv("INTERREFLECT_SCENES");
    if (!folder) return {};
    const auto file = std::filesystem::path(folder) / path;
    return std::filesystem::exists(file) ? file.string() : std::string();
}

}  // namespace ir::test
