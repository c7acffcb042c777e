#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "renderers/gl/device.h"
#include "renderers/gl/program.h"
#include "tests/unit/gl/context_fixture.h"

namespace ir::gl {

/// Runs the functions of shaders/lib on the device and brings their results back.
class ShaderLibTest : public ContextTest {
  protected:
    void SetUp() override {
        ContextTest::SetUp();
        device = make_gl_device(*context);
        std::filesystem::copy(std::filesystem::path(SOURCE_ROOT) / "shaders/lib", folder.path() / "lib");
    }
    void TearDown() override {
        device.reset();
        ContextTest::TearDown();
    }

    /// `body` computes `result[i]` (of type `type`) from `given[i]` for every i.
    template <class To, class From>
    std::vector<To> map(const std::vector<From>& given, const std::string& file, const std::string& from,
                        const std::string& to, const std::string& body) {
        folder.write("map.comp", "#include \"lib/" + file + "\"\nlayout(local_size_x = 64) in;\n" +
                                     "layout(std430) readonly buffer Given { " + from +
                                     " given[]; };\nlayout(std430) buffer Result { " + to +
                                     " result[]; };\nvoid main() {\n    uint i = gl_GlobalInvocationID.x;\n" +
                                     "    if (i >= uint(given.length())) return;\n    " + body + "\n}\n");
        ProgramLibrary library(*context, folder.path());
        const auto& program = library.get({{"map.comp"}});
        std::vector<To> result(given.size());
        const Name in = device->create_buffer(given.size() * sizeof(From), "given");
        const Name out = device->create_buffer(given.size() * sizeof(To), "result");
        device->write_buffer(in, 0, std::as_bytes(std::span(given)));
        program.use();
        program.bind_buffer("Given", in);
        program.bind_buffer("Result", out);
        program.dispatch(static_cast<std::int64_t>(given.size()));
        device->barrier();
        device->read_buffer(out, 0, std::as_writable_bytes(std::span(result)));
        return result;
    }

    std::unique_ptr<Device> device;
    ShaderFolder folder;
};

}  // namespace ir::gl
