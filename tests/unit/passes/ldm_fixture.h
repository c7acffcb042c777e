#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>

#include "renderers/gl/program.h"
#include "renderers/passes/ldm/parameters.h"
#include "tests/device_fixture.h"

namespace ir::passes::ldm {

/// Sequences of depths, by map, row and column.
using Lists = std::vector<std::vector<std::uint16_t>>;

/// A scene without textures, and its flattened world.
struct TestWorld {
    scene::Scene scene;
    scene::World world;

    TestWorld() { scene.materials.emplace_back(); }

    void add(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
        for (const auto& p : {a, b, c}) {
            world.indices.push_back(static_cast<std::uint32_t>(world.positions.size()));
            world.positions.push_back(p);
        }
        world.triangle_materials.push_back(0);
    }
    void add_quad(glm::vec3 corner, glm::vec3 side, glm::vec3 other) {
        add(corner, corner + side, corner + side + other);
        add(corner, corner + side + other, corner + other);
    }
    /// Fills what the uploads need; call after the last triangle.
    void finish() {
        const auto n = world.positions.size();
        world.normals.assign(n, {0, 1, 0});
        world.tangents.assign(n, {1, 0, 0, 1});
        world.uv0.assign(n, {0, 0});
        world.uv1.assign(n, {0, 0});
        world.colours.assign(n, 0xffffffffu);
        world.ranges = {{0, 0, static_cast<std::uint32_t>(world.triangles())}};
        world.opaque_triangles = static_cast<std::uint32_t>(world.triangles());
        world.bounds = {glm::vec3(1e30f), glm::vec3(-1e30f)};
        for (const auto& p : world.positions) {
            world.bounds.min = glm::min(world.bounds.min, p);
            world.bounds.max = glm::max(world.bounds.max, p);
        }
    }
};

/// Triangles of all sizes from far below a texel to the whole scene, slivers among them.
inline TestWorld random_world(int triangles, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(-1, 1);
    const auto point = [&] { return glm::vec3(uniform(random), uniform(random), uniform(random)); };
    TestWorld result;
    for (int i = 0; i < triangles; ++i) {
        const float size = std::exp2(-10 * std::abs(uniform(random)));
        const auto centre = point();
        auto b = centre + size * point(), c = centre + size * point();
        if (i % 7 == 0) c = glm::mix(centre, b, 0.5f) + 1e-4f * point();
        const auto inside = [](glm::vec3 p) { return glm::clamp(p, glm::vec3(-1.5f), glm::vec3(1.5f)); };
        result.add(centre, inside(b), inside(c));
    }
    result.finish();
    return result;
}

/// Parallel rectangles in a shuffled order, in a scene that is one metre wide.
inline TestWorld stack_of_rectangles(int layers, float depth) {
    TestWorld world;
    for (int i = 0; i < layers; ++i)
        world.add_quad({0, 0.001f * float(i * 7919 % layers), 0}, {1, 0, 0}, {0, 0, depth});
    world.add({0, 0, 1}, {0, 0, 1}, {0, 0, 1});
    world.finish();
    return world;
}

inline constexpr BuilderKind builders[] = {BuilderKind::raster, BuilderKind::compute};

inline Options options(StorageKind storage, BuilderKind builder, int directions = 20, int resolution = 64) {
    Options result;
    result.storage = storage;
    result.builder = builder;
    result.directions = directions;
    result.resolution = resolution;
    return result;
}

/// All storages that are there.
inline constexpr StorageKind all_storages[] = {
    StorageKind::linked_lists,    StorageKind::arrays,
    StorageKind::sparse_arrays,   StorageKind::hash,
    StorageKind::fixed_arrays,    StorageKind::fixed_arrays_presorted,
    StorageKind::lists_then_sort, StorageKind::pages,
    StorageKind::packed_arrays,   StorageKind::depth_peeling,
    StorageKind::outermost};

/// As people choose it.
inline std::string key_of(StorageKind storage) {
    MapParameters parameters;
    parameters.storage = storage;
    return std::get<std::string>(
        map_parameters({.outermost = true, .sloped = true}).settings(parameters).at("storage"));
}

/// Constants of ldm_lists.comp.
struct LdmLists {
    unsigned first_map;
    int resolution;
    IR_FIELDS(first_map, resolution)
};

/// Builds maps on OpenGL and reads them back, querying them in GLSL as methods do.
class LdmBuild {
  public:
    LdmBuild() {
        device_.context->make_current();
        reset();
    }
    /// Forgets how large buffers have grown.
    void reset() {
        graph_ = std::make_unique<graph::Graph>(*device_.device, device_.context.get(), &device_.programs);
    }
    ~LdmBuild() {
        graph_.reset();
        for (const auto& message : device_.context->take_messages())
            EXPECT_NE(message.severity, Severity::error) << message.text;
        device_.context->release();
    }

    Lists run(const TestWorld& world, const Options& options, graph::FrameOptions frame = {}) {
        return run(world.scene, world.world, options, std::move(frame));
    }
    Lists run(const scene::Scene& scene, const scene::World& world, const Options& options,
              graph::FrameOptions frame = {}) {
        graph::Method method;
        method.description.id = "test";
        method.setup = [&](graph::GraphBuilder& builder, const Settings&) { declare(builder, options); };
        graph::FrameInputs inputs;
        inputs.scene = &scene;
        inputs.world = &world;
        inputs.view.width = inputs.view.height = 8;
        frame.wanted = {"ldm.*", "test.*"};
        report = graph_->run(method, {}, inputs, frame);
        if (report.complete) {
            EXPECT_EQ(report.counters["test.wrong_answers"], 0) << key_of(options.storage);
        }
        return read();
    }

    FrameReport report;
    std::uint64_t room = 1 << 20;  ///< depths that can be read back

  private:
    void declare(graph::GraphBuilder& builder, const Options& options) {
        const auto scene = upload_scene(builder);
        const auto maps = declare_maps(builder, options);
        const auto texels =
            builder.buffer({.text = {.key = "test.texels", .label = "Texels"},
                            .fields = {{"first", graph::FieldType::u32}, {"count", graph::FieldType::u32}},
                            .elements = maps->layout.maps * maps->layout.map_texels()});
        const auto depths = builder.buffer({.text = {.key = "test.depths", .label = "Depths"},
                                            .fields = {{"depth", graph::FieldType::u32}},
                                            .elements = room});
        const auto copied = builder.counter({.key = "test.copied", .label = "Copied"});
        const auto wrong = builder.counter({.key = "test.wrong_answers", .label = "Wrong answers"});
        for (int batch = 0; batch < maps->layout.batches(); ++batch) {
            build_maps(builder, scene, maps, batch);
            auto pass = builder.pass("read" + maps->batch_name(batch));
            for (const auto buffer : maps->storage->buffers()) pass.reads(buffer);
            pass.writes("Texels", texels).writes("Out", depths);
            pass.counts("Copied", copied).counts("Wrong", wrong);
            pass.execute([=](graph::PassContext& context) {
                gl::ProgramSource source{{SOURCE_ROOT "/tests/data/shaders/ldm_lists.comp"}};
                source.defines = defines_of(context, *maps);
                const auto& program = context.use(source);
                program.set(LdmLists{static_cast<unsigned>(maps->first_map(batch)), maps->layout.resolution});
                program.dispatch(static_cast<std::int64_t>(maps->layout.map_texels()),
                                 maps->batch_maps(batch));
            });
        }
    }
    std::vector<std::uint32_t> words(const char* key) {
        const auto bytes = graph_->read_buffer(key);
        std::vector<std::uint32_t> result(bytes ? bytes->size() / 4 : 0);
        if (bytes) std::memcpy(result.data(), bytes->data(), result.size() * 4);
        return result;
    }
    /// Throws where `room` was too small.
    Lists read() {
        const auto texels = words("test.texels"), depths = words("test.depths");
        Lists result(texels.size() / 2);
        for (std::size_t t = 0; t < result.size(); ++t)
            for (std::uint32_t i = 0; i < texels[2 * t + 1]; ++i)
                result[t].push_back(static_cast<std::uint16_t>(depths.at(texels[2 * t] + i)));
        return result;
    }

    test::TestDevice& device_ = test::TestDevice::shared();
    std::unique_ptr<graph::Graph> graph_;
};

inline std::size_t total(const Lists& lists) {
    std::size_t sum = 0;
    for (const auto& list : lists) sum += list.size();
    return sum;
}

inline void expect_sorted(const Lists& lists) {
    for (const auto& list : lists) ASSERT_TRUE(std::is_sorted(list.begin(), list.end()));
}

/// Sum over all texels of the difference in length.
inline std::size_t different_fragments(const Lists& a, const Lists& b) {
    std::size_t sum = 0;
    for (std::size_t t = 0; t < a.size(); ++t)
        sum += a[t].size() > b[t].size() ? a[t].size() - b[t].size() : b[t].size() - a[t].size();
    return sum;
}

/// At most `fraction` of the fragments may differ, and few depths by more than some quanta: by what a shift
/// of 1/256 texel makes of the slope: builders differ in whether the corners' depths move with them when they
/// are snapped.
inline void expect_similar(const Lists& found, const Lists& expected, double fraction, int quanta = 32,
                           double far_fraction = 0.01) {
    ASSERT_EQ(found.size(), expected.size());
    EXPECT_LE(different_fragments(found, expected), fraction * total(expected));
    std::size_t far = 0, compared = 0;
    for (std::size_t t = 0; t < found.size(); ++t) {
        if (found[t].size() != expected[t].size()) continue;
        for (std::size_t i = 0; i < found[t].size(); ++i) {
            ++compared;
            far += std::abs(int(found[t][i]) - int(expected[t][i])) > quanta;
        }
    }
    EXPECT_LE(far, far_fraction * compared);
}

}  // namespace ir::passes::ldm
