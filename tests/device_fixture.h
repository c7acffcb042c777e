#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <vector>

#include "renderers/core/resources_path.h"
#include "renderers/graph/graph.h"

namespace ir::test {

/// A graph on the best device, with the product's shaders; any error that OpenGL reports fails the test.
class DeviceTest : public testing::Test {
  protected:
    void SetUp() override {
        gl::ContextOptions options;
        options.debug = true;
        context_ = gl::Context::create_best(options);
        device_ = gl::make_gl_device(*context_);
        use_shaders(shader_directory());
    }
    void TearDown() override {
        if (!context_) return;
        graph_.reset();
        for (const auto& message : context_->take_messages())
            EXPECT_NE(message.severity, Severity::error) << message.text;
        programs_.reset();
        device_.reset();
        context_->release();
    }
    /// Forgets all contents, and how large buffers have grown.
    void reset() { graph_ = std::make_unique<graph::Graph>(*device_, context_.get(), programs_.get()); }
    void use_shaders(const std::filesystem::path& folder) {
        graph_.reset();
        programs_ = std::make_unique<gl::ProgramLibrary>(*context_, folder);
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
    const gl::Api& api() const { return context_->api(); }
    gl::Context& context() const { return *context_; }
    gl::Device& device() const { return *device_; }
    gl::ProgramLibrary& programs() const { return *programs_; }

  private:
    std::unique_ptr<gl::Context> context_;
    std::unique_ptr<gl::Device> device_;
    std::unique_ptr<gl::ProgramLibrary> programs_;
    std::unique_ptr<graph::Graph> graph_;
};

}  // namespace ir::test
