#include "widgets/panels/controls.h"

#include <QBoxLayout>
#include <QComboBox>
#include <QCoreApplication>
#include <QItemSelectionModel>
#include <QKeyEvent>
#include <QLabel>
#include <QPainter>
#include <QProgressBar>
#include <QPushButton>
#include <QStringList>
#include <QStyle>
#include <QToolButton>

#include "widgets/panels/action_text.h"
#include "widgets/style/icons.h"

namespace ir::widgets {
namespace {

class CutLabel : public QLabel {
  public:
    explicit CutLabel(Qt::TextElideMode cut) : cut_(cut) {}

  protected:
    void paintEvent(QPaintEvent*) override {
        QPainter painter(this);
        const auto box = contentsRect();
        style()->drawItemText(&painter, box, int(alignment()) | Qt::TextSingleLine, palette(), isEnabled(),
                              fontMetrics().elidedText(text(), cut_, box.width()), foregroundRole());
    }

  private:
    const Qt::TextElideMode cut_;
};

}  // namespace

QString tip_with(const QString& tip, const QString& why_not) {
    return why_not.isEmpty() ? tip : QStringLiteral("%1.\n%2").arg(tip, why_not);
}

QLabel* make_cut_label(const char* name, Qt::TextElideMode cut) {
    auto* label = new CutLabel(cut);
    label->setObjectName(QLatin1String(name));
    label->setTextFormat(Qt::PlainText);
    label->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    label->setMinimumWidth(1);
    return label;
}

QToolButton* add_button(QBoxLayout* row, const char* name, const char* drawing, const QString& text) {
    auto* button = new QToolButton;
    button->setObjectName(QLatin1String(name));
    if (drawing) button->setIcon(icon(drawing));
    button->setText(text);
    button->setAccessibleName(text);
    button->setToolTip(text);
    button->setToolButtonStyle(drawing ? Qt::ToolButtonTextBesideIcon : Qt::ToolButtonTextOnly);
    button->setAutoRaise(true);
    button->setFocusPolicy(Qt::StrongFocus);
    mark_as_action(*button);
    row->addWidget(button);
    return button;
}

QToolButton* add_icon_button(QBoxLayout* row, const char* name, const char* drawing, const QString& text) {
    auto* button = add_button(row, name, drawing, text);
    button->setToolButtonStyle(Qt::ToolButtonIconOnly);
    return button;
}

QComboBox* add_list(QBoxLayout* row, const char* name, const QString& label, int letters, int stretch) {
    auto* list = new QComboBox;
    list->setObjectName(QLatin1String(name));
    list->setAccessibleName(label);
    list->setToolTip(label);
    list->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    list->setMinimumContentsLength(letters);
    row->addWidget(list, stretch);
    return list;
}

bool moves_through(QWidget* list, QEvent* event) {
    if (event->type() != QEvent::KeyPress) return false;
    const int key = static_cast<QKeyEvent*>(event)->key();
    if (key != Qt::Key_Up && key != Qt::Key_Down && key != Qt::Key_PageUp && key != Qt::Key_PageDown)
        return false;
    QCoreApplication::sendEvent(list, event);
    return true;
}

QProgressBar* add_progress(QBoxLayout* row) {
    auto* progress = new QProgressBar;
    progress->setObjectName(QStringLiteral("progress"));
    progress->setRange(0, 1000);
    progress->setMinimumWidth(50);
    progress->setMaximumHeight(16);
    row->addWidget(progress, 1);
    return progress;
}

EmptyPage make_empty_page() {
    const EmptyPage empty{new QWidget, new QLabel, new QPushButton};
    empty.text->setObjectName(QStringLiteral("empty"));
    empty.text->setWordWrap(true);
    empty.text->setAlignment(Qt::AlignCenter);
    empty.button->setObjectName(QStringLiteral("empty-button"));
    auto* column = new QVBoxLayout(empty.page);
    column->addStretch(1);
    column->addWidget(empty.text);
    column->addWidget(empty.button, 0, Qt::AlignHCenter);
    column->addStretch(1);
    return empty;
}

void EmptyPage::show(const QString& what, const QString& offered) const {
    text->setText(what);
    button->setText(offered);
    button->setVisible(!offered.isEmpty());
}

void show_options(QComboBox* list, const std::vector<Option>& options, const QString& current) {
    bool same = list->count() == int(options.size());
    for (std::size_t i = 0; same && i < options.size(); ++i)
        same = list->itemData(int(i)).toString() == options[i].id &&
               list->itemText(int(i)) == options[i].label &&
               list->itemData(int(i), Qt::ToolTipRole).toString() == options[i].tooltip;
    if (!same) {
        list->clear();
        for (const auto& option : options) {
            list->addItem(option.label, option.id);
            list->setItemData(list->count() - 1, option.tooltip, Qt::ToolTipRole);
        }
    }
    list->setCurrentIndex(list->findData(current));
}

QString rows_as_text(const QAbstractItemModel& model, const QItemSelectionModel& selection) {
    QStringList headings;
    for (int c = 0; c < model.columnCount(); ++c) headings << model.headerData(c, Qt::Horizontal).toString();
    QStringList lines{headings.join(QLatin1Char('\t'))};
    for (int row = 0; row < model.rowCount(); ++row) {
        if (selection.hasSelection() && !selection.isRowSelected(row, {})) continue;
        QStringList cells;
        for (int c = 0; c < model.columnCount(); ++c) cells << model.index(row, c).data().toString();
        lines << cells.join(QLatin1Char('\t'));
    }
    return lines.join(QLatin1Char('\n'));
}

}  // namespace ir::widgets
