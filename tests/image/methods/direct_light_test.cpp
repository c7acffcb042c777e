// Direct light of sources with an extent in whole rooms, by every method that has it, against the reference.
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "tests/image/methods/every_method.h"

namespace ir::test {
namespace {

const graph::Method* reference_method() {
    for (const auto* method : methods::all_methods())
        if (method->description.is_reference) return method;
    return nullptr;
}

bool has_direct_paths(const MethodDescription& method) {
    const auto* paths = find(method.parameters, "paths");
    if (!paths || !find(method.parameters, "light_samples")) return false;
    return std::ranges::find(paths->supported, "direct") != paths->supported.end();
}

std::vector<std::string> rooms() {
    std::vector<std::string> all{"builtin:cornell"};
    if (const char* folder = std::getenv("INTERREFLECT_SCENES")) {
        const auto file = std::filesystem::path(folder) / "rooms" / "cornell-box" / "cornell-box.glb";
        if (std::filesystem::exists(file)) all.push_back(file.string());
    }
    return all;
}

double luminance(const float* rgb) {
    return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

/// Mean over valid pixels, and the standard error of it.
struct Mean {
    double value = 0, error = 0;
};

Mean mean_of(const Frame& frame, const std::string& variance) {
    double sum = 0, squares = 0;
    std::size_t count = 0;
    const auto& noise = frame.images.at(variance).front().pixels;
    const auto pixels = frame.valid.pixels.size();
    for (std::size_t i = 0; i < pixels; ++i) {
        if (frame.valid.pixels[i] < 0.5f) continue;
        sum += luminance(&frame.main.pixels[4 * i]);
        if (noise.size() == pixels)
            squares += noise[i];
        else
            squares += std::pow(0.2126 * std::sqrt(noise[4 * i]) + 0.7152 * std::sqrt(noise[4 * i + 1]) +
                                    0.0722 * std::sqrt(noise[4 * i + 2]),
                                2);
        ++count;
    }
    const auto n = static_cast<double>(count);
    return {sum / n, std::sqrt(squares) / n};
}

TEST(DirectLight, OfRoomsAsTheyComeIsTheReferences) {
    const Shot shot{.frames = 4, .size = {48, 48}};
    int compared = 0;
    for (const auto& room : rooms()) {
        auto in_room = shot;
        in_room.scene = room;
        const auto& reference = *reference_method();
        auto matched = with(defaults(reference.description.parameters),
                            {{"paths", std::string("direct")}, {"samples", std::int64_t{128}}});
        const auto expected = mean_of(render(reference, matched, in_room), "reference.variance");
        ASSERT_GT(expected.value, 0.01) << room;
        for (const auto* method : methods::all_methods()) {
            if (!has_direct_paths(method->description)) continue;
            const auto settings =
                with(quick_settings(method->description), {{"paths", std::string("direct")},
                                                           {"light_samples", std::int64_t{64}},
                                                           {"light_filter", false}});
            const auto found = mean_of(render(*method, settings, in_room), "direct.extended.variance");
            const double tolerance = 4 * std::hypot(found.error, expected.error) + 2e-3 * expected.value;
            EXPECT_NEAR(found.value, expected.value, tolerance) << method->description.id << " in " << room;
            const auto filtered = mean_of(render(*method, with(settings, {{"light_filter", true}}), in_room),
                                          "direct.extended.variance");
            EXPECT_NEAR(filtered.value / expected.value, 1, 0.02) << method->description.id << " in " << room;
            ++compared;
        }
    }
    EXPECT_GE(compared, 3) << "photon-mapping, ldm-indirect and ssdo at least";
}

}  // namespace
}  // namespace ir::test
