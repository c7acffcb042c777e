// The body of ldm-ao on the host against the one on the device: the same pictures but for rounding.
#include <gtest/gtest.h>

#include <map>

#include "ldm_ao_fixture.h"

namespace ir::ldm_ao_test {
namespace {

struct Case {
    const char* name;
    const char* scene;
    const char* camera;
    Settings settings;
    double mean = 3e-5, far = 0.005;  ///< mean difference; part of the pixels that differ by more than 0.01
};

Settings set(std::initializer_list<Settings::value_type> values) {
    return Settings(values);
}
Settings maps(std::int64_t directions, std::int64_t resolution, double max_distance, Settings more = {}) {
    more["directions"] = directions;
    more["resolution"] = resolution;
    more["max_distance"] = max_distance;
    return more;
}

const std::vector<Case> cases{
    {"Unlimited", "builtin:atrium", "nave", maps(64, 200, 0)},
    {"Hard", "builtin:atrium", "nave", maps(64, 200, 1)},
    {"Smooth", "builtin:atrium", "gallery", maps(32, 200, 5, set({{"falloff", std::string("smooth")}}))},
    {"OddResolution", "builtin:atrium", "nave", maps(16, 333, 2)},
    {"OddResolutionUnlimited", "builtin:atrium", "nave", maps(16, 333, 0)},
    {"ManyBands", "builtin:cornell", "", maps(4, 1111, 0.5)},
    {"OneMap", "builtin:atrium", "nave", maps(1, 200, 0)},
    {"OneTexel", "builtin:atrium", "nave", maps(8, 1, 1)},
    {"NormalOffset", "builtin:atrium", "nave",
     maps(32, 200, 2, set({{"self_hit", std::string("normal-offset")}}))},
    {"NormalOffsetUnlimited", "builtin:atrium", "nave",
     maps(32, 200, 0, set({{"self_hit", std::string("normal-offset")}}))},
    {"Masks", "builtin:graveyard?detail=0.3", "", maps(32, 200, 0.5)},
    {"MasksUnlimited", "builtin:graveyard?detail=0.3", "", maps(32, 200, 0)},
    {"Leaks", "builtin:crevice", "wall-half", maps(64, 200, 0)},
    {"WideDip", "builtin:atrium", "nave",
     maps(32, 100, 2, set({{"max_dip", 4.0}, {"slope_tolerance", 2.0}}))},
    {"Hairs", "builtin:hairball?detail=0.1", "", maps(32, 150, 0)},
    {"Progressive", "builtin:atrium", "nave", maps(16, 200, 1, set({{"progressive", true}}))},
};

class LdmAoHost : public LdmAo, public testing::WithParamInterface<Case> {};

TEST_P(LdmAoHost, GivesThePictureOfTheDevice) {
    const auto& c = GetParam();
    load(c.scene);
    const auto view = *c.camera ? camera(c.camera) : world_.cameras.front();
    const auto on = [&](Processor which) {
        processor = which;
        return render(view, 133, 99, c.settings, {}, 3);
    };
    const auto device = on(Processor::gl), host = on(Processor::host);
    double sum = 0;
    std::size_t far = 0;
    for (std::size_t i = 0; i < device.pixels.size(); ++i) {
        const double difference = std::abs(device.pixels[i] - host.pixels[i]);
        sum += difference;
        far += difference > 0.01;
    }
    const auto pixels = static_cast<double>(device.pixels.size());
    std::printf("%s: mean of the picture %.4f, of the difference %.2g, largest %.3g, far %.4f\n", c.name,
                mean(device), sum / pixels, double{max_different(device, host)}, far / pixels);
    EXPECT_LE(sum / pixels, c.mean);
    EXPECT_LE(static_cast<double>(far) / pixels, c.far);
}

INSTANTIATE_TEST_SUITE_P(Cases, LdmAoHost, testing::ValuesIn(cases),
                         [](const auto& info) { return std::string(info.param.name); });

class LdmAoStream : public LdmAo {
  protected:
    LdmAoStream() { processor = Processor::host; }
};

TEST_F(LdmAoStream, PictureIsTheSameWhateverTheThreads) {
    load("builtin:atrium?detail=0.3");
    for (const double reach : {0.0, 1.0})
        for (const char* key : {"accessibility", "ldm.self_hits", "ldm.leaks"}) {
            std::vector<Image> images;
            for (const int count : {1, 2, 5}) {
                threads = count;
                images.push_back(render(world_.cameras.front(), 131, 90, maps(33, 120, reach), {}, 0, key));
            }
            EXPECT_EQ(images[0].pixels, images[1].pixels) << key;
            EXPECT_EQ(images[0].pixels, images[2].pixels) << key;
        }
}

TEST_F(LdmAoStream, MemoryDoesNotGrowWithTheNumberOfMaps) {
    load("builtin:atrium");
    threads = 2;
    for (const double reach : {0.0, 1.0}) {
        std::map<int, double> bytes;
        for (const int directions : {64, 256}) {
            render(world_.cameras.front(), 64, 48, maps(directions, 200, reach));
            bytes[directions] = report.counters.at("ldm.bytes");
            EXPECT_EQ(report.counters.at("ldm.texels"), directions * 200.0 * 200.0);
        }
        std::printf("maps take %.2f MB\n", bytes[256] / 1e6);
        EXPECT_LT(bytes[256], 2 * bytes[64]);  // more maps to a slice may let a thread hold more at once
        EXPECT_LT(bytes[256], 64e6);
    }
}

TEST_F(LdmAoStream, SelfHitsAreCountedAsOnTheDevice) {
    load("builtin:atrium?detail=0.3");
    for (const char* rule : {"tangent-plane", "normal-offset"})
        for (const char* key : {"ldm.self_hits", "ldm.missing", "ldm.leaks"}) {
            const auto settings = maps(24, 150, 1, set({{"self_hit", std::string(rule)}}));
            processor = Processor::gl;
            const auto device = render(world_.cameras.front(), 96, 64, settings, {}, 0, key);
            processor = Processor::host;
            const auto host = render(world_.cameras.front(), 96, 64, settings, {}, 0, key);
            double sum = 0;
            for (std::size_t i = 0; i < device.pixels.size(); ++i)
                sum += std::abs(device.pixels[i] - host.pixels[i]);
            EXPECT_LE(sum / static_cast<double>(device.pixels.size()), 2e-4) << rule << " " << key;
        }
}

bool has_pass(const FrameReport& report, const std::string& name) {
    return std::any_of(report.passes.begin(), report.passes.end(),
                       [&](const auto& pass) { return pass.name == name && !pass.culled; });
}

TEST_F(LdmAoStream, StandsForTheDefaultStorageAlone) {
    load("builtin:cornell");
    const auto render_with = [&](const char* key, const char* value) {
        render(world_.cameras.front(), 24, 16, maps(4, 50, 1, set({{key, std::string(value)}})));
        return has_pass(report, "build and trace maps");
    };
    EXPECT_TRUE(render_with("storage", "arrays"));
    EXPECT_FALSE(has_pass(report, "build maps"));
    EXPECT_FALSE(render_with("storage", "linked-lists"));
    EXPECT_TRUE(has_pass(report, "build maps"));
    EXPECT_FALSE(render_with("builder", "raster"));
    EXPECT_FALSE(render_with("exact", "near"));
}

TEST_F(LdmAoStream, WholeMapsAreBuiltWhileSomethingLooksAtThem) {
    load("builtin:cornell");
    const auto layers = render(world_.cameras.front(), 24, 16, maps(4, 50, 1), {}, 0, "ldm.layers");
    EXPECT_EQ(layers.width, 50);
    EXPECT_TRUE(has_pass(report, "build maps"));
    EXPECT_TRUE(has_pass(report, "build and trace maps"));
    EXPECT_EQ(report.processor, "host");
}

TEST_F(LdmAoStream, CancelsBetweenMaps) {
    load("builtin:cornell");
    CancelToken token;
    graph::FrameOptions options;
    options.cancel = &token;
    options.progress = [&](const std::string& pass, double) {
        if (pass == "build and trace maps") token.cancel();
    };
    EXPECT_THROW(render(world_.cameras.front(), 64, 48, maps(2048, 200, 1), options), Cancelled);
}

}  // namespace
}  // namespace ir::ldm_ao_test
