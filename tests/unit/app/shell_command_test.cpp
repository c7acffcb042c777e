// Completion and the manual's page tell what the commands are.
#include <algorithm>
#include <optional>
#include <sstream>

#include "tests/unit/app/outcome.h"

namespace ir {
namespace {

class ShellCommand : public CommandTest {
  protected:
    /// What bash offers for the last of `words`.
    std::vector<std::string> completed(const std::string& words, int index) const {
        const auto script = folder_ / "script", out = folder_ / "offered";
        std::ofstream(script) << output("completion bash") << "COMP_WORDS=(interreflect-cli " << words
                              << ")\nCOMP_CWORD=" << index
                              << "\n_interreflect_cli\nprintf '%s\\n' \"${COMPREPLY[@]}\"\n";
        EXPECT_EQ(std::system(("bash " + script.string() + " >" + out.string()).c_str()), 0);
        std::vector<std::string> lines;
        std::istringstream text(read(out));
        for (std::string line; std::getline(text, line);) lines.push_back(line);
        return lines;
    }
};

TEST_F(ShellCommand, BashCompletesCommandsOptionsAndValues) {
    using Words = std::vector<std::string>;
    EXPECT_EQ(completed("comp", 1), (Words{"compare", "completion"}));
    EXPECT_EQ(completed("render --met", 2), (Words{"--method"}));
    EXPECT_EQ(completed("render --method photon", 3), (Words{"photon-mapping"}));
    const auto scenes = completed("render --scene builtin:c", 3);
    EXPECT_EQ(std::count(scenes.begin(), scenes.end(), "builtin:cornell"), 1);
    std::ofstream(folder_ / "scene.glb");
    EXPECT_EQ(completed("render --scene " + (folder_ / "sc").string(), 3).size(), 2u)
        << "a file, and the script";
}

TEST_F(ShellCommand, EachShellHearsOfEveryCommand) {
    const auto help = output("--help");
    for (const auto* shell : {"bash", "zsh", "fish"}) {
        const auto script = output("completion " + std::string(shell));
        for (const auto* command : {"render", "compare", "rerun", "bench", "manual"})
            EXPECT_NE(script.find(command), std::string::npos) << shell << " " << command;
        EXPECT_NE(script.find("fail-above"), std::string::npos) << shell;
    }
    EXPECT_EQ(run("completion csh").status, 2);
}

/// What a shell prints for a command; nothing where the shell is not there.
std::optional<std::string> said_by(const std::string& shell, const std::string& line, const fs::path& out) {
    if (std::system(("command -v " + shell + " > /dev/null").c_str()) != 0) return {};
    EXPECT_EQ(std::system((shell + " " + line + " > " + out.string() + " 2>&1").c_str()), 0);
    return read(out);
}

TEST_F(ShellCommand, ZshCompletesAtTheFirstTab) {
    std::ofstream(file("_interreflect-cli")) << output("completion zsh");
    std::ofstream(file("first.zsh")) << "fpath=(" + folder_.string() + R"( $fpath)
_describe() { print -r -- commands $#commands }
_arguments() { print -rl -- "$@" }
compdef() { print -r -- registered }
autoload -U _interreflect-cli
words=(interreflect-cli re) CURRENT=2
_interreflect-cli
words=(interreflect-cli render --met) CURRENT=3
_interreflect-cli
)";
    const auto said = said_by("zsh", "-f " + file("first.zsh"), file("said"));
    if (!said) GTEST_SKIP() << "zsh is not installed";
    EXPECT_EQ(said->rfind("commands ", 0), 0u) << *said;
    EXPECT_NE(said->find("*--method["), std::string::npos) << *said;
}

TEST_F(ShellCommand, FishCompletesCommandsOptionsAndValues) {
    std::ofstream(file("c.fish")) << output("completion fish");
    const auto completed = [&](const std::string& line) {
        return said_by("fish",
                       "-c 'source " + file("c.fish") + "; complete -C \"interreflect-cli " + line + "\"'",
                       file("said"));
    };
    const auto commands = completed("comp");
    if (!commands) GTEST_SKIP() << "fish is not installed";
    EXPECT_NE(commands->find("compare\t"), std::string::npos) << *commands;
    EXPECT_NE(completed("render --met")->find("--method\t"), std::string::npos);
    EXPECT_NE(completed("render --method photon")->find("photon-mapping"), std::string::npos);
}

TEST_F(ShellCommand, LightsAreExplainedWhateverElseIsMissing) {
    const auto help = output("render --light help");
    for (const auto* part :
         {"point:position=", "rect:position=", "[inner]", "or flux", "W/sr", "--env", "Quote"})
        EXPECT_NE(help.find(part), std::string::npos) << part << "\n" << help;
}

TEST_F(ShellCommand, TheManualHasEveryCommandAndNoRequestByChance) {
    const auto page = output("manual");
    EXPECT_EQ(page.rfind(".TH ", 0), 0u);
    for (const auto* part :
         {".SS render\n", ".SS sweep\n", ".SS sweep merge\n", ".B \\-\\-dump\n", ".SH EXIT STATUS\n"})
        EXPECT_NE(page.find(part), std::string::npos) << part;
    std::istringstream lines(page);
    for (std::string line; std::getline(lines, line);) {
        if (line.empty() || line[0] != '.') continue;
        const auto request = line.substr(0, line.find(' '));
        EXPECT_TRUE(request == ".TH" || request == ".SH" || request == ".SS" || request == ".TP" ||
                    request == ".B" || request == ".I")
            << line;
    }
}

TEST_F(ShellCommand, StatusesAreThoseOfTheDocumentation) {
    const auto documented = read(fs::path(SOURCE_ROOT) / "docs" / "command-line.md");
    std::istringstream page(output("manual"));
    std::string line, value;
    while (std::getline(page, line) && line != ".SH EXIT STATUS") {
    }
    int statuses = 0;
    while (std::getline(page, line)) {
        if (line.rfind(".B ", 0) == 0) {
            value = line.substr(3);
        } else if (line != ".TP") {
            line.erase(std::remove(line.begin(), line.end(), '\\'), line.end());
            EXPECT_NE(documented.find("| " + value + " | " + line + " |"), std::string::npos) << value;
            ++statuses;
        }
    }
    EXPECT_EQ(statuses, 6);
}

}  // namespace
}  // namespace ir
