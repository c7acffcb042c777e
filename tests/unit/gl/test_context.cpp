#include <thread>

#include "context_fixture.h"
#include "renderers/core/error.h"

namespace ir::gl {
namespace {

INSTANTIATE_ON_BOTH_BACKENDS(ContextTest);

TEST_P(ContextTest, TellsWhatItIs) {
    const auto& info = context->info();
    EXPECT_EQ(info.backend, GetParam());
    EXPECT_FALSE(info.vendor.empty());
    EXPECT_FALSE(info.renderer.empty());
    EXPECT_TRUE(api().VERSION_4_5);
    EXPECT_GE(info.max_texture_size, 16384);  // least values of the OpenGL 4.5 specification, table 23.53 on
    EXPECT_GE(info.max_texture_layers, 2048);
    EXPECT_GE(info.max_compute_invocations, 1024);
    EXPECT_GE(info.max_compute_shared_bytes, 32768);
    EXPECT_GE(info.max_storage_buffer_bindings, 8);
    EXPECT_GE(info.max_storage_buffer_bytes, 1 << 27);
    EXPECT_TRUE(context->has_extension("GL_KHR_debug"));
    EXPECT_FALSE(context->has_extension("GL_KHR_debu"));
    EXPECT_EQ(info.software, info.renderer.find("llvmpipe") != std::string::npos);
}

TEST_P(ContextTest, SetsTheConventions) {
    GLint value = 0;
    api().GetIntegerv(GL_CLIP_ORIGIN, &value);
    EXPECT_EQ(value, GL_UPPER_LEFT);
    api().GetIntegerv(GL_CLIP_DEPTH_MODE, &value);
    EXPECT_EQ(value, GL_ZERO_TO_ONE);
    api().GetIntegerv(GL_PACK_ALIGNMENT, &value);
    EXPECT_EQ(value, 1);
    EXPECT_FALSE(api().IsEnabled(GL_DITHER));
    EXPECT_TRUE(api().IsEnabled(GL_TEXTURE_CUBE_MAP_SEAMLESS));
}

TEST_P(ContextTest, ReportsDriverErrorsOnce) {
    for (int i = 0; i < 3; ++i) api().Enable(GL_TEXTURE_WRAP_S);
    const auto messages = context->take_messages();
    ASSERT_EQ(messages.size(), 1u);
    EXPECT_EQ(messages[0].severity, Severity::error);
    EXPECT_EQ(messages[0].source, "gl");
    EXPECT_EQ(messages[0].text.find('\n'), std::string::npos);
    EXPECT_TRUE(context->take_messages().empty());
    while (api().GetError() != GL_NO_ERROR) {
    }
}

TEST_P(ContextTest, IsNotLost) {
    EXPECT_FALSE(context->is_lost());
}

TEST_P(ContextTest, ReleasesAndReturns) {
    EXPECT_TRUE(context->is_current());
    context->release();
    EXPECT_FALSE(context->is_current());
    context->make_current();
    EXPECT_TRUE(context->is_current());
    EXPECT_EQ(api().GetError(), static_cast<GLenum>(GL_NO_ERROR));
}

GLuint buffer_with(const Api& api, int value) {
    GLuint buffer = 0;
    api.CreateBuffers(1, &buffer);
    api.NamedBufferStorage(buffer, sizeof value, &value, 0);
    return buffer;
}

int value_in(const Api& api, GLuint buffer) {
    int value = -1;
    api.GetNamedBufferSubData(buffer, 0, sizeof value, &value);
    return value;
}

TEST_P(ContextTest, MovesToAWorkerThread) {
    const GLuint buffer = buffer_with(api(), 42);
    context->release();
    int seen = 0;
    bool current_here = true;
    std::thread worker([&] {
        context->make_current();
        seen = value_in(api(), buffer);
        current_here = context->is_current();
        context->release();
    });
    worker.join();
    EXPECT_EQ(seen, 42);
    EXPECT_TRUE(current_here);
    EXPECT_FALSE(context->is_current());
    context->make_current();
}

TEST_P(ContextTest, WorksBesideAnotherThreadsContext) {
    const GLuint buffer = buffer_with(api(), 1);
    int seen = 0;
    std::thread worker([&] {
        for (const Backend backend : {Backend::osmesa, Backend::egl}) {
            const auto other = Context::create(backend);
            seen += value_in(other->api(), buffer_with(other->api(), 10));
        }
    });
    worker.join();
    EXPECT_EQ(seen, 20);
    EXPECT_EQ(value_in(api(), buffer), 1);
}

// EGL and OSMesa share thread-local dispatch: with both current, calls would land in the wrong context. EGL
// does nothing for a context that it believes current, so the order egl, osmesa, egl is the hard one.
TEST(Contexts, AlternateOnOneThread) {
    const auto egl = Context::create(Backend::egl);
    const auto osmesa = Context::create(Backend::osmesa);
    const auto egl_again = Context::create(Backend::egl);
    const std::vector<Context*> contexts{egl.get(), osmesa.get(), egl_again.get()};
    std::vector<GLuint> buffers;
    for (std::size_t i = 0; i < contexts.size(); ++i) {
        contexts[i]->make_current();
        buffers.push_back(buffer_with(contexts[i]->api(), static_cast<int>(100 + i)));
    }
    for (const std::size_t i : {0, 1, 0, 1, 2, 1, 2, 0, 2, 1, 1, 0}) {
        contexts[i]->make_current();
        for (auto* other : contexts) EXPECT_EQ(other->is_current(), other == contexts[i]);
        EXPECT_EQ(value_in(contexts[i]->api(), buffers[i]), static_cast<int>(100 + i));
        EXPECT_EQ(contexts[i]->api().GetError(), static_cast<GLenum>(GL_NO_ERROR));
    }
}

TEST(Contexts, TakeTheBestThatWorks) {
    const auto context = Context::create_best();
    EXPECT_TRUE(context->is_current());
    EXPECT_EQ(context->info().backend, Backend::egl);
}

std::string message_of(Backend backend, const ContextOptions& options) {
    try {
        Context::create(backend, options);
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

TEST(Contexts, SayInOneLineThatOsMesaIsMissing) {
    ContextOptions options;
    options.osmesa_library = "libOSMesa-that-nobody-has.so";
    const std::string text = message_of(Backend::osmesa, options);
    EXPECT_NE(text.find("cannot load libOSMesa-that-nobody-has.so"), std::string::npos) << text;
    EXPECT_NE(text.find("libosmesa6"), std::string::npos) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos);
}

TEST(Contexts, RefuseALibraryThatIsNotOsMesa) {
    ContextOptions options;
    options.osmesa_library = "libm.so.6";
    EXPECT_NE(message_of(Backend::osmesa, options).find("OSMesaCreateContextAttribs"), std::string::npos);
}

TEST(Contexts, FilterByDevice) {
    ContextOptions options;
    options.device = Context::create(Backend::egl)->info().renderer.substr(0, 4);
    EXPECT_NO_THROW(Context::create(Backend::egl, options));
    options.device = "surfaceless";
    EXPECT_EQ(Context::create(Backend::egl, options)->info().platform, "surfaceless");
    options.device = "a device that nobody has";
    const std::string text = message_of(Backend::egl, options);
    EXPECT_NE(text.find("is not 'a device that nobody has'"), std::string::npos) << text;
}

TEST(Contexts, NamesOfBackends) {
    for (const Backend backend : {Backend::egl, Backend::osmesa})
        EXPECT_EQ(parse_backend(to_string(backend)), backend);
    EXPECT_THROW(parse_backend("vulkan"), UsageError);
}

}  // namespace
}  // namespace ir::gl
