#include "widgets/compare/difference_worker.h"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "renderers/core/error.h"
#include "renderers/image/channels.h"
#include "renderers/image/metrics.h"
#include "widgets/compare/compare_view.h"
#include "widgets/compare/one_size.h"
#include "widgets/compare/significance.h"
#include "widgets/image/preferred_maps.h"

namespace ir::widgets {
namespace {

QString label_of(DifferenceKind kind) {
    switch (kind) {
        case DifferenceKind::signed_:
            return QStringLiteral("%1 − %2");
        case DifferenceKind::absolute:
            return QStringLiteral("|%1 − %2|");
        case DifferenceKind::relative:
            return QStringLiteral("|%1 − %2| / (|%2| + ") +
                   QString::number(double(relative_difference_floor)) + QLatin1Char(')');
        case DifferenceKind::squared:
            return QStringLiteral("(%1 − %2)²");
        case DifferenceKind::flip:
            return QStringLiteral("ꟻLIP of %1 against %2");
        case DifferenceKind::hdr_flip:
            return QStringLiteral("HDR-ꟻLIP of %1 against %2");
        case DifferenceKind::significant:
            return QStringLiteral("%1 − %2 beyond noise");
    }
    return {};
}

QString unit_of(DifferenceKind kind, const QString& unit) {
    switch (kind) {
        case DifferenceKind::signed_:
        case DifferenceKind::absolute:
        case DifferenceKind::significant:
            return unit;
        case DifferenceKind::squared:
            return unit.isEmpty() ? QString() : QStringLiteral("(%1)²").arg(unit);
        case DifferenceKind::relative:
        case DifferenceKind::flip:
        case DifferenceKind::hdr_flip:
            break;
    }
    return {};
}

DifferenceImage computed_difference(const DifferenceRequest& request) {
    const Picture &a = *request.a, &b = *request.b;
    if (request.kind != DifferenceKind::significant)
        return difference(*a.image, *b.image, request.kind, a.valid.get(), b.valid.get(), a.semantic);
    Noise noise;
    noise.variance_a = has_variance(a) ? a.variance.get() : nullptr;
    noise.variance_b = has_variance(b) ? b.variance.get() : nullptr;
    return difference(*a.image, *b.image, request.kind, noise, a.valid.get(), b.valid.get(), a.semantic);
}

double rmse_of(const DifferenceRequest& request) {
    MetricOptions options;
    options.semantic = request.a->semantic;
    options.valid_image = request.a->valid.get();
    options.valid_reference = request.b->valid.get();
    return compute_metrics(*request.a->image, *request.b->image, {"rmse"}, options).values.at("rmse");
}

/// By the names that the reader knows the pictures by: difference() calls them A and B.
void require_equal_channels(const DifferenceRequest& request) {
    const auto channels_of = [&](const Picture& each) {
        return value_channels(request.a->semantic, each.image->channels);
    };
    const int a = channels_of(*request.a), b = channels_of(*request.b);
    if (a == b) return;
    const auto words = QCoreApplication::translate(
        "Difference", "Channels differ: %1 has %2, %3 has %4. Choose outputs of one kind.");
    throw Error(
        words.arg(request.name_a, QString::number(a), request.name_b, QString::number(b)).toStdString());
}

DifferenceRequest at_one_size(const DifferenceRequest& request) {
    auto result = request;
    std::tie(result.a, result.b) = at_one_size(request.a, request.b);
    result.name_a = name_at_size(request.name_a, *request.a, *request.b);
    result.name_b = name_at_size(request.name_b, *request.b, *request.a);
    return result;
}

std::shared_ptr<const DifferenceResult> compute(const DifferenceRequest& request) {
    auto result = std::make_shared<DifferenceResult>();
    result->request = request;
    const auto requested = at_one_size(request);
    Picture picture;
    picture.label = label_of(request.kind).arg(requested.name_a, requested.name_b);
    picture.atlas = request.a->atlas;
    picture.unit = unit_of(request.kind, request.a->unit);
    try {
        require_equal_channels(requested);
        auto computed = computed_difference(requested);
        result->rmse = rmse_of(requested);
        result->automatic = display_for_difference(request.kind, computed.image);
        picture.image = std::make_shared<const Image>(std::move(computed.image));
        if (!computed.valid.empty()) picture.valid = std::make_shared<const Image>(std::move(computed.valid));
    } catch (const Error& error) {
        picture.note = QString::fromUtf8(error.what());
    }
    result->picture = std::make_shared<const Picture>(std::move(picture));
    return result;
}

}  // namespace

bool DifferenceRequest::same_as(const DifferenceRequest& other) const {
    if (!a || !b || !other.a || !other.b) return false;
    if (kind == DifferenceKind::significant &&
        (a->variance != other.a->variance || b->variance != other.b->variance))
        return false;
    return a->image == other.a->image && b->image == other.b->image && a->valid == other.a->valid &&
           b->valid == other.b->valid && kind == other.kind && name_a == other.name_a &&
           name_b == other.name_b;
}

bool DifferenceRequest::continues(const DifferenceRequest& other) const {
    if (!a || !b || !other.a || !other.b) return false;
    return kind == other.kind && a->label == other.a->label && b->label == other.b->label &&
           a->size() == other.a->size() && a->unit == other.a->unit;
}

DifferenceWorker::DifferenceWorker(QObject* parent) : QObject(parent) {}

DifferenceWorker::~DifferenceWorker() {
    worker_.finish();
}

void DifferenceWorker::request(int slot, const DifferenceRequest& request) {
    if (slot >= int(slots_.size())) slots_.resize(slot + 1);
    Slot& each = slots_[slot];
    if (request.same_as(each.wanted)) return;
    each.wanted = request;
    if (each.result && !request.continues(each.result->request)) each.result.reset();
    each.running ? void(each.pending = true) : start(slot);
}

void DifferenceWorker::start(int slot) {
    Slot& each = slots_[slot];
    each.running = true;
    each.pending = false;
    worker_.start([this, slot, request = each.wanted] {
        auto result = compute(request);
        QMetaObject::invokeMethod(
            this, [this, slot, result] { take(slot, result); }, Qt::QueuedConnection);
    });
}

void DifferenceWorker::take(int slot, std::shared_ptr<const DifferenceResult> result) {
    Slot& each = slots_[slot];
    each.running = false;
    const bool useful = each.wanted.same_as(result->request) || each.wanted.continues(result->request);
    if (useful) each.result = std::move(result);
    if (each.pending) start(slot);
    if (useful) emit ready(slot);
}

const DifferenceResult* DifferenceWorker::result(int slot) const {
    return slot < int(slots_.size()) ? slots_[slot].result.get() : nullptr;
}

bool DifferenceWorker::is_outdated(int slot) const {
    const auto* shown = result(slot);
    return shown && !slots_[slot].wanted.same_as(shown->request);
}

bool DifferenceWorker::is_computing() const {
    return std::any_of(slots_.begin(), slots_.end(), [](const Slot& slot) { return slot.running; });
}

void DifferenceWorker::clear() {
    for (auto& slot : slots_) {
        slot.result.reset();
        slot.wanted = {};
        slot.pending = false;
    }
}

Display display_for_difference(DifferenceKind kind, const Image& difference) {
    // Of a pixel the channel of largest magnitude is shown.
    std::vector<float> magnitudes(difference.pixels.size() / std::size_t(difference.channels), 0.0f);
    for (std::size_t i = 0; i < difference.pixels.size(); ++i)
        if (auto& largest = magnitudes[i / std::size_t(difference.channels)];
            std::isfinite(difference.pixels[i]))
            largest = std::max(largest, std::abs(difference.pixels[i]));
    const double m = shown_extent(std::move(magnitudes));
    Display display;
    display.mode = Display::Mode::scalar;
    display.hide_invalid = true;
    display.negative_is_bad = false;
    display.colour_map = map_for_difference(kind);
    display.high = m;
    switch (kind) {
        case DifferenceKind::significant:
            display.grey_zero = true;
            [[fallthrough]];
        case DifferenceKind::signed_:
            display.low = -m;
            break;
        case DifferenceKind::relative:
            display.high = std::min(m, 1.0);
            break;
        case DifferenceKind::flip:
        case DifferenceKind::hdr_flip:
            display.high = 1;  // errors of different pictures are to look different
            break;
        case DifferenceKind::absolute:
        case DifferenceKind::squared:
            break;
    }
    return display;
}

std::string map_for_difference(DifferenceKind kind) {
    const bool has_sign = kind == DifferenceKind::signed_ || kind == DifferenceKind::significant;
    return preferred_map(has_sign ? MappedKind::signed_errors : MappedKind::errors);
}

}  // namespace ir::widgets
