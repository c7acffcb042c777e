#include "widgets/panels/preferences_dialog.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>

#include "widgets/inspect/colour_map_box.h"
#include "widgets/parameters/number_field.h"

namespace ir::widgets {

PreferencesDialog::PreferencesDialog(const std::vector<ParameterDescription>& preferences,
                                     const std::map<std::string, QString>& zeros, QWidget* parent)
    : QDialog(parent), panel_(new ParameterPanel), given_(new QLabel) {
    setWindowTitle(tr("Preferences"));
    setAttribute(Qt::WA_DeleteOnClose);
    setMinimumWidth(480);
    panel_->set_parameters("preferences", preferences, tr("For all projects"));
    for (const auto& [key, word] : zeros) {
        auto* editor = panel_->findChild<QWidget*>("editor:" + QString::fromStdString(key));
        auto* number = editor ? editor->findChild<NumberField*>() : nullptr;
        if (!number) continue;
        constexpr int buttons = 36;
        number->setSpecialValueText(word);
        number->setMinimumWidth(
            std::max(number->minimumWidth(), number->fontMetrics().horizontalAdvance(word) + buttons));
    }
    for (auto* list : panel_->findChildren<QComboBox*>()) add_map_pictures(*list);
    // A dialog is as wide as they are. Those that wrapped were cut at twice the scale.
    for (auto* label : panel_->findChildren<QLabel*>()) label->setWordWrap(false);
    given_->setObjectName(QStringLiteral("given"));
    given_->setWordWrap(true);
    auto* note = new QLabel(tr("A choice takes effect at once."));
    note->setWordWrap(true);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::RestoreDefaults | QDialogButtonBox::Close);
    buttons->button(QDialogButtonBox::RestoreDefaults)->setText(tr("&Defaults"));
    for (auto* each : buttons->buttons())
        static_cast<QPushButton*>(each)->setAutoDefault(false);  // Enter is for what is typed
    auto* layout = new QVBoxLayout(this);
    for (auto* part :
         {static_cast<QWidget*>(panel_), static_cast<QWidget*>(given_), static_cast<QWidget*>(note)})
        layout->addWidget(part);
    layout->addStretch(1);
    layout->addWidget(buttons);
    connect(panel_, &ParameterPanel::value_chosen, this, &PreferencesDialog::value_chosen);
    connect(panel_, &ParameterPanel::reset_chosen, this, &PreferencesDialog::reset_chosen);
    connect(buttons->button(QDialogButtonBox::RestoreDefaults), &QPushButton::clicked, this,
            [this, preferences] {
                for (const auto& each : preferences) emit reset_chosen(each.key);
            });
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
}

void PreferencesDialog::set_values(const Settings& settings, const std::map<std::string, QString>& given) {
    std::map<std::string, QString> reasons;
    QStringList options;
    for (const auto& [key, option] : given) {
        reasons[key] = tr("Set on the command line for this run: %1.").arg(option);
        options << option;
    }
    panel_->set_fixed(reasons);
    panel_->set_values(settings);
    given_->setText(tr("Set on the command line for this run: %1.").arg(options.join(QStringLiteral(", "))));
    given_->setVisible(!options.isEmpty());
}

}  // namespace ir::widgets
