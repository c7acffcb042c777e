#include <algorithm>
#include <set>

#include "app/gui/stage_chain.h"
#include "app/gui/workspace.h"
#include "projects/names.h"

namespace ir::gui {

using widgets::ViewMode;
using widgets::ViewPane;
using widgets::ViewSource;
using widgets::ViewState;

namespace {

/// Rows of stages begin with at most so many pictures.
constexpr std::size_t most_stages = 6;
/// Buffers of 3D views are sent along up to this size, so that their values can be read.
constexpr std::uint64_t most_sent_bytes = 4u << 20;

using widgets::Space;

Space space_of(const std::vector<widgets::AvailableBuffer>& buffers, const std::string& key) {
    for (const auto& buffer : buffers)
        if (buffer.key == key) return widgets::space_of(buffer.kind, buffer.fields);
    return Space::scene;
}

bool is_picture(OutputKind kind) {
    return kind == OutputKind::image || kind == OutputKind::pyramid || kind == OutputKind::stack;
}

}  // namespace

/// Where an experiment is gone, as after undoing what added it, the view shows what it did before it came,
/// and what it was compared with is not replaced by something that nobody asked for. Where it comes back, as
/// after redoing that, so does what the view showed of it, unless somebody looks at something else by then.
ViewState Workspace::without_lost(int view) const {
    auto state = states_[std::size_t(view)];
    if (!session_.has_project()) return state;
    const auto& gone = gone_[std::size_t(view)];
    if (session_.experiment(gone.state.a.owner) && state.a == gone.instead.a &&
        state.mode == gone.instead.mode)
        return gone.state;
    const auto is_lost = [this](const ViewSource& source) {
        return !source.owner.empty() && !source.is_file() && !session_.experiment(source.owner);
    };
    if (is_lost(state.a) && session_.experiment(before_[std::size_t(view)].a.owner))
        state = before_[std::size_t(view)];
    if (widgets::compares(state.mode) && state.mode != ViewMode::stages && is_lost(state.b))
        state.mode = ViewMode::single;
    return state;
}

ViewState Workspace::completed(ViewState state) const {
    if (!session_.has_project()) return state;
    const auto mend = [this](ViewSource& source) {
        if (!pictures_.has_owner(source.owner)) {
            const auto* chosen = session_.experiment();
            source = {chosen ? chosen->id : std::string(), {}};
        }
        const auto outputs = pictures_.outputs(source.owner);
        const auto* output = pictures_.find(outputs, source.output);
        // A buffer that another method lacks; while nothing is known, it may still come.
        if (!output && !outputs.empty() && (source.is_file() || live_.result(source.owner)))
            source.output.clear(), source.level = source.layer = 0;
        if (!output || !live_.result(source.owner)) return;
        source.level = output->levels < 2 ? 0 : std::min(source.level, output->levels - 1);
        source.layer = output->layers < 2 ? 0 : std::min(source.layer, output->layers - 1);
    };
    mend(state.a);
    // B is chosen when there is something to compare, among all that is there by then.
    if (widgets::compares(state.mode) && !pictures_.has_owner(state.b.owner))
        state.b = another_source(state.a);
    if (pictures_.has_owner(state.b.owner)) mend(state.b);
    state.more.erase(std::remove_if(state.more.begin(), state.more.end(),
                                    [&](const auto& source) { return !pictures_.has_owner(source.owner); }),
                     state.more.end());
    if (state.mode == ViewMode::stages) complete_stages(state);
    if (state.mode == ViewMode::stages && !state.chain && state.more.empty() && live_.result(state.a.owner))
        for (const auto& [source, label] : candidates(state))
            if (source.owner == state.a.owner && state.more.size() + 1 < most_stages)
                state.more.push_back(source);
    // Layers belong to A's experiment; another buffer starts with itself alone.
    const auto outputs = pictures_.outputs(state.a.owner);
    const auto* output = pictures_.find(outputs, state.a.output);
    if (output && widgets::is_spatial(output->kind)) {
        auto& layers = state.space.layers;
        const bool shown = std::any_of(layers.begin(), layers.end(),
                                       [&](const auto& layer) { return layer.key == output->key; });
        if (!shown) {
            const auto buffers = spatial_buffers(state.a.owner);
            const auto before = layers.empty() ? Space::scene : space_of(buffers, layers.front().key);
            layers.clear();
            if (space_of(buffers, output->key) != before) state.space.camera.reset();  // it saw another space
            for (const auto& buffer : buffers)
                if (buffer.key == output->key && !buffer.fields.empty())
                    layers = {widgets::default_layer(buffer)};  // by its fields, once they are known
        }
    }
    return state;
}

/// What A is compared with before anybody chose: the same output of another experiment or image, else
/// another output.
ViewSource Workspace::another_source(const ViewSource& a) const {
    const auto* chosen = session_.experiment(a.owner);
    if (chosen && !chosen->reference.empty() && session_.experiment(chosen->reference))
        return {chosen->reference, {}};
    for (const auto& owner : pictures_.owners())
        if (owner.id.toStdString() != a.owner) return {owner.id.toStdString(), {}};
    const auto outputs = pictures_.outputs(a.owner);
    for (const auto& output : outputs)
        if (output.key != pictures_.key_of(a) && is_picture(output.kind)) return {a.owner, output.key};
    return a;
}

std::vector<ViewSource> Workspace::sources(const ViewState& state) const {
    std::vector<ViewSource> all = {state.a};
    if (content_of(state) != ViewPane::Content::picture) return all;
    if (widgets::compares(state.mode) && state.mode != ViewMode::stages) all.push_back(state.b);
    if (widgets::takes_many(state.mode)) all.insert(all.end(), state.more.begin(), state.more.end());
    if (compares_reference(state)) all.push_back(reference_of(session_, state.a.owner));
    return all;
}

std::vector<std::pair<ViewSource, QString>> Workspace::candidates(const ViewState& state) const {
    std::vector<std::pair<ViewSource, QString>> list;
    const auto outputs = pictures_.outputs(state.a.owner);
    const auto* main = pictures_.find(outputs, {});
    const auto result = live_.result(state.a.owner);
    const auto size_of = [&](const std::string& key) {
        const auto* resource = result ? find_resource(result->report, key) : nullptr;
        return resource ? QSize(resource->width, resource->height) : QSize();
    };
    for (const auto& output : outputs) {
        const ViewSource source{state.a.owner, output.key};
        if (!is_picture(output.kind) || output.key == pictures_.key_of(state.a)) continue;
        if (main && size_of(output.key) != size_of(pictures_.key_of(state.a))) continue;
        list.push_back({source, output.label});
    }
    for (const auto& owner : pictures_.owners())
        if (owner.id.toStdString() != state.a.owner)
            list.push_back({{owner.id.toStdString(), {}}, owner.label});
    return list;
}

ViewPane::Content Workspace::content_of(const ViewState& state) const {
    const auto outputs = pictures_.outputs(state.a.owner);
    const auto* output = pictures_.find(outputs, state.a.output);
    if (!output || is_picture(output->kind)) return ViewPane::Content::picture;
    if (output->kind == OutputKind::table || state.as_table) return ViewPane::Content::table;
    return ViewPane::Content::space;
}

Want Workspace::want_of(const ViewState& state, const std::string& owner) const {
    Want want;
    const auto content = content_of(state);
    if (content == ViewPane::Content::picture)
        for (const auto& source : sources(state))
            if (source.owner == owner) want.parts.insert({source.output, source.level, source.layer});
    const bool differs = state.mode == ViewMode::difference || state.mode == ViewMode::stages;
    if (content == ViewPane::Content::picture && differs && state.difference == DifferenceKind::significant)
        for (const auto& source : sources(state))
            if (const auto key = pictures_.variance_key(source); source.owner == owner && !key.empty())
                want.parts.insert({key, 0, 0});
    if (state.a.owner != owner) return want;
    if (content == ViewPane::Content::table) want.buffers.insert(pictures_.key_of(state.a));
    if (content == ViewPane::Content::space) want.kept.insert(pictures_.key_of(state.a));
    if (content == ViewPane::Content::space)
        for (const auto& layer : state.space.layers) {
            if (!layer.visible) continue;
            want.kept.insert(layer.key);
            // A click says which item an element stands for, as far as sets are small enough to send.
            const auto result = live_.result(owner);
            const auto* resource = result ? find_resource(result->report, layer.key) : nullptr;
            if (resource && resource->bytes <= most_sent_bytes) want.buffers.insert(layer.key);
        }
    return want;
}

void Workspace::open_comparison(const projects::Comparison& comparison) {
    auto state = active_state();
    const auto owner = [this](const std::string& id) {
        return session_.experiment(id) ? id : std::string("image:") + id;
    };
    state.a = {owner(comparison.a), comparison.output};
    state.b = {owner(comparison.b), comparison.output};
    if (state.b.is_image()) state.b.output.clear();
    if (state.a.is_image()) state.a.output.clear();
    state.more.clear();
    state.as_table = false;
    const auto colon = comparison.mode.find(':');
    state.mode = widgets::mode_from_key(comparison.mode.substr(0, colon));
    if (colon != std::string::npos)
        state.difference = widgets::difference_from_key(comparison.mode.substr(colon + 1));
    if (comparison.mode == "flip-metric") {  // as projects called it before there were kinds of it
        state.mode = ViewMode::difference;
        state.difference = DifferenceKind::flip;
    }
    set_state(area_->active(), state);
    if (!comparison.range) return;
    auto shown = display();
    shown.low = comparison.range->x;
    shown.high = comparison.range->y;
    choose_display(shown);
}

projects::Comparison Workspace::as_comparison() {
    const auto& state = active_state();
    const auto id_of = [](const ViewSource& source) {
        return source.is_image() ? source.owner.substr(6) : source.owner;
    };
    projects::Comparison comparison;
    comparison.a = id_of(state.a);
    comparison.b = id_of(state.b);
    comparison.output = state.a.is_image() ? state.b.output : state.a.output;
    comparison.mode = widgets::to_key(state.mode);
    if (state.mode == ViewMode::difference) comparison.mode += ":" + widgets::to_key(state.difference);
    comparison.name =
        projects::comparison_name(pictures_.owner_name(state.a.owner), pictures_.owner_name(state.b.owner));
    if (!is_automatic()) comparison.range = glm::dvec2(display().low, display().high);
    return comparison;
}

}  // namespace ir::gui
