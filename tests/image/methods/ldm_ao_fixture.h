#pragma once

#include <algorithm>
#include <cmath>
#include <map>

#include "tests/image/methods/ldm_ao_method.h"

namespace ir::ldm_ao_test {

/// Renders the method on one machine, without what an experiment brings along.
class LdmAo : public test::LdmAoMethodTest {
  protected:
    void load(const std::string& name) {
        static std::map<std::string, scene::Scene> loaded;
        if (!loaded.contains(name)) loaded[name] = scene::load_scene(name);
        scene_ = loaded.at(name);
        world_ = scene::flatten(scene_, 0, 0);
    }
    scene::Camera camera(const std::string& name) const {
        const auto* found = scene_.find_camera(name);
        if (!found) throw std::runtime_error("no camera " + name);
        return *found;
    }

    scene::Environment& environment() { return scene_.environment; }

    Image render(const scene::Camera& camera, int width, int height, const Settings& settings,
                 graph::FrameOptions options = {}, int frame = 0, const std::string& key = "accessibility") {
        graph::FrameInputs inputs;
        inputs.scene = &scene_;
        inputs.world = &world_;
        inputs.view = inputs.previous_view = scene::make_view(camera, width, height, world_.bounds);
        inputs.frame = frame;
        inputs.seed = 5;
        inputs.threads = threads;
        inputs.processor = processor;
        inputs.geometry_fingerprint = geometry;
        options.wanted.push_back(key);
        report = graph().run(method(), settings, inputs, options);
        return graph().read_image(key).value();
    }

    FrameReport report;
    scene::World world_;
    Processor processor = Processor::gl;
    int threads = 0;
    std::string geometry;  ///< fingerprint; empty: nothing is kept from frame to frame

  private:
    scene::Scene scene_;
};

inline Settings ao_maps(int directions, int resolution) {
    return {{"directions", std::int64_t(directions)},
            {"resolution", std::int64_t(resolution)},
            {"max_distance", 0.0}};
}

inline Settings with(Settings settings, const std::string& key, Value value) {
    settings[key] = std::move(value);
    return settings;
}

inline float max_different(const Image& a, const Image& b) {
    float most = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        most = std::max(most, std::abs(a.pixels[i] - b.pixels[i]));
    return most;
}

inline double mean(const Image& image) {
    double sum = 0;
    for (const float value : image.pixels) sum += value;
    return sum / static_cast<double>(image.pixels.size());
}

}  // namespace ir::ldm_ao_test
