#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "renderers/gl/context.h"
#include "tests/own_folder.h"

namespace ir::gl {

/// Each test has its own debug context on each backend; any error that the driver reports fails the test,
/// unless the test took the messages itself.
class ContextTest : public testing::TestWithParam<Backend> {
  protected:
    void SetUp() override {
        ContextOptions options;
        options.debug = true;
        context = Context::create(GetParam(), options);
    }
    void TearDown() override {
        if (!context) return;
        for (const auto& message : context->take_messages())
            EXPECT_NE(message.severity, Severity::error) << message.text;
        context->release();
    }
    const Api& api() const { return context->api(); }

    std::unique_ptr<Context> context;
};

inline std::string backend_name(const testing::TestParamInfo<Backend>& info) {
    return to_string(info.param);
}

/// A folder of shader files that lives as long as a test.
class ShaderFolder {
  public:
    ShaderFolder() {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        std::string name = std::string(test->test_suite_name()) + "-" + test->name();
        std::replace(name.begin(), name.end(), '/', '-');
        path_ = own_folder(name);
        std::filesystem::remove_all(path_);
        std::filesystem::create_directories(path_);
    }
    ~ShaderFolder() { std::filesystem::remove_all(path_); }
    ShaderFolder(const ShaderFolder&) = delete;
    ShaderFolder& operator=(const ShaderFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    void write(const std::string& name, const std::string& text) const {
        std::filesystem::create_directories((path_ / name).parent_path());
        std::ofstream(path_ / name) << text;
    }
    void remove(const std::string& name) const { std::filesystem::remove(path_ / name); }

  private:
    std::filesystem::path path_;
};

}  // namespace ir::gl

#define INSTANTIATE_ON_BOTH_BACKENDS(fixture)                                                           \
    INSTANTIATE_TEST_SUITE_P(, fixture, testing::Values(ir::gl::Backend::egl, ir::gl::Backend::osmesa), \
                             ir::gl::backend_name)
