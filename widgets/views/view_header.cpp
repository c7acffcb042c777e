#include "widgets/views/view_header.h"

#include <QAbstractItemView>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenu>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "widgets/models/report_rows.h"
#include "widgets/panels/search_button.h"
#include "widgets/style/icons.h"
#include "widgets/style/theme.h"
#include "widgets/views/search_combo.h"

namespace ir::widgets {
namespace {

QString text_of(const std::string& text) {
    return QString::fromStdString(text);
}

/// Logical pixels: what a control keeps of itself in the narrowest view.
constexpr int min_width = 22;
/// Letters of a wide kind; twelve usual ones take as much room.
constexpr int letters_of_a_source = 10;

template <class Combo = QComboBox>
Combo* make_combo(QWidget* parent, const QString& name, const QString& tip, int letters) {
    auto* combo = new Combo(parent);
    combo->setObjectName(name);
    combo->setToolTip(tip);
    combo->setAccessibleName(tip);
    combo->setMinimumWidth(min_width);
    combo->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    combo->setMinimumContentsLength(letters);
    combo->view()->setMinimumWidth(240);
    combo->setFocusPolicy(Qt::StrongFocus);
    return combo;
}

QToolButton* make_button(QWidget* parent, const QString& name, const char* icon_name, const QString& tip,
                         bool checkable) {
    auto* button = new QToolButton(parent);
    button->setObjectName(name);
    button->setIcon(icon(icon_name));
    button->setToolTip(tip);
    button->setAccessibleName(tip);
    button->setAutoRaise(true);
    button->setCheckable(checkable);
    return button;
}

const OutputOption* find_output(const std::vector<OutputOption>& outputs, const std::string& key) {
    const auto found =
        std::find_if(outputs.begin(), outputs.end(), [&](const auto& each) { return each.key == key; });
    if (found != outputs.end()) return &*found;
    return key.empty() && !outputs.empty() ? &outputs.front() : nullptr;
}

SearchEntry entry_of(const OutputOption& output) {
    return {text_of(output.key), output.label, output.doc, output.group, sign_of(output.kind)};
}

struct PartEntry {
    int level = 0, layer = 0;
};

std::vector<PartEntry> parts_of(const OutputOption& output) {
    std::vector<PartEntry> parts;
    if (output.levels < 2 && output.layers < 2) return parts;
    parts.push_back({output.levels > 1 ? ViewSource::all : 0, output.layers > 1 ? ViewSource::all : 0});
    for (int layer = 0; layer < output.layers; ++layer)
        for (int level = 0; level < output.levels; ++level) parts.push_back({level, layer});
    return parts;
}

}  // namespace

QString part_name(const OutputOption& output, int level, int layer) {
    const bool levels = output.levels > 1, layers = output.layers > 1;
    if (levels && level == ViewSource::all) return QObject::tr("All levels");
    if (layers && layer == ViewSource::all) return QObject::tr("All slices");
    if (levels && layers) return QObject::tr("Slice %1, level %2").arg(layer).arg(level);
    if (levels) return QObject::tr("Level %1").arg(level);
    if (layers) return QObject::tr("Slice %1").arg(layer);
    return {};
}

template <class Change>
void ViewHeader::choose(Change change) {
    ViewState state = fields_.state;
    change(state);
    if (state != fields_.state) emit state_chosen(state);
}

ViewHeader::ViewHeader(QWidget* parent) : QWidget(parent) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(4, 2, 4, 2);
    column->setSpacing(2);
    a_ = make_line(QStringLiteral("a"), &ViewState::a);
    b_ = make_line(QStringLiteral("b"), &ViewState::b);
    column->addWidget(a_.line);
    column->addWidget(b_.line);
    make_mode_controls(a_.line, b_.line);
    make_menu();
    warning_ = new QLabel(this);
    warning_->setObjectName(QStringLiteral("warning"));
    warning_->setWordWrap(true);
    set_themed_sheet(warning_, [](const ThemeColours& colours) {
        return QStringLiteral("color: %1; padding: 1px 3px;").arg(colours.warning.name());
    });
    column->addWidget(warning_);
    warning_->hide();
    b_.line->hide();
}

ViewHeader::SourceLine ViewHeader::make_line(const QString& name, ViewSource ViewState::*member) {
    SourceLine result;
    result.line = new QWidget(this);
    auto* row = new QHBoxLayout(result.line);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(4);
    result.badge = new QLabel(name.toUpper(), result.line);
    make_bold(result.badge);
    result.badge->setContentsMargins(3, 0, 3, 0);
    result.owner = make_combo(result.line, QStringLiteral("owner-") + name,
                              tr("Experiment or image that is shown"), letters_of_a_source);
    result.output = make_combo<SearchCombo>(result.line, QStringLiteral("output-") + name,
                                            tr("Output or buffer that is shown"), letters_of_a_source);
    result.output->list().set_pictures([this, member](const QModelIndex& row) {
        const auto key = row.data(SearchList::key_role).toString();
        return thumbnails_ ? thumbnails_({(fields_.state.*member).owner, key.toStdString()}) : QImage();
    });
    result.part =
        make_combo(result.line, QStringLiteral("part-") + name, tr("Level or slice, or all at once"), 7);
    result.part->setMinimumWidth(result.part->sizeHint().width());  // "Slice 12"
    row->addWidget(result.badge);
    row->addWidget(result.owner, 3);
    row->addWidget(result.output, 3);
    row->addWidget(result.part, 1);
    connect(result.owner, &QComboBox::activated, this, [this, member, combo = result.owner](int index) {
        choose([&](ViewState& state) {
            (state.*member).owner = combo->itemData(index).toString().toStdString();
        });
    });
    connect(result.output, &QComboBox::activated, this, [this, member, combo = result.output](int index) {
        choose([&](ViewState& state) {
            auto& source = state.*member;
            source.output = combo->itemData(index).toString().toStdString();
            source.level = source.layer = 0;
            state.chain = false;
        });
    });
    connect(result.part, &QComboBox::activated, this, [this, member, combo = result.part](int index) {
        choose([&](ViewState& state) {
            const QPoint part = combo->itemData(index).toPoint();
            (state.*member).level = part.x();
            (state.*member).layer = part.y();
        });
    });
    return result;
}

void ViewHeader::make_mode_controls(QWidget* first, QWidget* second) {
    mode_ = make_combo(first, QStringLiteral("mode"), tr("How pictures are put beside each other"), 8);
    for (const auto mode : all_modes()) mode_->addItem(mode_name(mode), int(mode));
    connect(mode_, &QComboBox::activated, this, [this](int index) {
        choose([&](ViewState& state) { state.mode = ViewMode(mode_->itemData(index).toInt()); });
    });
    table_ =
        make_button(first, QStringLiteral("table"), "table", tr("The buffer's numbers as a table"), true);
    connect(table_, &QToolButton::clicked, this, [this](bool on) {
        if (on != fields_.state.as_table) choose([&](ViewState& state) { state.as_table = on; });
    });
    layers_ = make_button(first, QStringLiteral("layers"), "layers", tr("What is drawn, and how"), true);
    connect(layers_, &QToolButton::clicked, this, &ViewHeader::layers_toggled);
    for (QWidget* each :
         {static_cast<QWidget*>(mode_), static_cast<QWidget*>(layers_), static_cast<QWidget*>(table_)})
        first->layout()->addWidget(each);

    pictures_ = new SearchButton(second);
    pictures_->setObjectName(QStringLiteral("pictures"));
    pictures_->setText(tr("Pictures"));
    pictures_->setMinimumWidth(min_width);
    pictures_->setToolTip(tr("Further pictures of this row: hold 1 … 9 to see one of them"));
    pictures_->setAccessibleName(pictures_->toolTip());
    const auto candidate = [this](const QModelIndex& row) {
        return fields_.candidates[std::size_t(row.data(SearchList::place_role).toInt())].source;
    };
    pictures_->list().set_empty_text(tr("Nothing else has the size of this picture."));
    pictures_->list().set_pictures([this, candidate](const QModelIndex& row) {
        return thumbnails_ ? thumbnails_(candidate(row)) : QImage();
    });
    connect(&pictures_->list(), &SearchList::chosen, this,
            [this, candidate](const QModelIndex& row) { toggle_candidate(candidate(row)); });
    chain_ = make_button(second, QStringLiteral("chain"), "stages",
                         tr("The stages that the method names, in their order"), true);
    connect(chain_, &QToolButton::clicked, this, [this](bool on) {
        choose([&](ViewState& state) {
            state.chain = on;
            if (on) state.more.clear();
        });
    });
    difference_ = make_combo(second, QStringLiteral("difference"), tr("Kind of difference"), 9);
    for (const auto kind : all_differences()) {
        difference_->addItem(difference_name(kind), int(kind));
        difference_->setItemData(difference_->count() - 1, difference_doc(kind), Qt::ToolTipRole);
    }
    connect(difference_, &QComboBox::activated, this, [this](int index) {
        choose([&](ViewState& state) {
            state.difference = DifferenceKind(difference_->itemData(index).toInt());
        });
    });
    swap_ = make_button(second, QStringLiteral("swap"), "swap", tr("Swap A and B (X)"), false);
    connect(swap_, &QToolButton::clicked, this, &ViewHeader::swap_wanted);
    link_ = make_button(second, QStringLiteral("link"), "link",
                        tr("Zoom, place, camera and colour range are one for all views (L)"), true);
    connect(link_, &QToolButton::clicked, this, [this](bool on) {
        if (on != fields_.linked) emit link_chosen(on);
    });
    for (QWidget* each :
         {static_cast<QWidget*>(chain_), static_cast<QWidget*>(pictures_), static_cast<QWidget*>(difference_),
          static_cast<QWidget*>(swap_), static_cast<QWidget*>(link_)})
        second->layout()->addWidget(each);
}

void ViewHeader::make_menu() {
    more_ = make_button(a_.line, QStringLiteral("more"), "menu",
                        tr("How pictures are compared: this view is too narrow for the lists"), false);
    more_->setPopupMode(QToolButton::InstantPopup);
    menu_ = new QMenu(more_);
    more_->setMenu(menu_);
    connect(menu_, &QMenu::aboutToShow, this, &ViewHeader::fill_menu);
    a_.line->layout()->addWidget(more_);
    secondary_ = {{mode_, false},  {difference_, false}, {pictures_, false},
                  {chain_, false}, {swap_, false},       {link_, false}};
}

void ViewHeader::show_source(const SourceLine& line, const ViewSource& source,
                             const std::vector<OutputOption>& outputs) {
    line.owner->clear();
    for (const auto& owner : fields_.owners) {
        line.owner->addItem(owner.label, owner.id);
        line.owner->setItemData(line.owner->count() - 1, owner.tooltip, Qt::ToolTipRole);
    }
    line.owner->setCurrentIndex(line.owner->findData(text_of(source.owner)));
    std::vector<SearchEntry> entries;
    for (const auto& each : outputs) entries.push_back(entry_of(each));
    line.output->list().set_entries(entries);
    const auto* output = find_output(outputs, source.output);
    line.output->setCurrentIndex(output ? line.output->findData(text_of(output->key)) : -1);
    line.part->clear();
    const auto parts = output ? parts_of(*output) : std::vector<PartEntry>();
    for (const auto& part : parts)
        line.part->addItem(part_name(*output, part.level, part.layer), QPoint(part.level, part.layer));
    line.part->setCurrentIndex(line.part->findData(QPoint(source.level, source.layer)));
    line.part->setVisible(!parts.empty());
}

void ViewHeader::set_fields(const ViewFields& fields) {
    if (fields == fields_) return;
    fields_ = fields;
    const auto& state = fields_.state;
    const auto* output = find_output(fields_.outputs_a, state.a.output);
    const bool picture = !output || output->kind == OutputKind::image ||
                         output->kind == OutputKind::pyramid || output->kind == OutputKind::stack;
    const bool comparing = picture && compares(state.mode), stages = state.mode == ViewMode::stages;
    show_source(a_, state.a, fields_.outputs_a);
    a_.badge->setVisible(comparing);
    show_source(b_, state.b, fields_.outputs_b);
    // Rows of stages are chosen in the menu alone.
    for (QWidget* each :
         {static_cast<QWidget*>(b_.badge), static_cast<QWidget*>(b_.owner), static_cast<QWidget*>(b_.output)})
        each->setVisible(!stages);
    if (stages) b_.part->hide();
    chain_->setChecked(state.chain);
    pictures_->setText(tr("Pictures (%1)  ").arg(int(state.more.size()) + (stages ? 1 : 2)));
    show_candidates();
    difference_->setCurrentIndex(difference_->findData(int(state.difference)));
    difference_->setToolTip(tr("Kind of difference: %1").arg(difference_doc(state.difference)));
    mode_->setCurrentIndex(mode_->findData(int(state.mode)));
    table_->setVisible(output && !picture);
    table_->setEnabled(output && output->kind != OutputKind::table);
    table_->setChecked(state.as_table || (output && output->kind == OutputKind::table));
    layers_->setVisible(output && !picture && !table_->isChecked());
    link_->setChecked(fields_.linked);
    warning_->setText(fields_.warning);
    warning_->setVisible(comparing && !fields_.warning.isEmpty());
    const bool difference = state.mode == ViewMode::difference || stages;
    secondary_ = {{mode_, picture},
                  {difference_, comparing && difference},
                  {pictures_, comparing && takes_many(state.mode)},
                  {chain_, comparing && stages && (fields_.has_stages || state.chain)},
                  {swap_, comparing && !stages},
                  {link_, comparing}};
    fold();
}

void ViewHeader::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    fold();
}

/// For everything that is wanted, at the sizes that controls would like.
bool ViewHeader::has_room() const {
    for (const auto* line : {a_.line, b_.line}) {
        int needed = -line->layout()->spacing();
        for (int i = 0; i < line->layout()->count(); ++i) {
            auto* control = line->layout()->itemAt(i)->widget();
            const auto found = std::find_if(secondary_.begin(), secondary_.end(),
                                            [&](const auto& each) { return each.control == control; });
            if (control != more_ && (found == secondary_.end() ? !control->isHidden() : found->wanted))
                needed += control->sizeHint().width() + line->layout()->spacing();
        }
        if (needed > layout()->contentsRect().width()) return false;
    }
    return true;
}

void ViewHeader::fold() {
    const bool folds = !has_room();
    for (const auto& each : secondary_) each.control->setVisible(each.wanted && !folds);
    more_->setVisible(folds && secondary_.front().wanted);
    const bool comparing = a_.badge->isVisibleTo(a_.line);
    b_.line->setVisible(comparing && !(folds && b_.owner->isHidden()));
}

/// What stands in the header where there is room.
void ViewHeader::fill_menu() {
    menu_->clear();
    for (const auto& [control, wanted] : secondary_) {
        if (!wanted) continue;
        if (auto* combo = qobject_cast<QComboBox*>(control)) {
            menu_->addSection(combo->accessibleName());
            for (int i = 0; i < combo->count(); ++i) {
                auto* action = menu_->addAction(combo->itemText(i));
                action->setCheckable(true);
                action->setChecked(i == combo->currentIndex());
                connect(action, &QAction::triggered, combo, [combo, i] {
                    combo->setCurrentIndex(i);
                    emit combo->activated(i);
                });
            }
            menu_->addSeparator();
        } else if (control == pictures_) {
            connect(menu_->addAction(pictures_->text() + QStringLiteral(" …")), &QAction::triggered, this,
                    [this] { pictures_->list().open_at(*more_); });
        } else {
            auto* button = qobject_cast<QToolButton*>(control);
            auto* action = menu_->addAction(button->icon(), button->accessibleName());
            action->setCheckable(button->isCheckable());
            action->setChecked(button->isChecked());
            connect(action, &QAction::triggered, button, [button] { button->click(); });
        }
    }
}

void ViewHeader::show_layers_shown(bool shown) {
    layers_->setChecked(shown);
}

void ViewHeader::show_candidates() {
    const auto& more = fields_.state.more;
    std::vector<SearchEntry> entries;
    for (const auto& [source, shown] : fields_.candidates) {
        entries.push_back(entry_of(shown));
        entries.back().is_chosen = std::find(more.begin(), more.end(), source) != more.end();
    }
    pictures_->list().set_entries(entries);
}

void ViewHeader::toggle_candidate(const ViewSource& source) {
    choose([&](ViewState& state) {
        const auto count = state.more.size();
        leave_out(state, [&](const ViewSource& each) { return each == source; });
        if (state.more.size() == count) state.more.push_back(source);
        state.chain = false;
    });
}

}  // namespace ir::widgets
