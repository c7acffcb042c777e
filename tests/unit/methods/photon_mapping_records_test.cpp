#include "renderers/core/record.h"
#include "shaders/methods/photon-mapping/records.glsl.h"
#include "tests/unit/methods/photon_mapping_packing.h"

#include <cmath>
#include <cstring>
#include <glm/gtc/constants.hpp>
#include <random>

#include "renderers/gl/dispatch_items.h"
#include "renderers/graph/pass_context.h"
#include "tests/unit/passes/pass_fixture.h"

namespace ir::test {
namespace {

using namespace methods::photon_mapping;

/// Relative to the largest channel. Its mantissa has 256 to 511 steps, so that half a step is at most 2^-9 of
/// it; from 511.5 steps on it is rounded up to 512, steps are twice as long, and half of one is 1/511.5.
/// (2^-10 is what a largest channel with all nine bits set loses.)
constexpr double power_bound = 1 / 511.5 + 1e-7;
/// Projected halves lie at most 1 from 0, so that each is rounded by up to 2^-12. A stereographic projection
/// is conformal: the angle is 2 |dp| / (1 + p²), at most where both coordinates are just above 1/2. The rest
/// is float arithmetic.
const double direction_bound_degrees = 2 * std::sqrt(2.0) * 0x1p-12 / 1.5 * 180 / glm::pi<double>() + 1e-4;

double power_error(glm::vec3 power, glm::vec3 unpacked) {
    const glm::dvec3 difference = glm::abs(glm::dvec3(power) - glm::dvec3(unpacked));
    return std::max({difference.r, difference.g, difference.b}) / std::max({power.r, power.g, power.b});
}

double angle_degrees(glm::vec3 a, glm::vec3 b) {
    const glm::dvec3 x(a), y(b);
    return std::atan2(glm::length(glm::cross(x, y)), glm::dot(x, y)) * 180 / glm::pi<double>();
}

/// As a photon: what goes in, what the record holds, and what comes out of it on the device.
struct Trip {
    glm::vec3 power;
    std::uint32_t power_bits;
    glm::vec3 direction;
    std::uint32_t direction_bits;
    glm::vec3 power_out;
    std::uint32_t below;
    glm::vec3 direction_out;
    std::uint32_t unused;
    IR_FIELDS(power, power_bits, direction, direction_bits, power_out, below, direction_out, unused)
};

Trip trip(glm::vec3 power, glm::vec3 direction) {
    Trip result{};
    result.power = power;
    result.direction = direction;
    return result;
}

/// Powers over five decades around a unit, each channel its own; directions over the sphere.
std::vector<Trip> random_trips(std::size_t count) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> unit(0, 1), cosine(-1, 1), turn(0, glm::two_pi<float>());
    std::vector<Trip> trips(count);
    for (auto& trip : trips) {
        trip.power = std::pow(10.0f, 5 * unit(random) - 3) * glm::vec3(unit(random), unit(random), 1);
        const float z = cosine(random), phi = turn(random), r = std::sqrt(1 - z * z);
        trip.direction = {r * std::cos(phi), r * std::sin(phi), z};
    }
    return trips;
}

class PhotonRecords : public PassTest {
  protected:
    /// Packs and unpacks on the device.
    std::vector<Trip> on_device(const std::vector<Trip>& trips) {
        const Shot shot("builtin:cornell", "", 8, 6);
        run(shot, [&](graph::GraphBuilder& builder) {
            graph::BufferDesc desc;
            desc.text.key = "test.trips";
            desc.fields = record_fields<Trip>();
            desc.elements = trips.size();
            const auto buffer = builder.buffer(desc);
            builder.pass("upload").writes(buffer).execute([&trips, buffer](graph::PassContext& context) {
                context.upload(buffer, std::as_bytes(std::span(trips)));
            });
            builder.pass("round trip")
                .writes("Trips", buffer)
                .execute_sliced(static_cast<std::int64_t>(trips.size()), [=](graph::PassContext& context,
                                                                             graph::Slice slice) {
                    const auto& program =
                        context.use({{SOURCE_ROOT "/tests/data/shaders/photon_round_trip.comp"}});
                    gl::dispatch_items(program, slice.begin, slice.end);
                });
        });
        const auto bytes = graph().read_buffer("test.trips").value();
        std::vector<Trip> result(trips.size());
        std::memcpy(result.data(), bytes.data(), bytes.size());
        return result;
    }
};

TEST_F(PhotonRecords, ThreeMillionPhotonsKeepPowerAndDirection) {
    const auto trips = on_device(random_trips(3'000'000));
    double worst_power = 0, worst_direction = 0, worst_host_direction = 0;
    std::size_t other_powers = 0, other_halves = 0;
    for (const auto& t : trips) {
        worst_power = std::max(worst_power, power_error(t.power, t.power_out));
        worst_direction = std::max(worst_direction, angle_degrees(t.direction, t.direction_out));
        other_powers += packed_power(t.power) != t.power_bits;
        const auto host = packed_stereographic(t.direction);
        other_halves += host.xy != t.direction_bits;
        ASSERT_EQ(host.below, t.below != 0);
        ASSERT_EQ(unpacked_power(t.power_bits), t.power_out);
        const auto out = unpacked_stereographic(t.direction_bits, t.below != 0);
        // A card's driver may unpack what it packed a moment ago without rounding it to halves.
        ASSERT_LT(glm::distance(out, t.direction_out), device().software() ? 1e-6f : 1e-3f);
        worst_host_direction = std::max(
            worst_host_direction, angle_degrees(t.direction, unpacked_stereographic(host.xy, host.below)));
    }
    EXPECT_EQ(other_powers, 0u);
    EXPECT_LE(worst_power, power_bound);
    EXPECT_GT(worst_power, 0x1p-10) << "the bound is that of the format, not twice as good";
    EXPECT_LE(worst_direction, direction_bound_degrees);
    EXPECT_LE(worst_host_direction, direction_bound_degrees);
    EXPECT_LT(other_halves, 3000u) << "glm rounds ties away from 0, the device to even";
    RecordProperty("worst_power", std::to_string(worst_power));
    RecordProperty("worst_direction_degrees", std::to_string(worst_direction));
}

TEST_F(PhotonRecords, OneWattInThreeMillionPhotonsNeedsPowerUnits) {
    // 1 W in 3 M photons of a saturated colour, as each photon carries it
    const float unit = 1 / 3e6f;
    std::mt19937 random(2);
    std::uniform_real_distribution<float> share(0.5f, 1.5f);
    double worst_units = 0, worst_watts = 0;
    for (int i = 0; i < 100'000; ++i) {
        const glm::vec3 power = share(random) * glm::vec3(1, 0.5f, 0.1f);
        worst_units = std::max(worst_units, power_error(power, unpacked_power(packed_power(power))));
        const auto watts = unit * power;
        worst_watts = std::max(worst_watts, power_error(watts, unpacked_power(packed_power(watts))));
    }
    EXPECT_LE(worst_units, power_bound);
    EXPECT_GT(worst_watts, 0.08) << "half of a step of 2^-24 W is 9 % of a photon's 3.3e-7 W";
}

TEST_F(PhotonRecords, PowersAtTheEndsOfTheRange) {
    const float nan = std::nanf(""), infinity = INFINITY;
    const glm::vec3 given[] = {{0, 0, 0},          {-1, -2, -0.0f},       {nan, 1, nan},     {65408, 1, 0},
                               {65409, 0, 0},      {infinity, 0, -1e30f}, {0x1p-24f, 0, 0},  {0x1p-26f, 0, 0},
                               {0x1p-15f, 0, 0},   {511.75f, 0, 0},       {1023.5f, 512, 0}, {1e-40f, 0, 0},
                               {0.25f, 0.5f, 1.0f}};
    const glm::vec3 expected[] = {{0, 0, 0},          {0, 0, 0},     {0, 1, 0},        {65408, 0, 0},
                                  {65408, 0, 0},      {65408, 0, 0}, {0x1p-24f, 0, 0}, {0, 0, 0},
                                  {0x1p-15f, 0, 0},   {512, 0, 0},   {1024, 512, 0},   {0, 0, 0},
                                  {0.25f, 0.5f, 1.0f}};
    std::vector<Trip> trips;
    for (const auto& power : given) trips.push_back(trip(power, {0, 0, 1}));
    const auto out = on_device(trips);
    for (std::size_t i = 0; i < std::size(given); ++i) {
        EXPECT_EQ(unpacked_power(packed_power(given[i])), expected[i]) << i;
        EXPECT_EQ(out[i].power_out, expected[i]) << i;
        EXPECT_EQ(out[i].power_bits, packed_power(given[i])) << i;
    }
}

TEST_F(PhotonRecords, AxesAndTheSeamOfHemispheres) {
    std::vector<Trip> trips;
    for (const float z : {-1.0f, -0.0f, 0.0f, 1e-7f, -1e-7f, 1.0f})
        for (int i = 0; i < 8; ++i) {
            const float r = std::sqrt(1 - z * z), phi = glm::quarter_pi<float>() * static_cast<float>(i);
            trips.push_back(trip({1, 1, 1}, {r * std::cos(phi), r * std::sin(phi), z}));
        }
    for (const auto& t : on_device(trips)) {
        EXPECT_LE(angle_degrees(t.direction, t.direction_out), direction_bound_degrees);
        EXPECT_NEAR(glm::length(t.direction_out), 1, 1e-6);
        const auto host = packed_stereographic(t.direction);
        EXPECT_LE(angle_degrees(t.direction, unpacked_stereographic(host.xy, host.below)),
                  direction_bound_degrees);
    }
}

/// What a field list says must be what the struct holds.
TEST(PhotonRecordFields, FillTheRecord) {
    const auto expect_bytes = [](const std::vector<Field>& fields, int bytes) {
        int words = 0;
        for (const auto& field : fields) words += field.count;
        EXPECT_EQ(words * 4, bytes);
        EXPECT_EQ(fields.front().name, "position");
    };
    expect_bytes(record_fields<SamplePoint>(), 48);
    expect_bytes(record_fields<Photon>(), 32);
}

}  // namespace
}  // namespace ir::test
