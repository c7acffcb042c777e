#include "renderers/passes/viewers/layer_plan.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "renderers/core/words.h"
#include "renderers/image/colour_map.h"

namespace ir::passes::viewers {
namespace {

static_assert(static_cast<int>(FieldType::u32) == type_u32 && static_cast<int>(FieldType::i32) == type_i32 &&
              static_cast<int>(FieldType::f32) == type_f32);

/// A number of vertices that one draw takes on every device, at six for an element.
constexpr std::uint64_t max_drawn = 200'000'000;
/// Software drivers end loops silently after 65,535 iterations, and one texel may have to look at all.
constexpr std::uint64_t max_regions = 32'768;

/// Of layers in one colour.
constexpr std::array layer_colours{tints::orange, tints::sky,       tints::green,
                                   tints::yellow, tints::vermilion, tints::purple};

struct Place {
    std::int32_t offset = -1;
    const Field* field = nullptr;
};

Place find(const std::vector<Field>& fields, const std::string& name) {
    std::int32_t offset = 0;
    for (const auto& field : fields) {
        if (field.name == name) return {offset, &field};
        offset += field.count;
    }
    return {};
}

/// The offset of `count` floats, or -1.
std::int32_t floats(const std::vector<Field>& fields, const char* name, int count) {
    const auto place = find(fields, name);
    const bool fits = place.field && place.field->type == FieldType::f32 && place.field->count >= count;
    return fits ? place.offset : -1;
}

std::string names(const std::vector<Field>& fields) {
    return listed(words_of(fields, &Field::name));
}

void add_note(LayerPlan& plan, const std::string& text) {
    plan.drawn.note += (plan.drawn.note.empty() ? "" : "; ") + text;
}

/// Fills primitive and place; false with a note where a field is missing.
bool place_glyphs(LayerPlan& plan, const std::vector<Field>& fields) {
    const auto centre = floats(fields, "centre", 3), normal = floats(fields, "normal", 3),
               radius = floats(fields, "radius", 1), u = floats(fields, "axis_u", 3),
               v = floats(fields, "axis_v", 3), w = floats(fields, "axis_w", 3);
    plan.block.normal = normal;
    const bool is_disc = normal >= 0 && radius >= 0, has_sides = u >= 0 && v >= 0;
    if (centre < 0 || (!is_disc && !has_sides)) {
        add_note(plan, "'" + plan.wanted.key +
                           "' needs 'centre' with 'normal' and 'radius', or with 'axis_u', " +
                           "'axis_v' and perhaps 'axis_w', all of floats; it has " + names(fields));
        return false;
    }
    plan.primitive = !has_sides ? Primitive::discs
                     : w >= 0   ? Primitive::ellipsoids
                                : Primitive::parallelograms;
    plan.block.place = {centre, has_sides ? u : normal, has_sides ? v : radius, w};
    return true;
}

/// One or two vectors of three floats.
bool place_vectors(LayerPlan& plan, const std::vector<Field>& fields, Primitive primitive, const char* first,
                   const char* second = nullptr) {
    plan.primitive = primitive;
    plan.block.normal = floats(fields, "normal", 3);
    int place = 0;
    for (const char* name : {first, second}) {
        if (!name) continue;
        const auto offset = floats(fields, name, 3);
        if (offset < 0) {
            add_note(plan, "'" + plan.wanted.key + "' needs '" + name + "' of three floats; it has " +
                               names(fields));
            return false;
        }
        plan.block.place[static_cast<std::size_t>(place++)] = offset;
    }
    return true;
}

bool place_sphere(LayerPlan& plan, const std::vector<Field>& fields) {
    if (!place_vectors(plan, fields, Primitive::sphere, "centre")) return false;
    const auto colatitude = floats(fields, "colatitude", 2), longitude = floats(fields, "longitude", 2);
    if (colatitude >= 0 && longitude >= 0) {
        plan.block.colatitude = colatitude;
        plan.block.longitude = longitude;
    }
    return true;
}

bool place_fields(LayerPlan& plan, const std::vector<Field>& fields) {
    switch (plan.drawn.kind) {
        case OutputKind::point_set:
            plan.has_own_space = floats(fields, "place", 3) >= 0;
            return place_vectors(plan, fields, Primitive::points, plan.has_own_space ? "place" : "position");
        case OutputKind::line_set:
            return place_vectors(plan, fields, Primitive::lines, "start", "end");
        case OutputKind::glyphs:
            return place_glyphs(plan, fields);
        case OutputKind::sphere_values:
            return place_sphere(plan, fields);
        default:
            add_note(plan, "'" + plan.wanted.key + "' is of kind " + to_string(plan.drawn.kind) +
                               ", which has no place in space");
            return false;
    }
}

void choose_colour(LayerPlan& plan, const std::vector<Field>& fields, std::size_t index) {
    const auto colour = linear_from_srgb(layer_colours[index % layer_colours.size()]);
    plan.block.red = colour.r;
    plan.block.green = colour.g;
    plan.block.blue = colour.b;
    const auto& wanted = plan.wanted;
    if (wanted.colour_by.empty()) return;
    const auto place = find(fields, wanted.colour_by);
    if (place.field) {
        plan.block.colour_mode = static_cast<std::int32_t>(ColourMode::field);
        plan.block.colour_offset =
            place.offset + std::clamp(wanted.component, 0, std::max(0, place.field->count - 1));
        plan.colour_type = place.field->type;
        plan.block.colour_type = static_cast<std::int32_t>(place.field->type);
    } else if (wanted.colour_by == "facing" && plan.block.normal >= 0) {
        plan.block.colour_mode = static_cast<std::int32_t>(ColourMode::facing);
    } else {
        add_note(plan,
                 wanted.colour_by == "facing"
                     ? "in one colour: 'facing' needs the field 'normal' of three floats"
                     : "in one colour: no field '" + wanted.colour_by + "'; there are " + names(fields));
    }
}

/// The bits of the numbers of the field's type that lie in low … high.
FilterBlock filter_block(const Filter& filter, const Place& place) {
    FilterBlock block{place.offset, static_cast<std::int32_t>(place.field->type), 1, 0};
    const auto whole = [&](auto least, auto most) {
        // past its last number a range is empty, which 1 … 0 says
        if (!(std::ceil(filter.low) <= std::floor(filter.high)) || filter.low > double(most) ||
            filter.high < double(least))
            return;
        using Number = decltype(least);
        const double low = std::max(std::ceil(filter.low), double(least));
        const double high = std::min(std::floor(filter.high), double(most));
        block.low = static_cast<std::uint32_t>(static_cast<Number>(low));
        block.high = static_cast<std::uint32_t>(static_cast<Number>(high));
    };
    switch (place.field->type) {
        case FieldType::u32:
            whole(std::uint32_t{0}, std::numeric_limits<std::uint32_t>::max());
            break;
        case FieldType::i32:
            whole(std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::max());
            break;
        case FieldType::f32:
            block.low = std::bit_cast<std::uint32_t>(static_cast<float>(filter.low));
            block.high = std::bit_cast<std::uint32_t>(static_cast<float>(filter.high));
            break;
    }
    return block;
}

void choose_filters(LayerPlan& plan, const std::vector<Field>& fields) {
    auto& block = plan.block;
    for (const auto& filter : plan.wanted.filters) {
        const auto place = find(fields, filter.field);
        if (!place.field) {
            add_note(plan, "not filtered: no field '" + filter.field + "'; there are " + names(fields));
        } else if (static_cast<std::size_t>(block.filter_count) == block.filters.size()) {
            add_note(plan, "only the first " + std::to_string(block.filters.size()) + " filters are used");
            return;
        } else {
            block.filters[static_cast<std::size_t>(block.filter_count++)] = filter_block(filter, place);
        }
    }
}

void choose_map(LayerPlan& plan) {
    const auto& known = colour_map_names();
    if (std::find(known.begin(), known.end(), plan.wanted.colour_map) != known.end()) return;
    add_note(plan, "no colour map '" + plan.wanted.colour_map + "': shown with viridis");
    plan.wanted.colour_map = "viridis";
}

void choose_step(LayerPlan& plan, std::uint64_t max_elements) {
    const auto limit = std::clamp<std::uint64_t>(
        max_elements, 1, plan.primitive == Primitive::sphere ? max_regions : max_drawn);
    const auto step = (plan.drawn.elements + limit - 1) / limit;
    plan.drawn.stride = step;
    plan.block.step = static_cast<std::uint32_t>(step);
    plan.block.drawn = static_cast<std::uint32_t>((plan.drawn.elements + step - 1) / step);
}

}  // namespace

void keep_spaces_apart(std::vector<LayerPlan>& plans) {
    const bool in_scene = std::any_of(plans.begin(), plans.end(), [](const auto& plan) {
        return plan.drawable && !plan.has_own_space && plan.primitive != Primitive::sphere;
    });
    if (!in_scene) return;
    for (auto& plan : plans) {
        if (!plan.drawable || !plan.has_own_space) continue;
        plan.drawable = false;
        add_note(plan, "'" + plan.wanted.key +
                           "' stands in a space of its own: show it in a view without layers of the scene");
    }
}

LayerPlan plan_layer(const Layer& layer, const std::optional<graph::DeviceBuffer>& buffer, std::size_t index,
                     std::uint64_t max_elements, std::uint64_t max_buffer_bytes) {
    LayerPlan plan;
    plan.wanted = layer;
    plan.drawn.key = layer.key;
    if (!buffer) {
        add_note(plan, "there is no buffer '" + layer.key + "': no pass has made it with these parameters");
        return plan;
    }
    const auto& fields = buffer->desc.fields;
    plan.drawn.kind = buffer->desc.kind;
    plan.drawn.fields = fields;
    plan.drawn.elements = buffer->elements;
    plan.buffer = buffer->name;
    if (!place_fields(plan, fields)) return plan;
    const auto bytes = static_cast<std::uint64_t>(graph::stride(buffer->desc));
    if (buffer->elements == 0) {
        add_note(plan, "'" + layer.key + "' has no elements");
        return plan;
    }
    if (bytes * buffer->elements > max_buffer_bytes) {
        add_note(plan, "'" + layer.key + "' is larger than what a shader of this device can address");
        return plan;
    }
    plan.drawable = true;
    auto& block = plan.block;
    block.words = static_cast<std::uint32_t>(bytes / 4);
    block.number = static_cast<std::uint32_t>(index + 1);
    block.primitive = static_cast<std::int32_t>(plan.primitive);
    block.size_px = std::isfinite(layer.size_px) ? std::clamp(layer.size_px, 1.0f, 64.0f) : 3.0f;
    const bool may_be_translucent = plan.primitive != Primitive::sphere && std::isfinite(layer.opacity);
    plan.opacity = may_be_translucent ? std::clamp(layer.opacity, Layer::min_opacity, 1.0f) : 1;
    choose_step(plan, max_elements);
    choose_colour(plan, fields, index);
    if (plan.block.colour_mode == static_cast<std::int32_t>(ColourMode::field))
        plan.categories = categories_of(buffer->desc.text.categories, layer.colour_by);
    choose_filters(plan, fields);
    choose_map(plan);
    return plan;
}

}  // namespace ir::passes::viewers
