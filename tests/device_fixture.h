#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "renderers/core/resources_path.h"
#include "renderers/graph/graph.h"

namespace ir::test {

/// The best device with the product's shaders, one for all tests of a process: making contexts and linking
/// programs takes longer than most tests.
struct TestDevice {
    static TestDevice& shared() {
        static TestDevice instance;
        return instance;
    }
    std::unique_ptr<gl::Context> context = gl::Context::create_best({.debug = true, .device = {}});
    std::unique_ptr<gl::Device> device = gl::make_gl_device(*context);
    gl::ProgramLibrary programs{*context, shader_directory()};
};

/// Whether a pass whose name begins so ran on the host's threads.
inline bool ran_on_host(const FrameReport& report, std::string_view pass) {
    return std::any_of(report.passes.begin(), report.passes.end(),
                       [&](const auto& each) { return each.name.starts_with(pass) && each.queue == "cpu"; });
}

/// A graph of its own on that device; any error that OpenGL reports fails the test.
class DeviceTest : public testing::Test {
  protected:
    void SetUp() override {
        context().make_current();
        reset();
    }
    void TearDown() override {
        graph_.reset();
        for (const auto& message : context().take_messages())
            EXPECT_NE(message.severity, Severity::error) << message.text;
        own_programs_.reset();
        context().release();
    }
    /// Forgets all contents, and how large buffers have grown.
    void reset() { graph_ = std::make_unique<graph::Graph>(device(), &context(), &programs()); }
    /// In place of the product's.
    void use_shaders(const std::filesystem::path& folder) {
        use_product_shaders();
        own_programs_ = std::make_unique<gl::ProgramLibrary>(context(), folder);
        reset();
    }
    void use_product_shaders() {
        graph_.reset();
        own_programs_.reset();
        reset();
    }

    /// Expects no error among the frame's messages.
    FrameReport run_method(const graph::Method& method, const Settings& settings,
                           const graph::FrameInputs& inputs, const graph::FrameOptions& options) {
        const auto report = graph_->run(method, settings, inputs, options);
        for (const auto& message : report.messages)
            EXPECT_NE(message.severity, Severity::error) << message.text;
        return report;
    }
    /// All that the buffer has room for. Throws where it does not exist.
    template <class T>
    std::vector<T> elements(const std::string& key) const {
        const auto device = graph_->device_buffer(key);
        const auto bytes = graph_->read_buffer(key);
        if (!device || !bytes) throw std::runtime_error("no buffer " + key);
        std::vector<T> result(device->elements);
        if (!result.empty()) std::memcpy(result.data(), bytes->data(), sizeof(T) * result.size());
        return result;
    }
    /// Throws where the image does not exist.
    Image read(const std::string& key, int layer = 0) const {
        auto image = graph_->read_image(key, 0, layer);
        if (!image) throw std::runtime_error("no image " + key);
        return std::move(*image);
    }
    static glm::vec3 rgb(const Image& image, int x, int y) {
        return {image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)};
    }

    graph::Graph& graph() const { return *graph_; }
    const gl::Api& api() const { return context().api(); }
    gl::Context& context() const { return *TestDevice::shared().context; }
    gl::Device& device() const { return *TestDevice::shared().device; }
    gl::ProgramLibrary& programs() const {
        return own_programs_ ? *own_programs_ : TestDevice::shared().programs;
    }

  private:
    std::unique_ptr<gl::ProgramLibrary> own_programs_;
    std::unique_ptr<graph::Graph> graph_;
};

}  // namespace ir::test
