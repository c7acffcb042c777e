#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "renderers/core/resources_path.h"
#include "tests/own_folder.h"

namespace ir::engine {

/// A copy of the product's shaders that a test edits.
class EditedShaders {
  public:
    EditedShaders() {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = own_folder(std::string(test->test_suite_name()) + "-" + test->name());
        std::filesystem::remove_all(folder_);
        std::filesystem::copy(shader_directory(), folder_, std::filesystem::copy_options::recursive);
    }
    ~EditedShaders() { std::filesystem::remove_all(folder_); }
    EditedShaders(const EditedShaders&) = delete;

    const std::filesystem::path& folder() const { return folder_; }
    /// Who watches sees the old text or the new one.
    void write(const std::string& file, const std::string& text) const {
        const auto aside = folder_ / (file + ".new");
        std::ofstream(aside) << text;
        std::filesystem::rename(aside, folder_ / file);
    }
    void replace(const std::string& file, const std::string& old, const std::string& by) const {
        std::stringstream text;
        text << std::ifstream(folder_ / file).rdbuf();
        auto source = text.str();
        const auto place = source.find(old);
        ASSERT_NE(place, std::string::npos) << file << " has no " << old;
        write(file, source.replace(place, old.size(), by));
    }

  private:
    std::filesystem::path folder_;
};

}  // namespace ir::engine
