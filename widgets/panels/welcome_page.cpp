#include "widgets/panels/welcome_page.h"
#include "widgets/panels/cards.h"

#include <QDir>
#include <QFileInfo>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QScrollArea>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "widgets/style/icons.h"
#include "widgets/style/theme.h"

namespace ir::widgets {
namespace {

/// Below this width, logical pixels, samples stand under the rest.
constexpr int narrow_width = 760;

QLabel* heading(const QString& text) {
    auto* label = new QLabel(text);
    set_themed_sheet(label, [](const ThemeColours& colours) {
        return QStringLiteral("font-weight: bold; color: %1;").arg(colours.dim.name());
    });
    return label;
}

QLabel* dim_text(const QString& text) {
    auto* label = new QLabel(text);
    label->setWordWrap(true);
    set_themed_sheet(label, [](const ThemeColours& colours) {
        return QStringLiteral("color: %1; padding: 4px 6px;").arg(colours.dim.name());
    });
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

/// "2 s", "1 min"; empty where it is not known.
QString time_text(double seconds) {
    if (seconds <= 0) return {};
    if (seconds < 10) return WelcomePage::tr("%1 s").arg(seconds, 0, 'f', seconds < 3 ? 1 : 0);
    if (seconds < 90) return WelcomePage::tr("%1 s").arg(std::lround(seconds / 5) * 5);
    return WelcomePage::tr("%1 min").arg(std::lround(seconds / 60));
}

QString short_path(const QString& path) {
    const QString home = QDir::homePath();
    const bool below = home.size() > 1 && path.startsWith(home + QLatin1Char('/'));
    return QDir::toNativeSeparators(below ? QLatin1Char('~') + path.mid(home.size()) : path);
}

}  // namespace

WelcomePage::WelcomePage(QWidget* parent) : QWidget(parent) {
    auto* begin = new QWidget;
    auto* left = new QVBoxLayout(begin);
    left->setContentsMargins(20, 16, 8, 16);
    auto* title = new QLabel(tr("Interreflect"));
    make_bold(title, 2.2);
    auto* text =
        new QLabel(tr("Open a scene, run methods of global illumination on it, look inside every "
                      "buffer, and keep the whole as a project."));
    text->setWordWrap(true);
    left->addWidget(title);
    left->addWidget(text);
    left->addWidget(make_start());
    left->addWidget(heading(tr("Recent projects")));
    recent_ = new QVBoxLayout;
    recent_->setSpacing(2);
    left->addLayout(recent_);
    left->addStretch(1);

    auto* shelf = new QWidget;
    auto* right = new QVBoxLayout(shelf);
    right->setContentsMargins(8, 16, 20, 16);
    right->setSpacing(8);
    auto* row = new QHBoxLayout;
    row->addWidget(heading(tr("Samples")));
    search_ = new QLineEdit;
    search_->setObjectName(QStringLiteral("search"));
    search_->setPlaceholderText(tr("Search figures, methods, scenes …"));
    search_->setAccessibleName(tr("Search the samples"));
    search_->setClearButtonEnabled(true);
    search_->setMaximumWidth(320);
    search_->installEventFilter(this);
    row->addStretch(1);
    row->addWidget(search_, 1);
    right->addLayout(row);
    nothing_ = dim_text(tr("No sample has these words."));
    nothing_->hide();
    right->addWidget(nothing_);
    samples_ = new QVBoxLayout;
    samples_->setSpacing(6);
    right->addLayout(samples_);
    right->addStretch(1);
    connect(search_, &QLineEdit::textChanged, this, &WelcomePage::search);

    auto* whole = new QWidget;
    halves_ = new QHBoxLayout(whole);
    halves_->setContentsMargins(0, 0, 0, 0);
    halves_->addWidget(begin, 1);
    halves_->addWidget(shelf, 3);
    auto* scroll = scroll_ = new QScrollArea(this);
    scroll->setWidgetResizable(true);
    scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    scroll->setWidget(whole);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(scroll);
    set_recent(QStringList());
    set_samples(QStringList());
}

void WelcomePage::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    halves_->setDirection(width() < narrow_width ? QBoxLayout::TopToBottom : QBoxLayout::LeftToRight);
}

/// Down from the search into the cards, Enter opens the first of them. Arrows on a card go to another.
bool WelcomePage::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() != QEvent::KeyPress) return false;
    const int key = static_cast<QKeyEvent*>(event)->key();
    if (watched != search_) {
        if (key < Qt::Key_Left || key > Qt::Key_Down) return false;
        move_focus(key);
        return true;
    }
    if (key != Qt::Key_Down && key != Qt::Key_Return && key != Qt::Key_Enter) return false;
    for (const auto& section : sections_)
        for (const auto& [card, words] : section.samples) {
            if (card->isHidden()) continue;
            key == Qt::Key_Down ? card->setFocus() : card->click();
            return true;
        }
    return true;
}

void WelcomePage::keyPressEvent(QKeyEvent* event) {
    if (event->matches(QKeySequence::Find)) return search_->setFocus();
    QWidget::keyPressEvent(event);
}

/// To the nearest card in that direction.
void WelcomePage::move_focus(int key) {
    auto* from = qobject_cast<SampleCard*>(focusWidget());
    if (!from) return;
    const auto middle = [this](const QWidget* card) { return card->mapTo(this, card->rect().center()); };
    const bool sideways = key == Qt::Key_Left || key == Qt::Key_Right;
    const int sign = key == Qt::Key_Left || key == Qt::Key_Up ? -1 : 1;
    SampleCard* best = nullptr;
    int nearest = 0;
    for (const auto& section : sections_)
        for (const auto& [card, words] : section.samples) {
            const QPoint way = middle(card) - middle(from);
            const int ahead = sign * (sideways ? way.x() : way.y());
            const int aside = std::abs(sideways ? way.y() : way.x());
            if (card->isHidden() || ahead < (sideways ? 1 : from->height() / 2)) continue;
            if (sideways && aside > from->height() / 2) continue;
            if (const int far = ahead + 2 * aside; !best || far < nearest) best = card, nearest = far;
        }
    if (!best) return;
    best->setFocus();
    scroll_->ensureWidgetVisible(best);
}

void WelcomePage::search(const QString& text) {
    const QStringList words = text.split(QLatin1Char(' '), Qt::SkipEmptyParts);
    bool any = false;
    for (const auto& section : sections_) {
        bool some = false;
        for (const auto& [card, content] : section.samples) {
            const bool found = std::all_of(words.begin(), words.end(), [&](const QString& word) {
                return content.contains(word, Qt::CaseInsensitive);
            });
            card->setVisible(found);
            some |= found;
        }
        section.heading->setVisible(some);
        section.cards->setVisible(some);
        any |= some;
    }
    nothing_->setVisible(!any && !words.isEmpty());
}

QWidget* WelcomePage::make_start() {
    auto* start = new QWidget;
    auto* page = new QVBoxLayout(start);
    page->setContentsMargins(0, 8, 0, 10);
    auto* row = new QVBoxLayout;
    row->setSpacing(6);
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
    button("new", "new", tr("New project from a scene …"), tr("A .gltf or .glb file"),
           &WelcomePage::new_chosen);
    button("open", "open", tr("Open a project …"), tr("A folder NAME.interreflect"),
           &WelcomePage::open_chosen);
    page->addLayout(row);
    page->addWidget(dim_text(tr("Or drop a project, a .gltf or a .glb file here.")));
    return start;
}

void WelcomePage::set_samples(const std::vector<SampleProject>& samples) {
    sections_.clear();
    empty(samples_);
    QStringList groups;
    for (const auto& sample : samples)
        if (!groups.contains(sample.group)) groups << sample.group;
    for (const auto& group : groups) {
        Section section{heading(group), new QWidget, {}};
        auto* flow = new CardFlow(SampleCard::usual_width, section.cards);
        for (const auto& sample : samples) {
            if (sample.group != group) continue;
            const QString name = name_of(sample.path, sample.name);
            auto* card =
                new SampleCard({name, sample.description, time_text(sample.seconds), sample.thumbnail});
            card->installEventFilter(this);
            card->setToolTip(sample.description.isEmpty() ? sample.path : sample.description);
            connect(card, &SampleCard::clicked, this,
                    [this, path = sample.path] { emit project_chosen(path); });
            flow->addWidget(card);
            section.samples.push_back(
                {card, QStringList{name, sample.description, group, sample.path}.join(QLatin1Char('\n'))});
        }
        section.heading->setVisible(!group.isEmpty());
        samples_->addWidget(section.heading);
        samples_->addWidget(section.cards);
        sections_.push_back(std::move(section));
    }
    if (samples.empty()) samples_->addWidget(dim_text(tr("This installation has no sample projects.")));
    search_->setVisible(!samples.empty());
    if (!search_->text().isEmpty()) search(search_->text());
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
    for (const QString& path : paths) samples.push_back({path, {}, {}, {}, {}, 0});
    set_samples(samples);
}

void WelcomePage::set_recent(const QStringList& paths) {
    std::vector<RecentProject> projects;
    for (const QString& path : paths) projects.push_back({path, {}, {}, {}, !QFileInfo::exists(path)});
    set_recent(projects);
}

}  // namespace ir::widgets
