#include "projects/keep.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/own_folder.h"
#include "tests/unit/projects/sample.h"

namespace ir::projects {
namespace {

namespace fs = std::filesystem;

class DeleteResults : public ::testing::Test {
  protected:
    void SetUp() override {
        folder = own_folder(std::string("delete-results-") +
                            ::testing::UnitTest::GetInstance()->current_test_info()->name());
        fs::remove_all(folder);
        ResultIndex index;
        for (const auto& [key, shared] : {std::pair{key_a, false}, {key_b, true}, {key_c, true}}) {
            KeptResult result;
            result.key = key;
            const auto file = result_folder(shared ? key_b : key) + "/main.exr";
            result.files.push_back({main_role, file, "", {}});
            fs::create_directories((folder / "results" / file).parent_path());
            std::ofstream(folder / "results" / file) << key;
            index.put(result);
        }
        index.save(folder);
    }
    void TearDown() override { fs::remove_all(folder); }
    fs::path file_of_key(const std::string& key) {
        return folder / "results" / result_folder(key) / "main.exr";
    }

    fs::path folder;
    const std::string key_a = std::string(64, 'a'), key_b = std::string(64, 'b'),
                      key_c = std::string(64, 'c');
};

TEST_F(DeleteResults, TakesEntriesFilesAndEmptyFolders) {
    const auto deleted = delete_results(folder, {key_a, "unknown"});
    EXPECT_EQ(deleted.keys, std::vector<std::string>{key_a});
    EXPECT_EQ(deleted.files.size(), 1u);
    EXPECT_FALSE(fs::exists(file_of_key(key_a).parent_path()));
    EXPECT_EQ(ResultIndex::load(folder).entries().size(), 2u);
}

TEST_F(DeleteResults, LeavesFilesThatAnotherResultNames) {
    EXPECT_TRUE(delete_results(folder, {key_b}).files.empty());
    EXPECT_TRUE(fs::exists(file_of_key(key_b)));
    EXPECT_EQ(delete_results(folder, {key_c}).files.size(), 1u);
    EXPECT_FALSE(fs::exists(file_of_key(key_b)));
}

TEST_F(DeleteResults, NothingHappensForKeysThatAreNotThere) {
    const auto before = ResultIndex::load(folder);
    EXPECT_TRUE(delete_results(folder, {"unknown"}).keys.empty());
    EXPECT_EQ(ResultIndex::load(folder), before);
}

}  // namespace
}  // namespace ir::projects
