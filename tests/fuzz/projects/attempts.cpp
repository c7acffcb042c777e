#include "tests/fuzz/projects/attempts.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "projects/autosave.h"
#include "projects/check.h"
#include "projects/document_json.h"
#include "projects/light_spec.h"
#include "projects/results.h"
#include "projects/store.h"
#include "projects/sweep.h"
#include "renderers/core/changed_shaders.h"
#include "renderers/core/error.h"
#include "renderers/core/line_diff.h"
#include "tests/fuzz/require.h"

namespace ir::fuzz {
namespace {

using namespace ir::projects;

/// One file in memory; everything else is absent.
class OneFile final : public FileSystem {
  public:
    OneFile(std::filesystem::path name, std::string text) : name_(std::move(name)), text_(std::move(text)) {}
    bool exists(const std::filesystem::path& path) override { return path == name_; }
    std::string read(const std::filesystem::path& file, std::size_t) override {
        if (file != name_) throw InputError(file.string(), "", "cannot be opened");
        return text_;
    }
    std::int64_t modified(const std::filesystem::path&) override { return 0; }
    std::vector<std::filesystem::path> list(const std::filesystem::path&) override { return {}; }
    void write(const std::filesystem::path&, const std::filesystem::path&, const Fill&) override {
        throw_written();
    }
    void sync_directory(const std::filesystem::path&) override { throw_written(); }
    void rename(const std::filesystem::path&, const std::filesystem::path&) override { throw_written(); }
    void remove(const std::filesystem::path&) override { throw_written(); }
    void remove_all(const std::filesystem::path&) override { throw_written(); }
    void create_directories(const std::filesystem::path&) override { throw_written(); }
    void pour(const std::filesystem::path&, std::ostream&) override { throw_written(); }

  private:
    [[noreturn]] static void throw_written() { throw std::logic_error("reading must not write"); }
    std::filesystem::path name_;
    std::string text_;
};

/// Messages are one line, too.
void require_lines(const std::vector<Message>& messages) {
    for (const auto& message : messages) require(message.text.find('\n') == std::string::npos, message.text);
}

void use(const Project& project) {
    for (const auto& experiment : project.experiments) {
        result_key(project, experiment, registry());
        why_not_runnable(project, experiment, registry(), "/nonexistent");
    }
    for (const auto& sweep : project.sweeps) {
        try {
            const auto count = check_sweep(project, sweep, registry());
            require(sweep_points(project, sweep, registry()).size() == count,
                    "other points than were counted");
        } catch (const UsageError& error) {
            require_one_line(error.what());
        }
    }
}

}  // namespace

const Registry& registry() {
    static const MethodDescription fog = [] {
        MethodDescription method;
        method.id = "fog";
        method.version = 3;
        const auto number = [](const char* key, ParameterType type, Value value, Range hard) {
            ParameterDescription parameter;
            parameter.key = key;
            parameter.type = type;
            parameter.default_value = std::move(value);
            parameter.hard = hard;
            return parameter;
        };
        method.parameters = {number("samples", ParameterType::integer, std::int64_t{16}, {1, 4096}),
                             number("density", ParameterType::number, 0.25, {0, 100}),
                             number("max_distance", ParameterType::number, 0.0, {0, 1e9}),
                             number("jitter", ParameterType::toggle, true, {})};
        return method;
    }();
    static const Registry all({&fog});
    return all;
}

bool opens_project(const std::string& text) {
    try {
        const auto read = read_project(text, "fuzz.json", registry());
        const auto written = write_project(read.project);
        const auto again = read_project(written, "again.json", registry());
        require(write_project(again.project) == written, "what was written reads as something else");
        require_lines(check(read, "/nonexistent", registry()));
        use(read.project);
        return true;
    } catch (const InputError& error) {
        require_one_line(error.what(), "fuzz.json: ");  // never refuses what it wrote itself
        return false;
    }
}

bool offers_autosave(const std::string& text) {
    OneFile files(std::filesystem::path("p") / autosave_file_name, text);
    const auto recovery = find_recovery("p", registry(), files);
    if (!recovery) return false;
    require(recovery->summary.find('\n') == std::string::npos, recovery->summary);
    const auto written = write_project(recovery->project);
    require(write_project(read_project(written, "again.json", registry()).project) == written,
            "what was written reads as something else");
    return true;
}

bool reads_results(const std::string& text) {
    const auto name = std::filesystem::path("p") / "results" / "index.json";
    OneFile files(name, text);
    try {
        const auto read = ResultIndex::load("p", files);
        require_lines(check_results(read, "/nonexistent"));
        for (const auto& entry : read.entries())
            for (const auto& line : differences(entry.inputs, {{"seed", 8}}))
                require(line.find('\n') == std::string::npos, line);
        ResultIndex again;
        for (const auto& entry : read.entries()) again.put(entry);
        return true;
    } catch (const InputError& error) {
        require_one_line(error.what(), name.string());
        return false;
    }
}

bool reads_session(const std::string& text) {
    OneFile files(std::filesystem::path("p") / "session.json", text);
    const auto read = load_session("p", files);
    require(read.is_object(), "a session that is no object");
    return !read.empty();
}

bool reads_light(const std::string& text) {
    try {
        const auto light = parse_light(text);
        require(parse_light(to_string(light)) == light, "what was written reads as another light: " + text);
        return true;
    } catch (const UsageError& error) {
        require(std::string(error.what()).find('\n') == std::string::npos, error.what());
        return false;
    }
}

bool changes_shaders(const std::string& texts) {
    const auto first_end = std::min(texts.find('\0'), texts.size());
    const auto second_end = std::min(texts.find('\0', first_end + 1), texts.size());
    const auto part = [&](std::size_t begin, std::size_t end) {
        return begin < end ? texts.substr(begin, end - begin) : std::string();
    };
    const auto before = part(0, first_end), after = part(first_end + 1, second_end);
    const auto require_changes = [&](const std::string& to) {
        const auto hunks = line_diff(before, to);
        require(apply_line_diff(before, hunks) == to, "what was compared does not come out again");
        count_lines(hunks);
    };
    require_changes(after);
    bool is_changed = false;
    const auto may_refuse = [](const auto& act) {
        try {
            act();
        } catch (const Error& error) {
            require(std::string(error.what()).find('\n') == std::string::npos, error.what());
        }
    };
    const auto diff = part(second_end + 1, texts.size());
    may_refuse([&] {
        for (const auto& file : hunks_by_file(diff))
            may_refuse([&] {
                const auto changed = apply_line_diff(before, file.second);
                count_lines(file.second);
                require_changes(changed);
                is_changed = true;
            });
    });
    may_refuse([&] {
        for (const auto& [file, hunks] : read_changes(diff))
            require(problem_with_change(file, hunks).empty(), "a change that was read is wrong");
    });
    return is_changed;
}

}  // namespace ir::fuzz
