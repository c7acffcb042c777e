#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <random>

#include "renderers/gl/context.h"
#include "renderers/gl/device.h"
#include "renderers/gl/program.h"
#include "renderers/graph/graph.h"
#include "renderers/passes/ldm/builder.h"

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
        world.instances.assign(n, 0);
        world.motion.assign(1, glm::mat4(1));
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

inline gl::ContextOptions debug_options() {
    gl::ContextOptions options;
    options.debug = true;
    return options;
}

/// Builds maps on OpenGL and reads them back.
class LdmBuild {
  public:
    LdmBuild()
        : context_(gl::Context::create_best(debug_options())),
          device_(gl::make_gl_device(*context_)),
          programs_(*context_, std::filesystem::path(SOURCE_ROOT) / "shaders"),
          graph_(std::make_unique<graph::Graph>(*device_, context_.get(), &programs_)) {}
    ~LdmBuild() {
        graph_.reset();
        for (const auto& message : context_->take_messages())
            EXPECT_NE(message.severity, Severity::error) << message.text;
    }

    Lists run(const TestWorld& world, const Options& options, graph::FrameOptions frame = {}) {
        graph::Method method;
        method.description.id = "test";
        std::shared_ptr<const Maps> maps;
        method.setup = [&](graph::GraphBuilder& builder, const Settings&) {
            const auto scene = upload_scene(builder);
            maps = declare_maps(builder, options);
            for (int batch = 0; batch < maps->layout.batches(); ++batch)
                build_maps(builder, scene, maps, batch);
        };
        graph::FrameInputs inputs;
        inputs.scene = &world.scene;
        inputs.world = &world.world;
        inputs.view.width = inputs.view.height = 8;
        frame.wanted = {"ldm.*"};
        report = graph_->run(method, {}, inputs, frame);
        return options.storage == StorageKind::arrays ? read_arrays(*maps) : read_lists(*maps);
    }

    FrameReport report;

  private:
    std::vector<std::uint32_t> words(const char* key) {
        const auto bytes = graph_->read_buffer(key);
        std::vector<std::uint32_t> result(bytes ? bytes->size() / 4 : 0);
        if (bytes) std::memcpy(result.data(), bytes->data(), result.size() * 4);
        return result;
    }
    Lists read_lists(const Maps& maps) {
        const auto heads = words("ldm.heads"), nodes = words("ldm.list_nodes");
        Lists result(maps.layout.maps * maps.layout.map_texels());
        for (std::size_t t = 0; t < result.size(); ++t)
            for (auto node = heads[t]; node != 0; node = nodes.at(2 * node - 2))
                result[t].push_back(static_cast<std::uint16_t>(nodes.at(2 * node - 1)));
        return result;
    }
    Lists read_arrays(const Maps& maps) {
        const auto rows = words("ldm.rows"), offsets = words("ldm.offsets"), depths = words("ldm.depths");
        const std::size_t resolution = maps.layout.resolution, stride = (resolution + 2) / 2 * 2;
        const bool wide = offsets.size() >= stride * rows.size();
        const auto half = [](const std::vector<std::uint32_t>& from, std::size_t i) {
            return from.at(i / 2) >> (i % 2 * 16) & 0xffffu;
        };
        const auto offset = [&](std::size_t i) { return wide ? offsets.at(i) : half(offsets, i); };
        Lists result(maps.layout.maps * maps.layout.map_texels());
        if (2 * offsets.size() < stride * rows.size()) return result;  // too small even for 16 bits
        for (std::size_t t = 0; t < result.size(); ++t) {
            const auto row = t / resolution, column = t % resolution;
            for (auto i = offset(row * stride + column); i < offset(row * stride + column + 1); ++i)
                result[t].push_back(static_cast<std::uint16_t>(half(depths, rows[row] + i)));
        }
        return result;
    }

    std::unique_ptr<gl::Context> context_;
    std::unique_ptr<gl::Device> device_;
    gl::ProgramLibrary programs_;
    std::unique_ptr<graph::Graph> graph_;
};

inline std::size_t total(const Lists& lists) {
    std::size_t sum = 0;
    for (const auto& list : lists) sum += list.size();
    return sum;
}

/// Sum over all texels of the difference in length.
inline std::size_t different_fragments(const Lists& a, const Lists& b) {
    std::size_t sum = 0;
    for (std::size_t t = 0; t < a.size(); ++t)
        sum += a[t].size() > b[t].size() ? a[t].size() - b[t].size() : b[t].size() - a[t].size();
    return sum;
}

}  // namespace ir::passes::ldm
