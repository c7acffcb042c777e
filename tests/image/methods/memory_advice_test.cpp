// What a frame that does not fit tells to change is what makes it smaller.
#include <regex>

#include "renderers/core/error.h"
#include "tests/image/methods/every_method.h"

namespace ir::test {
namespace {

class MemoryAdvice : public testing::Test {
  protected:
    static void TearDownTestSuite() { machines().clear(); }

    /// The message under a budget that nothing fits.
    static std::string refusal(const engine::Experiment& experiment) {
        engine::Execution execution(machine(), experiment);
        graph::FrameOptions options;
        options.wanted = {"*"};
        options.memory_budget = 1;
        try {
            execution.run_frame(options);
        } catch (const BudgetError& error) {
            return error.what();
        }
        return {};
    }
    static std::string needed(const std::string& message) {
        std::smatch found;
        return std::regex_search(message, found, std::regex(" needs ([^,]*), more than")) ? found[1].str()
                                                                                          : "";
    }
};

TEST_F(MemoryAdvice, OfEveryMethodMakesTheFrameAsSmallAsItSays) {
    const std::regex change(
        "(?:lower|raise) (?:'([a-z_]+)'|the image size) to ([0-9.x]+) \\(then ([^)]*)\\)");
    for (const auto* m : methods::all_methods()) {
        SCOPED_TRACE(m->description.id);
        engine::Experiment experiment;
        experiment.scene = scenes.front();
        experiment.method = m->description.id;
        experiment.width = 200, experiment.height = 150;
        const auto message = refusal(experiment);
        int changes = 0;
        for (std::sregex_iterator i(message.begin(), message.end(), change), end; i != end; ++i, ++changes) {
            auto changed = experiment;
            const auto key = (*i)[1].str(), value = (*i)[2].str();
            if (key.empty())
                changed.width = 100, changed.height = 75;
            else
                changed.settings[key] = find(m->description.parameters, key)->parse(value);
            EXPECT_EQ(needed(refusal(changed)), (*i)[3].str()) << message;
            EXPECT_NE(needed(message), (*i)[3].str()) << message;
        }
        EXPECT_GT(changes, 0) << message;
    }
}

}  // namespace
}  // namespace ir::test
