#include "widgets/document/item_ref.h"

#include <QCoreApplication>
#include <QStringList>
#include <array>

namespace ir::widgets {
namespace {

struct Word {
    ItemKind kind;
    const char* key;
    const char* word;
};

constexpr std::array words{
    Word{ItemKind::project, "project", QT_TRANSLATE_NOOP("Items", "project")},
    Word{ItemKind::scene, "scene", QT_TRANSLATE_NOOP("Items", "scene")},
    Word{ItemKind::part, "part", QT_TRANSLATE_NOOP("Items", "part of a scene")},
    Word{ItemKind::camera, "camera", QT_TRANSLATE_NOOP("Items", "camera")},
    Word{ItemKind::light_set, "lights", QT_TRANSLATE_NOOP("Items", "set of lights")},
    Word{ItemKind::light, "light", QT_TRANSLATE_NOOP("Items", "light")},
    Word{ItemKind::motion, "motion", QT_TRANSLATE_NOOP("Items", "motion")},
    Word{ItemKind::experiment, "experiment", QT_TRANSLATE_NOOP("Items", "experiment")},
    Word{ItemKind::comparison, "comparison", QT_TRANSLATE_NOOP("Items", "comparison")},
    Word{ItemKind::image, "image", QT_TRANSLATE_NOOP("Items", "foreign image")},
    Word{ItemKind::sweep, "sweep", QT_TRANSLATE_NOOP("Items", "sweep")},
    Word{ItemKind::plot, "plot", QT_TRANSLATE_NOOP("Items", "plot")},
    Word{ItemKind::analysis, "analysis", QT_TRANSLATE_NOOP("Items", "analysis")},
};

const Word* word_of(ItemKind kind) {
    for (const auto& word : words)
        if (word.kind == kind) return &word;
    return nullptr;
}

}  // namespace

QString ItemRef::key() const {
    const Word* word = word_of(kind);
    if (!word) return {};
    QString text = QLatin1String(word->key);
    if (!id.isEmpty()) text += QLatin1Char(':') + id;
    if (index >= 0) text += QLatin1Char(':') + QString::number(index);
    return text;
}

ItemRef ItemRef::from_key(const QString& key) {
    const QStringList steps = key.split(QLatin1Char(':'));
    for (const auto& word : words) {
        if (steps.front() != QLatin1String(word.key)) continue;
        return {word.kind, steps.value(1), steps.size() > 2 ? steps[2].toInt() : -1};
    }
    return {};
}

ItemRef ItemRef::owner() const {
    if (kind == ItemKind::part) return {ItemKind::scene, id};
    if (kind == ItemKind::light) return {ItemKind::light_set, id};
    return *this;
}

QString kind_word(ItemKind kind) {
    const Word* word = word_of(kind);
    return word ? QCoreApplication::translate("Items", word->word) : QString();
}

}  // namespace ir::widgets
