#include "app/gui/film_dialog.h"

#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <QRadioButton>

#include "widgets/parameters/number_field.h"

namespace ir::gui {
namespace {

widgets::NumberField* make_number(double min, double max, double value, const QString& unit,
                                  const char* name) {
    auto* number = new widgets::NumberField;
    number->setObjectName(QLatin1String(name));
    number->setRange(min, max);
    number->setSuffix(unit);
    number->setValue(value);
    return number;
}

}  // namespace

FilmDialog::FilmDialog(const QString& what, double begin, double moves_until, double exposure,
                       QWidget* parent)
    : QDialog(parent),
      begin_(begin),
      time_(new QRadioButton(tr("&Time passes until"))),
      turn_(new QRadioButton(tr("&Camera turns once in"))),
      until_(make_number(begin, 1e6, std::max(begin, moves_until), tr(" s"), "film-until")),
      seconds_(make_number(0.1, 1e4, 4, tr(" s"), "film-turn")),
      exposure_(make_number(-40, 40, exposure, tr(" stops"), "film-exposure")),
      count_(new QLabel),
      video_(new QPushButton(tr("&Video …"))),
      pictures_(new QPushButton(tr("&Pictures …"))) {
    setWindowTitle(tr("Film"));
    setObjectName(QStringLiteral("film"));
    const bool moves = moves_until > begin;
    (moves ? time_ : turn_)->setChecked(true);
    time_->setToolTip(tr("Camera, lights, parts and animation move as in the timeline, from %1 s on")
                          .arg(begin, 0, 'g', 4));
    turn_->setToolTip(tr("About what it looks at; everything else moves on"));
    until_->setAccessibleName(tr("Time passes until"));
    until_->setToolTip(time_->toolTip());
    seconds_->setAccessibleName(tr("Camera turns once in"));
    seconds_->setToolTip(turn_->toolTip());
    exposure_->setToolTip(tr("The same for all pictures"));
    video_->setObjectName(QStringLiteral("film-video"));
    video_->setToolTip(tr("Made by ffmpeg, which has to be installed"));
    pictures_->setObjectName(QStringLiteral("film-pictures"));
    pictures_->setToolTip(tr("0001.png, 0002.png, … in a folder"));
    count_->setObjectName(QStringLiteral("film-count"));
    auto* subject = new QLabel(what);
    subject->setObjectName(QStringLiteral("film-what"));
    subject->setTextFormat(Qt::PlainText);
    subject->setWordWrap(true);
    auto* form = new QFormLayout(this);
    form->addRow(subject);
    form->addRow(time_, until_);
    form->addRow(turn_, seconds_);
    form->addRow(tr("&Exposure"), exposure_);
    form->addRow(count_);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
    buttons->addButton(video_, QDialogButtonBox::ActionRole);
    buttons->addButton(pictures_, QDialogButtonBox::ActionRole);
    video_->setDefault(true);
    form->addRow(buttons);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    connect(video_, &QPushButton::clicked, this, &FilmDialog::video_wanted);
    connect(pictures_, &QPushButton::clicked, this, &FilmDialog::pictures_wanted);
    connect(time_, &QRadioButton::toggled, this, &FilmDialog::update);
    for (auto* number : {until_, seconds_})
        connect(number, &QDoubleSpinBox::valueChanged, this, &FilmDialog::update);
    update();
}

engine::Film FilmDialog::film() const {
    engine::Film film;
    if (time_->isChecked())
        film.until = until_->value();
    else
        film.turntable = seconds_->value();
    film.exposure = exposure_->value();
    return film;
}

void FilmDialog::update() {
    until_->setEnabled(time_->isChecked());
    seconds_->setEnabled(turn_->isChecked());
    const int pictures = engine::count_pictures(film(), begin_, 0);
    const bool fits = pictures >= 1 && pictures <= engine::max_film_pictures;
    count_->setText(
        fits ? tr("%1 at 30 a second").arg(pictures == 1 ? tr("1 picture") : tr("%1 pictures").arg(pictures))
        : pictures == 0 ? tr("No time passes")
                        : tr("At most %1 pictures").arg(engine::max_film_pictures));
    for (auto* button : {video_, pictures_}) button->setEnabled(fits);
}

}  // namespace ir::gui
