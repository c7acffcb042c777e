#include "app/gui/figure_dialog.h"

#include <QClipboard>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QGroupBox>
#include <QGuiApplication>
#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QVBoxLayout>
#include <algorithm>
#include <limits>
#include <map>

#include "app/gui/json_fields.h"
#include "app/gui/text_of.h"
#include "renderers/core/error.h"
#include "renderers/core/reason.h"
#include "renderers/core/write_file.h"
#include "renderers/image/metrics.h"
#include "widgets/panels/empty_tree_view.h"
#include "widgets/style/theme.h"

namespace ir::gui {
namespace {

using report::Figure;
constexpr int picture_role = Qt::UserRole, inset_role = Qt::UserRole + 1;

QSize size_of(const report::Raster& raster) {
    return {raster.width, raster.height};
}

QString tip_of(const report::FigurePicture& picture) {
    const auto size = size_of(*picture.raster);
    return QStringLiteral("%1\n%2 × %3").arg(text_of(picture.label)).arg(size.width()).arg(size.height());
}

QString inset_text(const Rectangle& inset) {
    return QStringLiteral("%1 × %2 at %3, %4").arg(inset.width).arg(inset.height).arg(inset.x).arg(inset.y);
}

QIcon swatch(std::size_t inset) {
    QPixmap pixmap(12, 12);
    pixmap.fill(QColor(QString::fromStdString(report::frame_colour(inset))));
    return pixmap;
}

QRect rectangle_of(const QListWidgetItem& item) {
    return item.data(inset_role).toRect();
}

/// Says why it is empty.
class List : public QListWidget {
  public:
    explicit List(const QString& empty_text) : empty_text_(empty_text) {}

  protected:
    void paintEvent(QPaintEvent* event) override {
        QListWidget::paintEvent(event);
        widgets::paint_empty_text(*this, empty_text_);
    }

  private:
    QString empty_text_;
};

QListWidget* list(const char* name, const QString& tip, int lines, const QString& empty_text = {}) {
    auto* made = new List(empty_text);
    made->setObjectName(QLatin1String(name));
    made->setToolTip(tip);
    made->setAccessibleName(tip);
    made->setTextElideMode(Qt::ElideMiddle);
    made->setMaximumHeight(lines * (made->fontMetrics().height() + 6) + 6);
    return made;
}

}  // namespace

FigureDialog::FigureDialog(QWidget* parent)
    : QDialog(parent), drawing_(new widgets::NewestJob(this)), writing_(new widgets::NewestJob(this)) {
    setObjectName(QStringLiteral("figure-dialog"));
    setWindowTitle(tr("Figure"));
    auto* row = new QHBoxLayout(this);
    row->addWidget(make_choices());
    auto* right = new QVBoxLayout;
    preview_ = new QLabel;
    preview_->setObjectName(QStringLiteral("preview"));
    preview_->setAccessibleName(tr("The figure"));
    preview_->setAlignment(Qt::AlignCenter);
    preview_->setMinimumSize(280, 200);
    preview_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Ignored);
    problem_ = new QLabel;
    problem_->setObjectName(QStringLiteral("problem"));
    problem_->setWordWrap(true);
    problem_->setTextFormat(Qt::PlainText);
    widgets::set_themed_sheet(problem_, [](const widgets::ThemeColours& colours) {
        return QStringLiteral("color: %1;").arg(colours.warning.name());
    });
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
    save_ = buttons->addButton(tr("&Save …"), QDialogButtonBox::ActionRole);
    save_->setObjectName(QStringLiteral("save"));
    save_->setToolTip(tr("As PDF, SVG or PNG, by the name's ending"));
    copy_ = buttons->addButton(tr("&Copy"), QDialogButtonBox::ActionRole);
    copy_->setObjectName(QStringLiteral("copy"));
    copy_->setToolTip(
        tr("Copies the figure as a picture of %1 dots per inch").arg(report::Figure().dots_per_inch));
    connect(save_, &QPushButton::clicked, this, &FigureDialog::file_wanted);
    connect(copy_, &QPushButton::clicked, this, &FigureDialog::copy);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::close);
    right->addWidget(preview_, 1);
    right->addWidget(problem_);
    right->addWidget(buttons);
    row->addLayout(right, 1);
    resize(900, 560);
}

QWidget* FigureDialog::make_choices() {
    auto* choices = new QWidget;
    auto* column = new QVBoxLayout(choices);
    column->setContentsMargins(0, 0, 0, 0);
    list_ = list("pictures",
                 tr("Pictures of the views: tick what the figure shows, drag to order, F2 renames"), 6);
    list_->setDragDropMode(QAbstractItemView::InternalMove);
    list_->setEditTriggers(QAbstractItemView::EditKeyPressed | QAbstractItemView::DoubleClicked);
    connect(list_, &QListWidget::itemChanged, this, &FigureDialog::draw);
    connect(list_->model(), &QAbstractItemModel::rowsMoved, this, &FigureDialog::draw);
    column->addWidget(new QLabel(tr("Pictures")));
    column->addWidget(list_, 1);
    column->addWidget(make_insets());
    column->addWidget(make_numbers());
    column->addWidget(make_sizes());
    column->addStretch();
    choices->setFixedWidth(290);
    return choices;
}

QWidget* FigureDialog::make_insets() {
    auto* box = new QWidget;
    auto* column = new QVBoxLayout(box);
    column->setContentsMargins(0, 0, 0, 0);
    auto* row = new QHBoxLayout;
    add_ = new QPushButton(tr("&Add the rectangle"));
    add_->setObjectName(QStringLiteral("add-inset"));
    remove_ = new QPushButton(tr("&Remove"));
    remove_->setObjectName(QStringLiteral("remove-inset"));
    insets_ = list("insets", tr("Rectangles that stand zoomed below each picture"), 4,
                   tr("Add the rectangle that is drawn in a view (B)."));
    connect(add_, &QPushButton::clicked, this, [this] {
        add_inset({rectangle_.x(), rectangle_.y(), rectangle_.width(), rectangle_.height()});
        draw();
    });
    connect(remove_, &QPushButton::clicked, this, [this] {
        delete insets_->currentItem();
        for (int i = 0; i < insets_->count(); ++i) insets_->item(i)->setIcon(swatch(std::size_t(i)));
        draw();
    });
    connect(insets_, &QListWidget::currentRowChanged, this,
            [this] { remove_->setEnabled(insets_->currentItem()); });
    remove_->setEnabled(false);
    row->addWidget(add_);
    row->addWidget(remove_);
    column->addWidget(new QLabel(tr("Zoomed rectangles")));
    column->addWidget(insets_);
    column->addLayout(row);
    return box;
}

QWidget* FigureDialog::make_numbers() {
    auto* box = new QWidget;
    auto* column = new QVBoxLayout(box);
    column->setContentsMargins(0, 0, 0, 0);
    reference_ = new QComboBox;
    reference_->setObjectName(QStringLiteral("reference"));
    reference_->setToolTip(tr("What the others are measured against, over all valid pixels"));
    reference_->setAccessibleName(tr("Reference"));
    reference_->setMinimumContentsLength(12);
    reference_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    connect(reference_, &QComboBox::activated, this, &FigureDialog::draw);
    metrics_ = list("metrics", tr("Numbers beneath each picture but the reference"), 4);
    for (const auto& each : metrics()) {
        auto* item = new QListWidgetItem(text_of(each.label), metrics_);
        item->setData(Qt::UserRole, text_of(each.name));
        item->setToolTip(text_of(each.doc));
        item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable);
        item->setCheckState(each.name == "rmse" ? Qt::Checked : Qt::Unchecked);
    }
    connect(metrics_, &QListWidget::itemChanged, this, &FigureDialog::draw);
    column->addWidget(new QLabel(tr("Numbers against")));
    column->addWidget(reference_);
    column->addWidget(metrics_);
    return box;
}

QWidget* FigureDialog::make_sizes() {
    auto* box = new QWidget;
    auto* form = new QFormLayout(box);
    form->setContentsMargins(0, 0, 0, 0);
    const Figure usual;
    const auto number = [](const char* name, double low, double high, double value, const QString& suffix) {
        auto* field = new QDoubleSpinBox;
        field->setObjectName(QLatin1String(name));
        field->setRange(low, high);
        field->setDecimals(1);
        field->setValue(value);
        field->setSuffix(suffix);
        field->setKeyboardTracking(false);
        return field;
    };
    width_ = number("width", Figure::min_width, Figure::max_width, usual.width, tr(" mm"));
    width_->setToolTip(tr("Width of the figure: 178 mm are two columns of most papers, 86 mm one"));
    font_ = number("font", Figure::min_font, Figure::max_font, usual.font, tr(" pt"));
    font_->setToolTip(tr("Size of the letters"));
    columns_ = new QSpinBox;
    columns_->setObjectName(QStringLiteral("columns"));
    columns_->setRange(0, int(Figure::max_pictures));
    columns_->setSpecialValueText(tr("all"));
    columns_->setToolTip(tr("Pictures in a row"));
    for (auto* field : {width_, font_})
        connect(field, &QDoubleSpinBox::valueChanged, this, &FigureDialog::draw);
    connect(columns_, &QSpinBox::valueChanged, this, &FigureDialog::draw);
    form->addRow(tr("Width"), width_);
    form->addRow(tr("Letters"), font_);
    form->addRow(tr("In a row"), columns_);
    return box;
}

void FigureDialog::set_pictures(std::vector<report::FigurePicture> pictures) {
    struct Choice {
        int place, row;  ///< among the pictures, in the list
        QString text;
        Qt::CheckState state;
    };
    std::map<std::string, Choice> before;
    for (int row = 0; row < list_->count(); ++row) {
        const auto* item = list_->item(row);
        const int place = item->data(picture_role).toInt();
        before[pictures_[std::size_t(place)].label] = {place, row, item->text(), item->checkState()};
    }
    const bool are_same =
        std::is_permutation(pictures.begin(), pictures.end(), pictures_.begin(), pictures_.end(),
                            [](const auto& a, const auto& b) {
                                return a.label == b.label && size_of(*a.raster) == size_of(*b.raster);
                            });
    const auto place_of = [&](const report::FigurePicture& picture) {
        const auto found = before.find(picture.label);
        if (found == before.end()) return std::numeric_limits<int>::max();
        return are_same ? found->second.place : found->second.row;
    };
    std::stable_sort(pictures.begin(), pictures.end(),
                     [&](const auto& a, const auto& b) { return place_of(a) < place_of(b); });
    pictures_ = std::move(pictures);
    if (are_same) return draw();  // a name may be in the middle of being changed
    filling_ = true;
    list_->clear();
    for (std::size_t i = 0; i < pictures_.size(); ++i) {
        const auto found = before.find(pictures_[i].label);
        const bool is_known = found != before.end();
        const QSize size = size_of(*pictures_[i].raster), first = shown_size();
        // Those of another size cannot stand beside the first ones.
        const bool fits = first.isEmpty() || size == first;
        auto* item = new QListWidgetItem(is_known ? found->second.text : text_of(pictures_[i].label), list_);
        item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable |
                       Qt::ItemIsEditable | Qt::ItemIsDragEnabled);
        item->setData(picture_role, int(i));
        item->setCheckState(is_known ? found->second.state : fits ? Qt::Checked : Qt::Unchecked);
        item->setToolTip(tip_of(pictures_[i]));
    }
    fill_references();
    filling_ = false;
    draw();
}

QSize FigureDialog::shown_size() const {
    for (int i = 0; i < list_->count(); ++i)
        if (const auto* item = list_->item(i); item->checkState() == Qt::Checked)
            return size_of(*pictures_[std::size_t(item->data(picture_role).toInt())].raster);
    return {};
}

/// The one that was chosen stays; else the last is the reference, as in files of the command line.
void FigureDialog::fill_references() {
    const auto chosen = reference_->currentText();
    const bool had_one = reference_->count() > 1;
    reference_->clear();
    reference_->addItem(tr("nothing"), -1);
    for (std::size_t i = 0; i < pictures_.size(); ++i)
        reference_->addItem(text_of(pictures_[i].label), int(i));
    const int found = reference_->findText(chosen);
    reference_->setCurrentIndex(had_one && found >= 0 ? found : reference_->count() - 1);
}

void FigureDialog::set_rectangle(QSize size, const QRect& rectangle) {
    rectangle_size_ = size;
    rectangle_ = rectangle;
    update_add();
}

void FigureDialog::update_add() {
    QString why_not;
    if (rectangle_.isEmpty())
        why_not = tr("Draw a rectangle in a picture first (B)");
    else if (shown_size().isEmpty())
        why_not = tr("Tick a picture first");
    else if (rectangle_size_ != shown_size())
        why_not = tr("The rectangle was drawn in pictures of another size");
    else if (std::size_t(insets_->count()) >= Figure::max_insets)
        why_not = tr("A figure has at most %1 rectangles").arg(Figure::max_insets);
    add_->setEnabled(why_not.isEmpty());
    add_->setToolTip(why_not.isEmpty() ? tr("The rectangle of %1 × %2 pixels that is drawn in the pictures")
                                             .arg(rectangle_.width())
                                             .arg(rectangle_.height())
                                       : why_not);
}

void FigureDialog::add_inset(const Rectangle& inset) {
    if (std::size_t(insets_->count()) >= Figure::max_insets) return;
    auto* item = new QListWidgetItem(swatch(std::size_t(insets_->count())), inset_text(inset), insets_);
    item->setData(inset_role, QRect(inset.x, inset.y, inset.width, inset.height));
}

report::Figure FigureDialog::figure() const {
    Figure figure;
    const int reference = reference_->currentData().toInt();
    for (int i = 0; i < list_->count(); ++i) {
        const auto* item = list_->item(i);
        if (item->checkState() != Qt::Checked) continue;
        const int place = item->data(picture_role).toInt();
        if (place == reference) figure.reference = figure.pictures.size();
        figure.pictures.push_back(pictures_[std::size_t(place)]);
        figure.pictures.back().label = item->text().toStdString();
    }
    for (int i = 0; i < insets_->count(); ++i) {
        const QRect inset = rectangle_of(*insets_->item(i));
        figure.insets.push_back({inset.x(), inset.y(), inset.width(), inset.height()});
    }
    for (int i = 0; i < metrics_->count(); ++i)
        if (metrics_->item(i)->checkState() == Qt::Checked)
            figure.metrics.push_back(metrics_->item(i)->data(Qt::UserRole).toString().toStdString());
    figure.width = width_->value();
    figure.font = font_->value();
    figure.columns = columns_->value();
    return figure;
}

void FigureDialog::draw() {
    if (filling_) return;
    update_add();
    if (!isVisible()) return;
    auto now = figure();
    const double pixels = std::max(100, preview_->width()) * devicePixelRatioF();
    now.dots_per_inch = std::clamp(pixels / (now.width / 25.4), 20.0, 600.0);
    drawing_->start([this, now = std::move(now)](const std::atomic<bool>&) -> std::function<void()> {
        try {
            const auto png = QByteArray::fromStdString(draw_figure(now, report::FigureFormat::png));
            return [this, png] { show_preview(png, {}); };
        } catch (const std::exception& error) {
            return [this, text = QString::fromStdString(reason_of(error))] { show_preview({}, text); };
        }
    });
}

void FigureDialog::show_preview(const QByteArray& png, const QString& problem) {
    QPixmap pixmap = QPixmap::fromImage(QImage::fromData(png, "PNG"));
    const qreal ratio = devicePixelRatioF();
    if (!pixmap.isNull())
        pixmap = pixmap.scaled(preview_->size() * ratio, Qt::KeepAspectRatio, Qt::SmoothTransformation);
    pixmap.setDevicePixelRatio(ratio);
    preview_->setPixmap(pixmap);
    problem_->setText(problem);
    update_buttons();
}

/// One is written at a time: another one would take the place of one that waits.
void FigureDialog::update_buttons() {
    const bool can_write = problem_->text().isEmpty() && !writing_->is_running();
    for (auto* button : {save_, copy_}) button->setEnabled(can_write);
}

void FigureDialog::write(std::function<std::function<void()>(const report::Figure&)> work) {
    const auto job = [this, work = std::move(work),
                      now = figure()](const std::atomic<bool>&) -> std::function<void()> {
        std::function<void()> then;
        try {
            then = work(now);
        } catch (const std::exception& error) {
            then = [this, text = QString::fromStdString(reason_of(error))] { emit failed(text); };
        }
        return [this, then] {
            update_buttons();
            then();
        };
    };
    writing_->start(job);
    update_buttons();
}

void FigureDialog::save_to(const QString& file) {
    write([this, file](const Figure& now) {
        const auto name = file.toStdString();
        write_file(name, draw_figure(now, report::figure_format(name)));
        return [this, file] { emit written(file); };
    });
}

void FigureDialog::copy() {
    write([](const Figure& now) {
        const auto png = QByteArray::fromStdString(draw_figure(now, report::FigureFormat::png));
        return [png] { QGuiApplication::clipboard()->setImage(QImage::fromData(png, "PNG")); };
    });
}

projects::Json FigureDialog::save() const {
    const auto now = figure();
    projects::Json memory = {{"width", now.width},
                             {"font", now.font},
                             {"columns", now.columns},
                             {"metrics", now.metrics},
                             {"insets", projects::Json::array()}};
    for (const auto& inset : now.insets)
        memory["insets"].push_back(
            {{"x", inset.x}, {"y", inset.y}, {"width", inset.width}, {"height", inset.height}});
    return memory;
}

void FigureDialog::load(const projects::Json& memory) {
    const Figure usual;
    filling_ = true;
    width_->setValue(field_or(memory, "width", usual.width));
    font_->setValue(field_or(memory, "font", usual.font));
    columns_->setValue(field_or(memory, "columns", usual.columns));
    const auto& chosen = member_or_null(memory, "metrics");
    for (int i = 0; i < metrics_->count() && chosen.is_array(); ++i) {
        auto* item = metrics_->item(i);
        const auto name = item->data(Qt::UserRole).toString().toStdString();
        item->setCheckState(std::find(chosen.begin(), chosen.end(), projects::Json(name)) != chosen.end()
                                ? Qt::Checked
                                : Qt::Unchecked);
    }
    insets_->clear();
    for (const auto& each : member_or_null(memory, "insets"))
        add_inset({field_or(each, "x", 0), field_or(each, "y", 0), field_or(each, "width", 0),
                   field_or(each, "height", 0)});
    filling_ = false;
    draw();
}

void FigureDialog::resizeEvent(QResizeEvent* event) {
    QDialog::resizeEvent(event);
    draw();
}

void FigureDialog::showEvent(QShowEvent* event) {
    QDialog::showEvent(event);
    draw();
}

}  // namespace ir::gui
