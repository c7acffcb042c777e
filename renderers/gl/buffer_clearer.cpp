#include "renderers/gl/buffer_clearer.h"

#include <algorithm>

#include "renderers/core/error.h"

namespace ir::gl {
namespace {

constexpr const char* source = R"(#version 450 core
layout(local_size_x = 256) in;
layout(std430, binding = 0) writeonly buffer Words { uint words[]; };
layout(location = 0) uniform uint count;
void main() {
    for (uint i = gl_GlobalInvocationID.x; i < count; i += gl_NumWorkGroups.x * gl_WorkGroupSize.x) words[i] = 0u;
}
)";
constexpr std::uint64_t max_groups = 4096;

/// Of any device, as the specification promises.
constexpr std::uint64_t alignment = 256;

}  // namespace

BufferClearer::~BufferClearer() {
    // Without its context the program is gone already.
    if (program_ && context_.is_current()) context_.api().DeleteProgram(program_);
}

bool BufferClearer::takes(std::uint64_t offset, std::uint64_t bytes) const {
    return offset % alignment == 0 && bytes % 4 == 0 &&
           bytes <= static_cast<std::uint64_t>(context_.info().max_storage_buffer_bytes);
}

void BufferClearer::clear(Name buffer, std::uint64_t offset, std::uint64_t bytes) {
    const auto& gl = context_.api();
    if (!program_) make_program();
    GLint program = 0, bound = 0;
    GLint64 begin = 0, size = 0;
    gl.GetIntegerv(GL_CURRENT_PROGRAM, &program);
    // one that was deleted while it was current ends here
    GLint deleted = 0;
    if (program != 0) gl.GetProgramiv(static_cast<GLuint>(program), GL_DELETE_STATUS, &deleted);
    gl.GetIntegeri_v(GL_SHADER_STORAGE_BUFFER_BINDING, 0, &bound);
    gl.GetInteger64i_v(GL_SHADER_STORAGE_BUFFER_START, 0, &begin);
    gl.GetInteger64i_v(GL_SHADER_STORAGE_BUFFER_SIZE, 0, &size);
    gl.UseProgram(program_);
    gl.BindBufferRange(GL_SHADER_STORAGE_BUFFER, 0, buffer, static_cast<GLintptr>(offset),
                       static_cast<GLsizeiptr>(bytes));
    gl.ProgramUniform1ui(program_, 0, static_cast<GLuint>(bytes / 4));
    gl.MemoryBarrier(GL_ALL_BARRIER_BITS);
    const auto groups = (bytes / 4 + group_size_ - 1) / group_size_;
    gl.DispatchCompute(static_cast<GLuint>(std::min(groups, max_groups)), 1, 1);
    gl.MemoryBarrier(GL_ALL_BARRIER_BITS);
    gl.UseProgram(deleted ? 0 : static_cast<GLuint>(program));
    if (size > 0)
        gl.BindBufferRange(GL_SHADER_STORAGE_BUFFER, 0, static_cast<GLuint>(bound), begin, size);
    else
        gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, static_cast<GLuint>(bound));
}

void BufferClearer::make_program() {
    const auto& gl = context_.api();
    program_ = gl.CreateShaderProgramv(GL_COMPUTE_SHADER, 1, &source);
    GLint linked = 0;
    gl.GetProgramiv(program_, GL_LINK_STATUS, &linked);
    if (linked) {
        GLint size[3];
        gl.GetProgramiv(program_, GL_COMPUTE_WORK_GROUP_SIZE, size);
        group_size_ = static_cast<std::uint64_t>(size[0]);
        return;
    }
    gl.DeleteProgram(program_);
    program_ = 0;
    throw Error("the driver refuses the program that clears buffers; update it");
}

}  // namespace ir::gl
