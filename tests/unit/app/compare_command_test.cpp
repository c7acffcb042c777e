// `compare` on the real program: metrics, regions, difference files, refusals.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "renderers/image/exr.h"
#include "renderers/image/metrics.h"
#include "tests/own_folder.h"
#include "tests/unit/app/outcome.h"

namespace ir {
namespace {

class Compare : public testing::Test {
  protected:
    void SetUp() override {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = own_folder("compare-" + std::string(test->name()));
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    void TearDown() override { fs::remove_all(folder_); }

    std::string file(const std::string& name) const { return (folder_ / name).string(); }

    Outcome compare(const std::string& a, const std::string& b, const std::string& options = {}) const {
        return run_program("compare " + file(a) + " " + file(b) + " " + options, folder_);
    }

    void expect_refused(const Outcome& outcome, int status, const std::string& part) const {
        EXPECT_EQ(outcome.status, status) << outcome.out << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
    }

    /// A picture that is neither symmetric nor flat, brighter by `more` in its first ten columns.
    static Image picture(float more = 0, int width = 32, int height = 20) {
        Image image(width, height, 1);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                image.at(x, y) = 0.2f + 0.02f * float(x) + 0.005f * float(y) + (x < 10 ? more : 0);
        return image;
    }

    void write(const std::string& name, const Image& image, const ImageAttributes& attributes = {},
               std::vector<ImageLayer> more = {}) const {
        more.insert(more.begin(), {"", standard_channels(image.channels), image});
        write_exr(file(name), more, attributes);
    }

    fs::path folder_;
};

TEST_F(Compare, PrintsWhatTheLibraryComputes) {
    write("a.exr", picture(0.1f));
    write("b.exr", picture());
    const auto outcome = compare("a.exr", "b.exr", "--metric all --json");
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto json = nlohmann::json::parse(outcome.out);
    const auto expected = compute_metrics(picture(0.1f), picture(), metric_names());
    for (const auto& name : metric_names())
        EXPECT_NEAR(json["metrics"][name].get<double>(), expected.values.at(name), 1e-9) << name;
    EXPECT_FALSE(json.contains("reasons"));
    EXPECT_EQ(json["pixels"], 640);
    EXPECT_EQ(json["skipped"], 0);
    EXPECT_EQ(json["hdr_flip_exposures"]["count"], expected.exposures->count);
    const auto text = compare("a.exr", "b.exr", "--metric psnr,ssim").out;
    EXPECT_NE(text.find(" dB"), std::string::npos) << text;
}

TEST_F(Compare, FourValuesAreFourAndAlphaIsNone) {
    Image a(32, 20, 4, 0.5f), b = a;
    for (std::size_t i = 3; i < b.pixels.size(); i += 4) b.pixels[i] = 0.9f;
    const auto layers = [](const Image& image) {
        return std::vector<ImageLayer>{{"colour", {"R", "G", "B", "A"}, image},
                                       {"sums", {"0", "1", "2", "3"}, image}};
    };
    write("a.exr", a, {}, layers(a));
    write("b.exr", b, {}, layers(b));
    const auto mae = [&](const std::string& layer) {
        const auto outcome = compare(
            "a.exr", "b.exr",
            "--json --metric mae --diff " + file("d.exr") + (layer.empty() ? "" : " --layer " + layer));
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return std::pair(nlohmann::json::parse(outcome.out)["metrics"]["mae"].get<double>(),
                         read_exr(file("d.exr")).at(0).image.channels);
    };
    EXPECT_EQ(mae(""), std::pair(0.0, 3));
    EXPECT_EQ(mae("colour"), std::pair(0.0, 3));
    const auto [error, channels] = mae("sums");
    EXPECT_NEAR(error, 0.1, 1e-6);
    EXPECT_EQ(channels, 4);
}

TEST_F(Compare, TellsMeansAndBiasWithoutBeingRequested) {
    write("a.exr", picture(0.1f));
    write("b.exr", picture());
    const auto metrics = nlohmann::json::parse(compare("a.exr", "b.exr", "--json").out).at("metrics");
    const double bias = metrics.at("bias"), mean = metrics.at("mean"),
                 reference = metrics.at("reference-mean");
    EXPECT_NEAR(bias, 0.1 * 10 / 32, 1e-6);
    EXPECT_NEAR(mean - reference, bias, 1e-9);
    EXPECT_NEAR(metrics.at("relbias"), bias / reference, 1e-9);
    EXPECT_NEAR(nlohmann::json::parse(compare("b.exr", "a.exr", "--json").out)["metrics"]["bias"], -bias,
                1e-9);
}

TEST_F(Compare, NumbersThatAreNotFiniteAreNullWithAReason) {
    write("a.exr", picture());
    write("black.exr", Image(32, 20, 1, 0.0f));
    Image none(32, 20, 1, 0.0f);
    write("invalid.exr", picture(), {}, {{"valid", {"Y"}, none}});
    const auto json = [&](const char* a, const char* b) {
        return nlohmann::json::parse(compare(a, b, "--json").out);
    };
    auto equal = json("a.exr", "a.exr");
    EXPECT_TRUE(equal["metrics"]["psnr"].is_null());
    EXPECT_EQ(equal["reasons"]["psnr"], "infinite: the pictures are equal");
    EXPECT_EQ(equal["reasons"].size(), 1u);
    auto dark = json("a.exr", "black.exr");
    EXPECT_TRUE(dark["metrics"]["relbias"].is_null());
    EXPECT_EQ(dark["reasons"]["relbias"], "infinite: the mean of the reference is 0");
    auto nothing = json("invalid.exr", "a.exr");
    for (const auto* name : {"rmse", "bias", "psnr"}) {
        EXPECT_TRUE(nothing["metrics"][name].is_null()) << name;
        EXPECT_EQ(nothing["reasons"][name], "undefined: no pixel was compared") << name;
    }
}

TEST_F(Compare, AnExrFileIsKnownByItsContentNotItsName) {
    const Image none(32, 20, 1, 0.0f);
    write("a.exr", picture());
    write("invalid.exr", picture(), {}, {{"valid", {"Y"}, none}});
    fs::rename(folder_ / "invalid.exr", folder_ / "invalid.picture");
    const auto metrics = nlohmann::json::parse(compare("invalid.picture", "a.exr", "--json").out)["metrics"];
    EXPECT_TRUE(metrics["rmse"].is_null()) << "its layer of valid pixels counts";
}

TEST_F(Compare, CountsOnlyARectangleOrAMask) {
    write("a.exr", picture(0.1f));
    write("b.exr", picture());
    Image mask(32, 20, 1);
    for (int x = 0; x < 20; ++x) mask.at(x, 3) = 1;
    write("mask.exr", Image(32, 20, 3), {}, {{"object", {"Y"}, mask}});
    const auto json = [&](const std::string& options) {
        const auto outcome = compare("a.exr", "b.exr", "--json --metric mae " + options);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return nlohmann::json::parse(outcome.out);
    };
    EXPECT_NEAR(json("--rect 0,0,10,20")["metrics"]["mae"], 0.1, 1e-6);
    EXPECT_EQ(json("--rect 10,0,22,20")["metrics"]["mae"], 0);
    const auto masked = json("--mask " + file("mask.exr") + ":object");
    EXPECT_EQ(masked["pixels"], 20);
    EXPECT_NEAR(masked["metrics"]["mae"], 0.05, 1e-6);
    expect_refused(compare("a.exr", "b.exr", "--rect 30,0,10,10"), 2, "rectangle");
    expect_refused(compare("a.exr", "b.exr", "--rect 1,2,3"), 2, "--rect");
    expect_refused(compare("a.exr", "b.exr", "--mask " + file("none.exr")), 3, "none.exr");
    expect_refused(compare("a.exr", "b.exr", "--mask " + file("mask.exr") + ":no-layer"), 3, "no-layer");
}

TEST_F(Compare, WritesDifferencesAsValuesAndAsColours) {
    auto a = picture(0.1f);
    a.at(20, 5) = std::numeric_limits<float>::quiet_NaN();
    Image valid(32, 20, 1, 1.0f);
    valid.at(3, 3) = 0;
    write("a.exr", a, {}, {{"valid", {"Y"}, valid}});
    write("b.exr", picture());
    ASSERT_EQ(compare("a.exr", "b.exr", "--diff-kind squared --diff " + file("d.exr")).status, 0);
    ImageAttributes attributes;
    const auto layers = read_exr(file("d.exr"), &attributes);
    EXPECT_NEAR(layers.at(0).image.at(2, 2), 0.01, 1e-6);
    EXPECT_TRUE(std::isnan(layers.at(0).image.at(3, 3)));
    EXPECT_EQ(layers.at(1).name, "valid");
    EXPECT_EQ(attributes.at("interreflect.difference.kind"), "squared");
    EXPECT_EQ(attributes.at("interreflect.difference.range").substr(0, 2), "0,");

    const auto colours = compare(
        "a.exr", "b.exr", "--diff-kind signed --colour-map grey --range -0.2,0.2 --diff " + file("d.png"));
    ASSERT_EQ(colours.status, 0) << colours.err;
    EXPECT_NE(colours.out.find("-0.2 to 0.2 (grey)"), std::string::npos) << colours.out;
    const auto png = read_image(file("d.png"));
    const auto byte = [&](int x, int y, int c) {
        const float linear = png.at(x, y, c);
        return std::lround(
            255 * (linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f));
    };
    EXPECT_NEAR(byte(2, 2, 0), 191, 1);   // (0.1 + 0.2) / 0.4 of 255
    EXPECT_NEAR(byte(15, 2, 0), 128, 1);  // no difference
    EXPECT_EQ(byte(3, 3, 0), 96);         // invalid
    EXPECT_EQ(byte(20, 5, 0), 255);       // not a number
    EXPECT_EQ(byte(20, 5, 1), 0);

    for (const auto* kind : {"absolute", "relative", "flip", "hdr-flip"})
        EXPECT_EQ(
            compare("a.exr", "b.exr", std::string("--diff-kind ") + kind + " --diff " + file("k.png")).status,
            0)
            << kind;
    expect_refused(compare("a.exr", "b.exr", "--diff " + file("d.jpg")), 2, ".png");
    expect_refused(compare("a.exr", "b.exr", "--diff-kind odd --diff " + file("d.png")), 2, "odd");
    expect_refused(compare("a.exr", "b.exr", "--colour-map odd --diff " + file("d.png")), 2, "odd");
    expect_refused(compare("a.exr", "b.exr", "--range 1,0 --diff " + file("d.png")), 2, "--range");
}

TEST_F(Compare, TellsSignificantDifferencesByTheVarianceInTheFile) {
    const ImageAttributes named{{"interreflect.variance", "method.variance"}};
    const auto with = [&](float variance) {
        return std::vector<ImageLayer>{{"method.variance", {"Y"}, Image(32, 20, 1, variance)}};
    };
    write("a.exr", picture(0.1f), named, with(1e-6f));
    write("b.exr", picture(), named, with(1e-6f));
    write("noisy.exr", picture(0.1f), named, with(1));
    write("plain.exr", picture());
    const auto part = [&](const std::string& a, const std::string& b) {
        const auto outcome =
            compare(a, b, "--json --diff-kind significant --diff " + file("significant.exr"));
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return nlohmann::json::parse(outcome.out)["difference"]["significant_fraction"].get<double>();
    };
    EXPECT_NEAR(part("a.exr", "b.exr"), 10.0 / 32, 1e-9);
    EXPECT_NEAR(part("a.exr", "plain.exr"), 10.0 / 32, 1e-9);
    EXPECT_EQ(part("noisy.exr", "b.exr"), 0);
    expect_refused(compare("plain.exr", "plain.exr", "--diff-kind significant --diff " + file("s.exr")), 2,
                   "variance");
}

TEST_F(Compare, TrustsVariancesOfFewSamplesLess) {
    // 6 standard deviations: beyond Student's t at 1e-4 / 3 of 7 degrees pooled over 9 pixels, not of 1.
    const std::vector<ImageLayer> variance{{"method.variance", {"Y"}, Image(32, 20, 1, 1e-4f)}};
    auto counted = variance;
    counted.push_back({"method.samples", {"Y"}, Image(32, 20, 1, 2)});
    const auto part = [&](const std::string& samples, const std::vector<ImageLayer>& layers) {
        ImageAttributes attributes{{"interreflect.variance", "method.variance"}};
        if (!samples.empty()) attributes["interreflect.samples"] = samples;
        write("few.exr", picture(0.06f), attributes, layers);
        write("exact.exr", picture());
        const auto outcome = compare("few.exr", "exact.exr",
                                     "--json --diff-kind significant --diff " + file("significant.exr"));
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return nlohmann::json::parse(outcome.out)["difference"]["significant_fraction"].get<double>();
    };
    for (const auto* many : {"", "8", "4096"}) EXPECT_GT(part(many, variance), 0) << many;
    EXPECT_EQ(part("2", variance), 0);
    EXPECT_EQ(part("", counted), 0);
    EXPECT_GT(part("64", counted), 0) << "the attribute counts";
    write("one.exr", picture(0.1f),
          {{"interreflect.variance", "method.variance"}, {"interreflect.samples", "1"}}, variance);
    expect_refused(compare("one.exr", "exact.exr", "--diff-kind significant --diff " + file("s.exr")), 2,
                   "at least 2");
    EXPECT_EQ(compare("one.exr", "exact.exr", "--diff " + file("s.exr")).status, 0) << "others need none";
}

TEST_F(Compare, RefusesWhatIsNotAlikeUnlessAllowed) {
    const ImageAttributes base{{"interreflect.set.paths", "full"},
                               {"interreflect.set.max_bounces", "5"},
                               {"interreflect.camera.eye", "0,1,2"},
                               {"interreflect.camera.target", "0,0,0"},
                               {"interreflect.scene", "builtin:cornell@1"},
                               {"interreflect.scene_hash", "abc"},
                               {"interreflect.lighting", "123"},
                               {"interreflect.method", "one"},
                               {"interreflect.set.samples", "4"}};
    write("a.exr", picture(0.1f), base);
    const auto other = [&](const std::string& key, const std::string& value) {
        auto attributes = base;
        attributes["interreflect." + key] = value;
        write("b.exr", picture(), attributes);
    };
    const std::pair<const char*, std::pair<const char*, const char*>> cases[] = {
        {"transport", {"set.max_bounces", "7"}},
        {"transport", {"set.paths", "indirect"}},
        {"camera", {"camera.eye", "0,1,2.5"}},
        {"scene", {"scene_hash", "abd"}},
        {"lighting", {"lighting", "124"}}};
    for (const auto& [what, change] : cases) {
        other(change.first, change.second);
        expect_refused(compare("a.exr", "b.exr"), 3, std::string("--allow-different ") + what);
        const auto allowed = compare("a.exr", "b.exr", std::string("--allow-different ") + what + " --json");
        EXPECT_EQ(allowed.status, 0) << allowed.err;
        EXPECT_NE(allowed.err.find("warning"), std::string::npos);
        EXPECT_EQ(nlohmann::json::parse(allowed.out)["different"][0]["what"], what);
    }
    // What a method is called, how long it ran, and rounding of the camera do not matter.
    for (const auto& [key, value] : {std::pair{"method", "two"},
                                     {"set.samples", "64"},
                                     {"set.resolution", "7"},
                                     {"camera.eye", "0,1.0000001,2"}}) {
        other(key, value);
        EXPECT_EQ(compare("a.exr", "b.exr").status, 0) << key;
    }
    write("foreign.exr", picture());
    EXPECT_EQ(compare("a.exr", "foreign.exr").status, 0);
    expect_refused(compare("a.exr", "foreign.exr", "--allow-different everything"), 2, "everything");
}

/// What files say of sources counts, and no longer by which parameter they were left out.
TEST_F(Compare, RefusesLightThatIsInOnePictureAlone) {
    const auto lit = [&](const std::string& name, const std::string& parts, const std::string& paths,
                         const std::string& sky) {
        write(name, picture(),
              {{"interreflect.set.paths", paths},
               {"interreflect.set.environment_light", sky},
               {"interreflect.lights",
                R"([{"source":"emissive material 'neon'","kind":"surface","parts":[)" + parts + "]}]"}});
    };
    lit("method.exr", R"("seen")", "full", "true");
    lit("truth.exr", R"("seen","direct","indirect")", "full", "true");
    expect_refused(compare("method.exr", "truth.exr"), 3,
                   "emissive material 'neon' gives direct and indirect light in " + file("truth.exr") +
                       " alone (--allow-different sources");
    EXPECT_EQ(compare("method.exr", "truth.exr", "--allow-different sources").status, 0);
    lit("matched.exr", R"("seen")", "full", "false");
    EXPECT_EQ(compare("method.exr", "matched.exr").status, 0) << "there is no environment";
    write("old.exr", picture(),
          {{"interreflect.set.paths", "full"}, {"interreflect.set.environment_light", "false"}});
    expect_refused(compare("method.exr", "old.exr"), 3, "environment_light");
    lit("direct.exr", R"("direct")", "direct", "true");
    EXPECT_EQ(compare("truth.exr", "direct.exr", "--allow-different transport").status, 0)
        << "of one scattering both have the same";
}

/// "lit" has direct light where the picture is ambient occlusion.
TEST_F(Compare, RefusesLitPicturesOfOtherLight) {
    for (const std::string method : {"hbao", "ldm-ao"}) {
        const auto render = [&](const std::string& name, const std::string& more) {
            const auto outcome = run_program(
                "render --scene 'builtin:cornell?light=0' --size 16x12 --quiet "
                "--set directions=8 --dump lit --method " +
                    method + " --out " + file(name) + " " + more,
                folder_);
            EXPECT_EQ(outcome.status, 0) << outcome.err;
        };
        render("sampled.exr", "");
        render("unsampled.exr", "--set light_samples=0");
        render("sunny.exr", "--light 'directional:direction=0,-1,0;irradiance=3'");
        EXPECT_EQ(compare("sampled.exr", "unsampled.exr").status, 0) << "occlusion is the same";
        expect_refused(compare("sampled.exr", "unsampled.exr", "--layer lit"), 3, "gives direct light in");
        expect_refused(compare("sampled.exr", "sunny.exr", "--layer lit"), 3, "lights or environment differ");
        EXPECT_EQ(compare("sampled.exr", "sampled.exr", "--layer lit").status, 0);
    }
}

TEST_F(Compare, WhereSomethingMovesTheLastFramesAreOfOneMoment) {
    const auto at = [](const char* time, const char* moment, const char* moves) {
        return ImageAttributes{
            {"interreflect.time", time}, {"interreflect.moment", moment}, {"interreflect.moves", moves}};
    };
    write("frames.exr", picture(0.1f), at("0", "0.967", "true"));
    write("truth.exr", picture(), at("0.967", "0.967", "false"));  // its own camera stands still
    write("first.exr", picture(), at("0", "0", "true"));
    EXPECT_EQ(compare("frames.exr", "truth.exr").status, 0);
    expect_refused(compare("frames.exr", "first.exr"), 3, "time is 0.967 s and 0 s");
    expect_refused(compare("frames.exr", "first.exr"), 3, "--allow-different scene");
    EXPECT_EQ(compare("frames.exr", "first.exr", "--allow-different scene").status, 0);
    // Where nothing moves, methods of many frames and of one share a truth of any time.
    write("many.exr", picture(0.1f), at("0", "1.033", "false"));
    write("one.exr", picture(0.1f), at("0", "0", "false"));
    write("shared.exr", picture(), at("1.033", "1.033", "false"));
    for (const auto* image : {"many.exr", "one.exr"}) EXPECT_EQ(compare(image, "shared.exr").status, 0);
}

TEST_F(Compare, FilesThatDoNotSayWhetherAnythingMovesAreOfOneMoment) {
    write("old.exr", picture(0.1f), {{"interreflect.time", "0"}, {"interreflect.moment", "0.5"}});
    write("older.exr", picture(), {{"interreflect.time", "0.5"}});
    write("new.exr", picture(), {{"interreflect.moment", "0.1"}, {"interreflect.moves", "false"}});
    write("foreign.exr", picture());
    EXPECT_EQ(compare("old.exr", "older.exr").status, 0);
    EXPECT_EQ(compare("old.exr", "foreign.exr").status, 0);
    expect_refused(compare("old.exr", "new.exr"), 3, "do not both say that nothing moves");
}

TEST_F(Compare, NeitherBouncesNorLightsMatterToAmbientOcclusion) {
    write("a.exr", picture(0.1f),
          {{"interreflect.set.paths", "ao"},
           {"interreflect.set.max_bounces", "1"},
           {"interreflect.lighting", "123"}});
    write("b.exr", picture(),
          {{"interreflect.set.paths", "ao"},
           {"interreflect.set.max_bounces", "5"},
           {"interreflect.lighting", "124"}});
    EXPECT_EQ(compare("a.exr", "b.exr").status, 0);
}

TEST_F(Compare, RefusesPicturesThatAreTurned) {
    const auto image = picture(0.1f);
    Image upside_down = image, on_its_side(20, 32, 1);
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 32; ++x) {
            upside_down.at(x, 19 - y) = image.at(31 - x, y);
            on_its_side.at(y, x) = image.at(x, y);
        }
    write("a.exr", image);
    write("turned.exr", upside_down);
    write("side.exr", on_its_side);
    write("small.exr", picture(0, 16, 16));
    write("colour.exr", Image(32, 20, 3, 1.0f));
    expect_refused(compare("a.exr", "turned.exr"), 3, "180°");
    EXPECT_EQ(compare("a.exr", "turned.exr", "--allow-different orientation").status, 0);
    expect_refused(compare("a.exr", "side.exr"), 3, "on its side");
    expect_refused(compare("a.exr", "small.exr"), 3, "16x16");
    expect_refused(compare("a.exr", "colour.exr"), 3, "channels");
}

TEST_F(Compare, FailsBeyondLimits) {
    write("a.exr", picture(0.1f));
    write("b.exr", picture());
    const auto status = [&](const std::string& limit) {
        return compare("a.exr", "b.exr", "--fail-above " + limit).status;
    };
    EXPECT_EQ(status("mae=0.04"), 0);
    EXPECT_EQ(status("mae=0.03"), 4);
    EXPECT_EQ(status("psnr=20"), 0);
    EXPECT_EQ(status("psnr=40"), 4);
    EXPECT_EQ(status("ssim=0.5"), 0);
    EXPECT_EQ(status("ssim=0.9999"), 4);
    EXPECT_EQ(status("flip=0.9"), 0);
    EXPECT_EQ(status("bias=0.04"), 0);
    EXPECT_EQ(status("bias=0.03"), 4);
    for (const auto* limit : {"0.03", "-0.03"})  // its magnitude counts, however it is written
        EXPECT_EQ(compare("b.exr", "a.exr", std::string("--fail-above bias=") + limit).status, 4);
    EXPECT_EQ(compare("b.exr", "a.exr", "--fail-above bias=0.04").status, 0);
    expect_refused(compare("a.exr", "b.exr", "--fail-above mean=1"), 2, "no error");
    expect_refused(compare("a.exr", "b.exr", "--fail-above mse=1"), 2, "mse");
    expect_refused(compare("a.exr", "b.exr", "--metric mse"), 2, "hdr-flip");
}

TEST_F(Compare, WritesNoDifferenceOverAPicture) {
    write("a.exr", picture(0.1f));
    write("b.exr", picture());
    const auto before = read(file("b.exr"));
    fs::create_symlink(file("b.exr"), file("link.exr"));
    for (const auto* target : {"b.exr", "link.exr"})
        expect_refused(compare("a.exr", "b.exr", "--diff " + file(target)), 2, "is the file of REFERENCE");
    EXPECT_EQ(read(file("b.exr")), before);
}

}  // namespace
}  // namespace ir
