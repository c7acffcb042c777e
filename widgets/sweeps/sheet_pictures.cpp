#include "widgets/sweeps/sheet_pictures.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "renderers/core/error.h"
#include "renderers/image/difference.h"
#include "renderers/image/exr.h"
#include "widgets/compare/difference_worker.h"

namespace ir::widgets {
namespace {

struct Sheet {
    Image image, valid;
};

Sheet read_sheet(const QString& file) {
    Sheet sheet;
    for (auto& layer : read_exr(file.toStdString())) {
        if (layer.name.empty()) sheet.image = std::move(layer.image);
        if (layer.name == "valid") sheet.valid = std::move(layer.image);
    }
    if (sheet.image.empty()) throw InputError(file.toStdString(), "", "has no picture");
    return sheet;
}

/// As many pixels as there is room for.
QImage reduced(QImage image, std::size_t max_pixels) {
    const double pixels = double(image.width()) * image.height();
    if (pixels <= double(max_pixels)) return image;
    const double scale = std::sqrt(double(max_pixels) / pixels);
    const QSize size = (QSizeF(image.size()) * scale).toSize().expandedTo({1, 1});
    return image.scaled(size, Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
}

/// Where there is no value.
void grey_out(QImage& picture, const Image& valid) {
    for (int y = 0; y < valid.height; ++y)
        for (int x = 0; x < valid.width; ++x)
            if (valid.at(x, y) <= 0.5f)
                picture.setPixel(x, y, qRgb(zero_grey[0], zero_grey[1], zero_grey[2]));
}

double power_of_two_above(double value) {
    return value > 0 ? std::exp2(std::ceil(std::log2(value) - 1e-9)) : 0;
}

}  // namespace

struct SheetPictures::Reference {
    QString file, version;
    Sheet sheet;
};

SheetPictures::SheetPictures(std::size_t max_bytes, QObject* parent)
    : QObject(parent), max_bytes_(max_bytes), reference_(std::make_shared<Reference>()) {}

void SheetPictures::forget_all() {
    entries_.clear();
    bytes_ = 0;
    ++serial_;
}

void SheetPictures::set_semantic(Semantic semantic) {
    if (semantic == semantic_) return;
    semantic_ = semantic;
    restart();
}

void SheetPictures::restart() {
    display_.reset();
    extent_ = 0;
    forget_all();
}

void SheetPictures::set_exposure(double stops) {
    if (stops == stops_) return;
    stops_ = stops;
    drop(false);
    ++serial_;
    emit arrived();
}

void SheetPictures::drop(bool are_differences) {
    std::erase_if(entries_, [&](const auto& each) {
        if (each.first.reference.isEmpty() == are_differences) return false;
        bytes_ -= std::size_t(each.second.image.sizeInBytes());
        return true;
    });
}

void SheetPictures::want(std::vector<SheetRequest> requests) {
    wanted_ = std::move(requests);
    ++clock_;
    for (const auto& request : wanted_)
        if (const auto found = entries_.find(request); found != entries_.end()) found->second.used = clock_;
    read_next();
}

const QImage* SheetPictures::find(const SheetRequest& request) const {
    const auto found = entries_.find(request);
    return found == entries_.end() || found->second.image.isNull() ? nullptr : &found->second.image;
}

QString SheetPictures::problem(const SheetRequest& request) const {
    const auto found = entries_.find(request);
    return found == entries_.end() ? QString() : found->second.problem;
}

void SheetPictures::read_next() {
    if (job_.is_running()) return;
    const auto next = std::find_if(wanted_.begin(), wanted_.end(), [this](const SheetRequest& request) {
        return !request.picture.isEmpty() && entries_.count(request) == 0;
    });
    if (next == wanted_.end()) return;
    Look look{semantic_, display_, stops_, extent_, 0, serial_};
    // All that is seen has room, and as much beside it.
    look.max_pixels =
        std::max<std::size_t>(1024, max_bytes_ / 4 / std::max<std::size_t>(16, 2 * wanted_.size()));
    job_.start([this, request = *next, look, reference = reference_](const std::atomic<bool>&) mutable {
        auto entry = read(request, look, *reference);
        return [this, request, look, entry = std::move(entry)] { take(request, entry, look); };
    });
}

SheetPictures::Entry SheetPictures::read(const SheetRequest& request, Look& look, Reference& reference) {
    Entry entry;
    try {
        const auto sheet = read_sheet(request.picture);
        if (request.reference.isEmpty()) {
            if (!look.display) look.display = display_for(look.semantic, {}, sheet.image);
            auto display = *look.display;
            display.exposure += look.stops;
            entry.image = reduced(to_qimage(sheet.image, display), look.max_pixels);
            return entry;
        }
        if (reference.file != request.reference || reference.version != request.version) {
            reference.sheet = read_sheet(request.reference);
            reference.file = request.reference;
            reference.version = request.version;
        }
        const auto mask = [](const Image& valid) { return valid.empty() ? nullptr : &valid; };
        const auto apart = difference(sheet.image, reference.sheet.image, DifferenceKind::signed_,
                                      mask(sheet.valid), mask(reference.sheet.valid), look.semantic);
        auto display = display_for_difference(DifferenceKind::signed_, apart.image);
        look.extent = std::max(look.extent, power_of_two_above(display.high));
        display.low = -look.extent;
        display.high = look.extent;
        auto coloured = to_qimage(apart.image, display);
        grey_out(coloured, apart.valid);
        entry.image = reduced(std::move(coloured), look.max_pixels);
    } catch (const Error& error) {
        entry.problem = QString::fromUtf8(error.what());
    }
    return entry;
}

void SheetPictures::take(const SheetRequest& request, Entry entry, const Look& look) {
    ++read_count_;
    if (look.serial == serial_) {
        if (!display_) display_ = look.display;
        if (look.extent > extent_) {
            extent_ = look.extent;
            // Those with the smaller one are not to be compared with it.
            drop(true);
        }
        entry.used = clock_;
        bytes_ += std::size_t(entry.image.sizeInBytes());
        entries_[request] = std::move(entry);
        drop_oldest();
    }
    read_next();
    emit arrived();
}

void SheetPictures::drop_oldest() {
    while (bytes_ > max_bytes_) {
        auto oldest = entries_.end();
        for (auto each = entries_.begin(); each != entries_.end(); ++each)
            if (each->second.used < clock_ &&
                (oldest == entries_.end() || each->second.used < oldest->second.used))
                oldest = each;
        if (oldest == entries_.end()) return;  // all that are there are seen
        bytes_ -= std::size_t(oldest->second.image.sizeInBytes());
        entries_.erase(oldest);
    }
}

}  // namespace ir::widgets
