#include "widgets/compare/compare_mode.h"

#include <algorithm>
#include <cmath>

#include "widgets/compare/one_size.h"

namespace ir::widgets {
namespace {

/// Why the first `compared` pictures do not fit, and the mend.
QString refused_sizes(
    const ComparedPictures& all, int compared,
    const QString& advice = ComparedPictures::tr("Render both at one size to compare them.")) {
    const QString refusal = all.sizes_differ(compared);
    return refusal.isEmpty() ? refusal : refusal + QLatin1Char(' ') + advice;
}

/// Of A and B alone.
class OfTwo : public CompareMode {
  public:
    QString refusal(const ComparedPictures& all) const override {
        if (const QString missing = all.missing_picture(); !missing.isEmpty()) return missing;
        return refused_sizes(all, 2);
    }
};

class Wipe : public OfTwo {
  public:
    bool has_divider() const override { return true; }
};

class Lens : public OfTwo {
  public:
    bool has_lens() const override { return true; }
};

class Difference : public OfTwo {
  public:
    std::vector<PaneContent> contents(const ComparedPictures& all) const override {
        return all.held < 0 ? std::vector<PaneContent>{{0, true}} : OfTwo::contents(all);
    }
    QString refusal(const ComparedPictures& all) const override {
        for (const QString& refusal : {OfTwo::refusal(all), all.waits_for_full()})
            if (!refusal.isEmpty()) return refusal;
        return all.noise_unknown();
    }
};

/// All pictures at once.
class SideBySide : public CompareMode {
  public:
    std::vector<PaneContent> contents(const ComparedPictures& all) const override {
        if (all.count() < 2) return CompareMode::contents(all);
        std::vector<PaneContent> contents;
        for (int i = 0; i < all.count(); ++i) contents.push_back({i});
        return contents;
    }
    QString refusal(const ComparedPictures& all) const override {
        if (!all.linked) return {};
        return refused_sizes(
            all, all.count(),
            ComparedPictures::tr("Render both at one size, or unlink the views to see both."));
    }
    QSize grid(const ComparedPictures&, int panes, const SizeIn&) const override {
        const int columns = panes <= 3 ? std::max(1, panes) : int(std::ceil(std::sqrt(double(panes))));
        return {columns, (panes + columns - 1) / columns};
    }
    bool holds_pictures() const override { return false; }
    bool keeps_first() const override { return true; }
};

/// All pictures, below them the differences of neighbours or from one, and behind them a pair of choice.
class Stages : public SideBySide {
  public:
    std::vector<PaneContent> contents(const ComparedPictures& all) const override {
        auto contents = SideBySide::contents(all);
        for (int i = 0; i < all.difference_count(); ++i) contents.push_back({i, true, i});
        if (all.has_pair()) {
            contents.push_back({all.pair.b, false, ComparedPictures::pair_slot});
            contents.push_back({all.pair.a, true, ComparedPictures::pair_slot});
        }
        return contents;
    }
    QString refusal(const ComparedPictures& all) const override {
        // Of three or more each difference says for itself whether there is one.
        return all.count() > 2 || all.has_difference(0) ? QString() : CompareMode::refusal(all);
    }
    /// One row of pictures and one of differences, or more where these show them clearly larger, or all at
    /// once.
    QSize grid(const ComparedPictures& all, int, const SizeIn& size_in) const override {
        const int count = std::max(1, all.count()) + (all.has_pair() ? 1 : 0);
        const QSize row(count, 2);
        const auto zoom = [&](QSize grid) {
            const QSize pane = size_in(grid);
            const QSizeF picture = all.pictures.front()->size();
            return picture.isEmpty() || pane.isEmpty()
                       ? 0.0
                       : std::min(pane.width() / picture.width(), pane.height() / picture.height());
        };
        QSize best = row;
        for (int columns = count - 1; columns > 0; --columns) {
            const QSize rows(columns, 2 * ((count + columns - 1) / columns));
            if (zoom(rows) > (best == row ? clearly : 1) * zoom(best)) best = rows;
        }
        return best;
    }
    QPointF place(const ComparedPictures& all, const PaneContent& content, int, QSize grid) const override {
        const auto at = [&](int picture) {
            return QPointF(picture % grid.width(), 2 * (picture / grid.width()) + content.difference);
        };
        if (content.slot == ComparedPictures::pair_slot) return at(all.count());
        if (!content.difference) return at(content.picture);
        // Between neighbours in one row, else below the first of them.
        const bool is_between = grid.height() == 2 && !all.are_compared_with_one();
        return at(all.ends_of(content.slot).a) + QPointF(is_between ? 0.5 : 0, 0);
    }
    bool is_row() const override { return true; }
    bool keeps_first() const override { return false; }

  private:
    static constexpr double clearly = 1.2;
};

}  // namespace

const CompareMode& CompareMode::of(ComparedPictures::Mode mode) {
    static const CompareMode one_at_a_time;
    static const SideBySide side_by_side;
    static const Wipe wipe;
    static const Lens lens;
    static const Difference difference;
    static const Stages stages;
    switch (mode) {
        case ComparedPictures::Mode::side_by_side:
            return side_by_side;
        case ComparedPictures::Mode::wipe:
            return wipe;
        case ComparedPictures::Mode::lens:
            return lens;
        case ComparedPictures::Mode::difference:
            return difference;
        case ComparedPictures::Mode::stages:
            return stages;
        case ComparedPictures::Mode::single:
        case ComparedPictures::Mode::flip:
            break;
    }
    return one_at_a_time;
}

std::vector<PaneContent> CompareMode::contents(const ComparedPictures& all) const {
    if (all.held >= 0) return {{all.held}};
    return {{all.mode == ComparedPictures::Mode::flip ? all.flipped : 0}};
}

QString CompareMode::refusal(const ComparedPictures& all) const {
    return refused_sizes(all, all.count());
}

QSize CompareMode::grid(const ComparedPictures&, int, const SizeIn&) const {
    return {1, 1};
}

QPointF CompareMode::place(const ComparedPictures&, const PaneContent&, int pane, QSize grid) const {
    return QPointF(pane % grid.width(), pane / grid.width());
}

}  // namespace ir::widgets
