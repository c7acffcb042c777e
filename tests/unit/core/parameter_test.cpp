#include "renderers/core/parameter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "renderers/core/error.h"
#include "renderers/core/transport.h"

namespace ir {
namespace {

struct Fog {
    enum class Model { thin, thick, solid };
    bool jitter = true;
    int samples = 16;
    float density = 0.1f;
    double weight = 0.1;
    Model model = Model::thick;
    Transport transport;
};

ParameterTable<Fog> fog_table() {
    ParameterTable<Fog> table;
    table.add(&Fog::jitter, {.key = "jitter", .label = "Jitter", .doc = ""})
        .add(&Fog::samples, {.key = "samples", .label = "Samples", .doc = "", .hard = {1, 64}})
        .add(&Fog::density, {.key = "density", .label = "Density", .doc = "", .unit = "1/m", .hard = {0, 10}})
        .add(&Fog::weight, {.key = "weight", .label = "Weight", .doc = "", .hard = {0}})
        .add(&Fog::model, {.key = "model",
                           .label = "Model",
                           .doc = "",
                           .choices = {{"thin", "", ""}, {"thick", "", ""}, {"solid", "", ""}},
                           .supported = {"thin", "thick"},
                           .active_when = {"jitter", {true}}})
        .include(&Fog::transport, transport_parameters({{"ao", "direct"}, {"max_distance", "falloff"}}));
    return table;
}

ParameterDescription described(const std::string& key) {
    for (const auto& parameter : fog_table().descriptions())
        if (parameter.key == key) return parameter;
    throw Error("no parameter " + key);
}

std::string refusal(const std::function<void()>& action) {
    try {
        action();
    } catch (const UsageError& error) {
        return error.what();
    }
    return "nothing was refused";
}

TEST(AsWritten, IsTheShortestDecimalOfAFloat) {
    EXPECT_EQ(as_written(0.1f), 0.1);
    EXPECT_EQ(as_written(0.78539816f), 0.7853982);
    EXPECT_EQ(as_written(-2.5e-7f), -2.5e-7);
    EXPECT_EQ(as_written(0.25f), 0.25);
    EXPECT_EQ(as_written(1e30f), 1e30);
    EXPECT_TRUE(std::isinf(as_written(INFINITY)));
    EXPECT_TRUE(std::isnan(as_written(NAN)));
    EXPECT_EQ(as_written(0.10000000149011612), 0.10000000149011612) << "doubles are left alone";
}

TEST(AsWritten, ReadsBackBitForBit) {
    // Every 65521st pattern of bits, subnormal numbers included.
    for (std::uint64_t bits = 0; bits < 0x7f800000u; bits += 65521) {
        const auto pattern = static_cast<std::uint32_t>(bits);
        float number;
        std::memcpy(&number, &pattern, sizeof number);
        ASSERT_EQ(static_cast<float>(as_written(number)), number) << pattern;
        ASSERT_EQ(static_cast<float>(as_written(-number)), -number) << pattern;
    }
}

TEST(ParameterTable, TakesTypesAndDefaultsFromTheMembers) {
    EXPECT_EQ(described("jitter").type, ParameterType::toggle);
    EXPECT_EQ(described("samples").type, ParameterType::integer);
    EXPECT_EQ(described("density").type, ParameterType::number);
    EXPECT_EQ(described("model").type, ParameterType::choice);
    EXPECT_EQ(described("jitter").default_value, Value{true});
    EXPECT_EQ(described("samples").default_value, Value{std::int64_t{16}});
    EXPECT_EQ(described("density").default_value, Value{0.1}) << "a float default is what was written";
    EXPECT_EQ(described("weight").default_value, Value{0.1});
    EXPECT_EQ(described("model").default_value, Value{std::string("thick")});
}

TEST(ParameterTable, StructsAndSettingsRoundTrip) {
    Fog fog;
    fog.jitter = false;
    fog.samples = 7;
    fog.density = 0.3f;
    fog.weight = 1.0 / 3;
    fog.model = Fog::Model::thin;
    fog.transport.paths = Transport::Paths::direct;
    fog.transport.max_distance = 1.7f;
    fog.transport.falloff = Transport::Falloff::smooth;
    const auto settings = fog_table().settings(fog);
    EXPECT_EQ(settings.size(), 8u);
    EXPECT_EQ(settings.at("density"), Value{0.3});
    EXPECT_EQ(settings.at("falloff"), Value{std::string("smooth")});
    const Fog back = fog_table().typed(settings);
    EXPECT_EQ(back.jitter, false);
    EXPECT_EQ(back.samples, 7);
    EXPECT_EQ(back.density, 0.3f);
    EXPECT_EQ(back.weight, 1.0 / 3);
    EXPECT_EQ(back.model, Fog::Model::thin);
    EXPECT_EQ(back.transport.paths, Transport::Paths::direct);
    EXPECT_EQ(back.transport.max_distance, 1.7f);
    EXPECT_EQ(back.transport.falloff, Transport::Falloff::smooth);
    EXPECT_EQ(fog_table().settings(back), settings);
}

TEST(ParameterTable, TypedKeepsDefaultsOfWhatIsNotGivenAndChecksTheRest) {
    const Fog fog = fog_table().typed({{"samples", std::int64_t{3}}});
    EXPECT_EQ(fog.samples, 3);
    EXPECT_EQ(fog.density, 0.1f);
    EXPECT_THROW(fog_table().typed({{"samples", std::int64_t{65}}}), UsageError);
}

TEST(Coarse, NumbersAreAtMostTheCoarseValueAndOthersAreIt) {
    ParameterDescription samples, fast;
    samples.key = "samples";
    samples.type = ParameterType::integer;
    samples.default_value = std::int64_t{64};
    samples.coarse = std::int64_t{4};
    fast.key = "fast";
    fast.default_value = false;
    fast.coarse = true;
    const std::vector<ParameterDescription> all = {samples, fast};
    EXPECT_EQ(coarse(all, defaults(all)), (Settings{{"samples", std::int64_t{4}}, {"fast", true}}));
    EXPECT_EQ(coarse(all, {{"samples", std::int64_t{2}}, {"fast", true}}),
              (Settings{{"samples", std::int64_t{2}}, {"fast", true}}));
}

TEST(ParameterTable, OnlyKeepsTheNamedEntriesAndRestrictsOneChoice) {
    const auto few = fog_table().only({"model", "samples"}, "model", {"solid"}).descriptions();
    ASSERT_EQ(few.size(), 2u);
    EXPECT_EQ(few[0].key, "samples");
    EXPECT_EQ(few[1].key, "model");
    EXPECT_EQ(few[1].supported, std::vector<std::string>{"solid"});
    EXPECT_EQ(few[1].choices.size(), 3u) << "the order of the enum's values stays";
    EXPECT_EQ(few[1].choice_index("solid"), 2);
    EXPECT_THROW(few[1].checked(std::string("thin")), UsageError);
}

TEST(Checked, HardRangesIncludeTheirEnds) {
    const auto samples = described("samples"), density = described("density"), weight = described("weight");
    EXPECT_EQ(samples.checked(std::int64_t{1}), Value{std::int64_t{1}});
    EXPECT_EQ(samples.checked(std::int64_t{64}), Value{std::int64_t{64}});
    EXPECT_THROW(samples.checked(std::int64_t{0}), UsageError);
    EXPECT_THROW(samples.checked(std::int64_t{65}), UsageError);
    EXPECT_EQ(density.checked(10.0), Value{10.0});
    EXPECT_THROW(density.checked(std::nextafter(10.0, 11.0)), UsageError);
    EXPECT_THROW(density.checked(-1e-9), UsageError);
    EXPECT_EQ(weight.checked(1e300), Value{1e300}) << "no upper end was given";
    EXPECT_THROW(weight.checked(std::nan("")), UsageError);
    EXPECT_THROW(weight.checked(std::numeric_limits<double>::infinity()), UsageError);
}

TEST(Checked, NumbersConvertWithoutLossOnly) {
    EXPECT_EQ(described("samples").checked(8.0), Value{std::int64_t{8}});
    EXPECT_THROW(described("samples").checked(8.5), UsageError);
    EXPECT_EQ(described("density").checked(std::int64_t{2}), Value{2.0});
    EXPECT_THROW(described("density").checked(true), UsageError);
    EXPECT_THROW(described("density").checked(std::string("2")), UsageError);
    EXPECT_THROW(described("jitter").checked(std::int64_t{1}), UsageError);
}

TEST(Checked, ChoicesAreThoseThatTheMethodSupports) {
    const auto model = described("model");
    EXPECT_EQ(model.checked(std::string("thin")), Value{std::string("thin")});
    for (const char* key : {"solid", "Thin", ""})
        EXPECT_THROW(model.checked(std::string(key)), UsageError) << key;
    EXPECT_THROW(model.checked(std::int64_t{0}), UsageError);
}

TEST(Checked, RefusalsNameKeyValueAndWhatIsAllowed) {
    EXPECT_EQ(refusal([] { described("samples").checked(std::int64_t{99}); }),
              "parameter 'samples': '99' is not allowed; give an integer from 1 to 64");
    EXPECT_EQ(refusal([] { described("density").checked(-1.0); }),
              "parameter 'density': '-1' is not allowed; give a number from 0 to 10 (1/m)");
    EXPECT_EQ(refusal([] { described("weight").checked(-1.0); }),
              "parameter 'weight': '-1' is not allowed; give a number of at least 0");
    EXPECT_EQ(refusal([] { described("model").checked(std::string("solid")); }),
              "parameter 'model': 'solid' is not allowed; give one of thin, thick");
}

TEST(Parse, ReadsTextOfEveryType) {
    for (const char* text : {"true", "on", "1"}) EXPECT_EQ(described("jitter").parse(text), Value{true});
    for (const char* text : {"false", "off", "0"}) EXPECT_EQ(described("jitter").parse(text), Value{false});
    EXPECT_EQ(described("samples").parse("12"), Value{std::int64_t{12}});
    EXPECT_EQ(described("density").parse("2.5e-1"), Value{0.25});
    EXPECT_EQ(described("density").parse("3"), Value{3.0});
    EXPECT_EQ(described("model").parse("thin"), Value{std::string("thin")});
}

TEST(Parse, RefusesWhatIsNotWhollyAValue) {
    for (const char* text : {"", "yes", "TRUE", "2"})
        EXPECT_THROW(described("jitter").parse(text), UsageError) << text;
    for (const char* text : {"", "x", "12x", " 12", "1.5", "1e1", "99999999999999999999"})
        EXPECT_THROW(described("samples").parse(text), UsageError) << text;
    for (const char* text : {"", "x", "1,5", "1.5m", "nan", "inf", "11"})
        EXPECT_THROW(described("density").parse(text), UsageError) << text;
    EXPECT_THROW(described("model").parse("solid"), UsageError);
}

TEST(Completed, FillsInDefaultsAndListsKnownKeys) {
    const auto parameters = fog_table().descriptions();
    const auto settings = completed(parameters, {{"samples", std::int64_t{2}}});
    EXPECT_EQ(settings.size(), parameters.size());
    EXPECT_EQ(settings.at("samples"), Value{std::int64_t{2}});
    EXPECT_EQ(settings.at("density"), Value{0.1});
    EXPECT_EQ(defaults(parameters), completed(parameters, {}));
    EXPECT_EQ(refusal([&] {
                  completed(parameters, {{"depth", 1.0}});
              }),
              "unknown parameter 'depth'; known are jitter, samples, density, weight, model, paths, "
              "max_distance, falloff");
}

TEST(ActiveWhen, DependsOnTheOtherParametersValue) {
    const auto parameters = fog_table().descriptions();
    const auto model = described("model");
    EXPECT_TRUE(is_active(described("samples"), {})) << "without a condition always";
    EXPECT_TRUE(is_active(model, completed(parameters, {{"jitter", true}})));
    EXPECT_FALSE(is_active(model, completed(parameters, {{"jitter", false}})));
    EXPECT_FALSE(is_active(model, {})) << "the parameter it depends on is not there";
}

TEST(TransportGroup, HoldsWhatAMethodSupports) {
    const auto parameters = transport_parameters({{"ao", "direct"}, {"max_distance", "falloff"}});
    const auto descriptions = parameters.descriptions();
    ASSERT_EQ(descriptions.size(), 3u);
    EXPECT_EQ(descriptions[0].key, "paths") << "always there";
    EXPECT_EQ(descriptions[0].checked(std::string("direct")), Value{std::string("direct")});
    EXPECT_THROW(descriptions[0].checked(std::string("full")), UsageError);
    EXPECT_EQ(find(descriptions, "min_bounces"), nullptr);
}

TEST(TransportGroup, DefaultsComeFromTheMethodsOwnMember) {
    struct Method {
        Transport transport{.paths = Transport::Paths::full, .max_bounces = 5};
    };
    ParameterTable<Method> table;
    table.include(&Method::transport, transport_parameters({{"full"}, {"min_bounces", "max_bounces"}}));
    const auto descriptions = table.descriptions();
    EXPECT_EQ(find(descriptions, "paths")->default_value, Value{std::string("full")});
    EXPECT_EQ(find(descriptions, "max_bounces")->default_value, Value{std::int64_t{5}});
    EXPECT_TRUE(is_active(*find(descriptions, "max_bounces"), defaults(descriptions)));
    EXPECT_FALSE(is_active(*find(descriptions, "max_bounces"), {{"paths", std::string("direct")}}));
}

TEST(TransportGroup, KnowsItsKeysWhateverAMethodSupports) {
    for (const char* key : {"paths", "min_bounces", "max_bounces", "max_distance", "falloff", "materials",
                            "normal_maps", "environment_light", "emitters"})
        EXPECT_TRUE(is_transport_key(key)) << key;
    EXPECT_FALSE(is_transport_key("samples"));
    EXPECT_FALSE(is_transport_key(""));
}

}  // namespace
}  // namespace ir
