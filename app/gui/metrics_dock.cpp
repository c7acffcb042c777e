#include "app/gui/metrics_dock.h"

#include <algorithm>

#include "app/gui/json_fields.h"
#include "app/gui/text_of.h"
#include "widgets/compare/one_size.h"

namespace ir::gui {
namespace {

using widgets::ViewSource;

constexpr std::size_t max_remembered = 64;

std::string source_text(const ViewSource& source) {
    return source.owner + "/" + source.output + "/" + std::to_string(source.level) + "/" +
           std::to_string(source.layer);
}

std::string key_of(const auto& pairs) {
    std::string key;
    for (const auto& pair : pairs) key += (key.empty() ? "" : " ") + pair.key();
    return key;
}

/// Stands for a refusal that is found while measuring.
const QString turned = QStringLiteral("turned");

/// Ids of owners hold no '/'.
std::string mask_id(const std::string& owner, const std::string& output) {
    return owner + "/" + output;
}

ViewSource mask_of(const std::string& id) {
    const auto slash = id.find('/');
    if (slash == std::string::npos) return {};
    return {id.substr(0, slash), id.substr(slash + 1)};
}

}  // namespace

std::string MetricsDock::Pair::key() const {
    return source_text(a) + " " + source_text(b);
}

MetricsDock::MetricsDock(Session& session, LivePictures& live, Workspace& workspace)
    : session_(session),
      live_(live),
      workspace_(workspace),
      views_(workspace.views()),
      panel_(new widgets::MetricsPanel) {
    using Panel = widgets::MetricsPanel;
    connect(&views_, &ViewModel::active_changed, this, &MetricsDock::update);
    connect(&workspace_, &Workspace::picture_shown, this, &MetricsDock::update);
    connect(&workspace_.tools(), &PictureTools::region_changed, this, &MetricsDock::update);
    connect(&workspace_.tools(), &PictureTools::tool_changed, this, &MetricsDock::update);
    connect(panel_, &Panel::rectangle_chosen, this,
            [this](QRect rectangle) { workspace_.tools().set_region(panel_->fields().size, rectangle); });
    connect(panel_, &Panel::drawing_toggled, this, [this](bool on) {
        using Tool = widgets::ImageView::Tool;
        workspace_.tools().set_tool(on ? Tool::rectangle : Tool::inspect);
        if (on) workspace_.active_pane().setFocus();
    });
    connect(panel_, &Panel::swap_wanted, this, [this] { workspace_.active_pane().compare().swap(); });
    connect(panel_, &Panel::mask_chosen, this, &MetricsDock::choose_mask);
    connect(panel_, &Panel::override_wanted, this, &MetricsDock::compare_anyway);
}

void MetricsDock::set_visible(bool visible) {
    if (visible == visible_) return;
    visible_ = visible;
    update();
}

/// None where the active view shows one picture, space or a table.
MetricsDock::Pairs MetricsDock::pairs() const {
    if (!session_.has_project() || !workspace_.pane(workspace_.area().active())) return {};
    const auto& pane = workspace_.active_pane();
    const auto& state = views_.active_state();
    const auto& compared = workspace_.active_pane().compare().compared();
    const auto sources = views_.rules().places(state);
    if (pane.content() != widgets::ViewPane::Content::picture || compared.mode != state.mode ||
        compared.count() != int(views_.rules().pictures(state).size()))
        return {};
    Pairs all;
    for (const auto& [a, b] : compared.pairs())
        all.push_back({sources[std::size_t(a)], sources[std::size_t(b)], compared.picture(a),
                       compared.picture(b), compared.name(a), compared.name(b)});
    return all;
}

std::vector<widgets::Option> MetricsDock::masks(const Pairs& pairs) const {
    std::vector<widgets::Option> options;
    auto& pictures = views_.pictures();
    std::vector<std::string> owners;
    for (const auto& pair : pairs)
        for (const auto& owner : {pair.a.owner, pair.b.owner})
            if (std::find(owners.begin(), owners.end(), owner) == owners.end()) owners.push_back(owner);
    for (const auto& owner : owners) {
        if (!session_.experiment(owner)) continue;
        for (const auto& output : pictures.outputs(owner))
            if (output.semantic == Semantic::mask && output.kind == OutputKind::image)
                options.push_back(
                    {text_of(mask_id(owner, output.key)),
                     QStringLiteral("%1 · %2").arg(text_of(pictures.owner_name(owner)), output.label),
                     output.doc});
    }
    for (const auto& image : session_.document().images) {
        const std::string owner = "image:" + image.id;
        options.push_back({text_of(mask_id(owner, "")), text_of(pictures.owner_name(owner)),
                           tr("Its first channel; above 0.5 counts")});
    }
    return options;
}

std::optional<ViewSource> MetricsDock::chosen_mask(const Pairs& pairs) const {
    const auto found = masks_.find(key_of(pairs));
    if (found == masks_.end()) return {};
    const auto source = mask_of(found->second);
    return views_.pictures().has_owner(source.owner) ? std::optional(source) : std::nullopt;
}

std::string MetricsDock::generation(const Pair& pair) const {
    return live_.computed_from(pair.a.owner) + "\n" + live_.computed_from(pair.b.owner);
}

void MetricsDock::send_wants(const Pairs& pairs) {
    std::map<std::string, Want> wants;
    const auto mask = visible_ ? chosen_mask(pairs) : std::nullopt;
    if (mask && session_.experiment(mask->owner))
        wants[mask->owner].parts.insert({mask->output, mask->level, mask->layer});
    if (wants == sent_) return;
    sent_ = wants;
    views_.set_panel_wants(std::move(wants), "metrics");
}

QSize MetricsDock::size_of(const Pair& pair) const {
    const bool comparable = widgets::have_difference(*pair.image, *pair.reference);
    return comparable ? pair.image->size().expandedTo(pair.reference->size()) : pair.image->size();
}

widgets::MetricsPair MetricsDock::fields_of(const Pair& pair, const MaskPicture& mask) const {
    widgets::MetricsPair fields{pair.name_a, pair.name_b, pair.image->label, pair.reference->label};
    fields.warning = views_.pictures().warning(pair.a, pair.b);
    for (const auto& [name, each] :
         {std::pair(pair.name_a, pair.image), std::pair(pair.name_b, pair.reference),
          std::pair(tr("The mask"), mask)}) {
        const bool is_draft = each && !each->draft.isEmpty();
        if (!each || (each->has_image() && !is_draft)) continue;
        fields.refusal = is_draft               ? widgets::full_picture_awaited()
                         : each->note.isEmpty() ? tr("%1 has no picture yet.").arg(name)
                                                : tr("%1: %2").arg(name, each->note);
        return fields;
    }
    const QString mismatch = views_.pictures().mismatch().of(pair.a, pair.b);
    fields.may_override = !mismatch.isEmpty() && !is_accepted(pair, mismatch);
    if (fields.may_override) fields.refusal = mismatch;
    return fields;
}

void MetricsDock::update() {
    const auto now = pairs();
    send_wants(now);
    if (!visible_ || now.empty()) {
        panel_->set_fields(
            {.why_empty = tr("Choose two pictures: a mode of the menu Compare that shows both.")});
        return panel_->measure({});
    }
    widgets::MetricsFields fields;
    fields.size = size_of(now.front());
    fields.rectangle = workspace_.tools().region(fields.size);
    fields.drawing = workspace_.tools().tool() == widgets::ImageView::Tool::rectangle;
    fields.masks = masks(now);
    const auto chosen = chosen_mask(now);
    if (chosen) fields.mask = text_of(mask_id(chosen->owner, chosen->output));
    const auto mask = chosen ? views_.pictures().picture(*chosen) : nullptr;
    std::vector<std::optional<widgets::MetricsRequest>> requests;
    for (const auto& pair : now) {
        fields.pairs.push_back(fields_of(pair, mask));
        auto& request = requests.emplace_back();
        if (!fields.pairs.back().refusal.isEmpty()) continue;
        request = {.image = pair.image,
                   .reference = pair.reference,
                   .mask = mask,
                   .rectangle = workspace_.tools().region(size_of(pair)),
                   .pair = pair.key() + " " + fields.mask.toStdString(),
                   .generation = generation(pair),
                   .anyway = is_accepted(pair, turned)};
    }
    panel_->set_fields(fields);
    panel_->measure(requests);
}

void MetricsDock::choose_mask(const QString& id) {
    const auto key = key_of(pairs());
    if (key.empty()) return;
    if (id.isEmpty())
        masks_.erase(key);
    else
        masks_[key] = id.toStdString();
    update();
}

/// A pair that differs in something else than before is refused anew.
bool MetricsDock::is_accepted(const Pair& pair, const QString& refusal) const {
    return accepted_.count(pair.key() + "\n" + refusal.toStdString()) > 0;
}

void MetricsDock::compare_anyway(int pair) {
    const auto now = pairs();
    const auto& shown = panel_->fields().pairs;
    if (pair >= int(std::min(now.size(), shown.size()))) return;
    const auto& refusal = shown[std::size_t(pair)].refusal;
    accepted_.insert(now[std::size_t(pair)].key() + "\n" +
                     (refusal.isEmpty() ? turned : refusal).toStdString());
    update();
}

void MetricsDock::save(projects::Json& memory) const {
    auto& kept = memory["metrics"] = projects::Json::object();
    kept["accepted"] = projects::Json::array();
    for (const auto& each : accepted_) kept["accepted"].push_back(each);
    kept["masks"] = projects::Json::object();
    for (const auto& [pair, mask] : masks_) kept["masks"][pair] = mask;
}

void MetricsDock::load(const projects::Json& memory) {
    accepted_.clear();
    masks_.clear();
    const auto& kept = member_or_null(memory, "metrics");
    for (const auto& each : member_or_null(kept, "accepted"))
        if (each.is_string() && accepted_.size() < max_remembered) accepted_.insert(each.get<std::string>());
    if (const auto& masks = member_or_null(kept, "masks"); masks.is_object())
        for (const auto& [pair, mask] : masks.items())
            if (mask.is_string() && masks_.size() < max_remembered) masks_[pair] = mask.get<std::string>();
    update();
}

}  // namespace ir::gui
