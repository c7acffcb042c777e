#include "widgets/document/experiment_checks.h"

#include <algorithm>

#include "widgets/document/short_forms.h"

namespace ir::widgets {

ExperimentChecks::ExperimentChecks(const QString& name, QWidget* parent) : QListWidget(parent) {
    setObjectName(QStringLiteral("experiments"));
    setAccessibleName(name);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    setTextElideMode(Qt::ElideRight);
    connect(this, &QListWidget::itemChanged, this, [this](QListWidgetItem* item) {
        if (!showing_) emit ticked(item->data(Qt::UserRole).toString(), item->checkState() == Qt::Checked);
    });
}

void ExperimentChecks::show_experiments(const projects::Project& project,
                                        const std::vector<std::string>& chosen) {
    showing_ = true;
    const int current = currentRow();
    clear();
    const auto add = [&](const std::string& id, const QString& label, bool is_checked) {
        auto* item = new QListWidgetItem(label, this);
        item->setData(Qt::UserRole, q(id));
        item->setToolTip(q(id));
        item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable);
        item->setCheckState(is_checked ? Qt::Checked : Qt::Unchecked);
    };
    for (const auto& experiment : project.experiments)
        add(experiment.id, q(experiment.name),
            std::find(chosen.begin(), chosen.end(), experiment.id) != chosen.end());
    for (const auto& id : chosen)
        if (!projects::find_item(project.experiments, id))
            add(id, tr("%1 (not in the project)").arg(q(id)), true);
    setCurrentRow(std::clamp(current, -1, count() - 1));
    const int line = fontMetrics().lineSpacing() + 6;
    setFixedHeight(std::clamp(count(), 2, 6) * line + 4);
    showing_ = false;
}

}  // namespace ir::widgets
