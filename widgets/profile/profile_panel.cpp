#include "widgets/profile/profile_panel.h"

#include <QAction>
#include <QCheckBox>
#include <QClipboard>
#include <QComboBox>
#include <QGuiApplication>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QMenu>
#include <QMimeData>
#include <QResizeEvent>
#include <QSplitter>
#include <QStackedWidget>
#include <QStandardItemModel>
#include <QTableView>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <utility>

#include "renderers/plot/plot_svg.h"
#include "widgets/image/display.h"
#include "widgets/plot/plot_view.h"
#include "widgets/profile/waveform_view.h"
#include "widgets/style/icons.h"
#include "widgets/style/section.h"

namespace ir::widgets {
namespace {

using Tool = ImageView::Tool;

/// Least sizes, logical pixels. Side by side a plot of what was drawn is as high as one has to be to be read.
constexpr QSize least_plot(160, 120), least_table(160, 60);
constexpr int readable_height = 180;

void copy_text(const std::string& text) {
    QGuiApplication::clipboard()->setText(QString::fromStdString(text));
}

/// As a drawing where a program takes one, else as its text.
void copy_svg(const PlotData& plot) {
    const auto svg = QByteArray::fromStdString(plot_svg(plot, plot_svg_width, plot_svg_height, true));
    auto* data = new QMimeData;
    data->setData(QStringLiteral("image/svg+xml"), svg);
    data->setText(QString::fromUtf8(svg));
    QGuiApplication::clipboard()->setMimeData(data);
}

QString number(double value) {
    return std::isnan(value) ? QStringLiteral("–") : short_number(value);
}

}  // namespace

ProfilePanel::ProfilePanel(QWidget* parent)
    : QWidget(parent),
      measuring_(new NewestJob(this)),
      pages_(new QStackedWidget(this)),
      rows_(new QStandardItemModel(this)) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(make_head());
    column->addWidget(pages_, 1);
    empty_ = make_empty_text(pages_);
    pages_->addWidget(empty_);
    pages_->addWidget(make_content());
    set_fields({.why_empty = tr("No pictures.")});
}

QToolButton* ProfilePanel::make_tool(const char* name, const QString& tip, Tool tool) {
    auto* button = new QToolButton(this);
    button->setObjectName(QLatin1String("draw-") + QLatin1String(name));
    button->setIcon(icon(name));
    button->setToolTip(tip);
    button->setAccessibleName(tip);
    button->setAutoRaise(true);
    button->setCheckable(true);
    connect(button, &QToolButton::clicked, this,
            [this, tool](bool on) { emit tool_chosen(on ? tool : Tool::inspect); });
    return button;
}

QWidget* ProfilePanel::make_head() {
    auto* head = new QWidget(this);
    auto* row = new QHBoxLayout(head);
    row->setContentsMargins(6, 2, 4, 2);
    row->setSpacing(4);
    line_ = make_tool("line", tr("Draw a line: values of all shown pictures along it (N)"), Tool::line);
    rectangle_ =
        make_tool("rectangle", tr("Draw a rectangle: numbers and histograms of all shown pictures in it (B)"),
                  Tool::rectangle);
    choices_ = new QComboBox(head);
    choices_->setObjectName(QStringLiteral("channel"));
    choices_->setToolTip(
        tr("What is read of each pixel. One number is the luminance of a colour and the "
           "length of a vector"));
    choices_->setAccessibleName(tr("Channel"));
    connect(choices_, &QComboBox::activated, this, [this](int index) {
        wanted_choice_ = choices_->itemData(index).toInt();
        update_profile();
        update_region();
    });
    log_ = new QCheckBox(tr("Log"), head);
    log_->setObjectName(QStringLiteral("log"));
    log_->setToolTip(tr("Logarithmic shares of histograms and waveforms: rare values are seen"));
    connect(log_, &QCheckBox::toggled, this, &ProfilePanel::update_region);
    waves_ = new QCheckBox(tr("Waveforms"), head);
    waves_->setObjectName(QStringLiteral("waveforms"));
    waves_->setToolTip(tr("Beside the histograms: the values of each column of a picture"));
    connect(waves_, &QCheckBox::toggled, this, [this] {
        update_region();
        arrange();
    });
    note_ = new QLabel(head);
    note_->setObjectName(QStringLiteral("note"));
    note_->setEnabled(false);
    note_->setMinimumWidth(1);
    note_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    row->addWidget(line_);
    row->addWidget(rectangle_);
    row->addWidget(choices_);
    row->addWidget(log_);
    row->addWidget(waves_);
    row->addWidget(note_, 1);
    row->addWidget(make_copy());
    return head;
}

QToolButton* ProfilePanel::make_copy() {
    auto* copy = new QToolButton(this);
    copy->setObjectName(QStringLiteral("copy"));
    copy->setIcon(icon("copy"));
    copy->setToolTip(tr("Copy the profile or the numbers"));
    copy->setAccessibleName(copy->toolTip());
    copy->setAutoRaise(true);
    copy->setPopupMode(QToolButton::InstantPopup);
    auto* menu = new QMenu(copy);
    const auto add = [menu](const char* name, const QString& text, auto run) {
        auto* action = menu->addAction(text, menu, run);
        action->setObjectName(QLatin1String(name));
        return action;
    };
    of_line_ << add("copy-line-csv", tr("Profile as &CSV"), [this] { copy_text(profile_csv(along_)); })
             << add("copy-line-svg", tr("Profile as &SVG"), [this] { copy_svg(profile_->data()); });
    menu->addSeparator();
    of_region_ << add("copy-region-csv", tr("&Numbers as CSV"), [this] { copy_text(region_csv(*within_)); })
               << add("copy-region-svg", tr("&Histograms as SVG"), [this] { copy_svg(histograms_->data()); })
               << add("copy-waveforms", tr("&Waveforms as a picture"),
                      [this] { QGuiApplication::clipboard()->setPixmap(waveforms_->grab()); });
    copy->setMenu(menu);
    return copy;
}

QWidget* ProfilePanel::make_content() {
    profile_ = new PlotView;
    profile_->setObjectName(QStringLiteral("profile"));
    profile_->setAccessibleName(tr("Values along the line"));
    histograms_ = new PlotView;
    histograms_->setObjectName(QStringLiteral("histograms"));
    histograms_->setAccessibleName(tr("Histograms"));
    connect(profile_, &PlotView::selected_changed, this, [this](const QString& id) {
        const auto place = std::size_t(id.section(QLatin1Char(':'), 1).toULongLong());
        if (place < along_.places.size()) emit pixel_chosen({along_.places[place].x, along_.places[place].y});
    });
    waveforms_ = new WaveformView;
    waveforms_->setObjectName(QStringLiteral("waveform-view"));
    waveforms_->setMinimumSize(least_plot);
    make_table();
    split_ = new QSplitter;
    split_->setObjectName(QStringLiteral("parts"));
    split_->setChildrenCollapsible(false);
    for (auto* plot : {profile_, histograms_}) plot->setMinimumSize(least_plot);
    for (QWidget* part : {static_cast<QWidget*>(profile_), static_cast<QWidget*>(table_),
                          static_cast<QWidget*>(histograms_), static_cast<QWidget*>(waveforms_)})
        split_->addWidget(part);
    split_->setSizes({500, 330, 420, 420});  // shares
    return split_;
}

void ProfilePanel::make_table() {
    table_ = new QTableView;
    table_->setObjectName(QStringLiteral("numbers"));
    table_->setAccessibleName(tr("Numbers of the rectangle"));
    table_->setModel(rows_);
    table_->setShowGrid(false);
    table_->setAlternatingRowColors(true);
    table_->setSelectionBehavior(QAbstractItemView::SelectRows);
    table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    table_->setWordWrap(false);
    table_->setTextElideMode(Qt::ElideMiddle);
    table_->verticalHeader()->hide();
    table_->verticalHeader()->setDefaultSectionSize(fontMetrics().height() + 6);
    table_->horizontalHeader()->setHighlightSections(false);
    table_->setMinimumSize(least_table);
    auto* copy = new QAction(tr("Copy as CSV"), table_);
    copy->setShortcut(QKeySequence::Copy);
    copy->setShortcutContext(Qt::WidgetShortcut);
    connect(copy, &QAction::triggered, this, [this] {
        if (within_) copy_text(region_csv(*within_));
    });
    table_->addAction(copy);
    table_->setContextMenuPolicy(Qt::ActionsContextMenu);
}

void ProfilePanel::set_fields(const ProfileFields& fields) {
    if (fields == fields_) return;
    fields_ = fields;
    pages_->setCurrentIndex(fields.why_empty.isEmpty() ? 1 : 0);
    empty_->setText(fields.why_empty);
    note_->setText(fields.note);
    note_->setToolTip(fields.note);
    line_->setChecked(fields.tool == Tool::line);
    rectangle_->setChecked(fields.tool == Tool::rectangle);
    fill_choices();
    update_profile();
    update_region();
    arrange();
}

/// Of the first picture that has several channels.
void ProfilePanel::fill_choices() {
    std::vector<std::string> names;
    for (const auto* pictures : {&fields_.along, &fields_.within})
        for (const auto& each : *pictures)
            if (names.size() < 2)
                names = channel_choices(each.picture->semantic, each.picture->image->channels);
    if (names.size() < 2) names.clear();
    if (choices_->count() == 0 || names != channels_) {  // else the list may be open
        channels_ = names;
        choices_->clear();
        choices_->addItem(tr("One number"), one_number);
        if (!names.empty()) choices_->addItem(tr("Each channel"), all_channels);
        for (std::size_t c = 0; c < names.size(); ++c)
            choices_->addItem(QString::fromStdString(names[c]), int(c));
    }
    choices_->setCurrentIndex(std::max(0, choices_->findData(wanted_choice_)));
    choices_->setEnabled(!names.empty());
}

void ProfilePanel::update_profile() {
    profile_->setVisible(!fields_.line.isNull());
    along_ = {};
    PlotData plot;
    if (!fields_.line.isNull()) {
        const QLine& line = fields_.line;
        std::vector<MeasuredImage> images;
        for (const auto& each : fields_.along) images.push_back(measured(each));
        along_ = line_profile(images, {line.x1(), line.y1(), line.x2(), line.y2()},
                              choices_->currentData().toInt());
        plot = plot_of(along_, value_title(fields_.along));
        plot.title =
            tr("%1, %2 → %3, %4").arg(line.x1()).arg(line.y1()).arg(line.x2()).arg(line.y2()).toStdString();
    }
    profile_->set_data(plot);
    for (auto* action : of_line_) action->setEnabled(!along_.curves.empty());
}

void ProfilePanel::update_region() {
    const bool shown = shows_region() && fields_.why_empty.isEmpty();
    table_->setVisible(shown);
    histograms_->setVisible(shown);
    waveforms_->setVisible(shown && shows_waveforms());
    waves_->setEnabled(shown);
    log_->setEnabled(shown);
    for (auto* action : of_region_) action->setEnabled(shown && within_);
    of_region_.back()->setEnabled(shown && within_ && shows_waveforms());
    if (!shown) {  // keeps no picture
        requested_.reset();
        return measuring_->drop_waiting();
    }
    const RegionRequest request{fields_.within, fields_.rectangle, choices_->currentData().toInt(),
                                log_->isChecked(), shows_waveforms()};
    if (requested_ == request) return;
    requested_ = request;
    measuring_->start([this, request](const std::atomic<bool>& cancelled) {
        auto numbers = std::make_shared<const RegionNumbers>(measure_region(request, cancelled));
        return [this, numbers] { take(numbers); };
    });
}

void ProfilePanel::take(const std::shared_ptr<const RegionNumbers>& numbers) {
    within_ = numbers;
    const QStringList headings = {tr("Picture"), tr("Channel"), tr("Mean"),   tr("Deviation"), tr("Min"),
                                  tr("Median"),  tr("Max"),     tr("Pixels"), tr("Skipped")};
    const auto align = [](QStandardItem& item, qsizetype column) {
        item.setTextAlignment((column < 2 ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
    };
    rows_->clear();
    rows_->setHorizontalHeaderLabels(headings);
    for (int column = 0; column < rows_->columnCount(); ++column)
        align(*rows_->horizontalHeaderItem(column), column);
    for (const auto& row : numbers->rows) {
        QList<QStandardItem*> items;
        for (const auto& text :
             {QString::fromStdString(row.picture), QString::fromStdString(row.channel), number(row.mean),
              number(row.deviation), number(row.min), number(row.median), number(row.max),
              QString::number(row.pixels), QString::number(row.skipped)}) {
            items << new QStandardItem(text);
            items.back()->setToolTip(text);
            align(*items.back(), items.size() - 1);
        }
        rows_->appendRow(items);
    }
    const auto is_used = [&](auto is_said) { return std::ranges::any_of(numbers->rows, is_said); };
    table_->setColumnHidden(1, !is_used([](const auto& row) { return !row.channel.empty(); }));
    table_->setColumnHidden(8, !is_used([](const auto& row) { return row.skipped > 0; }));
    table_->resizeColumnsToContents();
    table_->horizontalHeader()->setSectionResizeMode(0, QHeaderView::Stretch);
    rows_->horizontalHeaderItem(8)->setToolTip(tr("Pixels without a value, NaN or infinite"));
    rows_->horizontalHeaderItem(3)->setToolTip(tr("Standard deviation over the pixels"));
    share_room();
    histograms_->set_data(numbers->histograms);
    waveforms_->set_waveforms(numbers->waveforms, requested_ && requested_->logarithmic);
    update_region();
}

/// Side by side numbers have what they need, names are cut, and plots share the rest. Done again where other
/// parts are seen or numbers need other room, and else left as a hand has put it.
void ProfilePanel::share_room() {
    if (table_->isHidden() || split_->orientation() != Qt::Horizontal || split_->width() == 0) return;
    constexpr int name_width = 96;
    int needed = name_width + 2 * table_->frameWidth();
    for (int column = 1; column < rows_->columnCount(); ++column)
        if (!table_->isColumnHidden(column)) needed += table_->columnWidth(column);
    std::vector<int> shared{needed};
    int plots = 0;
    for (int i = 0; i < split_->count(); ++i)
        if (!split_->widget(i)->isHidden() && split_->widget(i) != table_) ++plots, shared.push_back(i);
    if (plots == 0 || std::exchange(shared_, shared) == shared) return;
    const int room = split_->width() - plots * split_->handleWidth();
    const int numbers = std::clamp(needed, least_table.width(),
                                   std::max(least_table.width(), room - plots * least_plot.width()));
    QList<int> sizes;
    for (int i = 0; i < split_->count(); ++i)
        sizes << (split_->widget(i)->isHidden() ? 0
                  : split_->widget(i) == table_ ? numbers
                                                : (room - numbers) / plots);
    split_->setSizes(sizes);
}

void ProfilePanel::set_choice(int choice) {
    wanted_choice_ = choice;
    fill_choices();
}

void ProfilePanel::set_logarithmic(bool on) {
    log_->setChecked(on);
}

bool ProfilePanel::is_logarithmic() const {
    return log_->isChecked();
}

void ProfilePanel::set_shows_waveforms(bool on) {
    waves_->setChecked(on);
}

bool ProfilePanel::shows_waveforms() const {
    return waves_->isChecked();
}

/// Side by side where there is room for it. At their least width they turn, so that the panel can become
/// narrower.
void ProfilePanel::arrange() {
    int least = 0;
    for (int i = 0; i < split_->count(); ++i)
        if (const auto* part = split_->widget(i); !part->isHidden())
            least += part->minimumWidth() + split_->handleWidth();
    const bool fits = width() > least && width() > height();
    const bool has_drawn = !fields_.line.isNull() || !fields_.rectangle.isEmpty();
    const int height = fits && has_drawn ? readable_height : least_plot.height();
    for (QWidget* plot : {static_cast<QWidget*>(profile_), static_cast<QWidget*>(histograms_),
                          static_cast<QWidget*>(waveforms_)})
        plot->setMinimumHeight(height);
    const auto wanted = fits ? Qt::Horizontal : Qt::Vertical;
    if (split_->orientation() != wanted) split_->setOrientation(wanted);
}

void ProfilePanel::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    arrange();
}

}  // namespace ir::widgets
