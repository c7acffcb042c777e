#include "app/gui/view_rules.h"

#include <algorithm>

#include "app/gui/stage_chain.h"
#include "renderers/image/channels.h"

namespace ir::gui {

using widgets::Space;
using widgets::StagePair;
using widgets::ViewMode;
using widgets::ViewPane;
using widgets::ViewSource;
using widgets::ViewState;

namespace {

/// Rows of stages begin with at most so many pictures.
constexpr std::size_t max_stages = 6;
/// Buffers of 3D views are sent along up to this size, so that their values can be read.
constexpr std::uint64_t max_sent_bytes = 4u << 20;

Space space_of(const std::vector<widgets::AvailableBuffer>& buffers, const std::string& key) {
    for (const auto& buffer : buffers)
        if (buffer.key == key) return widgets::space_of(buffer.kind, buffer.fields);
    return Space::scene;
}

bool is_none(const ViewSource& source) {
    return source.owner.empty();
}

bool is_picture(OutputKind kind) {
    return kind == OutputKind::image || kind == OutputKind::pyramid || kind == OutputKind::stack;
}

}  // namespace

ViewState ViewRules::completed(ViewState state) const {
    if (!session_.has_project()) return state;
    complete_source(state.a);
    // B is chosen when there is something to compare, among all that is there by then.
    if (widgets::compares(state.mode) && !pictures_.has_owner(state.b.owner))
        state.b = another_source(state.a);
    if (pictures_.has_owner(state.b.owner)) complete_source(state.b);
    widgets::leave_out(state, [this](const auto& source) { return !pictures_.has_owner(source.owner); });
    if (state.mode == ViewMode::stages) complete_stages(state);
    complete_layers(state);
    return state;
}

void ViewRules::complete_source(ViewSource& source) const {
    if (!pictures_.has_owner(source.owner)) {
        const auto* chosen = session_.experiment();
        source = {chosen ? chosen->id : std::string(), {}};
    }
    if (live_.past().is_elsewhere()) return;  // what is missing then may be there now
    const auto outputs = pictures_.outputs(source.owner);
    const auto* output = pictures_.find(outputs, source.output);
    // A buffer that another method lacks; while nothing is known, it may still come.
    if (!output && !outputs.empty() && (source.is_file() || live_.result(source.owner)))
        source.output.clear(), source.level = source.layer = 0;
    if (!output || !live_.result(source.owner)) return;
    source.level = output->levels < 2 ? 0 : std::min(source.level, output->levels - 1);
    source.layer = output->layers < 2 ? 0 : std::min(source.layer, output->layers - 1);
}

/// A chain follows the settings of its experiment: stages come and go with them. Without one, a person's row
/// stays.
void ViewRules::complete_stages(ViewState& state) const {
    const auto chain = stages_of(session_, state.a.owner);
    state.chain |= state.more.empty() && chain.size() > 1;
    if (state.chain) {
        state.more.clear();
        for (std::size_t i = 0; i < chain.size(); ++i) {
            if (i == 0) state.a = chain[i].source;
            if (i > 0) state.more.push_back(chain[i].source);
        }
    }
    const int count = int(state.more.size()) + 1;
    auto& [a, b] = state.pair;
    if (a >= count) a = StagePair::none;
    if (b >= count || b == a) b = StagePair::none;
    const auto right = compared_references(state);
    if (b == StagePair::reference && std::all_of(right.begin(), right.end(), is_none)) b = StagePair::none;
    if (state.chain || !state.more.empty() || !live_.result(state.a.owner)) return;
    for (const auto& [source, shown] : candidates(state))
        if (source.owner == state.a.owner && state.more.size() + 1 < max_stages) state.more.push_back(source);
}

/// Layers belong to A's experiment; another buffer starts with itself alone.
void ViewRules::complete_layers(ViewState& state) const {
    const auto outputs = pictures_.outputs(state.a.owner);
    const auto* output = pictures_.find(outputs, state.a.output);
    if (!output || !widgets::is_spatial(output->kind)) return;
    auto& layers = state.space.layers;
    if (std::any_of(layers.begin(), layers.end(),
                    [&](const auto& layer) { return layer.key == output->key; }))
        return;
    const auto buffers = spatial_buffers(state.a.owner);
    const auto before = layers.empty() ? Space::scene : space_of(buffers, layers.front().key);
    if (space_of(buffers, output->key) != before) state.space.camera.reset();  // it saw another space
    std::vector<widgets::SpaceLayer> chosen;
    for (const auto& buffer : buffers)
        if (buffer.key == output->key && !buffer.fields.empty())
            chosen = {widgets::default_layer(buffer)};  // by its fields, once they are known
    widgets::begin_with(state.space, std::move(chosen));
}

/// What A is compared with before anybody chose: the same output of another experiment or image, else
/// another output.
ViewSource ViewRules::another_source(const ViewSource& a) const {
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

std::vector<ViewSource> ViewRules::pictures(const ViewState& state) const {
    std::vector<ViewSource> all = {state.a};
    if (content_of(state) != ViewPane::Content::picture) return all;
    if (widgets::compares(state.mode) && state.mode != ViewMode::stages) all.push_back(state.b);
    if (widgets::takes_many(state.mode)) all.insert(all.end(), state.more.begin(), state.more.end());
    return all;
}

std::vector<ViewSource> ViewRules::references(const ViewState& state) const {
    if (state.mode != ViewMode::stages) return {};
    const auto shown = pictures(state);
    std::vector<ViewSource> right;
    for (const auto& picture : shown) right.push_back(reference_of(session_, picture.owner));
    const auto first = std::find_if_not(right.begin(), right.end(), is_none);
    const auto of_others = first == right.end() ? ViewSource() : *first;
    for (std::size_t i = 0; i < shown.size(); ++i)
        if (shown[i].is_file()) right[i] = of_others;
    return right;
}

std::vector<ViewSource> ViewRules::compared_references(const ViewState& state) const {
    auto right = state.pair.b == StagePair::reference ? references(state) : std::vector<ViewSource>();
    for (std::size_t i = 0; i < right.size(); ++i)
        if (state.pair.a != StagePair::none && state.pair.a != int(i)) right[i] = {};
    return right;
}

std::vector<ViewSource> ViewRules::places(const ViewState& state) const {
    auto all = pictures(state);
    const auto right = references(state);
    all.insert(all.end(), right.begin(), right.end());
    return all;
}

std::vector<ViewSource> ViewRules::sources(const ViewState& state) const {
    auto all = pictures(state);
    for (const auto& right : compared_references(state))
        if (!is_none(right) && std::find(all.begin(), all.end(), right) == all.end()) all.push_back(right);
    return all;
}

std::vector<widgets::Candidate> ViewRules::candidates(const ViewState& state) const {
    std::vector<widgets::Candidate> list;
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
        list.push_back({source, output});
    }
    for (const auto& owner : pictures_.owners()) {
        if (owner.id.toStdString() == state.a.owner) continue;
        widgets::OutputOption shown;
        shown.label = owner.label;
        shown.doc = owner.tooltip;
        shown.group = QObject::tr("Other experiments, images and results");
        list.push_back({{owner.id.toStdString(), {}}, shown});
    }
    return list;
}

ViewPane::Content ViewRules::content_of(const ViewState& state) const {
    const auto outputs = pictures_.outputs(state.a.owner);
    const auto* output = pictures_.find(outputs, state.a.output);
    if (!output || is_picture(output->kind)) return ViewPane::Content::picture;
    if (output->kind == OutputKind::table || state.as_table) return ViewPane::Content::table;
    return ViewPane::Content::space;
}

Want ViewRules::want_of(const ViewState& state, const std::string& owner) const {
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
            if (resource && resource->bytes <= max_sent_bytes) want.buffers.insert(layer.key);
        }
    return want;
}

bool ViewRules::shows(const ViewState& state, const std::string& owner) const {
    const auto shown = sources(state);
    return std::any_of(shown.begin(), shown.end(), [&](const auto& source) { return source.owner == owner; });
}

std::vector<widgets::AvailableBuffer> ViewRules::spatial_buffers(const std::string& owner) const {
    std::vector<widgets::AvailableBuffer> buffers;
    const auto result = live_.result(owner);
    for (const auto& output : pictures_.outputs(owner)) {
        if (!widgets::is_spatial(output.kind)) continue;
        const auto* resource = result ? find_resource(result->report, output.key) : nullptr;
        buffers.push_back({output.key, output.label.toStdString(), output.kind, output.doc.toStdString(),
                           resource ? resource->fields : std::vector<Field>(), output.group.toStdString()});
    }
    return buffers;
}

bool ViewRules::is_explanation(const ViewSource& source) const {
    const auto result = live_.result(source.owner);
    const auto* resource = result ? find_resource(result->report, pictures_.key_of(source)) : nullptr;
    return resource && resource->explains;
}

QSize ViewRules::main_size(const std::string& owner) const {
    const auto result = live_.result(owner);
    const auto* main = result ? find_resource(result->report, pictures_.key_of({owner, {}})) : nullptr;
    return main ? QSize(main->width, main->height) : QSize();
}

ViewSource ViewRules::meaning_of(const ViewState& state, const ViewSource& source) const {
    const auto foreign = source.is_image() ? pictures_.picture(source) : nullptr;
    if (!foreign || !foreign->has_image()) return source;
    const auto values = [](const widgets::Picture& picture) {
        return value_channels(picture.semantic, picture.image->channels);
    };
    for (const auto& other : sources(state)) {
        const auto ours = other.is_image() ? nullptr : pictures_.picture(other);
        if (ours && ours->has_image() && values(*ours) == values(*foreign)) return other;
    }
    return source;
}

std::string ViewRules::display_key(const ViewSource& source) const {
    return source.is_image() ? source.owner + "/" + source.output : pictures_.key_of(source);
}

std::string ViewRules::difference_key(const ViewState& state) const {
    return "difference:" + widgets::to_key(state.difference) + ":" + display_key(meaning_of(state, state.a));
}

std::string ViewRules::display_key(const ViewState& state) const {
    return state.mode == ViewMode::difference ? difference_key(state)
                                              : display_key(meaning_of(state, state.a));
}

bool ViewRules::is_light(const ViewSource& source) const {
    const auto semantic = pictures_.picture(source)->semantic;
    return semantic == Semantic::radiance || semantic == Semantic::irradiance;
}

bool ViewRules::shows_light(const ViewState& state) const {
    return content_of(state) == ViewPane::Content::picture && state.mode != ViewMode::difference &&
           is_light(meaning_of(state, state.a));
}

QString ViewRules::missing_stages(const ViewState& state) const {
    if (!state.chain || !state.more.empty()) return {};
    if (!has_stages(session_, state.a.owner))
        return QObject::tr(
                   "The method of %1 names no stages. Choose pictures for the row in the list beside.")
            .arg(QString::fromStdString(pictures_.owner_name(state.a.owner)));
    return QObject::tr("Under these settings there is one stage alone.");
}

}  // namespace ir::gui
