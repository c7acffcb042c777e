#include "widgets/metrics/metrics_worker.h"

#include <QCoreApplication>
#include <algorithm>
#include <tuple>

#include "renderers/core/error.h"
#include "renderers/image/channels.h"
#include "widgets/compare/one_size.h"

namespace ir::widgets {
namespace {

QString message_text(const char* text) {
    return QCoreApplication::translate("Metrics", text);
}

/// The others are one pass over the pixels each.
bool looks_at_neighbours(const std::string& metric) {
    return metric == "ssim" || metric == "flip" || metric == "hdr-flip";
}

/// Groups of metrics that are measured in one go: the quick ones, then one by one.
std::vector<std::vector<std::string>> groups() {
    std::vector<std::vector<std::string>> result(1);
    for (const auto& name : metric_names()) {
        if (looks_at_neighbours(name))
            result.push_back({name});
        else
            result.front().push_back(name);
    }
    return result;
}

/// Where pixels count: the tiles of an atlas (its gaps are equal in any two pictures) and the chosen mask.
Image mask_of(const MetricsRequest& request) {
    const Picture& picture = *request.image;
    const bool tiled = !picture.atlas.tiles.empty();
    if (!tiled && !request.mask) return {};
    const Image& image = *picture.image;
    Image mask(image.width, image.height, 1, tiled ? 0.0f : 1.0f);
    for (const auto& tile : picture.atlas.tiles)
        for (int y = std::max(0, tile.y); y < std::min(image.height, tile.y + tile.height); ++y)
            for (int x = std::max(0, tile.x); x < std::min(image.width, tile.x + tile.width); ++x)
                mask.at(x, y) = 1;
    if (!request.mask) return mask;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            if (!(request.mask->image->at(x, y) > 0.5f)) mask.at(x, y) = 0;
    return mask;
}

void merge(MetricResult& into, const MetricResult& from) {
    into.values.insert(from.values.begin(), from.values.end());
    into.pixels = from.pixels;
    into.skipped = from.skipped;
}

/// Why pictures at one size can never be compared, in one line: sizes, channels, the mask's size. Empty: they
/// can.
QString why_not_measurable(const MetricsRequest& request) {
    const auto size = [](const Picture& picture) {
        return QStringLiteral("%1×%2").arg(picture.size().width()).arg(picture.size().height());
    };
    const Picture &a = *request.image, &b = *request.reference;
    if (a.size() != b.size())
        return message_text("Sizes differ: A has %1, B has %2 pixels. Render both at one size.")
            .arg(size(a), size(b));
    const auto compared = [&](const Picture& each) {
        return value_channels(a.semantic, each.image->channels);
    };
    if (compared(a) != compared(b))
        return message_text("Channels differ: A has %1, B has %2. Choose outputs of one kind.")
            .arg(a.image->channels)
            .arg(b.image->channels);
    if (request.mask && request.mask->size() != a.size())
        return message_text("The mask has %1 pixels, the pictures have %2. Choose another mask.")
            .arg(size(*request.mask), size(a));
    return {};
}

}  // namespace

bool MetricsRequest::same_as(const MetricsRequest& other) const {
    const auto pixels = [](const std::shared_ptr<const Picture>& each) {
        return each ? each->image : nullptr;
    };
    const auto valid = [](const std::shared_ptr<const Picture>& each) {
        return each ? each->valid : nullptr;
    };
    return continues(other) && generation == other.generation && pixels(image) == pixels(other.image) &&
           pixels(reference) == pixels(other.reference) && pixels(mask) == pixels(other.mask) &&
           valid(image) == valid(other.image) && valid(reference) == valid(other.reference);
}

bool MetricsRequest::continues(const MetricsRequest& other) const {
    return pair == other.pair && rectangle == other.rectangle && anyway == other.anyway &&
           !mask == !other.mask;
}

MetricsResult measure(const MetricsRequest& requested, const std::atomic<bool>& cancelled,
                      const std::function<void(const MetricsResult&)>& partial) {
    MetricsResult result;
    result.request = requested;
    result.complete = true;
    auto request = requested;
    std::tie(request.image, request.reference) = at_one_size(requested.image, requested.reference);
    const Picture &a = *request.image, &b = *request.reference;
    try {
        result.refusal = why_not_measurable(request);
        if (!result.refusal.isEmpty()) return result;
        if (!request.anyway) {
            result.refusal = QString::fromStdString(why_not_comparable(*a.image, *b.image, a.semantic));
            result.may_override = !result.refusal.isEmpty();
            if (result.may_override) return result;
        }
        const Image mask = mask_of(request);
        MetricOptions options;
        options.semantic = a.semantic;
        options.valid_image = a.valid.get();
        options.valid_reference = b.valid.get();
        options.mask = mask.empty() ? nullptr : &mask;
        const QRect& r = request.rectangle;
        if (!r.isEmpty()) result.rectangle.emplace();
        result.complete = false;
        for (const auto& names : groups()) {
            options.rectangle.reset();
            merge(result.image, compute_metrics(*a.image, *b.image, names, options));
            if (!r.isEmpty()) {
                options.rectangle = Rectangle{r.x(), r.y(), r.width(), r.height()};
                merge(*result.rectangle, compute_metrics(*a.image, *b.image, names, options));
            }
            if (cancelled) return result;
            if (partial) partial(result);
        }
        result.complete = true;
    } catch (const Error& error) {
        result.refusal = QString::fromUtf8(error.what());
        result.complete = true;
    }
    return result;
}

MetricsWorker::MetricsWorker(QObject* parent) : QObject(parent) {}

MetricsWorker::~MetricsWorker() {
    for (auto& slot : slots_)
        if (slot.cancelled) *slot.cancelled = true;
    worker_.finish();
}

void MetricsWorker::request(std::size_t slot, const MetricsRequest& request) {
    if (slot >= slots_.size()) slots_.resize(slot + 1);
    auto& each = slots_[slot];
    if (each.has_wanted && request.same_as(each.wanted)) return;
    if (each.running && !request.continues(each.wanted)) *each.cancelled = true;
    each.wanted = request;
    each.has_wanted = true;
    each.running ? void(each.pending = true) : start(slot);
}

void MetricsWorker::clear(std::size_t slot) {
    if (slot >= slots_.size()) return;
    auto& each = slots_[slot];
    if (each.cancelled) *each.cancelled = true;
    each.wanted = {};
    each.has_wanted = each.pending = false;
}

bool MetricsWorker::is_computing() const {
    return std::any_of(slots_.begin(), slots_.end(), [](const Slot& slot) { return slot.running; });
}

void MetricsWorker::start(std::size_t slot) {
    auto& each = slots_[slot];
    each.running = true;
    each.pending = false;
    each.cancelled = std::make_shared<std::atomic<bool>>(false);
    worker_.start([this, slot, request = each.wanted, cancelled = each.cancelled] {
        const auto post = [this, slot](const MetricsResult& result, bool last) {
            auto shared = std::make_shared<const MetricsResult>(result);
            QMetaObject::invokeMethod(
                this, [this, slot, shared, last] { take(slot, shared, last); }, Qt::QueuedConnection);
        };
        const auto result =
            measure(request, *cancelled, [&](const MetricsResult& some) { post(some, false); });
        post(result, true);
    });
}

void MetricsWorker::take(std::size_t slot, std::shared_ptr<const MetricsResult> result, bool last) {
    auto& each = slots_[slot];
    if (last) each.running = false;
    const bool useful =
        each.has_wanted && (result->request.same_as(each.wanted) ||
                            (result->request.continues(each.wanted) && (result->complete || !last)));
    if (last && each.pending) start(slot);
    if (useful || last) emit measured(slot, useful ? std::move(result) : nullptr);
}

}  // namespace ir::widgets
