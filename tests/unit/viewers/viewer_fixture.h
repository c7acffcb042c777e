#pragma once

#include <bit>
#include <functional>
#include <glm/glm.hpp>
#include <span>

#include "renderers/graph/pass_context.h"
#include "renderers/passes/viewers/draw.h"
#include "renderers/scene/view.h"
#include "tests/device_fixture.h"

namespace ir::test {

using passes::viewers::Filter;
using passes::viewers::Layer;
using passes::viewers::Picture3D;
using passes::viewers::Scene3D;

/// A buffer as a test fills it.
struct TestBuffer {
    std::string key;
    OutputKind kind = OutputKind::point_set;
    std::vector<Field> fields;
    std::vector<std::uint32_t> words;
    std::uint64_t reserved = 0;  ///< more elements than are in use; a counter says how many are

    TestBuffer(std::string k, OutputKind o, std::vector<Field> f)
        : key(std::move(k)), kind(o), fields(std::move(f)) {}
    std::uint64_t elements() const {
        std::uint64_t stride = 0;
        for (const auto& field : fields) stride += static_cast<std::uint64_t>(field.count);
        return words.size() / stride;
    }
    template <class... Values>
    void add(Values... values) {
        (put(values), ...);
    }

  private:
    void put(float value) { words.push_back(std::bit_cast<std::uint32_t>(value)); }
    void put(double value) { put(static_cast<float>(value)); }
    void put(std::uint32_t value) { words.push_back(value); }
    void put(int value) { words.push_back(std::bit_cast<std::uint32_t>(value)); }
    void put(glm::vec3 v) {
        for (int c = 0; c < 3; ++c) put(v[c]);
    }
};

inline const Field position_field{"position", FieldType::f32, 3};

/// Draws buffers that a cpu pass wrote.
class ViewerTest : public DeviceTest {
  protected:
    void SetUp() override {
        DeviceTest::SetUp();
        viewer_ = std::make_unique<passes::viewers::Viewer>(context(), device(), programs());
        world_ = scene::flatten(scene_, 0, 0);
    }
    void TearDown() override {
        viewer_.reset();
        DeviceTest::TearDown();
    }

    /// Runs a frame whose cpu passes write these buffers; `more` may declare further passes.
    void run(const std::vector<TestBuffer>& buffers,
             const std::function<void(graph::GraphBuilder&)>& more = nullptr) {
        graph::Method method;
        method.description.id = "test";
        method.setup = [&](graph::GraphBuilder& builder, const Settings&) {
            for (const auto& buffer : buffers) declare(builder, buffer);
            if (more) more(builder);
        };
        graph::FrameOptions options;
        options.wanted = {"*"};
        graph().run(method, {}, inputs(), options);
    }

    graph::FrameInputs inputs() const {
        graph::FrameInputs inputs;
        inputs.scene = &scene_;
        inputs.world = &world_;
        inputs.view = inputs.previous_view = scene::make_view(camera_, 8, 8, world_.bounds);
        return inputs;
    }

    Picture3D draw(const Scene3D& view) { return viewer_->draw(graph(), inputs(), camera_, view); }
    Picture3D draw(std::vector<Layer> layers, int width = 160, int height = 120, bool show_scene = true) {
        Scene3D view;
        view.width = width;
        view.height = height;
        view.show_scene = show_scene;
        view.layers = std::move(layers);
        return draw(view);
    }

    /// A square of two triangles around `centre`, counter-clockwise about `normal`.
    void add_square(glm::vec3 centre, glm::vec3 normal, float half) {
        const auto other = std::abs(normal.x) < 0.5f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
        const auto u = half * glm::normalize(glm::cross(other, normal));
        const auto v = half * glm::normalize(glm::cross(normal, u));
        scene::Mesh mesh;
        mesh.positions = {centre - u - v, centre + u - v, centre + u + v, centre - u + v};
        mesh.normals.assign(4, normal);
        mesh.uv0.assign(4, {0, 0});
        mesh.indices = {0, 1, 2, 0, 2, 3};
        scene::Node node;
        node.meshes = {static_cast<int>(scene_.meshes.size())};
        scene_.meshes.push_back(std::move(mesh));
        scene_.nodes.push_back(node);
        if (scene_.materials.empty()) scene_.materials.resize(1);
        world_ = scene::flatten(scene_, 0, 0);
    }

    /// The place on the picture, from the upper left corner.
    static glm::vec2 place_px(const scene::Camera& camera, int width, int height, glm::vec3 position) {
        const auto view = scene::make_view(camera, width, height, {glm::vec3(-10), glm::vec3(10)});
        const auto clip = view.clip_from_world() * glm::vec4(position, 1);
        return {(clip.x / clip.w * 0.5f + 0.5f) * static_cast<float>(width),
                (0.5f - clip.y / clip.w * 0.5f) * static_cast<float>(height)};
    }
    static std::size_t pixel(const Picture3D& picture, glm::vec2 place) {
        return static_cast<std::size_t>(place.y) * static_cast<std::size_t>(picture.colour.width) +
               static_cast<std::size_t>(place.x);
    }
    static std::int64_t element_at(const Picture3D& picture, glm::vec2 place) {
        return picture.element.at(pixel(picture, place));
    }
    static glm::vec3 colour_at(const Picture3D& picture, glm::vec2 place) {
        const auto* p = &picture.colour.pixels.at(3 * pixel(picture, place));
        return {p[0], p[1], p[2]};
    }
    static std::int64_t pixels_of(const Picture3D& picture, std::int64_t element) {
        return std::count(picture.element.begin(), picture.element.end(), element);
    }

    scene::Scene scene_;
    scene::World world_;
    scene::Camera camera_;  ///< from (0, 0, 5) to the origin
    std::unique_ptr<passes::viewers::Viewer> viewer_;

  private:
    static void declare(graph::GraphBuilder& builder, const TestBuffer& buffer) {
        graph::BufferDesc desc;
        desc.text = {buffer.key, buffer.key};
        desc.kind = buffer.kind;
        desc.fields = buffer.fields;
        desc.elements = buffer.elements() + buffer.reserved;
        desc.growable = buffer.reserved > 0;
        const auto ref = builder.buffer(std::move(desc));
        auto pass = builder.pass("write " + buffer.key, graph::Queue::cpu);
        pass.writes(ref);
        graph::CounterRef counter;
        if (buffer.reserved > 0) {
            counter = builder.counter({.key = buffer.key + ".count", .label = "Count", .growth_of = ref});
            pass.counts(counter);
        }
        pass.execute([ref, counter, &buffer](graph::PassContext& context) {
            const auto to = context.elements<std::uint32_t>(ref);
            std::copy(buffer.words.begin(), buffer.words.end(), to.begin());
            if (counter.index >= 0) context.add(counter, static_cast<std::uint32_t>(buffer.elements()));
        });
    }
};

}  // namespace ir::test
