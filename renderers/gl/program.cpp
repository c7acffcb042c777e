#include "renderers/gl/program.h"

#include <algorithm>
#include <array>

namespace ir::gl {
namespace {

/// Whether a uniform of type `declared` takes a constant. A bool may also be an int of 0 or 1.
bool accepts(GLenum declared, Constant::Type given) {
    using Type = Constant::Type;
    switch (given) {
        case Type::int_:
            return declared == GL_INT || declared == GL_BOOL;
        case Type::uint:
            return declared == GL_UNSIGNED_INT || declared == GL_BOOL;
        case Type::bool_:
            return declared == GL_BOOL || declared == GL_INT;
        case Type::float_:
            return declared == GL_FLOAT;
        case Type::vec2:
            return declared == GL_FLOAT_VEC2;
        case Type::vec3:
            return declared == GL_FLOAT_VEC3;
        case Type::vec4:
        case Type::vec4s:
            return declared == GL_FLOAT_VEC4;
        case Type::ivec2:
            return declared == GL_INT_VEC2;
        case Type::mat4:
            return declared == GL_FLOAT_MAT4;
    }
    return false;
}

template <class T>
const T& read(const void* bytes) {
    return *static_cast<const T*>(bytes);
}

void put(const Api& api, GLuint program, GLint location, const Constant& constant, const void* value) {
    using Type = Constant::Type;
    const auto floats = static_cast<const float*>(value);
    switch (constant.type) {
        case Type::int_:
            return api.ProgramUniform1i(program, location, read<int>(value));
        case Type::uint:
            return api.ProgramUniform1ui(program, location, read<unsigned>(value));
        case Type::bool_:
            return api.ProgramUniform1i(program, location, read<bool>(value));
        case Type::float_:
            return api.ProgramUniform1f(program, location, *floats);
        case Type::vec2:
            return api.ProgramUniform2fv(program, location, 1, floats);
        case Type::vec3:
            return api.ProgramUniform3fv(program, location, 1, floats);
        case Type::vec4:
            return api.ProgramUniform4fv(program, location, constant.count, floats);
        case Type::ivec2:
            return api.ProgramUniform2iv(program, location, 1, static_cast<const int*>(value));
        case Type::mat4:
            return api.ProgramUniformMatrix4fv(program, location, 1, GL_FALSE, floats);
        case Type::vec4s: {
            const auto& values = read<std::span<const glm::vec4>>(value);
            return api.ProgramUniform4fv(program, location, static_cast<GLsizei>(values.size()),
                                         reinterpret_cast<const float*>(values.data()));
        }
    }
}

}  // namespace

void Program::use() const {
    api_->UseProgram(name_);
}

std::vector<GLint> Program::locations_of(const ConstantLayout& layout) const {
    std::vector<GLint> locations;
    for (const auto& constant : layout) {
        const auto uniform = uniforms_.find(constant.name);
        if (uniform == uniforms_.end() && !identifiers_.contains(constant.name))
            throw ConstantsError(label_ + ": the source has no uniform '" + constant.name +
                                 "'; check its name");
        if (uniform != uniforms_.end() && !accepts(uniform->second.type, constant.type))
            throw ConstantsError(label_ + ": uniform '" + constant.name +
                                 "' has another type than the constant of its name");
        locations.push_back(uniform == uniforms_.end() ? -1 : uniform->second.location);
    }
    return locations;
}

void Program::set(const ConstantLayout& layout, const void* constants) const {
    auto& locations = locations_[&layout];
    if (locations.empty()) {
        locations = locations_of(layout);
        for (const auto& constant : layout) unset_.erase(constant.name);
    }
    for (std::size_t i = 0; i < layout.size(); ++i)
        if (locations[i] >= 0)
            put(*api_, name_, locations[i], layout[i],
                static_cast<const std::byte*>(constants) + layout[i].offset);
}

const ProgramResource* Program::find_resource(const std::string& name) const {
    if (!declares(name))
        throw Error(label_ + ": the source has no block, sampler or image '" + name + "'; check its name");
    const auto found = std::find_if(resources_.begin(), resources_.end(),
                                    [&](const ProgramResource& resource) { return resource.name == name; });
    return found == resources_.end() ? nullptr : &*found;
}

void Program::bind_buffer(const char* block, Name buffer, std::uint64_t offset, std::uint64_t bytes) const {
    const auto* resource = find_resource(block);
    if (!resource) return;
    if (bytes == 0)
        api_->BindBufferBase(GL_SHADER_STORAGE_BUFFER, resource->unit, buffer);
    else
        api_->BindBufferRange(GL_SHADER_STORAGE_BUFFER, resource->unit, buffer, static_cast<GLintptr>(offset),
                              static_cast<GLsizeiptr>(bytes));
}

void Program::bind_texture(const char* sampler, Name texture) const {
    const auto* resource = find_resource(sampler);
    if (!resource) return;
    api_->BindTextureUnit(resource->unit, texture);
    api_->BindSampler(resource->unit, 0);
}

void Program::bind_image(const char* image, Name texture, Format format) const {
    const auto* resource = find_resource(image);
    if (!resource) return;
    api_->BindImageTexture(resource->unit, texture, 0, GL_FALSE, 0, GL_READ_WRITE, info(format).internal);
}

void Program::require_uniforms() const {
    if (!unset_.empty()) throw ConstantsError(label_ + ": nobody gives '" + *unset_.begin() + "' a value");
}

void Program::dispatch(std::int64_t x, std::int64_t y, std::int64_t z) const {
    const std::array<std::int64_t, 3> invocations{x, y, z};
    std::array<GLuint, 3> groups{};
    for (int i = 0; i < 3; ++i) {
        const auto axis = static_cast<std::size_t>(i);
        const std::int64_t size = work_group_size_[i];
        const std::int64_t count = (invocations[axis] + size - 1) / size;
        if (invocations[axis] < 0 || count > max_groups_[i])
            throw Error(label_ + ": " + std::to_string(invocations[axis]) + " invocations in " + "xyz"[i] +
                        " are beyond the device's " + std::to_string(max_groups_[i]) + " groups of " +
                        std::to_string(size) + "; the pass must be sliced");
        if (count == 0) return;
        groups[axis] = static_cast<GLuint>(count);
    }
    require_uniforms();
    api_->DispatchCompute(groups[0], groups[1], groups[2]);
}

}  // namespace ir::gl
