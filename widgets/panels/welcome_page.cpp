#include "widgets/panels/welcome_page.h"

#include <QDir>
#include <QFileInfo>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QToolButton>
#include <QVBoxLayout>

#include "widgets/panels/project_card.h"
#include "widgets/style/icons.h"

namespace ir::widgets {
namespace {

QLabel* heading(const QString& text) {
    auto* label = new QLabel(text);
    label->setStyleSheet(QStringLiteral("font-weight: bold; color: #b8b8b8;"));
    return label;
}

QLabel* dim_text(const QString& text) {
    auto* label = new QLabel(text);
    label->setWordWrap(true);
    label->setStyleSheet(QStringLiteral("color: #8a8a8a; padding: 4px 6px;"));
    return label;
}

void empty(QVBoxLayout* list) {
    while (QLayoutItem* item = list->takeAt(0)) {
        if (item->widget()) item->widget()->hide();
        if (item->widget()) item->widget()->deleteLater();  // its own click may be what empties the list
        delete item;
    }
}

QString name_of(const QString& path, const QString& name) {
    return name.isEmpty() ? QFileInfo(path).completeBaseName() : name;
}

/// "today 14:02", "yesterday 09:30", "2026-03-01".
QString when_text(const QDateTime& when) {
    if (!when.isValid()) return {};
    const qint64 days = when.date().daysTo(QDate::currentDate());
    const QString time = when.toString(QStringLiteral("HH:mm"));
    if (days == 0) return WelcomePage::tr("today %1").arg(time);
    if (days == 1) return WelcomePage::tr("yesterday %1").arg(time);
    return when.date().toString(Qt::ISODate);
}

QString short_path(const QString& path) {
    const QString home = QDir::homePath();
    const bool below = home.size() > 1 && path.startsWith(home + QLatin1Char('/'));
    return QDir::toNativeSeparators(below ? QLatin1Char('~') + path.mid(home.size()) : path);
}

}  // namespace

WelcomePage::WelcomePage(QWidget* parent) : QWidget(parent) {
    auto* content = new QWidget;
    content->setMaximumWidth(880);
    content->setMinimumWidth(300);
    auto* grid = new QGridLayout(content);
    grid->setContentsMargins(20, 20, 20, 20);
    grid->setHorizontalSpacing(36);
    grid->setVerticalSpacing(8);
    grid->setColumnStretch(0, 1);
    grid->setColumnStretch(1, 1);
    auto* title = new QLabel(tr("Interreflect"));
    title->setStyleSheet(QStringLiteral("font-size: 26px; font-weight: bold;"));
    auto* text =
        new QLabel(tr("Open a scene, run methods of global illumination on it, look inside every "
                      "buffer, and keep the whole as a project."));
    text->setWordWrap(true);
    grid->addWidget(title, 0, 0, 1, 2);
    grid->addWidget(text, 1, 0, 1, 2);
    grid->addWidget(make_start(), 2, 0, 1, 2);
    const auto list = [&](const QString& name, int column) {
        grid->addWidget(heading(name), 3, column);
        auto* result = new QVBoxLayout;
        result->setSpacing(2);
        grid->addLayout(result, 4, column, Qt::AlignTop);
        return result;
    };
    recent_ = list(tr("Recent projects"), 0);
    samples_ = list(tr("Sample projects"), 1);

    auto* scroll = new QScrollArea(this);
    scroll->setWidgetResizable(true);
    auto* centred = new QWidget;
    auto* rows = new QVBoxLayout(centred);
    auto* columns = new QHBoxLayout;
    columns->addStretch(1);
    columns->addWidget(content, 1000);
    columns->addStretch(1);
    rows->addStretch(1);
    rows->addLayout(columns);
    rows->addStretch(2);
    scroll->setWidget(centred);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(scroll);
    set_recent(QStringList());
    set_samples(QStringList());
}

QWidget* WelcomePage::make_start() {
    auto* start = new QWidget;
    auto* page = new QVBoxLayout(start);
    page->setContentsMargins(0, 8, 0, 10);
    auto* row = new QHBoxLayout;
    row->setSpacing(8);
    const auto button = [&](const char* name, const char* icon_name, const QString& text, const QString& tip,
                            void (WelcomePage::*chosen)()) {
        auto* result = new QPushButton(icon(icon_name), text);
        result->setObjectName(QLatin1String(name));
        result->setToolTip(tip);
        result->setMinimumHeight(34);
        result->setAutoDefault(true);  // Enter presses it
        connect(result, &QPushButton::clicked, this, chosen);
        row->addWidget(result);
    };
    button("new", "new", tr("New project …"), tr("From a built-in scene or a file"),
           &WelcomePage::new_chosen);
    button("open", "open", tr("Open a project …"), tr("A folder NAME.interreflect, or a packed one"),
           &WelcomePage::open_chosen);
    button("scene", "add", tr("Open a scene …"), tr("A .gltf or .glb file, in a new project"),
           &WelcomePage::scene_chosen);
    row->addStretch(1);
    page->addLayout(row);
    page->addWidget(dim_text(tr("Or drop a project, a .gltf or a .glb file here.")));
    return start;
}

void WelcomePage::set_samples(const std::vector<SampleProject>& samples) {
    empty(samples_);
    for (const auto& sample : samples) {
        auto* card =
            new ProjectCard({name_of(sample.path, sample.name), sample.description, {}, sample.thumbnail});
        card->setToolTip(sample.description.isEmpty() ? sample.path
                                                      : sample.description + QLatin1Char('\n') + sample.path);
        connect(card, &ProjectCard::clicked, this, [this, path = sample.path] { emit project_chosen(path); });
        samples_->addWidget(card);
    }
    if (samples.empty()) samples_->addWidget(dim_text(tr("This installation has no sample projects.")));
}

void WelcomePage::set_recent(const std::vector<RecentProject>& projects) {
    empty(recent_);
    for (const auto& project : projects) {
        const QString note = project.missing ? tr("Not there any longer") : when_text(project.when);
        auto* row = new QWidget;
        auto* line = new QHBoxLayout(row);
        line->setContentsMargins(0, 0, 0, 0);
        line->setSpacing(2);
        auto* card = new ProjectCard(
            {name_of(project.path, project.name), note, short_path(project.path), project.thumbnail});
        card->setToolTip(project.path);
        card->setEnabled(!project.missing);
        connect(card, &ProjectCard::clicked, this,
                [this, path = project.path] { emit project_chosen(path); });
        line->addWidget(card, 1);
        auto* remove = new QToolButton;
        remove->setObjectName(QStringLiteral("remove"));
        remove->setIcon(icon("cancel"));
        remove->setIconSize({12, 12});
        remove->setAutoRaise(true);
        remove->setFocusPolicy(Qt::StrongFocus);
        remove->setToolTip(tr("Take it off this list; the project itself stays"));
        remove->setAccessibleName(tr("Remove %1 from the list").arg(name_of(project.path, project.name)));
        connect(remove, &QToolButton::clicked, this,
                [this, path = project.path] { emit recent_removed(path); });
        line->addWidget(remove);
        recent_->addWidget(row);
    }
    if (projects.empty()) recent_->addWidget(dim_text(tr("Projects that you open appear here.")));
}

void WelcomePage::set_samples(const QStringList& paths) {
    std::vector<SampleProject> samples;
    for (const QString& path : paths) samples.push_back({path, {}, {}, {}});
    set_samples(samples);
}

void WelcomePage::set_recent(const QStringList& paths) {
    std::vector<RecentProject> projects;
    for (const QString& path : paths) projects.push_back({path, {}, {}, {}, !QFileInfo::exists(path)});
    set_recent(projects);
}

}  // namespace ir::widgets
