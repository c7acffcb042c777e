#include "renderers/graph/builder.h"

#include <algorithm>
#include <stdexcept>

#include "renderers/gl/dispatch_items.h"
#include "renderers/graph/pass_context.h"

namespace ir::graph {
namespace {

bool is_image(OutputKind kind) {
    return kind == OutputKind::image || kind == OutputKind::pyramid || kind == OutputKind::stack;
}

}  // namespace

ResourceText text_of(const OutputDescription& output) {
    return {output.key,  output.label,      full_doc(output), output.semantic,
            output.unit, output.colour_map, output.categories};
}

int stride(const BufferDesc& desc) {
    int scalars = 0;
    for (const auto& field : desc.fields) scalars += field.count;
    return 4 * scalars;
}

PassBuilder& PassBuilder::counts(CounterRef counter) {
    pass_->counters.push_back(counter);
    return *this;
}

PassBuilder& PassBuilder::counts(std::string name, CounterRef counter) {
    pass_->bindings.emplace_back(std::move(name),
                                 Pass::Binding{Pass::Binding::Kind::counter, counter.index, true});
    return counts(counter);
}

PassBuilder& PassBuilder::reads(std::string name, ImageRef ref, const scene::Sampler& sampler) {
    bind(std::move(name), ref, false, false);
    pass_->bindings.back().second.sampler = sampler;
    return *this;
}

PassBuilder& PassBuilder::bind(std::string name, ImageRef ref, bool write, bool previous) {
    if (ref.index >= 0) access(ref, write, previous);
    pass_->bindings.emplace_back(std::move(name),
                                 Pass::Binding{Pass::Binding::Kind::image, ref.index, write, previous});
    return *this;
}

PassBuilder& PassBuilder::bind(std::string name, BufferRef ref, bool write, bool previous) {
    if (ref.index >= 0) access(ref, write, previous);
    pass_->bindings.emplace_back(std::move(name),
                                 Pass::Binding{Pass::Binding::Kind::buffer, ref.index, write, previous});
    return *this;
}

PassBuilder& PassBuilder::has_two_bodies() {
    pass_->has_two_bodies = true;
    return *this;
}

void PassBuilder::execute(std::function<void(PassContext&)> run) {
    pass_->execute = [run = std::move(run)](PassContext& context, Slice) { run(context); };
}

void PassBuilder::execute_sliced(std::int64_t items, std::function<void(PassContext&, Slice)> run,
                                 std::int64_t first_slice) {
    pass_->items = items;
    // Even of half a minute's work, the first slice then takes no longer than the others.
    pass_->first_slice = first_slice > 0 ? first_slice : std::max<std::int64_t>(1, items / 1024);
    pass_->execute = std::move(run);
}

void Constants::give(const PassContext& context, const gl::Program& program) const {
    if (give_)
        give_(context,
              [&](const gl::ConstantLayout& layout, const void* values) { program.set(layout, values); });
}

void PassBuilder::compute(const gl::ProgramSource& source, ImageRef over, Constants constants) {
    execute([source, over, constants = std::move(constants)](PassContext& context) {
        const auto& program = context.use(source);
        constants.give(context, program);
        const auto shape = context.shape(over);
        program.dispatch(shape.width, shape.height, std::max(1, shape.layers));
    });
}

void PassBuilder::compute(const gl::ProgramSource& source, std::int64_t invocations, Constants constants) {
    execute([source, invocations, constants = std::move(constants)](PassContext& context) {
        const auto& program = context.use(source);
        constants.give(context, program);
        program.dispatch(invocations);
    });
}

void PassBuilder::compute_sliced(const gl::ProgramSource& source, std::int64_t items, Constants constants,
                                 std::int64_t first_slice) {
    execute_sliced(
        items,
        [source, constants = std::move(constants)](PassContext& context, Slice slice) {
            const auto& program = context.use(source);
            constants.give(context, program);
            gl::dispatch_items(program, slice.begin, slice.end);
        },
        first_slice);
}

void PassBuilder::draw(const gl::ProgramSource& source, ImageRef target, Constants constants) {
    writes(target);
    auto drawn = source;
    drawn.files.insert(drawn.files.begin(), "lib/full_screen.vert");
    execute([drawn = std::move(drawn), target, constants = std::move(constants)](PassContext& context) {
        context.bind_framebuffer({{target}});
        const auto& program = context.use(drawn);
        constants.give(context, program);
        context.draw_full_screen();
    });
}

void PassBuilder::access(ImageRef ref, bool write, bool previous) {
    pass_->accesses.push_back({Pass::Access::Kind::image, ref.index, write, previous});
}

void PassBuilder::access(BufferRef ref, bool write, bool previous) {
    pass_->accesses.push_back({Pass::Access::Kind::buffer, ref.index, write, previous});
}

void PassBuilder::access(ObjectRef ref, bool write, bool previous) {
    if (previous) throw std::logic_error("pass '" + pass_->name + "' reads the history of an object");
    pass_->accesses.push_back({Pass::Access::Kind::object, ref.index, write, previous});
}

const OutputDescription* GraphBuilder::find_output(const std::string& key) const {
    for (const auto& output : method_.outputs)
        if (output.key == key) return &output;
    return nullptr;
}

const OutputDescription& GraphBuilder::output_of(const std::string& key) const {
    if (const auto* output = find_output(key)) return *output;
    throw std::logic_error("method '" + method_.id + "' has no output '" + key + "'");
}

ResourceText GraphBuilder::text_of_output(const std::string& key) const {
    return text_of(output_of(key));
}

ImageRef GraphBuilder::output(const std::string& key, ImageDesc desc) {
    desc.text = text_of_output(key);
    return image(std::move(desc));
}

BufferRef GraphBuilder::output(const std::string& key, BufferDesc desc) {
    desc.text = text_of_output(key);
    desc.kind = output_of(key).kind;
    return buffer(std::move(desc));
}

void GraphBuilder::refuse_kind(const OutputDescription& output, const std::string& held_by) const {
    throw std::logic_error("output '" + output.key + "' of method '" + method_.id + "' is described as " +
                           to_string(output.kind) + " and held by " + held_by);
}

void GraphBuilder::claim(const ResourceText& text) {
    const auto& key = text.key;
    const bool well_formed = !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.' || c == '_' || c == '-';
    });
    if (!well_formed)
        throw std::logic_error("resource key '" + key + "' is not of lower-case letters, digits and dots");
    if (std::find(keys_.begin(), keys_.end(), key) != keys_.end())
        throw std::logic_error("resource '" + key + "' is declared twice");
    if (const auto* output = find_output(key); output && text != text_of(*output))
        throw std::logic_error("output '" + key + "' of method '" + method_.id +
                               "' is declared with a text of its own; GraphBuilder::output takes that of the "
                               "description");
    keys_.push_back(key);
}

CountedBuffer GraphBuilder::explanation(const std::string& key, BufferDesc desc, CounterDesc counter) {
    desc.growable = true;  // so that the counter tells how many elements are in use
    CountedBuffer result{output(key, std::move(desc)), {}};
    if (counter.key.empty()) counter.key = key + "_count";
    if (counter.label.empty()) counter.label = output_of(key).label;
    counter.doc = std::string("0 while no pixel is picked, and where ") + no_surface + ".";
    counter.growth_of = result.elements;
    result.count = this->counter(std::move(counter));
    return result;
}

void GraphBuilder::tell_apart(std::string& fingerprint) const {
    if (!fingerprint.empty() && !inputs_.shader_changes.empty())
        fingerprint += " shaders " + digest_of(inputs_.shader_changes);
}

ImageRef GraphBuilder::image(ImageDesc desc) {
    claim(desc.text);
    // A pyramid of a small image may have one level, so only the sort of resource counts.
    if (const auto* output = find_output(desc.text.key); output && !is_image(output->kind))
        refuse_kind(*output, "an image");
    tell_apart(desc.fingerprint);
    images_.push_back(std::move(desc));
    return {static_cast<int>(images_.size()) - 1};
}

BufferRef GraphBuilder::buffer(BufferDesc desc) {
    claim(desc.text);
    if (const auto* output = find_output(desc.text.key);
        output && (output->kind != desc.kind || is_image(output->kind)))
        refuse_kind(*output, "a buffer of kind " + to_string(desc.kind));
    if (desc.fields.empty()) throw std::logic_error("buffer '" + desc.text.key + "' has no fields");
    tell_apart(desc.fingerprint);
    buffers_.push_back(std::move(desc));
    return {static_cast<int>(buffers_.size()) - 1};
}

ObjectRef GraphBuilder::object(ObjectDesc desc) {
    claim(desc.text);
    tell_apart(desc.fingerprint);
    objects_.push_back(std::move(desc));
    return {static_cast<int>(objects_.size()) - 1};
}

CounterRef GraphBuilder::counter(CounterDesc desc) {
    const int grown = desc.growth_of.index;
    if (grown >= 0 && !buffers_.at(grown).growable)
        throw std::logic_error("counter '" + desc.key + "' grows buffer '" + buffers_[grown].text.key +
                               "', which is not growable");
    counters_.push_back(std::move(desc));
    return {static_cast<int>(counters_.size()) - 1};
}

PassBuilder GraphBuilder::pass(std::string name, Queue queue) {
    for (const auto& pass : passes_)
        if (pass.name == name) throw std::logic_error("pass '" + name + "' is declared twice");
    Pass pass;
    pass.name = std::move(name);
    pass.queue = queue;
    passes_.push_back(std::move(pass));
    return PassBuilder(passes_.back());
}

int GraphBuilder::batches(int limit) {
    batch_limit_ = std::max(1, limit);
    return std::min(batches_, batch_limit_);
}

}  // namespace ir::graph
