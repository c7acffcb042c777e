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
    more["nodes"] = std::string("plain");
    return more;
}

Settings sloped(Settings more) {
    more["nodes"] = std::string("sloped");
    return more;
}

constexpr const char* atrium = "builtin:atrium?detail=0.3";

const std::vector<Case> cases{
    {"Unlimited", atrium, "nave", maps(32, 200, 0)},
    {"Hard", atrium, "nave", maps(32, 200, 1)},
    {"Smooth", atrium, "gallery", maps(32, 200, 5, set({{"falloff", std::string("smooth")}}))},
    {"OddResolution", atrium, "nave", maps(16, 333, 2)},
    {"OddResolutionUnlimited", atrium, "nave", maps(16, 333, 0)},
    {"ManyBands", "builtin:cornell", "", maps(4, 1111, 0.5)},
    {"OneMap", atrium, "nave", maps(1, 200, 0), 3e-4},  // one pixel is 1.6e-4
    {"OneTexel", atrium, "nave", maps(8, 1, 1)},
    {"NormalOffset", atrium, "nave", maps(32, 200, 2, set({{"self_hit", std::string("normal-offset")}}))},
    {"NormalOffsetUnlimited", atrium, "nave",
     maps(32, 200, 0, set({{"self_hit", std::string("normal-offset")}}))},
    {"Masks", "builtin:graveyard?detail=0.3", "", maps(32, 200, 0.5)},
    {"MasksUnlimited", "builtin:graveyard?detail=0.3", "", maps(32, 200, 0)},
    {"Leaks", "builtin:crevice", "wall-half", maps(64, 200, 0)},
    {"WideDip", atrium, "nave", maps(32, 100, 2, set({{"max_dip", 4.0}, {"slope_tolerance", 2.0}}))},
    {"Hairs", "builtin:hairball?detail=0.1", "", maps(32, 150, 0)},
    {"Coarse", atrium, "nave", maps(32, 200, 1, set({{"detail", 0.3}}))},
    {"CoarseMasks", "builtin:graveyard?detail=0.3", "", maps(32, 200, 0, set({{"detail", 0.5}}))},
    {"Tilted", atrium, "nave", maps(32, 200, 1, set({{"orientation", std::string("tilted")}}))},
    {"Sloped", atrium, "nave", sloped(maps(32, 200, 1)), 6e-5},  // codes, too, are rounded differently
    {"SlopedSmooth", atrium, "gallery", sloped(maps(32, 200, 5, set({{"falloff", std::string("smooth")}}))),
     6e-5},
    {"SlopedOddResolution", atrium, "nave", sloped(maps(16, 333, 2))},
    {"SlopedManyBands", "builtin:cornell", "", sloped(maps(4, 1111, 0.5))},
    {"SlopedOneTexel", atrium, "nave", sloped(maps(8, 1, 1))},
    {"SlopedMasks", "builtin:graveyard?detail=0.3", "", sloped(maps(32, 200, 0.5))},
    {"SlopedWideDip", atrium, "nave",
     sloped(maps(32, 100, 2, set({{"max_dip", 4.0}, {"slope_tolerance", 2.0}})))},
    {"Progressive", atrium, "nave", maps(16, 200, 1, set({{"progressive", true}}))},
};

/// Both bodies see the scene through G-buffers of their own, which differ at edges, by rounding, and in how
/// they filter normal maps. Pixels whose surfaces are not the same are left out.
class LdmAoOnBothBodies : public LdmAo {
  protected:
    struct Difference {
        double mean = 0;
        float largest = 0;
        double far = 0, left_out = 0;  ///< fractions of the pixels
    };
    /// Of the image `key` on the host from that on the device, which is `device`.
    Difference difference(const scene::Camera& view, int width, int height, const Settings& settings,
                          const std::string& key, int frames, Image& device) {
        const std::vector<std::string> surface{"gbuffer.position", "gbuffer.geometric_normal",
                                               "gbuffer.normal"};
        std::map<Processor, std::vector<Image>> images;
        for (const auto which : {Processor::gl, Processor::host}) {
            processor = which;
            graph::FrameOptions options;
            options.wanted = surface;
            images[which] = {render(view, width, height, settings, options, frames, key)};
            for (const auto& name : surface) images[which].push_back(image(name));
        }
        device = images[Processor::gl].front();
        const auto far_apart = [&](std::size_t image, int x, int y) {
            float apart = 0;
            for (int i = 0; i < 3; ++i)
                apart = std::max(apart, std::abs(images[Processor::gl][image].at(x, y, i) -
                                                 images[Processor::host][image].at(x, y, i)));
            return apart > 1e-3f;  // m, or of unit vectors
        };
        Difference result;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                if (far_apart(1, x, y) || far_apart(2, x, y) || far_apart(3, x, y)) {
                    ++result.left_out;
                    continue;
                }
                const float d = std::abs(device.at(x, y, 0) - images[Processor::host].front().at(x, y, 0));
                result.mean += d;
                result.largest = std::max(result.largest, d);
                result.far += d > 0.01f;
            }
        const double pixels = double(width) * height;
        result.mean /= pixels, result.far /= pixels, result.left_out /= pixels;
        return result;
    }
};

class LdmAoHost : public LdmAoOnBothBodies, public testing::WithParamInterface<Case> {};

TEST_P(LdmAoHost, GivesThePictureOfTheDevice) {
    const auto& c = GetParam();
    load(c.scene);
    const auto view = *c.camera ? camera(c.camera) : world_.cameras.front();
    Image device;
    const auto d = difference(view, 93, 69, c.settings, "accessibility", 3, device);
    std::printf(
        "%s: mean of the picture %.4f, of the difference %.2g, largest %.3g, far %.4f, left out %.4f\n",
        c.name, mean(device), d.mean, double{d.largest}, d.far, d.left_out);
    EXPECT_LE(d.mean, c.mean);
    EXPECT_LE(d.far, c.far);
    EXPECT_LE(d.left_out, 0.8);  // the ground of the graveyard has normal maps all over
}

INSTANTIATE_TEST_SUITE_P(Cases, LdmAoHost, testing::ValuesIn(cases),
                         [](const auto& info) { return std::string(info.param.name); });

class LdmAoStream : public LdmAoOnBothBodies {
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
                images.push_back(render(world_.cameras.front(), 67, 46, maps(33, 120, reach), {}, 0, key));
            }
            EXPECT_EQ(images[0].pixels, images[1].pixels) << key;
            EXPECT_EQ(images[0].pixels, images[2].pixels) << key;
        }
}

TEST_F(LdmAoStream, MemoryDoesNotGrowWithTheNumberOfMaps) {
    load(atrium);
    threads = 2;
    for (const double reach : {0.0, 1.0}) {
        std::map<int, double> bytes;
        for (const int directions : {64, 256}) {
            render(world_.cameras.front(), 64, 48, maps(directions, 200, reach));
            bytes[directions] = report.counters.at("ldm.bytes");
            EXPECT_EQ(report.counters.at("ldm.texels"), directions * 200.0 * 200.0);
        }
        std::printf("maps take %.2f MB\n", bytes[256] / 1e6);
        EXPECT_LT(bytes[256], 8 * bytes[64]);  // more maps to a slice let a thread hold more at once
        EXPECT_LT(bytes[256], 64e6);
    }
}

TEST_F(LdmAoStream, MapsThatStandStillAreKeptAndGiveTheSamePictures) {
    geometry = "atrium";
    load("builtin:atrium?detail=0.3");
    const auto settings = maps(40, 150, 0);
    const auto built = [&] { return report.counters.at("ldm.maps_built"); };
    const auto first = world_.cameras.front();
    auto moved = first;
    moved.eye += glm::vec3(0.3f, 0.1f, -0.2f);

    const auto fresh = render(first, 96, 64, settings);
    EXPECT_EQ(built(), 40);
    const auto fragments = report.counters.at("ldm.fragments");
    const auto kept = render(moved, 96, 64, settings);
    EXPECT_EQ(built(), 0);
    EXPECT_EQ(report.counters.at("ldm.fragments"), fragments);
    EXPECT_NE(kept.pixels, fresh.pixels);

    geometry.clear();
    EXPECT_EQ(render(moved, 96, 64, settings).pixels, kept.pixels);
    EXPECT_EQ(built(), 40);

    geometry = "another";
    render(moved, 96, 64, settings);
    EXPECT_EQ(built(), 40);
    graph::FrameOptions cold;
    cold.rebuild = true;
    EXPECT_EQ(render(moved, 96, 64, settings, cold).pixels, kept.pixels);
    EXPECT_EQ(built(), 40);
    render(moved, 96, 64, maps(40, 150, 1));  // lists are never kept
    EXPECT_EQ(built(), 40);
    for (const int frame : {0, 1}) {
        render(moved, 96, 64, maps(40, 150, 0, set({{"progressive", true}})), {}, frame);
        EXPECT_EQ(built(), 40);
    }
}

TEST_F(LdmAoStream, KeepsAsManyMapsAsFitAndStreamsTheRest) {
    geometry = "cornell";
    load("builtin:cornell");
    for (const int resolution : {200, 300}) {  // of one band, and of two
        const auto settings = maps(300, resolution, 0);
        render(world_.cameras.front(), 24, 16, settings);
        EXPECT_EQ(report.counters.at("ldm.maps_built"), 300);
        const auto kept = render(world_.cameras.front(), 40, 32, settings);
        const auto built = report.counters.at("ldm.maps_built");
        std::printf("of 300 maps of %d texels a side %g are built anew, %g MB\n", resolution, built,
                    report.counters.at("ldm.bytes") / 1e6);
        EXPECT_GT(built, 50);
        EXPECT_LT(built, 270);
        EXPECT_LT(report.counters.at("ldm.bytes"), 64e6);
        geometry.clear();
        EXPECT_EQ(render(world_.cameras.front(), 40, 32, settings).pixels, kept.pixels);
        geometry = "cornell";
    }
}

TEST_F(LdmAoStream, KeepsWhatTheMemoryBudgetLeavesOver) {
    geometry = "cornell";
    load("builtin:cornell");
    const auto settings = maps(64, 200, 0);
    const auto whole = render(world_.cameras.front(), 24, 16, settings);
    graph::FrameOptions options;
    options.memory_budget = report.memory_bytes - (4 << 20);
    for (const double built : {64.0, 32.0}) {
        EXPECT_EQ(render(world_.cameras.front(), 24, 16, settings, options).pixels, whole.pixels);
        EXPECT_LE(report.memory_bytes, options.memory_budget + 100'000);  // counters, hits
        EXPECT_LE(report.counters.at("ldm.maps_built"), built);
        EXPECT_GT(report.counters.at("ldm.maps_built"), 16);
    }
}

TEST_F(LdmAoStream, SelfHitsAreCountedAsOnTheDevice) {
    load("builtin:atrium?detail=0.3");
    for (const char* rule : {"tangent-plane", "normal-offset"})
        for (const char* key : {"ldm.self_hits", "ldm.missing", "ldm.leaks"}) {
            const auto settings = maps(24, 150, 1, set({{"self_hit", std::string(rule)}}));
            Image device;
            EXPECT_LE(difference(world_.cameras.front(), 96, 64, settings, key, 0, device).mean, 4e-4)
                << rule << " " << key;
            if (key == std::string("ldm.self_hits")) {
                EXPECT_GT(mean(device), 0.01) << rule;
            }
            if (rule == std::string("normal-offset")) continue;
            EXPECT_LE(difference(world_.cameras.front(), 96, 64, sloped(settings), key, 0, device).mean, 2e-4)
                << "sloped " << key;
        }
}

bool has_pass(const FrameReport& report, const std::string& name) {
    return std::any_of(report.passes.begin(), report.passes.end(),
                       [&](const auto& pass) { return pass.name == name && !pass.culled; });
}

TEST_F(LdmAoStream, CoarserScenesMissMoreOwnEntries) {
    load(atrium);
    processor = Processor::host;
    std::vector<double> missing;
    for (const double detail : {1.0, 0.5, 0.1})
        missing.push_back(mean(render(camera("nave"), 60, 45, maps(16, 200, 1, set({{"detail", detail}})), {},
                                      0, "ldm.missing")));
    EXPECT_GT(missing[1], missing[0]);
    EXPECT_GT(missing[2], missing[1]);
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
