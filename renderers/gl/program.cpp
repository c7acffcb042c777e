#include "renderers/gl/program.h"

#include <algorithm>
#include <array>
#include <glm/gtc/type_ptr.hpp>

namespace ir::gl {
namespace {

/// Samplers and images, which are set by int; their enumerants lie in these ranges.
bool is_opaque(GLenum type) {
    static constexpr std::array<std::pair<GLenum, GLenum>, 6> ranges{{
        {GL_SAMPLER_1D, GL_SAMPLER_2D_RECT_SHADOW},
        {GL_SAMPLER_1D_ARRAY, GL_SAMPLER_CUBE_SHADOW},
        {GL_INT_SAMPLER_1D, GL_UNSIGNED_INT_SAMPLER_BUFFER},
        {GL_SAMPLER_CUBE_MAP_ARRAY, GL_UNSIGNED_INT_SAMPLER_CUBE_MAP_ARRAY},
        {GL_IMAGE_1D, GL_UNSIGNED_INT_IMAGE_2D_MULTISAMPLE_ARRAY},
        {GL_SAMPLER_2D_MULTISAMPLE, GL_UNSIGNED_INT_SAMPLER_2D_MULTISAMPLE_ARRAY},
    }};
    return std::any_of(ranges.begin(), ranges.end(),
                       [type](const auto& range) { return type >= range.first && type <= range.second; });
}

/// "lights[2].position" → "lights"
std::string first_identifier(const std::string& uniform) {
    return uniform.substr(0, uniform.find_first_of("[."));
}

}  // namespace

void Program::use() const {
    api_->UseProgram(name_);
}

const Program::Uniform& Program::find_uniform(const std::string& uniform) const {
    const auto known = uniforms_.find(uniform);
    if (known != uniforms_.end()) return known->second;
    if (!identifiers_.contains(first_identifier(uniform)))
        throw Error(label_ + ": the source has no uniform '" + uniform + "'; check its name");
    Uniform found;
    const GLuint index = api_->GetProgramResourceIndex(name_, GL_UNIFORM, uniform.c_str());
    if (index != GL_INVALID_INDEX) {
        const std::array<GLenum, 2> properties{GL_LOCATION, GL_TYPE};
        std::array<GLint, 2> values{-1, 0};
        api_->GetProgramResourceiv(name_, GL_UNIFORM, index, 2, properties.data(), 2, nullptr, values.data());
        found = {values[0], static_cast<GLenum>(values[1])};
    }
    // the resource of an array is its element 0; the other elements are only known to this query
    if (found.location < 0) found = {api_->GetUniformLocation(name_, uniform.c_str()), GL_NONE};
    return uniforms_.emplace(uniform, found).first->second;
}

GLint Program::location(const char* uniform, std::initializer_list<GLenum> accepted) const {
    const Uniform& found = find_uniform(uniform);
    if (!unset_.empty()) unset_.erase(first_identifier(uniform));
    if (found.location < 0 || found.type == GL_NONE) return found.location;
    const bool by_int = *accepted.begin() == GL_INT && is_opaque(found.type);
    if (!by_int && std::find(accepted.begin(), accepted.end(), found.type) == accepted.end())
        throw Error(label_ + ": uniform '" + uniform + "' is set with another type than it is declared with");
    return found.location;
}

void Program::set(const char* uniform, int value) const {
    api_->ProgramUniform1i(name_, location(uniform, {GL_INT, GL_BOOL}), value);
}

void Program::set(const char* uniform, unsigned value) const {
    api_->ProgramUniform1ui(name_, location(uniform, {GL_UNSIGNED_INT, GL_BOOL}), value);
}

void Program::set(const char* uniform, float value) const {
    api_->ProgramUniform1f(name_, location(uniform, {GL_FLOAT}), value);
}

void Program::set(const char* uniform, glm::vec2 value) const {
    api_->ProgramUniform2fv(name_, location(uniform, {GL_FLOAT_VEC2}), 1, glm::value_ptr(value));
}

void Program::set(const char* uniform, glm::vec3 value) const {
    api_->ProgramUniform3fv(name_, location(uniform, {GL_FLOAT_VEC3}), 1, glm::value_ptr(value));
}

void Program::set(const char* uniform, glm::vec4 value) const {
    api_->ProgramUniform4fv(name_, location(uniform, {GL_FLOAT_VEC4}), 1, glm::value_ptr(value));
}

void Program::set(const char* uniform, glm::ivec2 value) const {
    api_->ProgramUniform2iv(name_, location(uniform, {GL_INT_VEC2}), 1, glm::value_ptr(value));
}

void Program::set(const char* uniform, std::span<const glm::vec4> values) const {
    api_->ProgramUniform4fv(name_, location(uniform, {GL_FLOAT_VEC4}), static_cast<GLsizei>(values.size()),
                            &values.data()->x);
}

void Program::set(const char* uniform, const glm::mat4& value) const {
    api_->ProgramUniformMatrix4fv(name_, location(uniform, {GL_FLOAT_MAT4}), 1, GL_FALSE,
                                  glm::value_ptr(value));
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
    if (!unset_.empty()) throw Error(label_ + ": nobody gives '" + *unset_.begin() + "' a value");
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
