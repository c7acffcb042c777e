#include "renderers/core/light_use.h"

#include <gtest/gtest.h>

#include <string>

#include "renderers/core/describe.h"
#include "renderers/core/transport.h"
#include "tests/processor_time.h"

namespace ir {
namespace {

using enum LightKind;
using enum LightPart;

struct Parameters {
    int samples = 1;
    Transport transport{.paths = Transport::Paths::full};
};

MethodDescription method(const std::vector<std::string>& keys, std::vector<MissingLight> missing = {}) {
    ParameterTable<Parameters> table;
    table.include(&Parameters::transport, transport_parameters({{"ao", "direct", "indirect", "full"}, keys}));
    MethodDescription result;
    result.parameters = table.descriptions();
    result.missing_light = std::move(missing);
    return result;
}

Settings paths(const std::string& value, Settings more = {}) {
    more["paths"] = value;
    return more;
}

const MethodDescription& truth() {
    static const auto result = method({"environment_light", "emitters"});
    return result;
}

Settings closest(const MethodDescription& to, const Settings& settings) {
    return with_light_use(truth(), completed(truth().parameters, paths("full")),
                          light_use(to, completed(to.parameters, settings)));
}

TEST(LightUse, FollowsPathsAndChoiceOfSources) {
    const auto of = [](const Settings& settings) {
        return light_use(truth(), completed(truth().parameters, settings));
    };
    const auto all = of(paths("full"));
    for (const auto kind : {punctual, lamp, surface, environment}) {
        EXPECT_TRUE(all.has(direct, kind) && all.has(indirect, kind));
        EXPECT_FALSE(of(paths("ao")).has(direct, kind));
        EXPECT_FALSE(of(paths("direct")).has(indirect, kind));
    }
    const auto none = of(paths("full", {{"emitters", "none"}}));
    EXPECT_TRUE(none.has(seen, surface)) << "a surface stays a surface";
    EXPECT_FALSE(none.has(seen, lamp));
    EXPECT_FALSE(none.has(direct, surface) || none.has(direct, lamp));
    EXPECT_TRUE(none.has(indirect, environment) && none.has(indirect, punctual));
    const auto once = of(paths("full", {{"emitters", "direct"}}));
    EXPECT_TRUE(once.has(seen, lamp) && once.has(direct, surface) && once.has(direct, environment));
    EXPECT_FALSE(once.has(indirect, surface) || once.has(indirect, environment));
    EXPECT_TRUE(once.has(indirect, punctual));
    EXPECT_FALSE(of(paths("full", {{"environment_light", false}})).has(direct, environment));
}

TEST(LightUse, TheReferenceLeavesOutWhatAMethodLacks) {
    const MissingLight no_lamps{{seen, direct, indirect}, {lamp}};
    const auto punctual_only = method({}, {no_lamps, {{direct, indirect}, {surface, environment}}});
    auto values = closest(punctual_only, paths("full"));
    EXPECT_EQ(values.at("emitters"), Value{std::string("none")});
    EXPECT_EQ(values.at("environment_light"), Value{false});
    const auto with_sky = method({"environment_light"}, {no_lamps, {{direct, indirect}, {surface}}});
    values = closest(with_sky, paths("full"));
    EXPECT_EQ(values.at("emitters"), Value{std::string("none")});
    EXPECT_EQ(values.at("environment_light"), Value{true});
    EXPECT_EQ(closest(with_sky, paths("full", {{"environment_light", false}})).at("environment_light"),
              Value{false});
    const auto no_bounces = method({}, {{{indirect}, {lamp, surface, environment}}});
    values = closest(no_bounces, paths("full"));
    EXPECT_EQ(values.at("emitters"), Value{std::string("direct")});
    EXPECT_EQ(values.at("environment_light"), Value{true});
    EXPECT_EQ(closest(method({}), paths("full")).at("emitters"), Value{std::string("all")});
}

TEST(LightUse, WhatIsMissingMayDependOnSettings) {
    const auto sometimes = method({"falloff"}, {{{direct}, {surface}, {{"falloff", {std::string("hard")}}}}});
    const auto misses = [&](const std::string& falloff) {
        return !light_use(sometimes, completed(sometimes.parameters, paths("full", {{"falloff", falloff}})))
                    .has(direct, surface);
    };
    EXPECT_TRUE(misses("hard"));
    EXPECT_FALSE(misses("smooth"));
}

TEST(LightUse, WhatIsMissingMayDependOnSeveralSettings) {
    const auto sometimes =
        method({"falloff", "normal_maps"},
               {{{direct}, {surface}, {{"falloff", {std::string("hard")}}, {"normal_maps", {false}}}}});
    for (const bool has_maps : {true, false})
        for (const char* falloff : {"hard", "smooth"}) {
            const auto settings = completed(sometimes.parameters,
                                            paths("full", {{"falloff", falloff}, {"normal_maps", has_maps}}));
            EXPECT_EQ(light_use(sometimes, settings).has(direct, surface),
                      has_maps || falloff == std::string("smooth"));
        }
    EXPECT_NE(describe_markdown(sometimes).find("Only where `falloff` is hard and `normal_maps` is false."),
              std::string::npos);
}

TEST(LightUse, DifferencesNameTheSource) {
    const std::vector<UsedLight> a{{{lamp, "rectangle light 'desk'"}, {seen, direct, indirect}},
                                   {{punctual, "point light 1"}, {direct}}},
        b{{{punctual, "point light 1"}, {direct}},
          {{lamp, "rectangle light 'desk'"}, {direct}},
          {{environment, "the environment"}, {direct}}};
    const auto full = light_parts_of("full");
    EXPECT_EQ(light_differences(a, b, full, "A", "B"),
              std::vector<std::string>{"rectangle light 'desk' is seen and gives indirect light in A alone"});
    EXPECT_EQ(light_differences(b, a, full, "B", "A"), light_differences(a, b, full, "A", "B"));
    EXPECT_TRUE(light_differences(a, b, light_parts_of("direct"), "A", "B").empty());
}

TEST(LightUse, GoesThroughFiles) {
    const std::vector<UsedLight> lights{{{surface, "emissive material 'neon \"9\"'"}, {seen, direct}},
                                        {{environment, "the environment"}, {}}};
    EXPECT_EQ(used_lights_from_json(to_json(lights)), lights);
    for (const char* text : {"", "{}", "[1]", "[{\"source\":1,\"kind\":\"lamp\",\"parts\":[]}]",
                             "[{\"source\":\"x\",\"kind\":\"moon\",\"parts\":[]}]"})
        EXPECT_TRUE(used_lights_from_json(text).empty()) << text;
}

/// A picture of somebody else may say anything of its lights.
TEST(LightUse, AnObjectOfManyKeysIsReadQuickly) {
    std::string text = "[{\"k\":0";
    for (int i = 0; i < 200'000; ++i) text += ",\"k" + std::to_string(i) + "\":0";
    const double start = processor_seconds();
    EXPECT_TRUE(used_lights_from_json(text + "}]").empty());
    // A list that is searched for each key takes minutes.
    EXPECT_LT(processor_seconds() - start, 10);
}

}  // namespace
}  // namespace ir
