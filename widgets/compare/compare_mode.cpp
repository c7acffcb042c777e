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
    /// Two in a view that is higher than wide stand one below the other where that shows them clearly larger.
    QSize grid(const ComparedPictures& all, int panes, const SizeIn& size_in) const override {
        if (panes == 2) {
            const QSize row(2, 1), column(1, 2), view = size_in(QSize(1, 1));
            const bool is_larger = zoom(all, size_in(column)) > clearly * zoom(all, size_in(row));
            return view.height() > view.width() && is_larger ? column : row;
        }
        const int columns = panes <= 3 ? std::max(1, panes) : int(std::ceil(std::sqrt(double(panes))));
        return {columns, (panes + columns - 1) / columns};
    }
    bool holds_pictures() const override { return false; }
    bool keeps_first() const override { return true; }

  protected:
    static constexpr double clearly = 1.2;  ///< so much larger justifies another order
    /// By how much a picture that fills such a pane is enlarged.
    static double zoom(const ComparedPictures& all, QSize pane) {
        const QSizeF picture = all.pictures.front()->size();
        return picture.isEmpty() || pane.isEmpty()
                   ? 0.0
                   : std::min(pane.width() / picture.width(), pane.height() / picture.height());
    }
};

/// Where the pictures of a row stand in columns and rows; the last one is that of the pair, if there is one.
/// Each has its difference in the cell below. Those at the end that have none stand one below the other, or
/// in rows of their own, so that no cells stay empty.
struct RowPlan {
    std::vector<QPoint> places;
    int rows = 0;

    RowPlan(const ComparedPictures& all, int columns) {
        const int count = std::max(1, all.count()) + all.has_pair();
        int single = 0;
        while (!all.has_pair() && single + 1 < count && !all.is_compared(count - 1 - single)) ++single;
        const int compared = count - single, lines = (compared + columns - 1) / columns;
        rows = 2 * lines;
        for (int i = 0; i < compared; ++i) places.emplace_back(i % columns, 2 * (i / columns));
        const int free = lines * columns - compared;
        for (int i = 0; i < single; ++i)
            places.push_back(single <= 2 * free ? QPoint((compared + i % free) % columns, rows - 2 + i / free)
                                                : QPoint(i % columns, rows + i / columns));
        if (single > 2 * free) rows += (single + columns - 1) / columns;
    }
};

/// All pictures, below them the differences of neighbours or from what is right, and behind them a pair of
/// choice.
class Stages : public SideBySide {
  public:
    std::vector<PaneContent> contents(const ComparedPictures& all) const override {
        auto contents = SideBySide::contents(all);
        for (int i = 0; i < all.count(); ++i)
            if (all.is_compared(i)) contents.push_back({i, true, i});
        if (all.has_pair()) {
            const auto [a, b] = all.ends_of(ComparedPictures::pair_slot);
            contents.push_back({b, false, ComparedPictures::pair_slot});
            contents.push_back({a, true, ComparedPictures::pair_slot});
        }
        return contents;
    }
    QString refusal(const ComparedPictures& all) const override {
        // Of three or more each difference says for itself whether there is one.
        const bool is_more = all.count() > 2 || all.has_difference(all.pairs().front());
        return is_more ? QString() : CompareMode::refusal(all);
    }
    /// As few rows as can be, or more where these show pictures clearly larger, or all at once.
    QSize grid(const ComparedPictures& all, int, const SizeIn& size_in) const override {
        const auto zoom_in = [&](QSize grid) { return zoom(all, size_in(grid)); };
        int columns = std::max(1, all.count()) + all.has_pair();
        const int fewest = RowPlan(all, columns).rows;
        while (columns > 1 && RowPlan(all, columns - 1).rows == fewest) --columns;
        const QSize row(columns, fewest);
        QSize best = row;
        while (--columns > 0) {
            const QSize rows(columns, RowPlan(all, columns).rows);
            if (zoom_in(rows) > (best == row ? clearly : 1) * zoom_in(best)) best = rows;
        }
        return best;
    }
    QPointF place(const ComparedPictures& all, const PaneContent& content, int, QSize grid) const override {
        const auto places = RowPlan(all, grid.width()).places;
        const bool is_pair = content.slot == ComparedPictures::pair_slot;
        const QPointF at = is_pair ? places.back() : places[std::size_t(content.picture)];
        if (!content.difference) return at;
        // Between neighbours in one row, else below the first of them.
        const bool is_between = !is_pair && grid.height() == 2 && !all.are_compared_with_one();
        return at + QPointF(is_between ? 0.5 : 0, 1);
    }
    bool is_row() const override { return true; }
    bool keeps_first() const override { return false; }
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
