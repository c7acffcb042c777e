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

/// A and B of the active view; absent where it shows one picture, space or a table.
std::optional<MetricsDock::Pair> MetricsDock::pair() const {
    const int active = workspace_.area().active();
    if (!session_.has_project() || !workspace_.pane(active)) return {};
    const auto& pane = workspace_.active_pane();
    const auto& state = views_.active_state();
    const auto& shown = workspace_.active_pane().compare().compared().pictures;
    if (pane.content() != widgets::ViewPane::Content::picture || !widgets::compares(state.mode) ||
        shown.size() < 2)
        return {};
    const bool row = state.mode == widgets::ViewMode::stages;
    if (row && state.more.empty()) return {};
    return Pair{state.a, row ? state.more.front() : state.b, shown[0], shown[1]};
}

std::vector<widgets::Option> MetricsDock::masks(const Pair& pair) const {
    std::vector<widgets::Option> options;
    auto& pictures = views_.pictures();
    std::vector<std::string> owners = {pair.a.owner};
    if (pair.b.owner != pair.a.owner) owners.push_back(pair.b.owner);
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

std::optional<ViewSource> MetricsDock::chosen_mask(const Pair& pair) const {
    const auto found = masks_.find(pair.key());
    if (found == masks_.end()) return {};
    const auto source = mask_of(found->second);
    return views_.pictures().has_owner(source.owner) ? std::optional(source) : std::nullopt;
}

std::string MetricsDock::generation(const Pair& pair) const {
    return live_.computed_from(pair.a.owner) + "\n" + live_.computed_from(pair.b.owner);
}

void MetricsDock::send_wants(const std::optional<Pair>& pair) {
    std::map<std::string, Want> wants;
    const auto mask = visible_ && pair ? chosen_mask(*pair) : std::nullopt;
    if (mask && session_.experiment(mask->owner))
        wants[mask->owner].parts.insert({mask->output, mask->level, mask->layer});
    if (wants == sent_) return;
    sent_ = wants;
    views_.set_panel_wants(std::move(wants), "metrics");
}

void MetricsDock::update() {
    const auto now = pair();
    send_wants(now);
    if (!visible_ || !now) {
        panel_->set_fields(
            {.why_empty = tr("Choose two pictures: mode side by side, wipe, flip or difference "
                             "(Alt+2 … Alt+5).")});
        return panel_->clear();
    }
    widgets::MetricsFields fields;
    fields.label_a = now->image->label;
    fields.label_b = now->reference->label;
    const bool comparable = widgets::have_difference(*now->image, *now->reference);
    fields.size = comparable ? now->image->size().expandedTo(now->reference->size()) : now->image->size();
    fields.rectangle = workspace_.tools().region(fields.size);
    fields.drawing = workspace_.tools().tool() == widgets::ImageView::Tool::rectangle;
    fields.masks = masks(*now);
    const auto mask = chosen_mask(*now);
    if (mask) fields.mask = text_of(mask_id(mask->owner, mask->output));
    const QString mismatch = views_.pictures().mismatch().of(now->a, now->b);
    if (!mismatch.isEmpty() && !is_accepted(*now, mismatch)) {
        fields.refusal = mismatch;
        fields.may_override = true;
    }
    fields.warning = views_.pictures().warning(now->a, now->b);
    const auto picture = mask ? views_.pictures().picture(*mask) : nullptr;
    for (const auto& [letter, each] : {std::pair(tr("A"), now->image), std::pair(tr("B"), now->reference),
                                       std::pair(tr("The mask"), picture)}) {
        const bool is_draft = each && !each->draft.isEmpty();
        if (!each || (each->has_image() && !is_draft)) continue;
        fields.refusal = is_draft               ? widgets::full_picture_awaited()
                         : each->note.isEmpty() ? tr("%1 has no picture yet.").arg(letter)
                                                : tr("%1: %2").arg(letter, each->note);
        fields.may_override = false;
        break;
    }
    panel_->set_fields(fields);
    if (!fields.refusal.isEmpty()) return panel_->clear();
    panel_->measure({.image = now->image,
                     .reference = now->reference,
                     .mask = picture,
                     .rectangle = fields.rectangle,
                     .pair = now->key() + " " + fields.mask.toStdString(),
                     .generation = generation(*now),
                     .anyway = is_accepted(*now, turned)});
}

void MetricsDock::choose_mask(const QString& id) {
    const auto now = pair();
    if (!now) return;
    if (id.isEmpty())
        masks_.erase(now->key());
    else
        masks_[now->key()] = id.toStdString();
    update();
}

/// A pair that differs in something else than before is refused anew.
bool MetricsDock::is_accepted(const Pair& pair, const QString& refusal) const {
    return accepted_.count(pair.key() + "\n" + refusal.toStdString()) > 0;
}

void MetricsDock::compare_anyway() {
    const auto now = pair();
    if (!now) return;
    const auto& refusal = panel_->fields().refusal;
    accepted_.insert(now->key() + "\n" + (refusal.isEmpty() ? turned : refusal).toStdString());
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
