#pragma once

#include "renderers/gl/program.h"
#include "tests/unit/gl/context_fixture.h"
#include "tests/unit/graph/graph_fixture.h"

namespace ir::graph {

/// A graph over real OpenGL, with shaders that the test writes.
class GlGraphFixture : public gl::ContextTest {
  protected:
    void SetUp() override {
        ContextTest::SetUp();
        device = gl::make_gl_device(*context);
        programs = std::make_unique<gl::ProgramLibrary>(*context, folder.path());
        graph = std::make_unique<Graph>(*device, context.get(), programs.get());
        options.wanted = {"*"};
    }
    void TearDown() override {
        graph.reset();
        programs.reset();
        device.reset();
        ContextTest::TearDown();
    }
    FrameReport run(const Declare& declare) {
        Method method;
        method.setup = [&](GraphBuilder& builder, const Settings&) { declare(builder); };
        return graph->run(method, {}, inputs, options);
    }

    gl::ShaderFolder folder;
    std::unique_ptr<gl::Device> device;
    std::unique_ptr<gl::ProgramLibrary> programs;
    std::unique_ptr<Graph> graph;
    FrameInputs inputs;
    FrameOptions options;
};

}  // namespace ir::graph
