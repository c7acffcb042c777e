#include "widgets/compare/compare_view.h"

#include <QKeyEvent>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "widgets/compare/difference_worker.h"
#include "widgets/compare/one_size.h"
#include "widgets/compare/stage_bar.h"
#include "widgets/compare/view_link.h"

namespace ir::widgets {
namespace {

bool is_plain(const QKeyEvent& event) {
    return !(event.modifiers() & ~Qt::KeyboardModifiers(Qt::KeypadModifier));
}

}  // namespace

CompareView::CompareView(QWidget* parent, ImageView::Surface surface)
    : QWidget(parent),
      panes_(new PaneBoard(this, surface)),
      link_(new ViewLink(this)),
      worker_(new DifferenceWorker(this)),
      bar_(new StageBar(this)) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(panes_, 1);
    layout->addWidget(bar_);
    connect(panes_, &PaneBoard::pane_made, this, &CompareView::connect_pane);
    connect(panes_, &PaneBoard::resized, this, &CompareView::arrange);
    connect(panes_, &PaneBoard::activated, this, [this] { emit activated(active_picture()); });
    connect(panes_, &PaneBoard::picked_changed, this, [this](int pane, QPoint pixel) {
        pointed_pane_ = pane;
        pointed_ = pixel;
        emit picked_changed(pixel);
    });
    connect(panes_, &PaneBoard::caption_pressed, this,
            [this](int pane) { choose_pair(with_chosen(all_.pair, contents_[std::size_t(pane)].picture)); });
    connect(worker_, &DifferenceWorker::ready, this, &CompareView::show_difference);
    connect(bar_, &StageBar::chosen, this, &CompareView::choose_pair);
    setFocusProxy(&main_view());
    refresh();
}

void CompareView::set_pictures(std::vector<std::shared_ptr<const Picture>> pictures) {
    for (auto& picture : pictures)
        if (!picture) picture = make_note({});
    if (pictures == all_.pictures) return;
    all_.pictures = std::move(pictures);
    all_.displays.resize(all_.pictures.size());
    all_.poses.resize(all_.pictures.size(), all_.poses.empty() ? CameraPose() : all_.poses.front());
    if (all_.flipped >= all_.count()) all_.flipped = 0;
    if (all_.held >= all_.count()) all_.held = -1;
    refresh();
}

void CompareView::set_displays(std::vector<Display> displays) {
    all_.displays = std::move(displays);
    all_.displays.resize(all_.pictures.size());
    refresh();
}

void CompareView::set_difference_display(std::optional<Display> display) {
    all_.difference_display = std::move(display);
    refresh();
}

void CompareView::set_mode(Mode mode) {
    if (mode == all_.mode) return;
    all_.mode = mode;
    all_.held = -1;
    all_.flipped = 0;
    refresh();
}

void CompareView::set_difference(DifferenceKind kind) {
    if (kind == all_.kind) return;
    all_.kind = kind;
    refresh();
}

void CompareView::set_stage_pair(StagePair pair) {
    if (pair == all_.pair) return;
    all_.pair = pair;
    refresh();
}

void CompareView::set_references(bool exist, std::vector<std::shared_ptr<const Picture>> pictures) {
    if (exist == all_.has_reference && pictures == all_.references) return;
    all_.has_reference = exist;
    all_.references = std::move(pictures);
    refresh();
}

void CompareView::set_wipe(double fraction) {
    all_.wipe = std::clamp(fraction, 0.0, 1.0);
    main_view().set_wipe(all_.wipe);
}

void CompareView::set_noise_hint(const QString& hint) {
    if (hint == all_.noise_hint) return;
    all_.noise_hint = hint;
    if (!all_.noise_unknown().isEmpty()) refresh();
}

void CompareView::set_camera(const CameraPose& pose, std::optional<int> picture) {
    if (!picture) {
        std::fill(all_.poses.begin(), all_.poses.end(), pose);
        if (all_.poses.empty()) all_.poses.push_back(pose);
        for (int i = 0; i < panes_->pane_count(); ++i) panes_->pane(i).camera().set_pose(pose);
        return;
    }
    if (*picture < 0 || *picture >= int(all_.poses.size())) return;
    all_.poses[std::size_t(*picture)] = pose;
    for (int i = 0; i < int(contents_.size()); ++i)
        if (picture_of(i, {}) == *picture) panes_->pane(i).camera().set_pose(pose);
}

void CompareView::swap() {
    if (all_.count() < 2) return;
    std::swap(all_.pictures[0], all_.pictures[1]);
    std::swap(all_.displays[0], all_.displays[1]);
    std::swap(all_.poses[0], all_.poses[1]);
    if (all_.references.size() > 1) std::swap(all_.references[0], all_.references[1]);
    if (rules().is_row()) all_.pair = with_swapped(all_.pair);
    refresh();
    emit swapped();
}

void CompareView::set_linked(bool linked) {
    if (linked == all_.linked) return;
    all_.linked = linked;
    link_->set_linked(linked);
    refresh();
    emit linked_changed(linked);
}

void CompareView::flip_next() {
    if (all_.mode != Mode::flip || all_.count() < 2) return;
    all_.flipped = (all_.flipped + 1) % all_.count();
    refresh();
    emit activated(all_.flipped);
}

int CompareView::active_picture() const {
    return std::max(0, picture_of(panes_->active(), {}));
}

std::vector<ImageView*> CompareView::views_where(bool row_difference) const {
    std::vector<ImageView*> views;
    for (int i = 0; i < int(contents_.size()); ++i)
        if ((rules().is_row() && contents_[std::size_t(i)].difference) == row_difference)
            views.push_back(&panes_->pane(i));
    return views;
}

std::shared_ptr<const Picture> CompareView::difference_picture() const {
    const auto* result = worker_->result(0);
    return result && result->picture->has_image() ? result->picture : nullptr;
}

std::shared_ptr<const Picture> CompareView::pointed_picture() const {
    const auto& view = panes_->pane(pointed_pane_);
    return is_of_second(pointed_pane_, pointed_) ? view.state().pictures[1].picture : view.picture();
}

bool CompareView::is_computing() const {
    return worker_->is_computing();
}

void CompareView::connect_pane(ImageView* view, int pane) {
    view->installEventFilter(this);
    if (const auto* pose = all_.pose(0)) view->camera().set_pose(*pose);
    connect(view, &ImageView::cursor_moved, this, [this, pane](QPoint pixel) {
        pointed_pane_ = pane;
        pointed_ = pixel;
        emit cursor_moved(pixel, picture_of(pane, pixel));
    });
    connect(view, &ImageView::menu_wanted, this, &CompareView::menu_wanted);
    connect(view, &ImageView::explain_wanted, this, &CompareView::explain_wanted);
    connect(view, &ImageView::zoom_changed, this, [this, pane](double zoom) {
        if (pane == panes_->active()) emit zoom_changed(zoom);
    });
    connect(view, &ImageView::transform_changed, this, &CompareView::transform_changed);
    connect(view, &ImageView::camera_moved, this,
            [this, pane](const CameraPose& pose) { camera_from(pane, pose); });
    connect(view, &ImageView::camera_gesture_finished, this,
            [this, pane] { emit camera_gesture_finished(camera_of(pane)); });
    connect(view, &ImageView::wipe_moved, this, [this](double fraction) {
        all_.wipe = fraction;
        emit wipe_moved(fraction);
    });
}

/// The picture whose camera a pane has: a reference has that of its picture.
int CompareView::camera_of(int pane) const {
    return all_.in_row(std::max(0, picture_of(pane, {})));
}

void CompareView::camera_from(int pane, const CameraPose& pose) {
    const int picture = camera_of(pane);
    set_camera(pose, all_.linked ? std::nullopt : std::optional(picture));
    emit camera_moved(pose, picture);
}

/// The lens is where the cursor is.
bool CompareView::is_of_second(int pane, QPoint pixel) const {
    const auto& view = panes_->pane(pane);
    if (all_.held >= 0 || !view.state().pictures[1].picture) return false;
    return rules().has_lens() || (rules().has_divider() && pixel.x() + 0.5 >= all_.wipe * view.image().width);
}

int CompareView::picture_of(int pane, QPoint pixel) const {
    if (pane >= int(contents_.size())) return 0;
    const PaneContent& content = contents_[std::size_t(pane)];
    if (content.difference) return -1;
    return is_of_second(pane, pixel) ? 1 : content.picture;
}

void CompareView::refresh() {
    contents_ = rules().contents(all_);
    const QString refusal = all_.held < 0 ? all_.refusal() : QString();
    if (refusal.isEmpty() || all_.count() < 2) request_differences();
    for (int i = 0; i < int(contents_.size()); ++i) fill(panes_->pane(i), contents_[std::size_t(i)], refusal);
    arrange();
    update_bar();
    relink();
}

void CompareView::arrange() {
    const bool captions = rules().is_row() && contents_.size() > 1;
    const QSize grid = rules().grid(all_, int(contents_.size()),
                                    [&](QSize tried) { return panes_->size_in(tried, captions); });
    std::vector<PaneBoard::Cell> cells;
    for (int i = 0; i < int(contents_.size()); ++i) cells.push_back(cell_of(i, grid));
    panes_->arrange(std::move(cells), grid, captions);
}

void CompareView::request_differences() {
    for (const auto& content : contents_) {
        if (!content.difference || all_.count() < 2) continue;
        const auto ends = all_.ends_of(content.slot);
        if (!all_.has_difference(ends)) continue;
        const auto [a, b] = ends;
        worker_->request(content.slot,
                         {all_.picture(a), all_.picture(b), all_.kind, all_.name(a), all_.name(b)});
    }
}

void CompareView::show_difference(int slot) {
    const bool visible = std::any_of(contents_.begin(), contents_.end(), [&](const PaneContent& content) {
        return content.difference && content.slot == slot;
    });
    if (!visible) return;
    refresh();
    emit difference_shown();
}

void CompareView::fill(ImageView& view, const PaneContent& content, const QString& refusal) {
    const bool has_second = (rules().has_divider() || rules().has_lens()) && all_.held < 0 &&
                            all_.count() >= 2 && refusal.isEmpty();
    if (!has_second) view.set_second(nullptr);
    if (all_.count() == 0) {
        view.set_picture(nullptr);
        return view.set_labels({});
    }
    // In a row it stands below.
    const bool is_named = !content.difference && all_.count() >= 2 && !rules().is_row();
    const QString title = is_named ? all_.title(content.picture) : QString();
    // The reason stands in the place of what does not fit.
    const bool fits =
        rules().keeps_first() && all_.picture(content.picture)->size() == all_.pictures.front()->size();
    const bool alone = all_.count() < 2 && all_.mode != Mode::difference;
    if (!refusal.isEmpty() && !fits && !alone) {
        view.set_picture(make_note(refusal));
        return view.set_labels(title);
    }
    if (content.difference) return fill_difference(view, content.slot);
    view.set_display(all_.shown_display(content.picture));
    view.set_picture(all_.picture(content.picture));
    view.set_labels(title);
    if (const auto* pose = all_.pose(content.picture)) view.camera().set_pose(*pose);
    if (!has_second) return;
    view.set_second(all_.pictures[1], all_.shown_display(1), rules().has_lens());
    view.set_labels(title, all_.title(1));
    view.set_wipe(all_.wipe);
}

void CompareView::fill_difference(ImageView& view, int slot) {
    const auto* result = worker_->result(slot);
    const auto [a, b] = all_.ends_of(slot);
    const Picture &left = *all_.picture(a), &right = *all_.picture(b);
    const bool possible = all_.has_difference({a, b});
    if (!result || !possible) {
        view.set_labels({});
        return view.set_picture(
            make_note(possible                                          ? tr("Computing the difference …")
                      : !left.draft.isEmpty() || !right.draft.isEmpty() ? full_picture_awaited()
                      : left.has_image() && right.has_image()
                          ? tr("Sizes differ: %1 and %2 pixels.").arg(size_text(left), size_text(right))
                          : QString()));
    }
    Display display = own_difference_display().value_or(result->automatic);
    if (all_.difference_display) {
        display = *all_.difference_display;
        display.hide_invalid = true;
        display.grey_zero = result->automatic.grey_zero;
    }
    if (slot == 0) shown_difference_ = display;
    view.set_display(display);
    Picture picture = *result->picture;
    picture.stale = worker_->is_outdated(slot) || left.stale || right.stale;
    view.set_labels(picture.label);
    view.set_picture(picture.stale ? std::make_shared<const Picture>(std::move(picture)) : result->picture);
    if (const auto* pose = all_.pose(a)) view.camera().set_pose(*pose);
}

/// One range for the whole row, so that equal colours mean equal differences: that of the largest values, but
/// of signed and absolute differences no more than a few RMSE, where outliers would leave all others pale.
std::optional<Display> CompareView::row_display() const {
    constexpr double max_rmse = 4;
    std::optional<Display> common;
    double rmse = 0;
    for (const auto& content : contents_) {
        const auto* result = content.difference ? worker_->result(content.slot) : nullptr;
        if (!result || !result->picture->has_image()) continue;
        if (!common) common = result->automatic;
        common->low = std::min(common->low, result->automatic.low);
        common->high = std::max(common->high, result->automatic.high);
        if (std::isfinite(result->rmse)) rmse = std::max(rmse, result->rmse);
    }
    const bool bounded = all_.kind == DifferenceKind::signed_ || all_.kind == DifferenceKind::absolute;
    if (common && rmse > 0 && bounded) {
        common->low = std::max(common->low, -max_rmse * rmse);
        common->high = std::min(common->high, max_rmse * rmse);
    }
    return common;
}

std::optional<Display> CompareView::own_difference_display() const {
    if (std::ranges::none_of(contents_, &PaneContent::difference)) return {};
    const auto* result = worker_->result(0);
    auto own = rules().is_row() || !result ? row_display() : std::optional(result->automatic);
    if (own) own->colour_map = map_for_difference(all_.kind);  // it may be preferred since
    return own;
}

PaneBoard::Cell CompareView::cell_of(int pane, QSize grid) const {
    const PaneContent& content = contents_[std::size_t(pane)];
    PaneBoard::Cell cell;
    cell.place = rules().place(all_, content, pane, grid);
    cell.difference = content.difference;
    if (!rules().is_row() || all_.count() < 2) return cell;
    if (content.difference) {
        cell.caption = number_of(content.slot);
        cell.tip = tip_of(content.slot);
        return cell;
    }
    cell.caption = all_.title(content.picture);
    cell.clickable = content.picture < all_.count();
    if (cell.clickable) cell.tip = tr("Click two for their difference (1 … 9; 0: none); double click: alone");
    cell.chosen = content.slot == ComparedPictures::pair_slot || content.picture == all_.pair.a ||
                  content.picture == all_.pair.b;
    return cell;
}

/// What stands under a difference of a row.
QString CompareView::number_of(int slot) const {
    const auto* result = worker_->result(slot);
    if (!result || !std::isfinite(result->rmse) || !all_.refusal().isEmpty() ||
        !all_.has_difference(all_.ends_of(slot)))
        return {};
    const QString& unit = result->request.a->unit;
    return tr("RMSE %1").arg(result->rmse, 0, 'g', 4) +
           (unit.isEmpty() ? QString() : QLatin1Char(' ') + unit);
}

QString CompareView::tip_of(int slot) const {
    const auto [a, b] = all_.ends_of(slot);
    if (!all_.has_difference({a, b})) return {};
    return tr("%1\nagainst %2\nRoot mean square of the difference over all valid pixels.\n%3")
        .arg(all_.title(a), all_.title(b),
             size_rule(all_.name(a), *all_.picture(a), all_.name(b), *all_.picture(b)))
        .trimmed();
}

void CompareView::relink() {
    const int shown = int(contents_.size());
    for (int i = 0; i < panes_->pane_count(); ++i) {
        if (i < shown && shown > 1)
            link_->add(&panes_->pane(i));
        else
            link_->remove(&panes_->pane(i));
    }
    if (all_.linked && shown > 1) link_->align_to(&active_view());
}

void CompareView::update_bar() {
    const bool row = rules().is_row() && all_.count() >= 2;
    bar_->setVisible(row);
    if (!row) return;
    QStringList titles;
    for (int i = 0; i < all_.count(); ++i) titles << all_.title(i);
    bar_->set_stages(titles, all_.has_reference);
    bar_->set_pair(all_.pair);
    bar_->set_number(all_.has_pair() ? number_of(ComparedPictures::pair_slot) : QString());
}

/// The picture that a number shows for as long as it is held; -1: none.
int CompareView::held_by(const QKeyEvent& event) const {
    const int picture = event.key() - Qt::Key_1;
    const bool held = is_plain(event) && picture >= 0 && picture < std::min(9, all_.count()) &&
                      all_.count() >= 2 && rules().holds_pictures();
    return held ? picture : -1;
}

void CompareView::hold(int picture) {
    if (picture == all_.held) return;
    all_.held = picture;
    refresh();
}

void CompareView::choose_pair(StagePair pair) {
    if (pair == all_.pair) return;
    set_stage_pair(pair);
    if (all_.has_pair()) panes_->ensureWidgetVisible(&panes_->pane(int(contents_.size()) - 1));
    emit stage_pair_chosen(pair);
}

bool CompareView::choose_by_key(const QKeyEvent& event) {
    const int digit = event.key() - Qt::Key_0;
    if (!rules().is_row() || all_.count() < 2 || !is_plain(event) || digit < 0 ||
        digit > std::min(9, all_.count()))
        return false;
    if (event.type() == QEvent::KeyPress && !event.isAutoRepeat())
        choose_pair(digit == 0 ? StagePair() : with_chosen(all_.pair, digit - 1));
    return true;
}

void CompareView::keyPressEvent(QKeyEvent* event) {
    if (const int picture = held_by(*event); picture >= 0) {
        if (!event->isAutoRepeat()) hold(picture);
        return;
    }
    if (choose_by_key(*event)) return;
    if (event->modifiers() == Qt::NoModifier && event->key() == Qt::Key_X && all_.count() >= 2) return swap();
    if (event->modifiers() == Qt::NoModifier && event->key() == Qt::Key_L) return set_linked(!all_.linked);
    QWidget::keyPressEvent(event);
}

void CompareView::keyReleaseEvent(QKeyEvent* event) {
    if (event->isAutoRepeat()) return;
    if (all_.held >= 0 && event->key() == Qt::Key_1 + all_.held) return hold(-1);
    QWidget::keyReleaseEvent(event);
}

bool CompareView::eventFilter(QObject* watched, QEvent* event) {
    switch (event->type()) {
        case QEvent::ShortcutOverride: {  // a number is no shortcut of the window where it means a picture
            const auto& key = *static_cast<QKeyEvent*>(event);
            if (held_by(key) >= 0 || choose_by_key(key)) event->accept();
            break;
        }
        case QEvent::KeyPress: {
            const auto& key = *static_cast<QKeyEvent*>(event);
            if (all_.mode == Mode::flip && key.key() == Qt::Key_Tab && key.modifiers() == Qt::NoModifier &&
                all_.count() >= 2) {
                flip_next();
                return true;
            }
            break;
        }
        case QEvent::FocusOut:  // the release of a held key goes elsewhere
            hold(-1);
            break;
        default:
            break;
    }
    return QWidget::eventFilter(watched, event);
}

}  // namespace ir::widgets
