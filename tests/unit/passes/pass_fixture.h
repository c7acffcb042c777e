#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <sstream>

#include "renderers/core/record.h"
#include "renderers/graph/pass_context.h"
#include "renderers/passes/gbuffer/gbuffer.h"
#include "renderers/passes/scene/scene_buffers.h"
#include "tests/device_fixture.h"

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

/// The same, orthographic where it has a height, m.
inline scene::Camera looking(glm::vec3 eye, glm::vec3 target, glm::vec3 up, float height) {
    auto camera = looking(eye, target, up);
    camera.orthographic = height > 0;
    camera.height = height;
    return camera;
}

/// As `looking`; from above or below, up is `vertical_up`. `height` of an orthographic one, m.
inline scene::Camera looking_at(glm::vec3 eye, glm::vec3 target, bool orthographic, float height,
                                glm::vec3 vertical_up) {
    const bool is_vertical = std::abs(glm::normalize(target - eye).y) > 0.9f;
    auto camera = looking(eye, target, is_vertical ? vertical_up : glm::vec3(0, 1, 0));
    camera.orthographic = orthographic;
    camera.height = height;
    return camera;
}

/// 2 x 16 bits SNORM. [Cigolle14 "oct"]
inline std::uint32_t octahedral(glm::vec3 n) {
    const auto sign = [](float v) { return v >= 0 ? 1.0f : -1.0f; };
    n /= std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    glm::vec2 p(n.x, n.y);
    if (n.z < 0) p = {(1 - std::abs(n.y)) * sign(n.x), (1 - std::abs(n.x)) * sign(n.y)};
    const auto bits = [](float v) { return static_cast<std::uint32_t>(std::lround(v * 32767)) & 0xffffu; };
    return bits(p.x) | bits(p.y) << 16;
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

/// Declares a buffer with these records, and their counter. `capacity` 0: as many as there are; `uncounted`
/// is added to the counter: records that found no place.
template <class Record>
graph::CountedBuffer upload_records(graph::GraphBuilder& builder, graph::BufferDesc desc,
                                    const std::string& counter, const std::vector<Record>& records,
                                    std::uint64_t capacity = 0, std::uint32_t uncounted = 0) {
    desc.fields = record_fields<Record>();
    desc.elements = capacity ? capacity : std::max<std::size_t>(1, records.size());
    const graph::CountedBuffer result{builder.buffer(std::move(desc)),
                                      builder.counter({.key = counter, .label = "Records"})};
    builder.pass("upload records")
        .writes(result.elements)
        .counts("Counter", result.count)
        .execute([=](graph::PassContext& p) {
            const auto there = std::min<std::size_t>(records.size(), p.capacity(result.elements));
            p.upload(result.elements, std::as_bytes(std::span(records).first(there)));
            add_to_counter(p, static_cast<std::uint32_t>(records.size()) + uncounted);
        });
    return result;
}

/// Runs passes on the best device.
class PassTest : public DeviceTest {
  protected:
    using Setup = std::function<void(graph::GraphBuilder&)>;

    /// Those of the method that run() runs.
    virtual std::vector<OutputDescription> outputs() const { return {}; }

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
    void mend_shaders() { use_product_shaders(); }
    void TearDown() override {
        std::filesystem::remove_all(broken_shaders());
        DeviceTest::TearDown();
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
        return run_method(method, {}, inputs, options);
    }
    /// `run`: what tests differ in, with wanted, initial_capacity and inspection.
    template <class Run>
    FrameReport run_shot(const Shot& shot, const graph::Method& method, const Run& run,
                         std::uint64_t seed = 0, Processor on = Processor::gl, int threads = 0) {
        graph::FrameOptions options;
        options.wanted = run.wanted;
        options.initial_capacity = run.initial_capacity;
        auto inputs = shot.inputs();
        inputs.seed = seed;
        inputs.processor = on;
        inputs.threads = threads;
        inputs.inspection = run.inspection;
        return run_method(method, {}, inputs, options);
    }
    void run_gbuffer(const Shot& shot, const passes::GBufferOptions& options = {}) {
        run(shot, [&](graph::GraphBuilder& builder) {
            passes::gbuffer(builder, passes::upload_scene(builder), options);
        });
    }

  private:
    static std::filesystem::path broken_shaders() {
        return std::filesystem::path(testing::TempDir()) / ("shaders" + std::to_string(getpid()));
    }
};

/// The file of a scene that the project does not ship, or empty.
inline std::string scene_file(const std::string& path) {
    const char* folder = std::getenv("INTERREFLECT_SCENES");
    if (!folder) return {};
    const auto file = std::filesystem::path(folder) / path;
    return std::filesystem::exists(file) ? file.string() : std::string();
}

}  // namespace ir::test
