#include "widgets/parameters/parameter_editor.h"

#include <QCheckBox>
#include <QComboBox>
#include <QHBoxLayout>
#include <QSlider>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>

#include "widgets/parameters/number_field.h"
#include "widgets/parameters/row_state.h"

namespace ir::widgets {
namespace {

constexpr int slider_steps = 1000;

QHBoxLayout* bare_layout(QWidget* widget) {
    auto* layout = new QHBoxLayout(widget);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(6);
    return layout;
}

/// The wheel belongs to the page unless the control has the focus.
template <class Control>
class Calm : public Control {
  public:
    using Control::Control;

  protected:
    void wheelEvent(QWheelEvent* event) override {
        this->hasFocus() ? Control::wheelEvent(event) : event->ignore();
    }
};

class ToggleEditor final : public ParameterEditor {
  public:
    explicit ToggleEditor(QWidget* parent) : ParameterEditor(parent), box_(new QCheckBox(this)) {
        bare_layout(this)->addWidget(box_);
        setFocusProxy(box_);
        connect(box_, &QCheckBox::clicked, this, [this](bool on) {
            emit chosen(Value(on));
            emit finished();
        });
    }
    void show_value(const Value& value) override {
        if (const auto* on = std::get_if<bool>(&value)) box_->setChecked(*on);
    }

  private:
    QCheckBox* box_;
};

class ChoiceEditor final : public ParameterEditor {
  public:
    ChoiceEditor(const ParameterDescription& parameter, QWidget* parent)
        : ParameterEditor(parent), box_(new Calm<QComboBox>(this)) {
        bare_layout(this)->addWidget(box_);
        setFocusProxy(box_);
        box_->setFocusPolicy(Qt::StrongFocus);
        box_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
        for (const auto& choice : parameter.choices) {
            const auto& allowed = parameter.supported;
            if (!allowed.empty() && std::find(allowed.begin(), allowed.end(), choice.key) == allowed.end())
                continue;
            box_->addItem(QString::fromStdString(choice.label), QString::fromStdString(choice.key));
            box_->setItemData(box_->count() - 1, QString::fromStdString(choice.doc), Qt::ToolTipRole);
        }
        connect(box_, &QComboBox::activated, this, [this](int index) {
            emit chosen(Value(box_->itemData(index).toString().toStdString()));
            emit finished();
        });
    }
    void show_value(const Value& value) override {
        if (const auto* key = std::get_if<std::string>(&value))
            box_->setCurrentIndex(box_->findData(QString::fromStdString(*key)));
    }

  private:
    QComboBox* box_;
};

class NumberEditor final : public ParameterEditor {
  public:
    NumberEditor(const ParameterDescription& parameter, QWidget* parent)
        : ParameterEditor(parent),
          range_(slider_range(parameter)),
          whole_(parameter.type == ParameterType::integer) {
        auto* layout = bare_layout(this);
        if (range_.min < range_.max) {
            slider_ = new Calm<QSlider>(Qt::Horizontal, this);
            slider_->setRange(0, whole_ && !is_logarithmic(range_) ? whole_steps() : slider_steps);
            slider_->setFocusPolicy(Qt::StrongFocus);
            slider_->setMinimumWidth(16);
            layout->addWidget(slider_, 1);
            connect(slider_, &QSlider::valueChanged, this, &NumberEditor::slide);
            connect(slider_, &QSlider::sliderReleased, this, &ParameterEditor::finished);
        }
        field_ = new NumberField(this);
        field_->set_whole(whole_);
        field_->setMinimum(std::max(parameter.hard.min, whole_ ? -9e15 : -field_->max_value));
        field_->setMaximum(std::min(parameter.hard.max, whole_ ? 9e15 : field_->max_value));
        suffix_ = suffix_text(parameter);
        suffix_of_one_ = suffix_text(parameter, 1);
        if (!suffix_.isEmpty()) {
            field_->setSuffix(suffix_);
            field_->setMinimumWidth(field_->minimumWidth() +
                                    field_->fontMetrics().horizontalAdvance(suffix_));
        }
        layout->addWidget(field_, slider_ ? 0 : 1);
        setFocusProxy(field_);
        connect(field_, &NumberField::chosen, this, [this](double value) {
            report(value);
            emit finished();
        });
    }
    void show_value(const Value& value) override {
        const auto* real = std::get_if<double>(&value);
        const auto* whole = std::get_if<std::int64_t>(&value);
        if (!real && !whole) return;
        const double number = real ? *real : double(*whole);
        showing_ = true;
        show_number(number);
        // A slider in the hand is not pulled back by rounding.
        if (slider_ && !slider_->isSliderDown())
            slider_->setValue(int(std::lround(slider_position(range_, number) * slider_->maximum())));
        showing_ = false;
    }

  private:
    int whole_steps() const { return int(std::min(range_.max - range_.min, 100000.0)); }
    void show_number(double value) {
        field_->show_value(value);
        const auto& suffix = value == 1 ? suffix_of_one_ : suffix_;
        if (field_->suffix() != suffix) field_->setSuffix(suffix);
    }
    void slide(int position) {
        if (showing_) return;
        double value = slider_value(range_, position / double(slider_->maximum()));
        value = whole_ ? std::round(value) : std::stod(QString::number(value, 'g', 4).toStdString());
        show_number(value);
        report(value);
        if (!slider_->isSliderDown()) emit finished();
    }
    void report(double value) {
        emit chosen(whole_ ? Value(static_cast<std::int64_t>(value)) : Value(value));
    }

    Range range_;
    QString suffix_, suffix_of_one_;
    bool whole_, showing_ = false;
    QSlider* slider_ = nullptr;
    NumberField* field_ = nullptr;
};

}  // namespace

ParameterEditor* make_editor(const ParameterDescription& parameter, QWidget* parent) {
    switch (parameter.type) {
        case ParameterType::toggle:
            return new ToggleEditor(parent);
        case ParameterType::choice:
            return new ChoiceEditor(parameter, parent);
        default:
            return new NumberEditor(parameter, parent);
    }
}

}  // namespace ir::widgets
