#include "widgets/plot/plot_header.h"

#include <QAction>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QProgressBar>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "widgets/panels/controls.h"
#include "widgets/style/icons.h"

namespace ir::widgets {
namespace {

/// Also what is disabled says what it would do, and why it cannot.
void set_usable(QWidget* control, bool usable, const QString& why_not) {
    const auto tip = control->property("tip").toString();
    control->setEnabled(usable);
    control->setToolTip(usable || why_not.isEmpty() ? tip : QStringLiteral("%1.\n%2").arg(tip, why_not));
}

void set_tip(QWidget* control, const QString& tip) {
    control->setProperty("tip", tip);
    control->setToolTip(tip);
}

}  // namespace

PlotHeader::PlotHeader(QWidget* parent) : QWidget(parent) {
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(4, 3, 4, 3);
    column->setSpacing(3);
    auto* first = new QHBoxLayout;
    first->setSpacing(3);
    make_first_row(first);
    column->addLayout(first);
    second_ = new QWidget;
    auto* row = new QHBoxLayout(second_);
    row->setContentsMargins(0, 0, 0, 0);
    row->setSpacing(3);
    make_second_row(row);
    column->addWidget(second_);
}

QComboBox* PlotHeader::add_tipped_list(QBoxLayout* row, const char* name, const QString& label,
                                       const QString& tip, void (PlotHeader::*chosen)(const QString&)) {
    auto* list = add_list(row, name, label, 7);
    list->setMinimumWidth(48);
    set_tip(list, tip);
    if (chosen)
        connect(list, &QComboBox::activated, this,
                [this, list, chosen](int index) { emit(this->*chosen)(list->itemData(index).toString()); });
    return list;
}

QToolButton* PlotHeader::add_tipped_button(QBoxLayout* row, const char* name, const char* drawing,
                                           const QString& text, const QString& tip) {
    auto* button = add_button(row, name, drawing, text);
    set_tip(button, tip);
    return button;
}

void PlotHeader::make_first_row(QBoxLayout* row) {
    plots_ = add_tipped_list(row, "plot", tr("Plot"), tr("The plot that is shown"), &PlotHeader::plot_chosen);
    add_ = add_tipped_button(row, "plot-add", "add", tr("New"),
                             tr("Add a plot to the project, of its experiments against their reference"));
    edit_ = add_tipped_button(
        row, "plot-edit", "rename", tr("Edit"),
        tr("Show all that makes this plot in the project's panel: experiments, reference, notes"));
    run_ = add_tipped_button(
        row, "plot-run", "rerun", tr("Run"),
        tr("Render and measure all points of this plot. What renders meanwhile in the views "
           "makes times longer"));
    connect(add_, &QToolButton::clicked, this, &PlotHeader::new_wanted);
    connect(edit_, &QToolButton::clicked, this, &PlotHeader::edit_wanted);
    connect(run_, &QToolButton::clicked, this,
            [this] { is_running_ ? emit cancel_wanted() : emit run_wanted(); });
    stale_ = new QLabel(tr("stale"));
    stale_->setObjectName(QStringLiteral("stale"));
    stale_->setStyleSheet(QStringLiteral(
        "QLabel { background: #8a5a10; color: #ffffff; border-radius: 3px; padding: 1px 6px; }"));
    stale_->setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
    row->addWidget(stale_);
    progress_ = new QProgressBar;
    progress_->setObjectName(QStringLiteral("progress"));
    progress_->setMinimumWidth(60);
    progress_->setMaximumHeight(16);
    row->addWidget(progress_, 1);
    doing_ = make_cut_label("doing", Qt::ElideMiddle);
    row->addWidget(doing_, 2);
    export_ = add_tipped_button(row, "plot-export", "export", tr("Export"), tr("Write or copy the plot"));
    export_->setPopupMode(QToolButton::InstantPopup);
    export_->setMenu(make_export_menu());
}

void PlotHeader::make_second_row(QBoxLayout* row) {
    metrics_ = add_tipped_list(row, "metric", tr("Metric"),
                               tr("Error that is drawn; all metrics are measured at once"),
                               &PlotHeader::metric_chosen);
    row->addWidget(new QLabel(tr("over")));
    keys_ = add_tipped_list(row, "over", tr("Varies"), tr("What differs from point to point"),
                            &PlotHeader::key_chosen);
    values_ = new QLineEdit;
    values_->setObjectName(QStringLiteral("values"));
    values_->setAccessibleName(tr("Values"));
    values_->setMinimumWidth(60);
    set_tip(values_, tr("Its values, separated by commas: 32, 64, 128"));
    row->addWidget(values_, 2);
    connect(values_, &QLineEdit::editingFinished, this, &PlotHeader::take_values);
    axis_ = add_tipped_list(row, "axis", tr("Horizontal axis"),
                            tr("Drawn against the time that rendering took, or against the values"), nullptr);
    axis_->addItem(tr("against time"));
    axis_->addItem(tr("against values"));
    connect(axis_, &QComboBox::activated, this, [this](int index) { emit against_time_chosen(index == 0); });
    log_x_ = add_tipped_button(row, "log-x", nullptr, tr("log x"), tr("Logarithmic horizontal axis"));
    log_y_ = add_tipped_button(row, "log-y", nullptr, tr("log y"), tr("Logarithmic vertical axis"));
    for (auto* button : {log_x_, log_y_}) {
        button->setCheckable(true);
        connect(button, &QToolButton::clicked, this,
                [this] { emit log_chosen(log_x_->isChecked(), log_y_->isChecked()); });
    }
}

QMenu* PlotHeader::make_export_menu() {
    auto* menu = new QMenu(this);
    const auto entry = [&](const char* name, const QString& text, const char* drawing, auto run) {
        auto* action = menu->addAction(drawing ? icon(drawing) : QIcon(), text);
        action->setObjectName(QLatin1String(name));
        connect(action, &QAction::triggered, this, run);
    };
    entry("export-paper", tr("Picture on white (PNG) …"), "export",
          [this] { emit picture_wanted(1, true, false); });
    entry("export-paper-2", tr("Picture on white, twice as fine (PNG) …"), nullptr,
          [this] { emit picture_wanted(2, true, false); });
    entry("export-screen", tr("Picture as shown (PNG) …"), nullptr,
          [this] { emit picture_wanted(1, false, false); });
    entry("export-screen-2", tr("Picture as shown, twice as fine (PNG) …"), nullptr,
          [this] { emit picture_wanted(2, false, false); });
    entry("export-numbers", tr("Numbers (CSV) …"), "table", [this] { emit numbers_wanted(false); });
    menu->addSeparator();
    entry("copy-paper", tr("Copy picture on white"), "copy", [this] { emit picture_wanted(2, true, true); });
    entry("copy-screen", tr("Copy picture as shown"), nullptr,
          [this] { emit picture_wanted(2, false, true); });
    entry("copy-numbers", tr("Copy numbers"), nullptr, [this] { emit numbers_wanted(true); });
    return menu;
}

QAction* PlotHeader::action(const char* name) const {
    return findChild<QAction*>(QLatin1String(name));
}

void PlotHeader::take_values() {
    const auto text = values_->text().trimmed();
    if (text == shown_values_) return;
    shown_values_ = text;
    emit values_chosen(text);
}

void PlotHeader::show_list(QComboBox* list, const std::vector<Option>& options, const QString& current) {
    std::vector<Option> all = options;
    const auto is_current = [&](const Option& option) { return option.id == current; };
    if (!current.isEmpty() && std::none_of(all.begin(), all.end(), is_current))
        all.push_back({current, current, {}});
    show_options(list, all, current);
}

void PlotHeader::show_choices(const PlotChoices& choices) {
    const bool has_plot = !choices.plot.isEmpty(), writable = choices.why_read_only.isEmpty();
    show_list(plots_, choices.plots, choices.plot);
    show_list(metrics_, choices.metrics, choices.metric);
    show_list(keys_, choices.keys, choices.key);
    if (choices.values != shown_values_ || !values_->hasFocus()) values_->setText(choices.values);
    shown_values_ = choices.values;
    values_->setPlaceholderText(choices.values_hint);
    axis_->setCurrentIndex(choices.against_time ? 0 : 1);
    log_x_->setChecked(choices.log_x && choices.why_no_log_x.isEmpty());
    log_y_->setChecked(choices.log_y && choices.why_no_log_y.isEmpty());
    set_usable(log_x_, choices.why_no_log_x.isEmpty(), choices.why_no_log_x);
    set_usable(log_y_, choices.why_no_log_y.isEmpty(), choices.why_no_log_y);
    set_usable(add_, writable, choices.why_read_only);
    for (QWidget* each : {static_cast<QWidget*>(metrics_), static_cast<QWidget*>(keys_),
                          static_cast<QWidget*>(values_), static_cast<QWidget*>(axis_)})
        set_usable(each, has_plot && writable, choices.why_read_only);
    plots_->setVisible(has_plot);
    edit_->setVisible(has_plot);
    run_->setVisible(has_plot);
    export_->setVisible(has_plot);
    second_->setVisible(has_plot);
    set_usable(export_, choices.has_numbers, tr("There are no numbers yet: run the plot."));
    if (is_running_ != choices.is_running) {
        is_running_ = choices.is_running;
        run_->setText(is_running_ ? tr("Cancel") : tr("Run"));
        run_->setIcon(icon(is_running_ ? "cancel" : "rerun"));
    }
    set_usable(run_, is_running_ || choices.why_not_run.isEmpty(), choices.why_not_run);
    progress_->setVisible(is_running_);
    progress_->setRange(0, choices.fraction < 0 ? 0 : 1000);
    progress_->setValue(int(1000 * choices.fraction));
    doing_->setText(is_running_ ? choices.doing : QString());
    doing_->setToolTip(choices.doing);
    stale_->setVisible(!choices.stale.isEmpty() && !is_running_);
    stale_->setToolTip(choices.stale);
}

}  // namespace ir::widgets
