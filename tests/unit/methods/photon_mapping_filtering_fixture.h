#pragma once

#include <random>
#include <span>

#include "renderers/graph/pass_context.h"
#include "renderers/methods/photon-mapping/stages.h"
#include "tests/unit/passes/pass_fixture.h"
#include "tests/unit/passes/small_world.h"

namespace ir::test {

namespace pm = methods::photon_mapping;

/// An estimate of irradiance as a test makes it up.
struct Estimate {
    int width = 0, height = 0, divisor = 1;
    std::vector<glm::vec4> value;
    std::vector<glm::vec2> direction;

    Estimate(int w, int h, int d = 1)
        : width((w + d - 1) / d), height((h + d - 1) / d), divisor(d), value(size()), direction(size()) {}
    std::size_t size() const { return static_cast<std::size_t>(width) * height; }
    glm::vec4& at(int x, int y) { return value[static_cast<std::size_t>(y) * width + x]; }

    /// Grey, the direction's components like the colours.
    static Estimate constant(int w, int h, glm::vec4 colour) {
        Estimate e(w, h);
        e.value.assign(e.size(), colour);
        e.direction.assign(e.size(), glm::vec2(colour));
        return e;
    }
    /// Independent, uniform in [0, 1); x of the direction equals red, y and z green and blue.
    static Estimate random(int w, int h, unsigned seed) {
        Estimate e(w, h);
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> unit(0, 1);
        for (std::size_t i = 0; i < e.size(); ++i) {
            const glm::vec3 c(unit(random), unit(random), unit(random));
            e.value[i] = {c, c.r};
            e.direction[i] = {c.g, c.b};
        }
        return e;
    }
};

class FilteringTest : public PassTest {
  protected:
    static double largest_difference(const Image& a, const Image& b) {
        double most = 0;
        for (std::size_t i = 0; i < a.pixels.size(); ++i)
            most = std::max(most, std::abs(1.0 * a.pixels[i] - b.pixels[i]));
        return most;
    }
    std::vector<OutputDescription> outputs() const override { return pm::filtering_outputs(); }
    template <class T>
    static graph::ImageRef declare(graph::GraphBuilder& builder, const std::string& key, gl::Format format,
                                   const std::vector<T>& texels, float scale) {
        graph::ImageDesc desc;
        desc.text = {key, key};
        desc.format = format;
        desc.extent = graph::Extent::view(scale);
        const auto image = builder.image(desc);
        builder.pass("make " + key).writes(image).execute([image, &texels](graph::PassContext& context) {
            context.upload(image, std::as_bytes(std::span(texels)));
        });
        return image;
    }
    static pm::Splat declare(graph::GraphBuilder& builder, const Estimate& e) {
        const float scale = 1.0f / static_cast<float>(e.divisor);
        pm::Splat splat;
        splat.irradiance = declare(builder, "splat.irradiance", gl::Format::rgba32f, e.value, scale);
        splat.direction = declare(builder, "splat.direction", gl::Format::rg32f, e.direction, scale);
        splat.divisor = e.divisor;
        return splat;
    }

    /// One more frame; the history stays.
    FrameReport filter(const Shot& shot, const Estimate& estimate, const pm::Parameters& parameters) {
        return run(shot, [&](graph::GraphBuilder& builder) {
            const auto scene = passes::upload_scene(builder);
            const auto gbuffer = passes::gbuffer(builder, scene);
            pm::filter_irradiance(builder, gbuffer, declare(builder, estimate), parameters);
        });
    }
    /// One frame from an empty history.
    FrameReport filter_once(const Shot& shot, const Estimate& estimate, const pm::Parameters& parameters) {
        graph().reset_history();
        return filter(shot, estimate, parameters);
    }
    Image result(const pm::Parameters& parameters) const {
        return read(parameters.filter_passes > 0 ? "filter.irradiance" : "filter.temporal");
    }

    static pm::Parameters spatial(int passes, float gamma,
                                  pm::FilterKernel kernel = pm::FilterKernel::printed) {
        pm::Parameters p;
        p.temporal = false;
        p.filter_passes = passes;
        p.filter_kernel = kernel;
        p.detail_clip = gamma;
        return p;
    }
    static pm::Parameters temporal(float weight) {
        pm::Parameters p;
        p.filter_passes = 0;
        p.temporal_weight = weight;
        p.warm_up = false;
        return p;
    }

    /// A plane z = 0 that covers the picture, seen straight.
    static Shot wall(int width, int height) {
        SmallWorld small;
        small.square({0, 0, 0}, {0, 0, 1}, 50);
        return {small.scene(), looking({0, 0, 5}, {0, 0, 0}), width, height};
    }
    /// A slanted square in front of nothing.
    static Shot leaf(int width, int height) {
        SmallWorld small;
        small.square({0, 0, 0}, glm::normalize(glm::vec3(0.3f, 0.9f, 0.6f)), 1.4f);
        return {small.scene(), looking({0, 0, 5}, {0, 0, 0}), width, height};
    }
};

}  // namespace ir::test
