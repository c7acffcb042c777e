#pragma once

#include <QString>

namespace ir::widgets {

/// An entry of a list to choose from.
struct Option {
    QString id, label, tooltip;
    bool operator==(const Option&) const = default;
};

}  // namespace ir::widgets
