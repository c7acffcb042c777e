// States on disk, bit by bit, and executions that go on from them.
#include <ImfChannelList.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>

#include "app/engine/execution.h"
#include "app/engine/live_session.h"
#include "app/engine/pictures.h"
#include "app/engine/stored_state.h"
#include "projects/samples.h"
#include "renderers/core/error.h"
#include "tests/own_folder.h"
#include "tests/unit/engine/egl_machine.h"
#include "tests/unit/scarce_disk.h"

namespace ir::engine {
namespace {

namespace fs = std::filesystem;

class StateTest : public testing::Test {
  protected:
    void SetUp() override {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        folder = own_folder("state-" + std::string(test->name()));
        fs::remove_all(folder);
        fs::create_directories(folder);
    }
    void TearDown() override { fs::remove_all(folder); }
    fs::path folder;
};

graph::History::Entry entry_of(const std::string& key, gl::Format format, int width, int height, int layers) {
    graph::History::Entry entry;
    entry.key = key;
    entry.shape = {.width = width, .height = height, .levels = 1, .layers = layers, .format = format};
    entry.bytes.resize(static_cast<std::size_t>(width * height * std::max(1, layers)) *
                       static_cast<std::size_t>(gl::info(format).bytes));
    return entry;
}

/// Every format, a stack, another size and buffers, of random bits: among them NaNs, denormals and −0.
graph::History odd_history() {
    graph::History history;
    using F = gl::Format;
    for (const auto format : {F::r8, F::rgba8, F::r16f, F::rg16f, F::rgba16f, F::r32f, F::rg32f, F::rgba32f,
                              F::r32ui, F::rg32ui, F::depth32f, F::srgba8})
        history.entries.push_back(entry_of(std::string("image.") + gl::info(format).name, format, 7, 5, 0));
    history.entries.push_back(entry_of("stack", F::rgba32f, 7, 5, 3));
    history.entries.push_back(entry_of("half_size", F::rgba16f, 3, 2, 0));
    for (const std::uint64_t elements : {1, 5000}) {
        graph::History::Entry buffer;
        buffer.key = "buffer" + std::to_string(elements);
        buffer.is_image = false;
        buffer.element_bytes = 12;
        buffer.elements = elements;
        buffer.bytes.resize(12 * elements);
        history.entries.push_back(std::move(buffer));
    }
    std::mt19937 random(1);
    for (auto& entry : history.entries)
        for (auto& byte : entry.bytes) byte = static_cast<std::byte>(random());
    return history;
}

TEST_F(StateTest, FilesKeepEveryBit) {
    const auto history = odd_history();
    write_state(folder / "state.exr", history, {{"interreflect.seed", "7"}});
    ImageAttributes attributes;
    const auto read = read_state(folder / "state.exr", &attributes);
    EXPECT_EQ(attributes.at("interreflect.seed"), "7");
    ASSERT_EQ(read.entries.size(), history.entries.size());
    for (std::size_t i = 0; i < read.entries.size(); ++i) {
        const auto &a = history.entries[i], &b = read.entries[i];
        EXPECT_EQ(a.key, b.key);
        EXPECT_EQ(a.is_image, b.is_image);
        EXPECT_EQ(a.bytes, b.bytes) << a.key;
        if (a.is_image) {
            EXPECT_EQ(a.shape, b.shape) << a.key;
        } else {
            EXPECT_EQ(a.elements, b.elements);
        }
    }
    // Other programs see images.
    bool has_layer = false;
    for (const auto& layer : read_exr(folder / "state.exr"))
        has_layer = has_layer || layer.name == "stack.layer2";
    EXPECT_TRUE(has_layer);
}

TEST_F(StateTest, DamagedFilesAreOneLine) {
    EXPECT_THROW(read_state(folder / "nothing.exr"), InputError);
    std::ofstream(folder / "text.exr") << "no image";
    EXPECT_THROW(read_state(folder / "text.exr"), InputError);
    write_exr(folder / "image.exr", {{"", {"Y"}, Image(4, 4, 1)}}, {});
    EXPECT_THROW(read_state(folder / "image.exr"), InputError);
    write_state(folder / "state.exr", odd_history(), {});
    EXPECT_THROW(load_state(folder / "state.exr"), InputError) << "it does not say of what it is";
    const auto size = fs::file_size(folder / "state.exr");
    for (const double part : {0.1, 0.5, 0.9}) {
        fs::copy_file(folder / "state.exr", folder / "cut.exr", fs::copy_options::overwrite_existing);
        fs::resize_file(folder / "cut.exr", static_cast<std::uintmax_t>(static_cast<double>(size) * part));
        EXPECT_THROW(read_state(folder / "cut.exr"), InputError) << part;
    }
    EXPECT_THROW(write_state(folder / "empty.exr", {}, {}), Error);
    // What it says of itself and what it holds differ.
    for (const auto& [from, to] :
         {std::pair<std::string, std::string>{"[7,5]", "[5,7]"}, {"rgba32f", "rgba16f"}}) {
        std::ifstream stream(folder / "state.exr", std::ios::binary);
        std::string bytes{std::istreambuf_iterator<char>(stream), {}};
        const auto at = bytes.find(from);
        ASSERT_NE(at, std::string::npos);
        bytes.replace(at, from.size(), to);
        std::ofstream(folder / "false.exr", std::ios::binary) << bytes;
        EXPECT_THROW(read_state(folder / "false.exr"), InputError) << from;
    }
}

TEST_F(StateTest, BlocksOfLinesCountInTheLimit) {
    Imf::Header header(1 << 22, 16);
    header.compression() = Imf::ZIP_COMPRESSION;
    header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
    Imf::OutputFile((folder / "wide.exr").c_str(), header);  // without pixels
    try {
        read_state(folder / "wide.exr");
        ADD_FAILURE() << "it is read";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("far more memory"), std::string::npos) << error.what();
    }
}

TEST_F(StateTest, IsWholeOrTheOneBeforeOnAFullDisk) {
    const auto before = odd_history();
    auto after = before;
    after.entries.resize(5);
    const Ordeal ordeal{[&](const fs::path& disk) { write_state(disk / "state.exr", before, {}); },
                        [&](const fs::path& disk) { write_state(disk / "state.exr", after, {}); },
                        [&](const fs::path& disk, bool done) -> std::string {
                            const auto read = read_state(disk / "state.exr").entries.size();
                            return read == (done ? after : before).entries.size() ? "" : "another state";
                        }};
    EXPECT_EQ(with_small_files(folder, ordeal, 200), "ok");
    const auto answer = with_few_pages(folder, ordeal);
    if (answer == "not allowed") GTEST_SKIP() << "may not mount; files of limited size went well";
    EXPECT_EQ(answer, "ok");
}

/// Each method of this build that accumulates, on a small picture.
class ResumeTest : public StateTest {
  protected:
    static std::vector<const MethodDescription*> methods() {
        std::vector<const MethodDescription*> found;
        for (const auto* method : registry().methods())
            if (projects::accumulates(*method)) found.push_back(method);
        if (found.empty()) throw std::logic_error("no method of this build accumulates");
        return found;
    }
    static std::string parameter_of(const MethodDescription& method) {
        for (const auto& parameter : method.parameters)
            if (parameter.accumulates) return parameter.key;
        return {};
    }
    /// Each is another way through the method.
    static std::vector<std::string> paths_of(const MethodDescription& method) {
        const auto* parameter = find(method.parameters, "paths");
        std::vector<std::string> keys;
        for (const auto& choice : parameter ? parameter->choices : std::vector<Choice>())
            keys.push_back(choice.key);
        return keys.empty() ? std::vector<std::string>{""} : keys;
    }
    /// By the first of its ways: of the reference ambient occlusion, whose picture has one channel.
    static Experiment experiment_of(const MethodDescription& method, std::int64_t samples, int frames) {
        Experiment experiment;
        experiment.scene = "builtin:cornell";
        experiment.method = method.id;
        experiment.width = 24;
        experiment.height = 16;
        experiment.settings[parameter_of(method)] = samples;
        if (const auto paths = paths_of(method).front(); !paths.empty()) experiment.settings["paths"] = paths;
        experiment.frames = frames;
        return experiment;
    }
    static FrameReport finish(Execution& execution) {
        FrameReport report;
        graph::FrameOptions options;
        options.wanted = {"*"};
        while (!execution.is_done()) report = execution.run_frame(options);
        return report;
    }
    static std::vector<std::vector<std::byte>> bits(const Execution& execution) {
        std::vector<std::vector<std::byte>> result;
        const auto history = execution.graph().history().value();
        for (const auto& entry : history.entries) result.push_back(entry.bytes);
        const auto image = main_result(execution);
        const auto* bytes = reinterpret_cast<const std::byte*>(image.pixels.data());
        result.emplace_back(bytes, bytes + image.pixels.size() * sizeof(float));
        return result;
    }

    Machine& machine = egl_machine();
};

TEST_F(ResumeTest, SavedAndContinuedIsAtOnce) {
    for (const auto* method : methods())
        for (const auto& paths : paths_of(*method)) {
            SCOPED_TRACE(method->id + " " + paths);
            const auto experiment = [&](std::int64_t samples, int frames) {
                auto result = experiment_of(*method, samples, frames);
                if (!paths.empty()) result.settings["paths"] = paths;
                return result;
            };
            Execution whole(machine, experiment(61, 1));
            finish(whole);
            for (const auto& [samples, frames] : {std::pair{5, 1}, {3, 5}, {61, 1}}) {
                Execution first(machine, experiment(samples, frames));
                finish(first);
                store(folder / "state.exr", first.state().value(), attributes(first));
                Execution second(machine, experiment(61, 1));
                second.restore(load_state(folder / "state.exr"));
                finish(second);
                EXPECT_EQ(second.samples(), 61u);
                EXPECT_TRUE(bits(second) == bits(whole)) << samples << " x " << frames;
                EXPECT_EQ(second.origins().size(), 1u);
                EXPECT_EQ(second.origins()[0].samples, static_cast<std::uint64_t>(samples) * frames);
                EXPECT_EQ(second.is_extended(), samples * frames < 61);
            }
            // The mutant: a state that is not continued exactly where it ended.
            Execution mutant(machine, experiment(61, 1)), other(machine, experiment(5, 1));
            finish(other);
            auto state = other.state().value();
            state.samples = 30;
            mutant.restore(std::move(state));
            finish(mutant);
            EXPECT_FALSE(bits(mutant) == bits(whole));
        }
}

TEST_F(ResumeTest, MoreThanAskedForIsShownAndNothingIsAdded) {
    for (const auto* method : methods()) {
        Execution first(machine, experiment_of(*method, 20, 1));
        finish(first);
        Execution second(machine, experiment_of(*method, 4, 2));
        second.restore(first.state().value());
        EXPECT_FALSE(second.is_done()) << "the picture is not there yet";
        finish(second);
        EXPECT_EQ(second.samples(), 20u);
        EXPECT_FALSE(second.is_extended());
        EXPECT_TRUE(bits(second) == bits(first)) << method->id;
        EXPECT_EQ(second.state()->origins, second.origins());
    }
}

TEST_F(ResumeTest, AnotherNumberOfSamplesKeepsTheHistory) {
    for (const auto* method : methods()) {
        Execution whole(machine, experiment_of(*method, 40, 1)), grown(machine, experiment_of(*method, 6, 2));
        finish(whole);
        finish(grown);
        EXPECT_FALSE(grown.update(experiment_of(*method, 6, 3)));
        finish(grown);
        EXPECT_EQ(grown.samples(), 18u);
        EXPECT_FALSE(grown.update(experiment_of(*method, 8, 5)));
        finish(grown);
        EXPECT_TRUE(bits(grown) == bits(whole)) << method->id;
        EXPECT_FALSE(grown.update(experiment_of(*method, 8, 2)));
        EXPECT_TRUE(grown.is_done()) << "less is contained in it";
        auto other = experiment_of(*method, 8, 2);
        other.seed = 5;
        EXPECT_TRUE(grown.update(other));
        EXPECT_EQ(grown.samples(), 0u);
    }
}

TEST_F(ResumeTest, AnEnvironmentIsKnownByItsContentNotItsAddress) {
    const auto under = [&](float radiance) {
        auto experiment = experiment_of(*methods().front(), 2, 1);
        experiment.environment = scene::map_environment(std::make_shared<const Image>(4, 2, 3, radiance));
        return experiment;
    };
    Execution execution(machine, under(1));
    finish(execution);
    const auto world = execution.inputs().world_fingerprint;
    EXPECT_FALSE(execution.update(under(1)));
    EXPECT_TRUE(execution.is_done());
    EXPECT_TRUE(execution.update(under(2)));
    finish(execution);
    EXPECT_NE(execution.inputs().world_fingerprint, world);
    EXPECT_TRUE(execution.update(under(1)));
    finish(execution);
    EXPECT_EQ(execution.inputs().world_fingerprint, world);
}

TEST_F(ResumeTest, StatesOfOtherPicturesAreRefused) {
    for (const auto* method : methods()) {
        Execution first(machine, experiment_of(*method, 2, 1));
        finish(first);
        const std::vector<std::function<void(Experiment&)>> changes{
            [](auto& e) { e.seed = 3; },
            [](auto& e) { e.width = 25; },
            [](auto& e) { e.scene = "builtin:atrium"; },
            [](auto& e) { e.replace_lights = true; },
            [](auto& e) {
                e.environment = scene::Environment{glm::vec3(1), nullptr};
            },
            [](auto& e) { e.camera = scene::Camera{}; },
        };
        for (const auto& change : changes) {
            auto experiment = experiment_of(*method, 4, 1);
            change(experiment);
            Execution second(machine, experiment);
            EXPECT_THROW(second.restore(first.state().value()), Error);
        }
    }
}

class LiveStateTest : public ResumeTest {
  protected:
    LiveRequest request_of(const MethodDescription& method, std::int64_t samples, int frames,
                           const fs::path& file) {
        LiveRequest request;
        request.tag = "a";
        request.experiment = experiment_of(method, samples, frames);
        request.parts = {Part{}};
        request.state_file = file.string();
        return request;
    }
    static int count(const FrameReport& report, const std::string& source) {
        int found = 0;
        for (const auto& message : report.messages) found += message.source == source;
        return found;
    }
    LiveSession session{machine};
};

TEST_F(LiveStateTest, BeginsWithTheStateAndBeginsWithItAgainAfterAReset) {
    for (const auto* method : methods()) {
        Execution whole(machine, experiment_of(*method, 12, 1));
        finish(whole);
        store(folder / "state.exr", whole.state().value(), {});
        auto result = session.advance(request_of(*method, 4, 3, folder / "state.exr"), 1, {});
        EXPECT_TRUE(result.finished) << "one frame shows it";
        EXPECT_EQ(result.frame, 3);
        EXPECT_EQ(result.images.at(Part{}).pixels, main_result(whole).pixels);
        session.forget_results();
        result = session.advance(request_of(*method, 4, 3, folder / "state.exr"), 2, {});
        EXPECT_TRUE(result.finished);
        auto moved = request_of(*method, 4, 3, {});
        moved.experiment.seed = 9;
        EXPECT_FALSE(session.advance(moved, 3, {}).finished);
        EXPECT_TRUE(session.advance(request_of(*method, 4, 3, folder / "state.exr"), 4, {}).finished);
        session.release("a");
    }
}

TEST_F(LiveStateTest, ADamagedFileIsOneWarning) {
    for (const auto* method : methods()) {
        std::ofstream(folder / "damaged.exr") << "no state";
        auto result = session.advance(request_of(*method, 4, 3, folder / "damaged.exr"), 1, {});
        EXPECT_EQ(result.frame, 1);
        EXPECT_EQ(count(result.report, "state"), 1);
        session.release("a");
        result = session.advance(request_of(*method, 4, 3, folder / "absent.exr"), 2, {});
        EXPECT_EQ(count(result.report, "state"), 0);
        session.release("a");
    }
}

}  // namespace
}  // namespace ir::engine
