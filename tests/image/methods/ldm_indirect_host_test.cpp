// The bodies of ldm-indirect on the host against those on the device: the same pictures but for rounding.
#include <gtest/gtest.h>

#include <map>

#include "ldm_ao_fixture.h"

namespace ir::ldm_indirect_test {
namespace {

Settings photons(std::int64_t directions, std::int64_t emission, const Settings& more = {}) {
    Settings settings{{"directions", directions}, {"resolution", std::int64_t{200}}, {"emission", emission}};
    for (const auto& [key, value] : more) settings[key] = value;
    return settings;
}

Settings unclipped(Settings settings) {
    settings["clipping"] = std::string("none");
    return settings;
}

struct Case {
    const char* name;
    const char* scene;
    const char* camera;
    Settings settings;
    double mean = 0.01;  ///< difference over the mean of the picture
};

const std::vector<Case> cases{
    // More than 6,553 photons in a tile: as many turns as llvmpipe gives their loop.
    {"Atrium", "builtin:atrium?detail=0.3", "nave", photons(32, 12)},
    {"Gallery", "builtin:atrium?detail=0.1", "gallery", photons(64, 10)},
    {"Masks", "builtin:graveyard?detail=0.3", "", photons(32, 24)},
    {"Ellipsoids", "builtin:atrium?detail=0.3", "nave", unclipped(photons(32, 12))},
    {"ManyEllipsoids", "builtin:atrium?detail=0.1", "gallery", unclipped(photons(64, 10))},
    {"SmallSplats", "builtin:atrium?detail=0.1", "nave", photons(32, 12, {{"splat_size", 0.5}})},
    {"LargeSplats", "builtin:atrium?detail=0.1", "nave", photons(16, 16, {{"splat_size", 2.0}})},
    {"DirectPhotons", "builtin:atrium?detail=0.1", "nave",
     photons(16, 16, {{"direct", std::string("photons")}, {"splat_size", 2.0}})},
    // 0.012: four photons of 7043 are rejected on one side alone, and each lights much
    {"Rejected", "builtin:atrium?detail=0.1", "nave", unclipped(photons(32, 24, {{"reject_hidden", true}})),
     0.02},
    {"Progressive", "builtin:atrium?detail=0.1", "nave", photons(32, 12, {{"progressive", true}})},
    {"Quads", "builtin:atrium?detail=0.1", "nave", photons(16, 16, {{"splatting", std::string("quads")}})},
    {"Published", "builtin:atrium?detail=0.1", "nave",
     unclipped(photons(32, 12, {{"footprint", std::string("published")}}))},
};

class LdmIndirectOnBothBodies : public ldm_ao_test::LdmAo {
  protected:
    std::string id() const override { return "ldm-indirect"; }
    bool has_pass(const std::string& name) const {
        return std::any_of(report.passes.begin(), report.passes.end(),
                           [&](const auto& pass) { return pass.name == name && !pass.culled; });
    }
};

constexpr int width = 49, height = 33;

class LdmIndirectHost : public LdmIndirectOnBothBodies, public testing::WithParamInterface<Case> {};

/// Both bodies see the scene through G-buffers of their own; pixels whose surfaces are not the same are left
/// out.
TEST_P(LdmIndirectHost, GivesThePictureOfTheDevice) {
    const auto& c = GetParam();
    load(c.scene);
    const auto view = *c.camera ? camera(c.camera) : world_.cameras.front();
    std::map<Processor, Image> picture, position;
    std::map<Processor, double> count;
    for (const auto which : {Processor::gl, Processor::host}) {
        processor = which;
        graph::FrameOptions options;
        options.wanted = {"gbuffer.position"};
        picture[which] = render(view, width, height, c.settings, options, 0, "indirect.irradiance");
        position[which] = image("gbuffer.position");
        count[which] = report.counters.at("indirect.count");
    }
    double sum = 0, difference = 0, left_out = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            float apart = 0;
            for (int i = 0; i < 3; ++i)
                apart = std::max(apart, std::abs(position[Processor::gl].at(x, y, i) -
                                                 position[Processor::host].at(x, y, i)));
            left_out += apart > 1e-3f;
            for (int i = 0; i < 3 && apart <= 1e-3f; ++i) {
                sum += picture[Processor::gl].at(x, y, i);
                difference +=
                    std::abs(picture[Processor::gl].at(x, y, i) - picture[Processor::host].at(x, y, i));
            }
        }
    std::printf("%s: difference %.2g of the mean, photons %.0f and %.0f, left out %.4f\n", c.name,
                difference / sum, count[Processor::gl], count[Processor::host], left_out / (width * height));
    EXPECT_GT(sum, 0);
    EXPECT_LE(difference / sum, c.mean);
    EXPECT_NEAR(count[Processor::host] / count[Processor::gl], 1, 0.005);
    EXPECT_LE(left_out, 0.02 * width * height);
}

INSTANTIATE_TEST_SUITE_P(Cases, LdmIndirectHost, testing::ValuesIn(cases),
                         [](const auto& info) { return std::string(info.param.name); });

/// Both in one layout. A step is a sixteenth of an octave; on edges a pixel may query another texel.
TEST_F(LdmIndirectOnBothBodies, SeeAsFarAlongMaps) {
    load("builtin:atrium?detail=0.1");
    for (const std::int64_t resolution : {60, 300}) {  // one band, and some
        std::map<Processor, std::vector<std::byte>> looks;
        for (const auto which : {Processor::gl, Processor::host}) {
            processor = which;
            graph::FrameOptions options;
            options.wanted = {"indirect.looks"};
            const auto settings = photons(5, 8, {{"resolution", resolution}});
            render(camera("nave"), width, height, settings, options, 0, "radiance");
            looks[which] = graph().read_buffer("indirect.looks").value();
        }
        const auto &gl = looks[Processor::gl], &host = looks[Processor::host];
        ASSERT_EQ(gl.size(), host.size());
        EXPECT_EQ(gl.size(), std::size_t{7 * 5 * 5 * 64});
        std::size_t others = 0, open = 0, dark = 0;
        for (std::size_t i = 0; i < gl.size(); ++i) {
            others += std::abs(int(gl[i]) - int(host[i])) > 1;
            open += gl[i] == std::byte{255};
            dark += gl[i] == std::byte{0};
        }
        EXPECT_LT(double(others) / double(gl.size()), 0.01) << resolution;
        EXPECT_GT(open, gl.size() / 100);
        EXPECT_LT(dark, gl.size() / 2);
    }
}

TEST_F(LdmIndirectOnBothBodies, ThreadsChangeNothing) {
    load("builtin:atrium?detail=0.3");
    processor = Processor::host;
    std::vector<Image> pictures;
    for (const int count : {1, 2, 5}) {
        threads = count;
        pictures.push_back(render(world_.cameras.front(), 83, 57, photons(17, 16), {}, 0, "radiance"));
    }
    EXPECT_EQ(pictures[0].pixels, pictures[1].pixels);
    EXPECT_EQ(pictures[0].pixels, pictures[2].pixels);
}

TEST_F(LdmIndirectOnBothBodies, StandForTheDefaultsAlone) {
    load("builtin:cornell");
    processor = Processor::host;
    const auto render_with = [&](const char* key, const char* value) {
        render(world_.cameras.front(), 24, 16, photons(4, 8, {{key, std::string(value)}}), {}, 0, "radiance");
    };
    render_with("storage", "arrays");
    EXPECT_TRUE(has_pass("trace photons through maps"));
    EXPECT_FALSE(has_pass("build maps"));
    EXPECT_FALSE(has_pass("gather photons of tiles"));
    render_with("storage", "linked-lists");
    EXPECT_FALSE(has_pass("trace photons through maps"));
    EXPECT_TRUE(has_pass("trace photons"));
    EXPECT_FALSE(has_pass("gather photons of tiles"));
    render_with("paths", "direct");
    EXPECT_FALSE(has_pass("trace photons through maps"));
    processor = Processor::gl;
    render_with("storage", "arrays");
    EXPECT_TRUE(has_pass("gather photons of tiles"));
}

TEST_F(LdmIndirectOnBothBodies, ViewsAndMapsAreThereOnTheHost) {
    load("builtin:atrium?detail=0.3");
    processor = Processor::host;
    graph::FrameOptions options;
    options.wanted = {"indirect.footprints", "indirect.primary", "indirect.energy"};
    const auto layers = render(world_.cameras.front(), 24, 16, photons(4, 16), options, 0, "ldm.layers");
    EXPECT_EQ(layers.width, 200);
    EXPECT_TRUE(has_pass("build maps"));
    EXPECT_TRUE(has_pass("trace photons through maps"));
    EXPECT_EQ(report.processor, "host");
    EXPECT_EQ(report.counters.at("indirect.footprints_shown"), report.counters.at("indirect.count"));
    EXPECT_GT(report.counters.at("indirect.count"), 0);
}

}  // namespace
}  // namespace ir::ldm_indirect_test
