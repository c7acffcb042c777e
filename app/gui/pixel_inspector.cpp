#include "app/gui/pixel_inspector.h"

#include <QTimer>
#include <algorithm>
#include <cmath>
#include <utility>

#include "app/gui/beside.h"
#include "app/gui/json_fields.h"
#include "app/gui/pixel_places.h"
#include "app/gui/printed.h"
#include "app/gui/text_of.h"

namespace ir::gui {
namespace {

constexpr std::size_t max_pins = 16;
constexpr int probe_patience_ms = 500;
/// Larger sets are shown on their own, not as a part of an explanation.
constexpr std::uint64_t max_drawn = 20000;

/// World positions, where some image of three or four channels means them.
std::vector<std::array<float, 3>> positions_of(const engine::ProbeResult& result) {
    std::vector<std::array<float, 3>> positions;
    for (const auto& row : result.rows) {
        if (row.semantic != Semantic::position || !row.available || row.channels < 3) continue;
        for (const auto& values : row.values)
            positions.push_back(values.size() < 3 ? std::array<float, 3>{NAN, NAN, NAN}
                                                  : std::array<float, 3>{values[0], values[1], values[2]});
        break;
    }
    return positions;
}

/// Textures and maps have other pixels.
bool shows_pixels_of(const ResourceReport& resource, const FrameReport& report, const std::string& main_key) {
    const auto* main = find_resource(report, main_key);
    if (!main || resource.width == 0) return main != nullptr && resource.is_output;
    return level_of({main->width, main->height}, {resource.width, resource.height}).has_value();
}

}  // namespace

PixelInspector::PixelInspector(Session& session, LivePictures& live, Renderer& renderer, Workspace& workspace)
    : session_(session),
      live_(live),
      renderer_(renderer),
      workspace_(workspace),
      views_(workspace.views()),
      panel_(new widgets::InspectorPanel),
      explain_(new widgets::ExplainPanel) {
    panel_->model().set_thumbnails([this](const std::string& key) {
        return workspace_.thumbnail({experiment(), key});
    });
    connect(&workspace_, &Workspace::cursor_moved, this, [this](QPoint pixel) {
        cursor_ = pixel;
        request();
    });
    connect(&workspace_, &Workspace::picked, this, [this](QPoint pixel) { marked_ = pixel; });
    connect(&workspace_, &Workspace::explain_wanted, this, &PixelInspector::explain);
    connect(&views_, &ViewModel::active_changed, this, &PixelInspector::update);
    connect(&live_, &LivePictures::picture_arrived, this, [this](const std::string& id) {
        if (id == experiment() && !live_.draft(id)) update();
    });
    // A picture arrives before it counts as finished, and until then nothing is known to be empty.
    connect(&live_, &LivePictures::state_changed, this, [this](const std::string& id) {
        if (id == experiment()) update_explain();
    });
    connect(&renderer_, &Renderer::probe_arrived, this, &PixelInspector::on_probe);
    using Panel = widgets::InspectorPanel;
    connect(panel_, &Panel::pin_wanted, this, &PixelInspector::pin);
    connect(panel_, &Panel::pin_removed, this, [this](int number) {
        if (number < 0 || number >= int(pins_.size())) return;
        pins_.erase(pins_.begin() + number);
        show_pins();
        update();
    });
    connect(panel_, &Panel::pins_cleared, this, [this] {
        pins_.clear();
        show_pins();
        update();
    });
    connect(panel_, &Panel::fly_wanted, this, &PixelInspector::fly_wanted);
    connect(panel_, &Panel::explain_wanted, this, &PixelInspector::explain);
    connect(panel_, &Panel::show_wanted, this,
            [this](const QString& key) { views_.show_output(key.toStdString()); });
    connect(panel_, &Panel::compute_wanted, this, [this](const QString& key) {
        computed_.insert(key.toStdString());
        send_wants();
    });
    connect(panel_, &Panel::compute_all_chosen, this, [this](bool on) {
        compute_all_ = on;
        send_wants();
    });
    using Explain = widgets::ExplainPanel;
    connect(explain_, &Explain::show_wanted, this, [this](const QString& key) {
        show_beside(views_, workspace_.area(), experiment(),
                    key.toStdString());  // the explained picture stays
    });
    connect(explain_, &Explain::pixel_cleared, this, &PixelInspector::explain_nothing);
    connect(explain_, &Explain::item_chosen, this, [this](const QString& selector, int item) {
        auto now = views_.inspection(experiment());
        now.chosen[selector.toStdString()] = item;
        views_.set_inspection(experiment(), now);
        update_explain();
    });
}

std::string PixelInspector::experiment() const {
    const auto& owner = views_.active_state().a.owner;
    return session_.experiment(owner) ? owner : std::string();
}

std::optional<QPoint> PixelInspector::explained() const {
    const auto& now = views_.inspection(experiment());
    return now.has_pixel() ? std::optional(QPoint(now.x, now.y)) : std::nullopt;
}

void PixelInspector::set_visible(bool inspector, bool explain) {
    inspector_shown_ = inspector;
    explain_shown_ = explain;
    send_wants();
    update();
}

void PixelInspector::set_thumbnails_wanted(bool wanted) {
    thumbnails_ = wanted;
    send_wants();
}

void PixelInspector::send_wants() {
    std::map<std::string, Want> wants;
    if (const auto id = experiment(); !id.empty()) {
        auto& want = wants[id];
        want.thumbnails = thumbnails_;
        if (inspector_shown_) {
            want.kept = computed_;
            if (compute_all_) want.kept.insert("*");
        }
        if (explain_shown_ || open_explanation_)
            if (explained())
                for (const auto& key : explaining_keys(false)) want.kept.insert(key);
    }
    views_.set_panel_wants(std::move(wants));
}

std::vector<PixelInspector::Explaining> PixelInspector::explaining() const {
    std::vector<Explaining> all;
    const auto* chosen = session_.experiment(experiment());
    const auto* method = chosen ? session_.registry().find(chosen->method) : nullptr;
    if (!method) return all;
    for (const auto& output : method->outputs)
        if (output.explains) all.push_back({output.key, output.label, full_doc(output), output.kind});
    const auto is_known = [&](const std::string& key) {
        return std::ranges::any_of(method->outputs, [&](const auto& output) { return output.key == key; });
    };
    if (const auto result = live_.result(experiment()))
        for (const auto& each : result->report.resources)
            if (each.explains && each.elements > 0 && !is_known(each.key))
                all.push_back({each.key, each.label, each.doc, each.kind});
    return all;
}

std::vector<std::string> PixelInspector::explaining_keys(bool spatial) const {
    std::vector<std::string> keys;
    for (const auto& output : explaining()) {
        const bool drawn = widgets::is_spatial(output.kind) && output.kind != OutputKind::sphere_values;
        if (!spatial || drawn) keys.push_back(output.key);
    }
    return keys;
}

void PixelInspector::pin(QPoint pixel) {
    if (pixel.x() < 0 || std::find(pins_.begin(), pins_.end(), pixel) != pins_.end()) return;
    if (pins_.size() >= max_pins) pins_.erase(pins_.begin());
    pins_.push_back(pixel);
    show_pins();
    update();
}

void PixelInspector::show_pins() {
    std::vector<widgets::PinMark> marks;
    for (int i = 0; i < int(pins_.size()); ++i)
        marks.push_back({pins_[std::size_t(i)], widgets::pin_colour(i), i + 1});
    workspace_.tools().set_pins(std::move(marks));
    emit pins_changed();
}

void PixelInspector::pin_cursor() {
    if (says_none()) return;
    pin(pointed());
}

bool PixelInspector::says_none() {
    const bool is_none = pointed().x() < 0;
    if (is_none) emit said(tr("Mark a pixel first: click it with Inspect (I)."));
    return is_none;
}

void PixelInspector::move_pin(int number, QPoint pixel) {
    if (number < 0 || number >= int(pins_.size()) ||
        std::find(pins_.begin(), pins_.end(), pixel) != pins_.end())
        return;
    pins_[std::size_t(number)] = pixel;
    show_pins();
    update();
}

void PixelInspector::explain(QPoint pixel) {
    if (pixel.x() < 0 || experiment().empty()) return;
    if (const auto why_not = live_.past().why_not_now(); !why_not.isEmpty()) return emit said(why_not);
    auto now = views_.inspection(experiment());
    now.x = pixel.x();
    now.y = pixel.y();
    const auto result = live_.result(experiment());
    open_explanation_ = !explaining().empty() || (result && result->report.can_print);
    views_.set_inspection(experiment(), now);
    send_wants();
    update_explain();
    show_everything();
}

void PixelInspector::explain_cursor() {
    if (says_none()) return;
    explain(pointed());
}

void PixelInspector::explain_nothing() {
    auto now = views_.inspection(experiment());
    now.x = now.y = -1;
    views_.set_inspection(experiment(), now);
    send_wants();
    update_explain();
}

/// Once its buffers are there, an explanation is drawn over the scene.
void PixelInspector::show_everything() {
    if (!open_explanation_) return;
    const auto result = live_.result(experiment());
    const auto pixel = explained();
    if (!result || !pixel || result->inspection.x != pixel->x() || result->inspection.y != pixel->y()) return;
    std::vector<std::string> drawn;
    bool complete = true;
    for (const auto& output : explaining()) {
        if (!widgets::is_spatial(output.kind)) continue;
        const auto* resource = find_resource(result->report, output.key);
        complete = complete && resource && resource->available;
        if (!resource || !resource->available || resource->elements > max_drawn) continue;
        drawn.push_back(output.key);
    }
    if (!complete && live_.state(experiment()) == LivePictures::State::rendering) return;
    if (drawn.empty()) return;
    open_explanation_ = false;
    show_in_space(views_, workspace_.area(), experiment(), drawn);
}

void PixelInspector::update() {
    panel_->set_pins(pins_);
    send_wants();
    update_explain();
    show_everything();
    request();
}

void PixelInspector::update_explain() {
    std::vector<widgets::ExplainOutput> outputs;
    std::vector<widgets::ExplainSelector> selectors;
    const auto id = experiment();
    const auto* chosen = session_.experiment(id);
    const auto* method = chosen ? session_.registry().find(chosen->method) : nullptr;
    const auto result = live_.result(id);
    const auto pixel = explained();
    const auto why_not_now = live_.past().why_not_now();  // buffers of the newest frame explain
    if (method) {
        for (const auto& output : explaining()) {
            const auto* resource = result ? find_resource(result->report, output.key) : nullptr;
            // Without elements, what is not finished may be of an older frame.
            const bool may_lack = resource && resource->elements == 0 && resource->width == 0 &&
                                  !views_.pictures().why_unfinished(id).isEmpty();
            const bool available = resource && resource->available && !may_lack && why_not_now.isEmpty();
            const bool counted = available && resource->width == 0;
            outputs.push_back({output.key, text_of(output.label), text_of(to_string(output.kind)),
                               text_of(output.doc), counted ? qint64(resource->elements) : -1, available,
                               !pixel                  ? QString()
                               : why_not_now.isEmpty() ? views_.pictures().why_empty(id, output.key)
                                                       : why_not_now});
        }
        for (const auto& each : views_.selectors(id))
            selectors.push_back({each.key, text_of(each.label), text_of(each.doc), each.count, each.item});
    }
    explain_->set_content(pixel, outputs, selectors);
    const bool is_changed = chosen && !chosen->shaders.empty();
    explain_->set_on_host(is_changed ? live_.passes_on_host(id) : QString());
    explain_->set_printed(result && result->report.can_print,
                          printed_of(result.get(), views_.inspection(id)));
}

void PixelInspector::request() {
    const auto id = experiment();
    if (!inspector_shown_ || id.empty()) return;
    engine::ProbeRequest probe;
    probe.tag = id;
    if (cursor_.x() >= 0) probe.pixels.push_back({cursor_.x(), cursor_.y()});
    for (const auto& pin : pins_) probe.pixels.push_back({pin.x(), pin.y()});
    if (live_.past().is_elsewhere()) {
        const auto past = live_.result(id);
        const auto main = views_.pictures().key_of({id, {}});
        return show_readings(
            past ? engine::probe(*past, main, probe.pixels) : engine::ProbeResult{id, probe.pixels, {}},
            cursor_.x() >= 0);
    }
    if (!live_.result(id)) return;
    // An execution that is gone never answers.
    if (is_probing_ && probed_tag_ == id && probed_since_.elapsed() < probe_patience_ms) {
        if (!std::exchange(probe_again_, true))
            QTimer::singleShot(probe_patience_ms, this, [this] {
                if (probe_again_) request();
            });
        return;
    }
    probe_again_ = false;
    is_probing_ = true;
    probed_tag_ = id;
    probed_with_cursor_ = cursor_.x() >= 0;
    probed_since_.start();
    renderer_.probe(std::move(probe));
}

void PixelInspector::show_readings(const engine::ProbeResult& result, bool with_cursor) {
    widgets::Readings readings;
    for (const auto& pixel : result.pixels) readings.pixels.push_back({pixel.x, pixel.y});
    if (with_cursor && !readings.pixels.empty()) readings.cursor = readings.pixels.front();
    readings.world = positions_of(result);
    const auto frame = live_.result(result.tag);
    const auto main = views_.pictures().key_of({result.tag, {}});
    for (const auto& row : result.rows) {
        const auto* resource = frame ? find_resource(frame->report, row.key) : nullptr;
        if (!frame || !resource || !shows_pixels_of(*resource, frame->report, main)) continue;
        readings.buffers.push_back({row.key, text_of(row.label), text_of(row.unit), text_of(resource->doc),
                                    text_of(resource->pass), row.semantic, resource->is_output, row.available,
                                    row.channels, row.values, categories_of(resource->categories, "")});
    }
    panel_->set_readings(std::move(readings));
}

void PixelInspector::on_probe(std::shared_ptr<const engine::ProbeResult> result) {
    if (result->tag != probed_tag_) return;
    is_probing_ = false;
    if (result->tag == experiment() && !live_.past().is_elsewhere())
        show_readings(*result, probed_with_cursor_);
    if (std::exchange(probe_again_, false)) request();
}

void PixelInspector::save(projects::Json& memory) const {
    auto& pins = memory["pins"] = projects::Json::array();
    for (const auto& pin : pins_) pins.push_back({pin.x(), pin.y()});
    memory["compute_all"] = compute_all_;
}

void PixelInspector::load(const projects::Json& memory) {
    pins_.clear();
    computed_.clear();
    cursor_ = marked_ = {-1, -1};
    is_probing_ = probe_again_ = open_explanation_ = false;
    for (const auto& pin : member_or_null(memory, "pins"))
        if (pin.is_array() && pin.size() == 2 && pin[0].is_number_integer() && pin[1].is_number_integer() &&
            pins_.size() < max_pins)
            pins_.push_back(
                {std::clamp(pin[0].get<int>(), 0, 65535), std::clamp(pin[1].get<int>(), 0, 65535)});
    compute_all_ = field_or(memory, "compute_all", false);
    panel_->set_compute_all(compute_all_);
    show_pins();
    update();
}

}  // namespace ir::gui
