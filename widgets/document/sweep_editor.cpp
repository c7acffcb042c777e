#include "widgets/document/sweep_editor.h"

#include <QApplication>
#include <QClipboard>
#include <QFontDatabase>
#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QRegularExpression>
#include <QToolButton>
#include <algorithm>
#include <memory>

#include "projects/sweep.h"
#include "renderers/core/error.h"
#include "widgets/document/axis_text.h"
#include "widgets/document/edit_maker.h"
#include "widgets/document/fields.h"
#include "widgets/document/options.h"
#include "widgets/document/ordered_list.h"
#include "widgets/document/short_forms.h"

namespace ir::widgets {
namespace {

using projects::Sweep;
using Axes = std::vector<Sweep::Axis>;

/// What may vary: the method's parameters, then what every experiment has.
std::vector<Option> key_options(const Registry& registry, const projects::Experiment& base) {
    std::vector<Option> options;
    if (const auto* method = registry.find(base.method))
        for (const auto& parameter : method->parameters)
            options.push_back({q(parameter.key), q(parameter.label), q(parameter.doc)});
    for (const auto& key : general_axis_keys()) options.push_back({q(key), q(key), {}});
    return options;
}

Sweep::Axis& axis_at(Axes& axes, int index) {
    if (index < 0 || std::size_t(index) >= axes.size()) throw UsageError("there is no such axis any more");
    return axes[std::size_t(index)];
}

/// As a POSIX shell takes it for one word.
QString shell_word(const QString& text) {
    static const QRegularExpression plain(QStringLiteral("^[A-Za-z0-9_@%+=:,./-]+$"));
    if (plain.match(text).hasMatch()) return text;
    return QLatin1Char('\'') + QString(text).replace(QLatin1Char('\''), QStringLiteral("'\\''")) +
           QLatin1Char('\'');
}

}  // namespace

SweepEditor::SweepEditor(QWidget* parent) : ItemForm(parent) {
    auto* grid = make_form_section(tr("Sweep"), this);
    name_ = name_row(grid, ItemKind::sweep, tr("What the sweep is called"));
    experiment_ = new ChoiceField("experiment", this);
    row(grid, projects::field_of(projects::sweep_fields(), "experiment").text, experiment_);
    connect(experiment_, &ChoiceField::chosen, this, [this](const QString& id) {
        emit edit_wanted(field_edit<Sweep>(
            id_, "experiment", [id = id.toStdString()](Sweep& sweep) { sweep.experiment = id; }, false));
    });
    make_axes(make_form_section(tr("Axes"), this));
    make_command(make_form_section(tr("Run"), this));
}

void SweepEditor::make_command(QGridLayout* grid) {
    auto* how = new QLabel(tr("The Sweeps panel runs it, or this command in a terminal:"), this);
    how->setWordWrap(true);
    add_wide(grid, how);
    command_ = new QLineEdit(this);
    command_->setObjectName(QStringLiteral("command"));
    command_->setAccessibleName(tr("Command that runs the sweep"));
    command_->setReadOnly(true);
    command_->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
    add_wide(grid, command_);
    copy_ = make_button("copy", tr("Copy the command, to be pasted into a terminal"), this);
    copy_->setObjectName(QStringLiteral("copy-command"));
    copy_->setText(tr("Copy command"));
    copy_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    grid->addWidget(copy_, grid->rowCount(), 0, 1, 3, Qt::AlignLeft);
    connect(copy_, &QToolButton::clicked, this,
            [this] { QApplication::clipboard()->setText(command_->text()); });
    outcome_ = new QLabel(this);
    outcome_->setObjectName(QStringLiteral("outcome"));
    outcome_->setWordWrap(true);
    add_wide(grid, outcome_);
}

void SweepEditor::make_axes(QGridLayout* grid) {
    list_ = new OrderedList("axes", tr("axis"), 0, this);
    add_wide(grid, list_);
    connect(list_, &OrderedList::current_changed, this, [this](int index) {
        chosen_ = index;
        show_axis();
    });
    connect(list_, &OrderedList::add_wanted, this, &SweepEditor::add_axis);
    connect(list_, &OrderedList::duplicate_wanted, this, [this](int) { add_axis(); });
    connect(list_, &OrderedList::remove_wanted, this, [this](int index) {
        change_axes(
            tr("axes"),
            [index](Axes& axes) {
                axis_at(axes, index);
                axes.erase(axes.begin() + index);
            },
            false);
    });
    connect(list_, &OrderedList::move_wanted, this, [this](int from, int to) {
        chosen_ = to;
        change_axes(
            tr("axes"), [from, to](Axes& axes) { std::swap(axis_at(axes, from), axis_at(axes, to)); }, false);
    });
    key_ = new ChoiceField("axis-key", this);
    row(grid, tr("Key"), key_, tr("What varies along this axis; the last axis varies fastest"));
    connect(key_, &ChoiceField::chosen, this, &SweepEditor::choose_key);
    values_ = new TextField("axis-values", this);
    row(grid, tr("Values"), values_,
        tr("Separated by commas: 1, 2, 4. Sizes as 512x512; cameras, lights and scenes by id"));
    connect(values_, &TextField::chosen, this, [this](const QString& text) {
        const auto refused = change_axes(
            tr("values"),
            [index = chosen_, text = text.toStdString()](Axes& axes) {
                auto& axis = axis_at(axes, index);
                axis.values = parse_axis(axis.key, text);
            },
            true);
        if (refused.isEmpty()) return;
        values_->keep_refused(text);
        count_->setText(refused);
    });
    count_ = new QLabel(this);
    count_->setObjectName(QStringLiteral("sweep-count"));
    count_->setWordWrap(true);
    add_wide(grid, count_);
}

/// Returns why it was refused, in one line; empty: it was not.
QString SweepEditor::change_axes(const QString& field, const std::function<void(Axes&)>& change,
                                 bool checks) {
    const auto put = field_edit<Sweep>(
        id_, field.toStdString(), [change](Sweep& sweep) { change(sweep.axes); }, false);
    const auto refused = std::make_shared<QString>();
    emit edit_wanted([=, id = id_, registry = registry_](const projects::Project& project) {
        if (!checks) return put(project);
        try {  // what the method would refuse is refused now
            Sweep changed = projects::edits::item_of<Sweep>(project, id);
            change(changed.axes);
            projects::check_sweep(project, changed, *registry);
        } catch (const Error& error) {
            *refused = QString::fromUtf8(error.what());
            throw;
        }
        return put(project);
    });
    return *refused;
}

void SweepEditor::add_axis() {
    for (const auto& option : key_options(*registry_, base_)) {
        const std::string key = option.id.toStdString();
        const auto same = [&](const Sweep::Axis& axis) { return axis.key == key; };
        const auto value = present_value(base_, key);
        if (value.is_null() || std::any_of(sweep_.axes.begin(), sweep_.axes.end(), same)) continue;
        chosen_ = int(sweep_.axes.size());
        change_axes(
            tr("axes"),
            [=](Axes& axes) {
                axes.push_back({key, {value}});
            },
            false);
        values_->setFocus(Qt::OtherFocusReason);  // others are typed over the one that is there
        values_->selectAll();
        return;
    }
}

void SweepEditor::choose_key(const QString& key) {
    // The old key's values mean nothing here: it begins with what the experiment has.
    change_axes(
        tr("key"),
        [index = chosen_, key = key.toStdString(),
         value = present_value(base_, key.toStdString())](Axes& axes) {
            auto& axis = axis_at(axes, index);
            axis.key = key;
            axis.values.clear();
            if (!value.is_null()) axis.values.push_back(value);
        },
        true);
}

void SweepEditor::show_axis() {
    const bool is_there = chosen_ >= 0 && std::size_t(chosen_) < sweep_.axes.size();
    const QString none = tr("There is no axis yet; add one above.");
    if (key_->isEnabled() && !is_there) {
        set_usable(key_, none);
        set_usable(values_, none);
    }
    const Sweep::Axis axis = is_there ? sweep_.axes[std::size_t(chosen_)] : Sweep::Axis{};
    key_->show_options(key_options(*registry_, base_), q(axis.key));
    values_->show_text(q(axis_text(axis)));
}

void SweepEditor::show_count(const ShownProject& shown) {
    try {
        const auto count = projects::check_sweep(shown.project, sweep_, shown.registry);
        count_->setText(count == 1 ? tr("1 variation") : tr("%1 variations").arg(count));
    } catch (const Error& error) {
        count_->setText(QString::fromUtf8(error.what()));
    }
}

void SweepEditor::show_command(const CommandLine& line) {
    const QString id = q(sweep_.id),
                  out = line.folder + QStringLiteral("/results/") + q(projects::sweep_path(sweep_.id));
    QStringList words = {line.program, QStringLiteral("sweep"),   line.folder, id, QStringLiteral("--out"),
                         out,          QStringLiteral("--resume")};
    for (auto& word : words) word = shell_word(word);
    const bool is_known = !line.folder.isEmpty();
    command_->setText(is_known ? words.join(QLatin1Char(' ')) : QString());
    command_->setCursorPosition(0);
    set_usable(copy_, is_known ? QString() : tr("Save the project first: the command names its folder."));
    const QString outcome =
        tr("A picture of each point, and the list sweep.json, go to the project's folder results/%1, where "
           "the panel finds them.")
            .arg(q(projects::sweep_path(sweep_.id)));
    outcome_->setText(line.is_saved ? outcome
                                    : tr("It reads the project as it was saved: save it first. ") + outcome);
}

void SweepEditor::show_item(const ShownProject& shown, const ItemRef& item) {
    if (item != shown_item_) chosen_ = 0;
    shown_item_ = item;
    id_ = item.id.toStdString();
    registry_ = &shown.registry;
    sweep_ = *projects::find_item(shown.project.sweeps, id_);
    const auto* base = projects::find_item(shown.project.experiments, sweep_.experiment);
    base_ = base ? projects::effective(*base) : projects::Experiment();
    const QString why_not = shown.read_only ? shown.why_read_only : QString();
    set_controls_usable(why_not);
    list_->set_usable(why_not);
    name_->show_text(q(sweep_.name));
    experiment_->show_options(named_options(shown.project.experiments), q(sweep_.experiment));
    std::vector<OrderedList::Line> lines;
    const auto keys = key_options(shown.registry, base_);
    for (const auto& axis : sweep_.axes) {
        const QString text = tr("%1: %2").arg(label_in(keys, q(axis.key)), q(axis_text(axis)));
        lines.push_back({text, text});
    }
    chosen_ = std::clamp(chosen_, 0, std::max(0, int(lines.size()) - 1));
    list_->show_lines(lines, chosen_);
    show_axis();
    show_count(shown);
    show_command(shown.command_line);
}

}  // namespace ir::widgets
