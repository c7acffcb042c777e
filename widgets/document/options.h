#pragma once

#include <QObject>
#include <algorithm>
#include <vector>

#include "projects/document.h"
#include "widgets/parameters/option.h"

namespace ir::widgets {

/// The items of a list of the project, to choose from.
template <class List>
std::vector<Option> named_options(const List& list) {
    std::vector<Option> options;
    for (const auto& item : list)
        options.push_back({QString::fromStdString(item.id), QString::fromStdString(item.name),
                           QString::fromStdString(item.id)});
    return options;
}

/// What a metric can take: experiments, then images from files.
inline std::vector<Option> picture_options(const projects::Project& project) {
    auto options = named_options(project.experiments);
    for (const auto& image : project.images)
        options.push_back({QString::fromStdString(image.id),
                           QObject::tr("%1 (image)").arg(QString::fromStdString(image.name)),
                           QString::fromStdString(image.source)});
    return options;
}

inline std::vector<Option> with_first(const Option& first, std::vector<Option> others) {
    others.insert(others.begin(), first);
    return others;
}

/// Label of an option, or the id where there is none.
inline QString label_in(const std::vector<Option>& options, const QString& id) {
    const auto found =
        std::find_if(options.begin(), options.end(), [&](const Option& each) { return each.id == id; });
    return found == options.end() ? id : found->label;
}

}  // namespace ir::widgets
