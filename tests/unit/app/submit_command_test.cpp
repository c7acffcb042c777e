// The script of `submit`, run as Slurm would run it.
#include "tests/unit/app/outcome.h"

namespace ir {
namespace {

class SubmitCommand : public CommandTest {
  protected:
    void SetUp() override {
        CommandTest::SetUp();
        const Json json{
            {"schema", 6},
            {"name", "Sweep"},
            {"scenes", {{{"id", "box"}, {"parts", {{{"source", "builtin:cornell"}}}}}}},
            {"experiments", {{{"id", "a"}, {"scene", "box"}, {"method", "ldm-ao"}, {"size", {40, 24}}}}},
            {"sweeps",
             {{{"id", "s"},
               {"experiment", "a"},
               {"axes", {{{"key", "directions"}, {"values", {4, 8, 16}}}}}}}}};
        fs::create_directories(project());
        std::ofstream(project() + "/project.json") << json.dump(2);
        // What tells Slurm to run a task again.
        fs::create_directories(file("bin"));
        std::ofstream(file("bin/scontrol")) << "#!/bin/sh\necho \"$*\" >>" << file("requeued") << "\n";
        fs::permissions(file("bin/scontrol"), fs::perms(0755));
    }

    std::string project() const { return file("p.interreflect"); }
    /// Writes the script, and returns its name.
    std::string script(const std::string& arguments) const {
        output("submit --script " + file("job.sh") + " " + arguments);
        return file("job.sh");
    }
    /// One task of the array.
    std::string task(int index, int count, const std::string& rest) const {
        return "PATH=" + file("bin") +
               ":$PATH SLURM_ARRAY_JOB_ID=7 SLURM_ARRAY_TASK_ID=" + std::to_string(index) +
               " SLURM_ARRAY_TASK_MIN=1 SLURM_ARRAY_TASK_COUNT=" + std::to_string(count) + " " + rest;
    }
    static int shell(const std::string& line) {
        const int status = std::system(line.c_str());
        EXPECT_TRUE(WIFEXITED(status)) << line;
        return WEXITSTATUS(status);
    }
};

TEST_F(SubmitCommand, AsksForWhatATaskNeeds) {
    const auto text = output(
        "submit --tasks 16 --cpus 8 --mem 12G --time 1-02:00:00 --name box "
        "--sbatch=--partition=short sweep " +
        project() + " s --out '" + file("out dir") + "'");
    for (const char* line :
         {"#!/bin/sh\n", "\n#SBATCH --array=1-16\n", "\n#SBATCH --cpus-per-task=8\n", "\n#SBATCH --mem=12G\n",
          "\n#SBATCH --time=1-02:00:00\n", "\n#SBATCH --requeue\n", "\n#SBATCH --job-name=box\n",
          "\n#SBATCH --partition=short\n", " --shard-from-env --resume --threads "})
        EXPECT_NE(text.find(line), std::string::npos) << line << "\n" << text;
    EXPECT_NE(text.find("--out '" + file("out dir") + "'"), std::string::npos) << text;
    EXPECT_NE(text.find("sweep merge '" + file("out dir") + "'"), std::string::npos) << text;
}

TEST_F(SubmitCommand, ItsTasksMakeTheSweepOfOneMachine) {
    const auto job = script("--tasks 2 sweep " + project() + " s --quiet --out " + file("out"));
    for (const int index : {2, 1}) EXPECT_EQ(shell(task(index, 2, "sh " + job + " >" + file("log"))), 0);
    output("sweep merge " + file("out") + " --out " + file("out/sweep.json"));
    output("sweep " + project() + " s --quiet --out " + file("one"));
    const auto list = Json::parse(read(file("out/sweep.json")));
    ASSERT_EQ(list["points"].size(), 3u);
    for (const auto& point : list["points"]) {
        const auto image = point["image"].get<std::string>();
        EXPECT_EQ(read(file("out/" + image)), read(file("one/" + image))) << image;
    }
    EXPECT_FALSE(fs::exists(file("requeued")));
}

/// Slurm says so with SIGUSR1, to the script alone.
TEST_F(SubmitCommand, BeforeItsTimeIsUpATaskKeepsWhatItHasAndQueuesAgain) {
    const auto job =
        script("--tasks 2 reference " + project() + " --quiet --samples 1000000 --checkpoint 0.01");
    const auto parts = project() + "/results/parts";
    const auto status =
        shell(task(1, 2,
                   "sh " + job + " 2>" + file("err") +
                       " & job=$!; "
                       "while ! ls " +
                       parts +
                       " 2>/dev/null | grep -q exr; do "
                       "kill -0 $job || exit 99; sleep 0.05; done; kill -USR1 $job; wait $job"));
    EXPECT_EQ(status, 143) << read(file("err"));
    EXPECT_EQ(read(file("requeued")), "requeue 7_1\n");
    EXPECT_NE(read(file("err")).find("run it again to go on"), std::string::npos) << read(file("err"));
    EXPECT_FALSE(fs::is_empty(parts));
}

/// It would begin anew each time.
TEST_F(SubmitCommand, ATaskThatCannotGoOnAsksForMoreTime) {
    for (const std::string sh : {"sh", "bash"}) {
        const auto out = file("by " + sh);
        const auto job =
            script("--tasks 1 render " + project() + " --quiet --size 4000x4000 --out '" + out + "'");
        const auto status =
            shell(task(1, 1,
                       sh + " " + job + " 2>" + file("err") + " & job=$!; while ! [ -d '" + out +
                           "' ]; do kill -0 $job || exit 99; sleep 0.05; done; kill -USR1 $job; wait $job"));
        EXPECT_EQ(status, 143) << sh << ": " << read(file("err"));
        EXPECT_FALSE(fs::exists(file("requeued"))) << sh;
        EXPECT_NE(read(file("err")).find("more --time"), std::string::npos) << read(file("err"));
    }
}

TEST_F(SubmitCommand, AFolderWithALineBreakAddsNoCommand) {
    const auto text = output("submit --tasks 1 sweep " + project() + " s --out '" + file("a\nfalse") + "'");
    EXPECT_EQ(text.find("# When all tasks"), std::string::npos) << text;
}

TEST_F(SubmitCommand, RefusesInOneLine) {
    const auto sweep = " sweep " + project() + " s --out " + file("out");
    expect_refused("submit --tasks 2", 2, "sweep, reference, render, plot");
    expect_refused("submit" + sweep, 2, "--tasks is required");
    expect_refused("submit" + sweep + " --tasks 4", 2, "give --tasks before the command");
    expect_refused("submit teleport", 2, "'teleport' cannot be divided");
    expect_refused("submit --tasks 0" + sweep, 2, "--tasks");
    expect_refused("submit --tasks 2 compare a.exr b.exr", 2, "'compare' cannot be divided");
    expect_refused("submit --tasks 2 sweep merge a --out b", 2, "when all tasks are done");
    expect_refused("submit --tasks 2" + sweep + " --shard 1/2", 2, "--shard is what submit adds");
    expect_refused("submit --tasks 2 sweep " + project(), 2, "is required");
    expect_refused("submit --tasks 2" + sweep + " --colour red", 2, "--colour");
    expect_refused("submit --tasks 2 --time soon" + sweep, 2, "--time 'soon'");
    for (const char* time : {"4", "4:59", "00:04:59", "0-0:4"})
        expect_refused("submit --tasks 2 --time " + std::string(time) + sweep, 2, "at least 5 minutes");
    for (const char* time : {"5", "00:05:00", "0-1"})
        EXPECT_FALSE(output("submit --tasks 2 --time " + std::string(time) + sweep).empty());
    expect_refused("submit --tasks 2 --mem lots" + sweep, 2, "--mem 'lots'");
    expect_refused("submit --tasks 2 --name 'a b'" + sweep, 2, "--name 'a b'");
}

}  // namespace
}  // namespace ir
