#include "widgets/image/prepared_picture.h"

#include <algorithm>
#include <cmath>

#include "renderers/image/channels.h"
#include "renderers/image/colour_map.h"

namespace ir::widgets {
namespace {

/// More than a person holds keys for; each entry is small unless the image has more than four channels.
constexpr std::size_t remembered = 10;

bool same(const std::weak_ptr<const Image>& known, const std::shared_ptr<const Image>& image) {
    return known.lock() == image;
}

std::shared_ptr<const CoverMap> cover_of(const Picture& picture) {
    const Image& image = *picture.image;
    const Image* valid = picture.valid.get();
    if (valid && (valid->width != image.width || valid->height != image.height)) valid = nullptr;
    if (picture.atlas.tiles.empty() && !valid) return nullptr;
    const bool gaps = !picture.atlas.tiles.empty();
    auto cover =
        std::make_shared<CoverMap>(std::size_t(image.width) * image.height, gaps ? Cover::gap : Cover::value);
    for (const auto& tile : picture.atlas.tiles)
        for (int y = std::max(0, tile.y); y < std::min(image.height, tile.y + tile.height); ++y)
            for (int x = std::max(0, tile.x); x < std::min(image.width, tile.x + tile.width); ++x)
                (*cover)[std::size_t(y) * image.width + x] = Cover::value;
    if (!valid) return cover;
    for (std::size_t i = 0; i < cover->size(); ++i)
        if ((*cover)[i] == Cover::value && !(valid->pixels[i * valid->channels] > 0.5f))
            (*cover)[i] = Cover::hidden;
    return cover;
}

std::shared_ptr<const Occurring> occurring_in(const Picture& picture, const Image& shown,
                                              const CoverMap* cover) {
    auto found = std::make_shared<Occurring>();
    bool any = false;
    std::vector<bool> named(picture.categories.size());
    const int values = value_channels(picture.semantic, shown.channels);
    const std::size_t pixels = shown.pixels.size() / std::size_t(std::max(1, shown.channels));
    for (std::size_t i = 0; i < pixels; ++i) {
        if (cover && (*cover)[i] != Cover::value) {
            found->hidden |= (*cover)[i] == Cover::hidden;
            if ((*cover)[i] == Cover::gap) continue;
        }
        const float* pixel = &shown.pixels[i * std::size_t(shown.channels)];
        const bool hidden = cover && (*cover)[i] == Cover::hidden;
        for (int c = 0; c < values; ++c) {
            const bool infinite = std::isinf(pixel[c]), negative = pixel[c] < 0;
            (hidden ? found->hidden_bad : found->bad)
                .add({std::isnan(pixel[c]), infinite && !negative, infinite && negative, negative});
            if (!std::isfinite(pixel[c]) || hidden) continue;
            found->least = any ? std::min(found->least, pixel[c]) : pixel[c];
            found->greatest = any ? std::max(found->greatest, pixel[c]) : pixel[c];
            any = true;
        }
        for (std::size_t k = 0; k < named.size(); ++k)
            if (!named[k]) named[k] = shows(pixel, shown.channels, picture.categories[k]);
    }
    for (std::size_t k = 0; k < named.size(); ++k)
        if (named[k]) found->categories.push_back(picture.categories[k]);
    return found;
}

}  // namespace

Cover PreparedPicture::cover_at(int x, int y) const {
    return cover ? (*cover)[std::size_t(y) * shown->width + x] : Cover::value;
}

PreparedPicture PictureCache::prepare(std::shared_ptr<const Picture> picture, const Display& display) {
    PreparedPicture result;
    result.display = display;
    result.picture = std::move(picture);
    if (!result.picture || !result.picture->has_image()) return result;
    const bool many = result.picture->image->channels > 4;
    const Entry& entry = entry_for(*result.picture, many ? display.channel : -1);
    result.shown = entry.derived ? entry.derived : result.picture->image;
    result.cover = entry.cover;
    result.occurring = entry.occurring;
    if (many) result.display.channel = -1;
    return result;
}

const PictureCache::Entry& PictureCache::entry_for(const Picture& picture, int channel) {
    std::erase_if(entries_, [](const Entry& entry) {
        return entry.image.expired() || (entry.masked && entry.valid.expired());
    });
    const auto known = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
        return same(entry.image, picture.image) && same(entry.valid, picture.valid) &&
               entry.channel == channel && entry.atlas.tiles == picture.atlas.tiles;
    });
    if (known != entries_.end()) {
        std::rotate(known, known + 1, entries_.end());
        return entries_.back();
    }
    Entry entry{picture.image, picture.valid, picture.valid != nullptr, picture.atlas,
                channel,       nullptr,       cover_of(picture),        nullptr};
    if (picture.image->channels > 4)
        entry.derived = std::make_shared<const Image>(shown_channels(*picture.image, channel));
    entry.occurring =
        occurring_in(picture, entry.derived ? *entry.derived : *picture.image, entry.cover.get());
    if (entries_.size() >= remembered) entries_.erase(entries_.begin());
    entries_.push_back(std::move(entry));
    return entries_.back();
}

}  // namespace ir::widgets
