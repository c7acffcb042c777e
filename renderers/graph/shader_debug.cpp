#include "renderers/graph/shader_debug.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <regex>

#include "renderers/core/record.h"
#include "renderers/graph/cache.h"
#include "renderers/graph/pass_context.h"
#include "shaders/lib/debug.glsl.h"

namespace ir::graph {
namespace {

/// Of the block: the counts, and the records.
constexpr std::uint64_t head_bytes = 8;
constexpr std::uint64_t block_bytes = head_bytes + debug_capacity * sizeof(DebugRecord);

struct Uniforms {
    glm::ivec2 debug_pixel, debug_size;
    int debug_use;
    IR_FIELDS(debug_pixel, debug_size, debug_use)
};

// Of the shapes; `line` is that of the shader's file.
struct DrawnPoint {
    glm::vec3 position;
    float value;
    std::uint32_t line;
    IR_FIELDS(position, value, line)
};
struct DrawnLine {
    glm::vec3 start, end;
    float value;
    std::uint32_t line;
    IR_FIELDS(start, end, value, line)
};
struct DrawnDisc {
    glm::vec3 centre, normal;
    float radius, value;
    std::uint32_t line;
    IR_FIELDS(centre, normal, radius, value, line)
};

DebugKind kind_of(const DebugRecord& record) {
    return static_cast<DebugKind>(record.kind);
}

bool is_printed(const DebugRecord& record) {
    return kind_of(record) < DebugKind::point || kind_of(record) == DebugKind::no_pixel;
}

float number(const DebugRecord& record, std::size_t index) {
    return std::bit_cast<float>(record.data[index]);
}

glm::vec3 vector(const DebugRecord& record, std::size_t index) {
    return {number(record, index), number(record, index + 1), number(record, index + 2)};
}

template <class Number>
std::string text_of(Number number) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), number).ptr;
    return {text.data(), end};
}

std::string text_of(const DebugRecord& record, std::size_t index) {
    switch (kind_of(record)) {
        case DebugKind::floats:
            return text_of(number(record, index));
        case DebugKind::ints:
            return text_of(static_cast<std::int32_t>(record.data[index]));
        case DebugKind::bools:
            return record.data[index] ? "true" : "false";
        default:
            return text_of(record.data[index]);
    }
}

/// What stands between the parentheses of the line's print() that is in the arguments of so many others; the
/// line where there is none, or several.
std::string argument_of(const std::string& line, std::size_t depth) {
    static const std::regex call(R"(\bprint\s*\()");
    std::vector<std::size_t> ends;  // of the calls that are open
    std::string found;
    for (std::sregex_iterator match(line.begin(), line.end(), call), none; match != none; ++match) {
        const auto begin = std::size_t(match->position() + match->length());
        std::size_t end = begin;
        for (int open = 1; end < line.size(); ++end)
            if (open += line[end] == '(' ? 1 : line[end] == ')' ? -1 : 0; open == 0) break;
        std::erase_if(ends, [&](std::size_t each) { return each < begin; });
        if (ends.size() == depth) {
            if (!found.empty() || end == line.size()) return line;
            found = line.substr(begin, end - begin);
        }
        ends.push_back(end);
    }
    return found.empty() ? line : found;
}

}  // namespace

ShaderDebug::~ShaderDebug() {
    if (buffer_) device_.destroy_buffer(buffer_);
}

void ShaderDebug::begin(glm::ivec2 pixel, glm::ivec2 size) {
    pixel_ = pixel;
    size_ = size;
    mute_.clear();
    noted_.clear();
    uses_.clear();
    is_clear_ = false;
}

gl::Name ShaderDebug::buffer() {
    if (!buffer_) buffer_ = device_.create_buffer(block_bytes, "debug");
    if (!is_clear_) device_.clear_buffer(buffer_, 0, block_bytes);
    is_clear_ = true;
    return buffer_;
}

const gl::Program& ShaderDebug::choose(const std::string& pass, const gl::ProgramSource& source,
                                       const Compiled& compiled) {
    const auto& ordinary = compiled(source);
    if (!ordinary.can_debug()) return ordinary;
    passes_.insert(pass);
    noted_.insert(pass);
    if (!is_asked()) return ordinary;
    auto variant = source;
    variant.debugs = true;
    const auto& program = compiled(variant);
    mute_.insert(program.mute().begin(), program.mute().end());
    if (!program.debugged().empty()) tell(pass, program);
    return program;
}

/// What the variant must know.
void ShaderDebug::tell(const std::string& pass, const gl::Program& program) {
    auto found = std::find(uses_.begin(), uses_.end(), Use{pass, program.debugged().front()});
    const auto first = found - uses_.begin();
    if (found == uses_.end())
        for (const auto& stage : program.debugged()) uses_.push_back({pass, stage});
    program.set(Uniforms{pixel_, size_, static_cast<int>(first)});
}

ShaderDebug::Said ShaderDebug::read() {
    Said said;
    said.mute = mute_;
    if (!is_clear_) return said;  // no program had the block
    device_.barrier();
    std::uint32_t count = 0;
    device_.read_buffer(buffer_, 0, std::as_writable_bytes(std::span(&count, 1)));
    said.records.resize(std::min(count, debug_capacity));
    said.dropped = count - said.records.size();
    if (!said.records.empty())
        device_.read_buffer(buffer_, head_bytes, std::as_writable_bytes(std::span(said.records)));
    return said;
}

gl::StageSource::Line ShaderDebug::line_of(const DebugRecord& record) const {
    return record.use < uses_.size() ? uses_[record.use].source->line(record.line) : gl::StageSource::Line();
}

PrintedValue ShaderDebug::printed(const DebugRecord& record) const {
    const auto line = line_of(record);
    PrintedValue value{record.use < uses_.size() ? uses_[record.use].pass : "",
                       line.place,
                       argument_of(line.text, record.depth),
                       {}};
    if (kind_of(record) == DebugKind::no_pixel) {
        value.text =
            "says nothing here: this stage works for no pixel, so first say which one it is, with "
            "at_clip(position) or at_pixel(pixel)";
        return value;
    }
    for (std::size_t i = 0; i < std::min<std::size_t>(record.numbers, 4); ++i)
        value.text += (i > 0 ? " " : "") + text_of(record, i);
    return value;
}

bool is_debug(const std::string& key) {
    return matches(debug_pattern, key);
}

void declare_debug(GraphBuilder& builder, GraphCache& cache) {
    const auto declare = [&](const char* key, const char* label, const char* call, OutputKind kind,
                             std::vector<Field> fields) {
        const std::string doc = std::string("Where shaders call ") + call +
                                " for the picked pixel. value: its last argument. line: of its file.";
        CountedBuffer result;
        result.elements = builder.buffer({.text = {.key = key, .label = label, .doc = doc},
                                          .kind = kind,
                                          .fields = std::move(fields),
                                          .elements = debug_capacity,
                                          .growable = true});
        result.count = builder.counter(
            {.key = std::string(key) + "_count", .label = label, .doc = doc, .growth_of = result.elements});
        return result;
    };
    const auto points = declare("debug.points", "Drawn points", "draw_point(p)", OutputKind::point_set,
                                record_fields<DrawnPoint>());
    const auto lines = declare("debug.lines", "Drawn lines", "draw_line(a, b)", OutputKind::line_set,
                               record_fields<DrawnLine>());
    const auto discs = declare("debug.discs", "Drawn discs", "draw_disc(centre, normal, radius)",
                               OutputKind::glyphs, record_fields<DrawnDisc>());
    auto pass = builder.pass("what shaders say", Queue::cpu);
    for (const auto& each : {points, lines, discs}) pass.writes(each.elements).counts(each.count);
    pass.execute([points, lines, discs, &cache](PassContext& context) {
        auto& debug = cache.debug;
        const auto said = debug.read();
        auto& printed = cache.report.printed;
        printed.clear();
        std::uint32_t point_count = 0, line_count = 0, disc_count = 0;
        for (const auto& r : said.records) {
            if (is_printed(r)) {
                printed.push_back(debug.printed(r));
                continue;
            }
            const auto line = static_cast<std::uint32_t>(debug.line_of(r).number);
            if (kind_of(r) == DebugKind::point)
                context.elements<DrawnPoint>(points.elements)[point_count++] = {vector(r, 0), number(r, 3),
                                                                                line};
            else if (kind_of(r) == DebugKind::line)
                context.elements<DrawnLine>(lines.elements)[line_count++] = {vector(r, 0), vector(r, 3),
                                                                             number(r, 6), line};
            else
                context.elements<DrawnDisc>(discs.elements)[disc_count++] = {
                    vector(r, 0), vector(r, 3), number(r, 6), number(r, 7), line};
        }
        context.add(points.count, point_count);
        context.add(lines.count, line_count);
        context.add(discs.count, disc_count);
        for (const auto& file : said.mute)
            context.notes().warn(file +
                                 ": print and draw say nothing here: this driver lets no shader of "
                                 "such a stage write");
        if (said.dropped > 0)
            context.notes().warn("shaders say more of the picked pixel than there is room for: the first " +
                                 std::to_string(debug_capacity) + " calls of print and draw are kept, " +
                                 std::to_string(said.dropped) + " are left out");
    });
}

}  // namespace ir::graph
