#include <algorithm>
#include <map>

#include "renderers/core/error.h"
#include "renderers/core/record.h"
#include "renderers/graph/frame.h"
#include "renderers/graph/pass_context.h"

/// Joins the names of a pass's programs with its resources.
namespace ir::graph {
namespace {

using BindingKind = Pass::Binding::Kind;
using Resource = gl::ProgramResource;

GLenum wrap_of(scene::Wrap wrap) {
    switch (wrap) {
        case scene::Wrap::repeat:
            return GL_REPEAT;
        case scene::Wrap::mirrored_repeat:
            return GL_MIRRORED_REPEAT;
        default:
            return GL_CLAMP_TO_EDGE;
    }
}

GLuint make_sampler(const gl::Api& gl, const scene::Sampler& sampler) {
    const bool linear = sampler.min == scene::Filter::linear;
    GLuint name = 0;
    gl.CreateSamplers(1, &name);
    gl.SamplerParameteri(name, GL_TEXTURE_WRAP_S, static_cast<GLint>(wrap_of(sampler.wrap_s)));
    gl.SamplerParameteri(name, GL_TEXTURE_WRAP_T, static_cast<GLint>(wrap_of(sampler.wrap_t)));
    gl.SamplerParameteri(name, GL_TEXTURE_MAG_FILTER,
                         sampler.mag == scene::Filter::linear ? GL_LINEAR : GL_NEAREST);
    gl.SamplerParameteri(name, GL_TEXTURE_MIN_FILTER,
                         sampler.mipmaps ? (linear ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST_MIPMAP_NEAREST)
                                         : (linear ? GL_LINEAR : GL_NEAREST));
    return name;
}

constexpr scene::Sampler nearest_clamped{scene::Wrap::clamp_to_edge, scene::Wrap::clamp_to_edge,
                                         scene::Filter::nearest, scene::Filter::nearest, false};

/// "levels[2]" → "levels"
std::string without_index(const std::string& name) {
    return name.substr(0, name.find('['));
}

/// Names of one of its elements; "levels[0]" also where the array has no other.
std::vector<std::string> names_of(const Resource& resource, int element) {
    if (resource.count > 1) return {resource.element(element)};
    return {resource.name, resource.name + "[0]"};
}

/// What a member of a record holds, as a field would say it; count 0: no numbers of four bytes.
Field numbers_of(const Resource::Member& member) {
    static const std::map<GLenum, Field> known{{GL_FLOAT, {"", FieldType::f32}},
                                               {GL_FLOAT_VEC2, {"", FieldType::f32, 2}},
                                               {GL_FLOAT_VEC3, {"", FieldType::f32, 3}},
                                               {GL_FLOAT_VEC4, {"", FieldType::f32, 4}},
                                               {GL_FLOAT_MAT4, {"", FieldType::f32, 16}},
                                               {GL_INT, {"", FieldType::i32}},
                                               {GL_INT_VEC2, {"", FieldType::i32, 2}},
                                               {GL_INT_VEC3, {"", FieldType::i32, 3}},
                                               {GL_INT_VEC4, {"", FieldType::i32, 4}},
                                               {GL_UNSIGNED_INT, {"", FieldType::u32}},
                                               {GL_UNSIGNED_INT_VEC2, {"", FieldType::u32, 2}},
                                               {GL_UNSIGNED_INT_VEC3, {"", FieldType::u32, 3}},
                                               {GL_UNSIGNED_INT_VEC4, {"", FieldType::u32, 4}}};
    const auto found = known.find(member.type);
    if (found == known.end()) return {plain_name(member.name), FieldType::f32, 0};
    return {plain_name(member.name), found->second.type, found->second.count * member.count};
}

/// How a program's records differ from the buffer's; empty where they agree. A member is a field of its name,
/// its type and as many numbers. Or several members together are one field of several numbers, or an array
/// stands for several whole fields; these have names of their own.
std::string compare(const Resource& resource, const BufferDesc& desc) {
    if (resource.stride != stride(desc))
        return "a record has " + std::to_string(resource.stride) + " bytes in the program and " +
               std::to_string(stride(desc)) + " in the buffer";
    const auto is_field = [&](const std::string& name) {
        return std::any_of(desc.fields.begin(), desc.fields.end(),
                           [&](const Field& field) { return field.name == name; });
    };
    std::map<const Field*, int> shared;  // numbers of the members that are one field together
    for (const auto& member : resource.members) {
        const auto numbers = numbers_of(member);
        int begin = 0;
        auto field = desc.fields.begin();
        while (field + 1 != desc.fields.end() && member.offset >= begin + 4 * field->count)
            begin += 4 * field++->count;
        const auto differs = [&](const std::string& what) {
            return "the program has '" + member.name + "' at byte " + std::to_string(member.offset) +
                   ", where the buffer has '" + field->name + "'" + what;
        };
        const bool is_named_so = member.offset == begin && numbers.name == field->name;
        if (!is_named_so && is_field(numbers.name)) return differs("");
        if (numbers.type != field->type) return differs(" of another type");
        if (is_named_so) {
            if (numbers.count == field->count) continue;
            return differs(" of " + std::to_string(field->count) + " numbers");
        }
        if (member.offset + 4 * numbers.count <= begin + 4 * field->count && numbers.count < field->count) {
            shared[&*field] += numbers.count;
            continue;
        }
        if (!member.is_array || member.offset != begin) return differs("");
        int left = numbers.count;
        for (; left > 0 && field != desc.fields.end() && field->type == numbers.type; ++field)
            left -= field->count;
        if (left != 0) return "the program's array '" + member.name + "' ends within a field of the buffer";
    }
    for (const auto& [field, count] : shared)
        if (count != field->count)
            return "the program has " + std::to_string(count) + " of the " + std::to_string(field->count) +
                   " numbers of '" + field->name + "'";
    return {};
}

bool sees_parameters(const gl::ProgramSource& source) {
    return std::any_of(source.files.begin(), source.files.end(),
                       [](const std::string& file) { return file.starts_with("methods/"); });
}

}  // namespace

PassContext::PassContext(Frame& frame, const Pass& pass) : frame_(frame), pass_(pass) {
    const auto& builder = *frame_.builder;
    for (const auto& access : pass.accesses) {
        if (access.kind == Pass::Access::Kind::object || access.previous) continue;
        const bool is_image = access.kind == Pass::Access::Kind::image;
        const auto& name =
            is_image ? builder.images().at(access.index).name : builder.buffers().at(access.index).name;
        if (!name.empty())
            offer(name, {is_image ? BindingKind::image : BindingKind::buffer, access.index, access.write});
    }
    for (const auto counter : pass.counters)
        if (const auto& name = builder.counters().at(counter.index).name; !name.empty())
            offer(name, {BindingKind::counter, counter.index, true});
    for (const auto& [name, binding] : pass.bindings) bindings_[name] = binding;
}

void PassContext::offer(const std::string& name, const Pass::Binding& binding) {
    const auto [known, is_new] = bindings_.emplace(name, binding);
    if (is_new) return;
    if (known->second.kind != binding.kind || known->second.index != binding.index)
        known->second.ambiguous = true;
    known->second.write |= binding.write;
}

GLuint PassContext::sampler_of(const scene::Sampler& sampler) const {
    auto& samplers = frame_.cache.samplers;
    const auto found = std::find_if(samplers.begin(), samplers.end(),
                                    [&](const auto& entry) { return entry.first == sampler; });
    if (found != samplers.end()) return found->second;
    return samplers.emplace_back(sampler, make_sampler(api(), sampler)).second;
}

const gl::Program& PassContext::method_program(const gl::ProgramSource& source) const {
    auto& s = frame_;
    auto& made = s.cache.programs_with_parameters[source];
    if (made) {
        s.cache.programs->touch(*made);
        return *made;
    }
    gl::ProgramSource complete = source;
    complete.preamble += s.cache.parameter_glsl;
    complete.changes = s.cache.shader_changes;
    const auto& program = s.cache.programs->get(complete);
    gl::check_parameter_block(api(), program.name(), s.method->description.parameters);
    made = &program;
    return program;
}

const gl::Program& PassContext::program(const gl::ProgramSource& source) const {
    auto& cache = frame_.cache;
    if (const auto forgotten = cache.programs->forgotten(); forgotten != cache.forgotten_programs) {
        cache.programs_with_parameters.clear();
        cache.compared_records.clear();
        cache.forgotten_programs = forgotten;
    }
    if (sees_parameters(source)) return method_program(source);
    if (cache.shader_changes.empty()) return cache.programs->get(source);
    auto changed = source;
    changed.changes = cache.shader_changes;
    return cache.programs->get(changed);
}

const gl::Program& PassContext::use(const gl::ProgramSource& source) const {
    frame_.cache.shaders_of_passes[pass_.name].insert(source.files.begin(), source.files.end());
    const auto& wanted = frame_.cache.debug.choose(
        pass_.name, source, [this](const auto& each) -> const gl::Program& { return program(each); });
    use(wanted);
    return wanted;
}

void PassContext::use(const gl::Program& program) const {
    program.use();
    programs_.erase(std::remove(programs_.begin(), programs_.end(), &program), programs_.end());
    programs_.push_back(&program);
    for (const auto& resource : program.resources())
        for (int element = 0; element < resource.count; ++element) bind_element(resource, element);
}

void PassContext::bind_element(const gl::ProgramResource& resource, int element) const {
    const auto& s = frame_;
    if (resource.name == gl::parameter_block_name || resource.name == gl::debug_block_name) {
        const bool is_debug = resource.name == gl::debug_block_name;
        api().BindBufferBase(GL_SHADER_STORAGE_BUFFER, resource.unit,
                             is_debug ? frame_.cache.debug.buffer() : s.cache.parameter_buffer);
        return;
    }
    auto found = bindings_.end();
    for (const auto& name : names_of(resource, element))
        if (found == bindings_.end()) found = bindings_.find(name);
    if (found == bindings_.end()) refuse(resource, "is in the program, and the pass declares nothing for it");
    const auto& binding = found->second;
    if (binding.ambiguous) refuse(resource, "is the name of several resources that the pass declares");
    const bool is_block = resource.kind == Resource::Kind::buffer;
    if (is_block != (binding.kind != BindingKind::image))
        refuse(resource, is_block ? "is a block, and the pass declares an image for it"
                                  : "is a texture or image, and the pass declares a buffer for it");
    if (resource.written && !binding.write && binding.index >= 0)
        refuse(resource, "is written by the program and only read by the pass; declare it readonly");
    if (is_block)
        bind_block(resource, binding);
    else
        bind_image(resource, resource.unit + static_cast<GLuint>(element), binding);
}

void PassContext::bind_block(const gl::ProgramResource& resource, const Pass::Binding& binding) const {
    if (binding.kind == BindingKind::counter) {
        api().BindBufferRange(GL_SHADER_STORAGE_BUFFER, resource.unit, frame_.cache.counter_buffer,
                              static_cast<GLintptr>(binding.index * counter_stride), 16);
        return;
    }
    const BufferRef ref{binding.index};
    if (ref.index >= 0) compare_records(resource, ref);
    const auto bound = ref.index < 0 ? 0 : binding.previous ? previous(ref) : buffer(ref);
    api().BindBufferBase(GL_SHADER_STORAGE_BUFFER, resource.unit, bound);
}

void PassContext::compare_records(const gl::ProgramResource& resource, BufferRef ref) const {
    if (resource.members.empty()) return;
    auto& s = frame_;
    const auto& desc = s.builder->buffers().at(static_cast<std::size_t>(ref.index));
    auto& [linked, agreed] = s.cache.compared_records[{programs_.back(), resource.name, desc.text.key}];
    if (linked == programs_.back()->name() && agreed == desc.fields) return;
    if (const auto difference = compare(resource, desc); !difference.empty())
        refuse(resource, "and buffer '" + desc.text.key + "' differ: " + difference);
    linked = programs_.back()->name();
    agreed = desc.fields;
}

void PassContext::bind_image(const gl::ProgramResource& resource, GLuint unit,
                             const Pass::Binding& binding) const {
    const ImageRef ref{binding.index};
    if (ref.index < 0) {
        api().BindTextureUnit(unit, 0);
        return;
    }
    const auto shape = this->shape(ref);
    const auto& format = gl::info(binding.format.value_or(shape.format));
    if (resource.is_array_texture() != (shape.layers > 0))
        refuse(resource, resource.is_array_texture() ? "has layers, and the pass's image has none"
                                                     : "has no layers, and the pass's image has some");
    if (!resource.format.empty() && resource.format != format.name)
        refuse(resource, "has format " + resource.format + ", and the pass's image " + format.name);
    if (resource.is_integer() != format.integer)
        refuse(resource, "has another type than the pass's image, which is " + std::string(format.name));
    const auto texture = binding.previous ? previous(ref) : image(ref);
    if (resource.kind == Resource::Kind::image) {
        api().BindImageTexture(unit, texture, binding.level, shape.layers > 0, 0, GL_READ_WRITE,
                               format.internal);
        return;
    }
    api().BindTextureUnit(unit, texture);
    api().BindSampler(unit, sampler_of(binding.sampler.value_or(nearest_clamped)));
}

void PassContext::refuse(const gl::ProgramResource& resource, const std::string& problem) const {
    throw Error("pass '" + pass_.name + "', " + programs_.back()->label() + ": '" + resource.name + "' " +
                problem);
}

void PassContext::put(const std::string& name, const Pass::Binding& binding) const {
    bindings_[name] = binding;
    if (programs_.empty()) return;
    for (const auto& resource : programs_.back()->resources())
        for (int element = 0; element < resource.count; ++element)
            for (const auto& known : names_of(resource, element))
                if (known == name) bind_element(resource, element);
}

bool PassContext::writes(Pass::Access::Kind kind, int index) const {
    return std::any_of(pass_.accesses.begin(), pass_.accesses.end(), [&](const Pass::Access& access) {
        return access.write && access.kind == kind && access.index == index;
    });
}

void PassContext::bind(const std::string& name, ImageRef ref, int level) const {
    put(name, {BindingKind::image, ref.index, writes(Pass::Access::Kind::image, ref.index), false, level});
}

void PassContext::bind(const std::string& name, ImageRef ref, const scene::Sampler& sampler) const {
    put(name, {BindingKind::image, ref.index, false, false, 0, sampler});
}

void PassContext::bind(const std::string& name, ImageRef ref, gl::Format format) const {
    put(name, {.kind = BindingKind::image,
               .index = ref.index,
               .write = writes(Pass::Access::Kind::image, ref.index),
               .format = format});
}

void PassContext::bind(const std::string& name, BufferRef ref) const {
    put(name, {BindingKind::buffer, ref.index, writes(Pass::Access::Kind::buffer, ref.index)});
}

void PassContext::check_names() const {
    if (programs_.empty()) return;
    const auto& builder = *frame_.builder;
    const auto require = [&](const std::string& name) {
        const auto has_it = [&](const gl::Program* program) {
            return program->declares(without_index(name));
        };
        if (std::none_of(programs_.begin(), programs_.end(), has_it))
            throw Error("pass '" + pass_.name + "' declares '" + name + "', which " +
                        programs_.back()->label() + " does not have");
    };
    for (const auto& [name, binding] : pass_.bindings) require(name);
    const auto require_own = [&](BindingKind kind, int index, const std::string& name) {
        const auto is_it = [&](const auto& entry) {
            return entry.second.kind == kind && entry.second.index == index;
        };
        if (name.empty() || touched_.contains({kind, index}) ||
            std::any_of(pass_.bindings.begin(), pass_.bindings.end(), is_it))
            return;
        require(name);
    };
    for (const auto& access : pass_.accesses) {
        if (access.previous || access.optional) continue;
        const auto index = static_cast<std::size_t>(access.index);
        if (access.kind == Pass::Access::Kind::image)
            require_own(BindingKind::image, access.index, builder.images().at(index).name);
        if (access.kind == Pass::Access::Kind::buffer)
            require_own(BindingKind::buffer, access.index, builder.buffers().at(index).name);
    }
    for (const auto counter : pass_.counters)
        require_own(BindingKind::counter, counter.index,
                    builder.counters().at(static_cast<std::size_t>(counter.index)).name);
}

}  // namespace ir::graph
