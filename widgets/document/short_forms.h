#pragma once

#include <QString>
#include <QStringList>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace ir::widgets {

inline QString q(const std::string& text) {
    return QString::fromStdString(text);
}

inline std::vector<double> numbers(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

/// Labels of a vector's components.
inline const QStringList xyz{QStringLiteral("x"), QStringLiteral("y"), QStringLiteral("z")};

}  // namespace ir::widgets
