#include "widgets/panels/preferences_dialog.h"

#include <QDialogButtonBox>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

namespace ir::widgets {

PreferencesDialog::PreferencesDialog(const std::vector<ParameterDescription>& preferences, QWidget* parent)
    : QDialog(parent), panel_(new ParameterPanel), given_(new QLabel) {
    setWindowTitle(tr("Preferences"));
    setAttribute(Qt::WA_DeleteOnClose);
    setMinimumWidth(480);
    panel_->set_parameters("preferences", preferences, tr("For all projects"));
    given_->setObjectName(QStringLiteral("given"));
    given_->setWordWrap(true);
    auto* note = new QLabel(tr("A choice takes effect at once."));
    note->setWordWrap(true);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
    buttons->button(QDialogButtonBox::Close)->setAutoDefault(false);  // Enter is for what is typed
    auto* layout = new QVBoxLayout(this);
    for (auto* part :
         {static_cast<QWidget*>(panel_), static_cast<QWidget*>(given_), static_cast<QWidget*>(note)})
        layout->addWidget(part);
    layout->addStretch(1);
    layout->addWidget(buttons);
    connect(panel_, &ParameterPanel::value_chosen, this, &PreferencesDialog::value_chosen);
    connect(panel_, &ParameterPanel::reset_chosen, this, &PreferencesDialog::reset_chosen);
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
