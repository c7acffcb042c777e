#include "renderers/methods/ldm-indirect/splatting/host/leave_out.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "renderers/core/parallel_for.h"
#include "renderers/methods/ldm-indirect/splatting/found.h"

namespace ir::methods::ldm_indirect {
namespace {

/// By how much a pixel changes where each map's direction, or its opposite, is left out.
struct Changes {
    std::vector<float> along, against;
};

class LeaveOut {
  public:
    LeaveOut(const std::vector<passes::ldm::Direction>& directions, std::span<const Primary> primaries)
        : maps_(directions.size()), primaries_(primaries) {
        for (const auto& direction : directions) {
            x_.push_back(static_cast<float>(direction.centre.x));
            y_.push_back(static_cast<float>(direction.centre.y));
            z_.push_back(static_cast<float>(direction.centre.z));
        }
    }

    /// Of one pixel, in the order of sources.
    Changes of(std::span<const Contribution> all) const {
        Changes changes{std::vector<float>(maps_), std::vector<float>(maps_)};
        std::vector<float> carried(maps_);
        for (auto first = all.begin(); first != all.end();) {
            const auto last = std::find_if(first, all.end(),
                                           [&](const Contribution& c) { return c.source != first->source; });
            leave_out(std::span(first, last), carried, changes);
            first = last;
        }
        return changes;
    }

  private:
    /// What photons of one primary photon add.
    void leave_out(std::span<const Contribution> photons, std::span<float> carried, Changes& changes) const {
        const auto& p = primaries_[photons.front().source];
        float light = 0;
        for (const auto& photon : photons) light += photon.light;
        for (std::size_t i = 0; i < maps_; ++i) {
            const float cosine = p.shading_ws.x * x_[i] + p.shading_ws.y * y_[i] + p.shading_ws.z * z_[i];
            const float others = p.cosine_sum - std::abs(cosine);
            carried[i] = others > 0 ? std::abs(cosine) / others : 0.0f;
            changes.along[i] += cosine > 0 ? light * carried[i] : 0.0f;
            changes.against[i] += cosine > 0 ? 0.0f : light * carried[i];
        }
        for (const auto& photon : photons) {
            const auto map = photon.leg & leg_map;
            const bool is_along = (photon.leg & leg_along) != 0;
            if (map < maps_)
                (is_along ? changes.along : changes.against)[map] -= photon.light * (1 + carried[map]);
        }
    }

    std::size_t maps_;
    std::span<const Primary> primaries_;
    std::vector<float> x_, y_, z_;
};

/// Where the contributions of each pixel that has any begin, and where the last one's end.
std::vector<std::size_t> begins_of_pixels(std::span<const Contribution> sorted) {
    std::vector<std::size_t> begins;
    for (std::size_t i = 0; i < sorted.size(); ++i)
        if (i == 0 || sorted[i].cell != sorted[i - 1].cell) begins.push_back(i);
    begins.push_back(sorted.size());
    return begins;
}

void set_mean(DirectionEffect& effect, double sum, double squares, std::size_t pixels) {
    if (pixels == 0) return;
    effect.change = static_cast<float>(sum / static_cast<double>(pixels));
    effect.effect = static_cast<float>(std::sqrt(squares / static_cast<double>(pixels)));
}

}  // namespace

std::vector<DirectionEffect> effects_of_leaving_out(std::vector<Contribution> contributions,
                                                    std::size_t pixels, std::span<const Primary> primaries,
                                                    const passes::ldm::Options& options, int threads) {
    const auto directions = turned_directions(options);
    std::erase_if(contributions, [&](const Contribution& c) { return c.source >= primaries.size(); });
    std::ranges::sort(contributions, {},
                      [](const Contribution& c) { return std::tuple(c.cell, c.source, c.leg, c.light); });
    const auto begins = begins_of_pixels(contributions);
    const LeaveOut leave_out(directions, primaries);
    std::vector<Changes> changes(begins.size() - 1);
    parallel_for(threads, 0, static_cast<std::int64_t>(changes.size()), [&](std::int64_t i) {
        const auto pixel = static_cast<std::size_t>(i);
        changes[pixel] =
            leave_out.of(std::span(contributions).subspan(begins[pixel], begins[pixel + 1] - begins[pixel]));
    });
    std::vector<DirectionEffect> effects;
    for (std::size_t map = 0; map < directions.size(); ++map)
        for (const int side : {1, -1}) {
            double sum = 0, squares = 0;
            for (const auto& of_pixel : changes) {
                const double change = (side > 0 ? of_pixel.along : of_pixel.against)[map];
                sum += change;
                squares += change * change;
            }
            auto& effect = effects.emplace_back();
            set_region(effect, directions[map], static_cast<int>(map), side);
            set_mean(effect, sum, squares, pixels);
        }
    return effects;
}

}  // namespace ir::methods::ldm_indirect
