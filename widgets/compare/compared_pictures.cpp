#include "widgets/compare/compared_pictures.h"

#include <algorithm>
#include <tuple>

#include "renderers/image/channels.h"
#include "widgets/compare/compare_mode.h"
#include "widgets/compare/one_size.h"
#include "widgets/compare/significance.h"

namespace ir::widgets {

const std::shared_ptr<const Picture>& ComparedPictures::picture(int place) const {
    return place < count() ? pictures[std::size_t(place)] : references[std::size_t(in_row(place))];
}

const CameraPose* ComparedPictures::pose(int place) const {
    if (poses.empty()) return nullptr;
    return &poses[std::min<std::size_t>(std::size_t(in_row(place)), poses.size() - 1)];
}

QString ComparedPictures::name(int place) const {
    if (place < count()) return place < 26 ? QString(QChar('A' + place)) : QString::number(place + 1);
    const auto& right = picture(place);
    const auto is_it = [&](const auto& each) { return each && each->image == right->image; };
    if (right->has_image())
        if (const auto found = std::find_if(pictures.begin(), pictures.end(), is_it); found != pictures.end())
            return name(int(found - pictures.begin()));
    const bool is_only = std::all_of(references.begin(), references.end(),
                                     [&](const auto& each) { return !each || is_it(each); });
    return is_only || right->label.isEmpty() ? tr("Reference") : right->label;
}

QString ComparedPictures::title(int place) const {
    const QString &label = picture(place)->label, named = name(place);
    return label.isEmpty() || label == named ? named : named + QStringLiteral("   ") + label;
}

Display ComparedPictures::shown_display(int place) const {
    if (place < 0 || in_row(place) >= int(displays.size())) return {};
    const auto kind_of = [](const Picture& each) {
        return std::tuple(each.semantic, each.unit,
                          each.has_image() ? value_channels(each.semantic, each.image->channels) : 0);
    };
    const bool alike = kind_of(*picture(place)) == kind_of(*pictures.front());
    return displays[std::size_t(linked && alike ? 0 : in_row(place))];
}

bool ComparedPictures::has_pair() const {
    return has_pair_end() && pair.a >= 0 && pair.a < count() && pair.b != pair.a;
}

bool ComparedPictures::are_compared_with_one() const {
    return has_pair_end() && pair.a == StagePair::none;
}

bool ComparedPictures::has_reference_of(int picture) const {
    return picture >= 0 && picture < std::min(count(), int(references.size())) &&
           references[std::size_t(picture)];
}

/// Whether B of the pair is there.
bool ComparedPictures::has_pair_end() const {
    if (mode != Mode::stages || count() < 2) return false;
    if (pair.b != StagePair::reference) return pair.b >= 0 && pair.b < count();
    for (int i = 0; i < count(); ++i)
        if ((pair.a == StagePair::none || pair.a == i) && has_reference_of(i)) return true;
    return false;
}

bool ComparedPictures::is_compared(int picture) const {
    if (!are_compared_with_one()) return picture + 1 < count();
    return pair.b == StagePair::reference ? has_reference_of(picture) : picture != pair.b;
}

StagePair ComparedPictures::ends_of(int slot) const {
    const int a = slot == pair_slot ? pair.a : slot;
    if (slot != pair_slot && !are_compared_with_one()) return {a, a + 1};
    return {a, pair.b == StagePair::reference ? count() + a : pair.b};
}

std::vector<StagePair> ComparedPictures::pairs() const {
    if (mode == Mode::single || count() < 2) return {};
    if (mode != Mode::stages) return {{0, 1}};
    std::vector<StagePair> all;
    for (int i = 0; i < count(); ++i)
        if (is_compared(i)) all.push_back(ends_of(i));
    if (has_pair()) all.push_back(ends_of(pair_slot));
    return all;
}

bool ComparedPictures::has_difference(StagePair ends) const {
    return have_difference(*picture(ends.a), *picture(ends.b));
}

QString ComparedPictures::difference_text(const Picture* difference, QPoint pixel) const {
    if (kind != DifferenceKind::significant || !difference || count() < 2) return {};
    const QString numbers = significance_text(*pictures[0], *pictures[1], pixel);
    if (numbers.isEmpty() || difference->size() != pictures[0]->size()) return numbers;
    bool explained = true;
    for (int c = 0; c < difference->image->channels; ++c)
        explained &= difference->image->at(pixel.x(), pixel.y(), c) == 0;
    return numbers + QStringLiteral("   ") + (explained ? tr("within noise") : tr("significant"));
}

QString ComparedPictures::refusal() const {
    if (mode == Mode::single) return {};
    if (count() < 2) return tr("Choose a second picture to compare with.");
    return CompareMode::of(mode).refusal(*this);
}

QString ComparedPictures::missing_picture() const {
    for (int i = 0; i < std::min(2, count()); ++i)
        if (!pictures[i]->has_image())
            return pictures[i]->note.isEmpty() ? tr("%1 has no picture yet.").arg(name(i))
                                               : tr("%1: %2").arg(name(i), pictures[i]->note);
    return {};
}

QString ComparedPictures::waits_for_full() const {
    for (int i = 0; i < std::min(2, count()); ++i)
        if (!pictures[i]->draft.isEmpty()) return full_picture_awaited();
    return {};
}

QString ComparedPictures::sizes_differ(int pictures_compared) const {
    int first = -1;
    for (int i = 0; i < std::min(pictures_compared, count()); ++i) {
        if (!pictures[i]->has_image()) continue;
        if (first < 0) first = i;
        if (pictures[i]->size() != pictures[first]->size())
            return tr("Sizes differ: %1 has %2, %3 has %4 pixels.")
                .arg(name(first), size_text(*pictures[first]), name(i), size_text(*pictures[i]));
    }
    return {};
}

QString ComparedPictures::noise_unknown() const {
    if (kind != DifferenceKind::significant || count() < 2) return {};
    const Picture &a = *pictures[0], &b = *pictures[1];
    if (a.awaits_variance || b.awaits_variance) return tr("Waiting for the variance …");
    if (has_variance(a) || has_variance(b)) return {};
    return tr("Neither A nor B comes with its variance, so noise cannot be told from error. %1")
        .arg(noise_hint.isEmpty() ? tr("Compare with a result of a method that estimates it.") : noise_hint);
}

}  // namespace ir::widgets
