#include "renderers/passes/scan/scan.h"

#include <cstring>
#include <numeric>
#include <random>

#include "renderers/graph/pass_context.h"
#include "tests/unit/passes/pass_fixture.h"

namespace ir::test {
namespace {

using Words = std::vector<std::uint32_t>;

class Scan : public PassTest {
  protected:
    struct Result {
        Words places;
        double total = 0;
    };

    /// `items` may be more than there are counts.
    Result scan(const Words& counts, std::size_t items) {
        const auto report = run(shot_, [&](graph::GraphBuilder& builder) {
            graph::BufferDesc desc;
            desc.text.key = "test.counts";
            desc.fields = {{"count", FieldType::u32}};
            desc.elements = counts.size();
            const auto words = builder.buffer(desc);
            const auto total = builder.counter({.key = "test.total", .label = "Total"});
            builder.pass("upload").writes(words).execute([&counts, words](graph::PassContext& context) {
                context.upload(words, std::as_bytes(std::span(counts)));
            });
            const auto places = passes::exclusive_scan(builder, "test", words, items, total);
            EXPECT_EQ(builder.buffers()[static_cast<std::size_t>(places.index)].text.key, "test.places");
        });
        const auto bytes = graph().read_buffer("test.places").value();
        Result result{Words(items), report.counters.at("test.total")};
        if (items > 0) std::memcpy(result.places.data(), bytes.data(), std::min(bytes.size(), items * 4));
        return result;
    }

    static Words random_counts(std::size_t size, std::uint32_t most, unsigned seed) {
        std::mt19937 random(seed);
        std::uniform_int_distribution<std::uint32_t> word(0, most);
        Words counts(size);
        for (auto& count : counts) count = word(random);
        return counts;
    }

    static Words expected(const Words& counts) {
        Words places(counts.size());
        std::exclusive_scan(counts.begin(), counts.end(), places.begin(), 0u);
        return places;
    }

  private:
    Shot shot_{"builtin:cornell", "", 8, 6};
};

TEST_F(Scan, SumsWhatIsBeforeEachItem) {
    // around a work group, a tile of 2048, and more tiles than one work group scans at once
    for (const std::size_t size : {0, 1, 255, 256, 257, 2047, 2048, 2049, 1'000'000, 4'200'001}) {
        const auto counts = random_counts(size, 100, static_cast<unsigned>(size) + 1);
        const auto result = scan(counts, size);
        ASSERT_EQ(result.places, expected(counts)) << size;
        EXPECT_EQ(result.total, std::accumulate(counts.begin(), counts.end(), 0.0)) << size;
    }
}

TEST_F(Scan, ItemsWithoutCountsCountNothing) {
    auto counts = random_counts(3000, 7, 1);
    const auto result = scan(counts, 5000);
    counts.resize(5000);
    EXPECT_EQ(result.places, expected(counts));
    EXPECT_EQ(result.total, std::accumulate(counts.begin(), counts.end(), 0.0));
}

TEST_F(Scan, RefusesMoreItemsThanTheCountsOfTilesAreMadeFor) {
    EXPECT_THROW(scan({1}, (std::size_t{1} << 26) + 1), std::logic_error);
}

}  // namespace
}  // namespace ir::test
