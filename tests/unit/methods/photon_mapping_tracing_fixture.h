#pragma once

#include <cstring>
#include <optional>
#include <random>

#include "renderers/core/record.h"
#include "renderers/graph/pass_context.h"
#include "renderers/methods/photon-mapping/stages.h"
#include "renderers/passes/surface/triangle_plane.h"
#include "shaders/methods/photon-mapping/records.glsl.h"
#include "tests/unit/methods/photon_mapping_packing.h"
#include "tests/unit/passes/pass_fixture.h"
#include "tests/unit/passes/small_world.h"

namespace ir::test {

using methods::photon_mapping::MicrofacetSampling;
using methods::photon_mapping::Parameters;
using methods::photon_mapping::Photon;
using methods::photon_mapping::Roulette;
using methods::photon_mapping::SamplePoint;

/// A row of "photons.tally".
struct TallyRow {
    std::uint32_t bounce, rays, missed, stored, culled, absorbed, cut;
    glm::vec3 power;
};
static_assert(sizeof(TallyRow) == 40);

/// What a sample point is made of.
struct FirstHit {
    glm::vec3 position_ws, normal_ws, base_colour{1};
    float roughness = 1, metallic = 0;
    glm::vec3 power{1};
    std::optional<glm::vec3> arrived_from = {};  ///< unit, towards the light; none: a lamp at the origin
};

inline SamplePoint sample_point(const FirstHit& hit, std::uint32_t seed) {
    SamplePoint point{};
    point.position_ws = hit.position_ws;
    point.power = methods::photon_mapping::packed_power(hit.power);
    point.normal = point.geometric_normal = octahedral(hit.normal_ws);
    point.arrived_from = octahedral(hit.arrived_from.value_or(glm::normalize(-hit.position_ws)));
    const auto byte = [](float x) { return static_cast<std::uint32_t>(std::lround(x * 255)); };
    point.surface = byte(hit.base_colour.r) | byte(hit.base_colour.g) << 8 | byte(hit.base_colour.b) << 16 |
                    byte(hit.roughness) << 24;
    point.light = static_cast<std::uint32_t>(std::lround(hit.metallic * 65535)) << 16;
    point.ior = 1.5f;
    point.seed = seed;
    return point;
}

/// With a normal for each triangle, so that shading normals are geometric ones.
inline scene::Scene flat_shaded(scene::Scene scene) {
    for (auto& mesh : scene.meshes) {
        auto flat = mesh;
        flat.positions.clear(), flat.normals.clear(), flat.uv0.clear(), flat.indices.clear();
        flat.tangents.clear(), flat.uv1.clear(), flat.colours.clear();
        for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
            const auto* corner = &mesh.indices[i - i % 3];
            flat.positions.push_back(mesh.positions[mesh.indices[i]]);
            flat.normals.push_back(passes::triangle_normal(
                mesh.positions[corner[0]], mesh.positions[corner[1]], mesh.positions[corner[2]]));
            flat.uv0.emplace_back(0, 0);
            flat.indices.push_back(static_cast<std::uint32_t>(i));
        }
        mesh = std::move(flat);
    }
    return scene;
}

/// Points on the triangles of a world, each with the power 1 and seeds from 0.
inline std::vector<SamplePoint> random_points(const scene::World& world, int count, const FirstHit& material,
                                              unsigned seed = 5) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<SamplePoint> points;
    for (int i = 0; i < count; ++i) {
        const auto triangle = random() % world.triangles();
        glm::vec3 corners[3];
        for (std::size_t j = 0; j < 3; ++j) corners[j] = world.positions[world.indices[3 * triangle + j]];
        float u = unit(random), v = unit(random);
        if (u + v > 1) u = 1 - u, v = 1 - v;
        auto hit = material;
        hit.position_ws = corners[0] + u * (corners[1] - corners[0]) + v * (corners[2] - corners[0]);
        hit.normal_ws = passes::triangle_normal(corners[0], corners[1], corners[2]);
        points.push_back(sample_point(hit, static_cast<std::uint32_t>(i)));
    }
    return points;
}

/// Traces photons from points that no emission has made.
class TracingTest : public PassTest {
  protected:
    std::vector<OutputDescription> outputs() const override {
        return methods::photon_mapping::tracing_outputs();
    }
    struct Outcome {
        std::vector<TallyRow> tally;
        std::vector<Photon> photons;
        FrameReport report;

        std::uint32_t stored() const {
            std::uint32_t sum = 0;
            for (const auto& row : tally) sum += row.stored;
            return sum;
        }
    };

    Outcome trace(const Shot& shot, const std::vector<SamplePoint>& points, const Parameters& parameters) {
        return trace(shot.inputs(), points, parameters);
    }
    Outcome trace(const graph::FrameInputs& inputs, const std::vector<SamplePoint>& points,
                  const Parameters& parameters) {
        Outcome outcome;
        outcome.report = run(inputs, [&](graph::GraphBuilder& builder) {
            const auto scene = passes::upload_scene(builder);
            const auto samples = upload(builder, points, parameters);
            methods::photon_mapping::trace_photons(builder, scene, samples, parameters);
        });
        outcome.tally = elements<TallyRow>("photons.tally");
        outcome.photons = elements<Photon>("photons.records");
        outcome.photons.resize(std::min<std::size_t>(outcome.photons.size(), outcome.stored()));
        return outcome;
    }
    template <class T>
    std::vector<T> elements(const std::string& key) {
        const auto bytes = graph().read_buffer(key).value();
        std::vector<T> result(bytes.size() / sizeof(T));
        std::memcpy(result.data(), bytes.data(), result.size() * sizeof(T));
        return result;
    }

    /// Closed, lambertian, all bounces stored.
    static Parameters plain(int max_bounces) {
        Parameters parameters;
        parameters.transport.materials = Transport::Materials::lambert;
        parameters.transport.max_bounces = max_bounces;
        parameters.culling = false;
        return parameters;
    }

  private:
    static methods::photon_mapping::SamplePoints upload(graph::GraphBuilder& builder,
                                                        const std::vector<SamplePoint>& points,
                                                        const Parameters& parameters) {
        methods::photon_mapping::SamplePoints samples;
        samples.points = builder.buffer({.text = {.key = "photons.samples", .label = "Sample points"},
                                         .fields = record_fields<SamplePoint>(),
                                         .elements = points.size()});
        samples.count = builder.counter({.key = "photons.sample_count", .label = "Sample points"});
        samples.photons_per_point = parameters.photons_per_point;
        samples.power_unit = 2;
        samples.paths = points.size() * static_cast<std::uint64_t>(parameters.photons_per_point);
        builder.pass("upload samples")
            .writes(samples.points)
            .counts("Counter", samples.count)
            .execute([=](graph::PassContext& context) {
                context.upload(samples.points, std::as_bytes(std::span(points)));
                add_to_counter(context, static_cast<std::uint32_t>(points.size()));
            });
        return samples;
    }
};

}  // namespace ir::test
