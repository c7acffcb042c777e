#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderers/graph/graph.h"
#include "renderers/graph/pass_context.h"

namespace ir::graph {

using Declare = std::function<void(GraphBuilder&)>;

inline ImageDesc image_of(const std::string& key, gl::Format format = gl::Format::r32f) {
    ImageDesc desc;
    desc.text = {.key = key, .label = key};
    desc.format = format;
    return desc;
}

inline BufferDesc buffer_of(const std::string& key, std::uint64_t elements, FieldType type = FieldType::u32) {
    BufferDesc desc;
    desc.text = {.key = key, .label = key};
    desc.fields = {{"value", type}};
    desc.elements = elements;
    return desc;
}

template <class T>
std::vector<T> as(const std::vector<std::byte>& bytes) {
    std::vector<T> result(bytes.size() / sizeof(T));
    std::memcpy(result.data(), bytes.data(), result.size() * sizeof(T));
    return result;
}

/// What() of the exception of type E that `run` throws; empty when it throws none.
template <class E>
std::string message_of(const std::function<void()>& run) {
    try {
        run();
    } catch (const E& error) {
        return error.what();
    }
    return {};
}

inline bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

inline const PassReport& pass_of(const FrameReport& report, const std::string& name) {
    for (const auto& pass : report.passes)
        if (pass.name == name) return pass;
    throw std::out_of_range("no pass " + name);
}

inline const ResourceReport& resource_of(const FrameReport& report, const std::string& key) {
    for (const auto& resource : report.resources)
        if (resource.key == key) return resource;
    throw std::out_of_range("no resource " + key);
}

/// A graph on the null device; its passes are of the cpu queue. Fails a test that leaks device memory.
class GraphTest : public testing::Test {
  protected:
    GraphTest()
        : device(gl::make_null_device(&counts)), graph(std::make_unique<Graph>(*device, nullptr, nullptr)) {
        inputs.view.width = 4;
        inputs.view.height = 3;
        options.wanted = {"*"};
    }
    void TearDown() override {
        graph.reset();
        EXPECT_EQ(counts.images, 0);
        EXPECT_EQ(counts.buffers, 0);
    }

    FrameReport run(const Declare& declare) {
        Method method;
        method.description.id = "test";
        method.setup = [&](GraphBuilder& builder, const Settings&) { declare(builder); };
        inputs.frame = frame;
        auto report = graph->run(method, {}, inputs, options);
        if (report.complete) ++frame;
        return report;
    }
    template <class T = std::uint32_t>
    std::vector<T> elements(const std::string& key) const {
        return as<T>(graph->read_buffer(key).value());
    }
    /// What a declaration is refused with.
    std::string refusal(const Declare& declare) {
        return message_of<std::logic_error>([&] { run(declare); });
    }

    gl::NullDeviceCounts counts;
    std::unique_ptr<gl::Device> device;
    std::unique_ptr<Graph> graph;
    FrameInputs inputs;
    FrameOptions options;
    int frame = 0;
};

}  // namespace ir::graph
