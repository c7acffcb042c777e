#pragma once

#include <string>

#include "renderers/core/method.h"

/// What is tried with damaged and hostile texts, by tests with mutations of their own and by libFuzzer. Each
/// says whether the text was opened; it may refuse it in one line. Throws std::logic_error where something
/// does not hold that must hold for any text.
namespace ir::fuzz {

/// Of one method, "fog".
const Registry& registry();

/// All that a window or command does first with project.json.
bool opens_project(const std::string& text);
/// project.json.autosave; what is damaged is not offered.
bool offers_autosave(const std::string& text);
/// results/index.json
bool reads_results(const std::string& text);
/// session.json; what is damaged counts as empty.
bool reads_session(const std::string& text);
/// What --light takes.
bool reads_light(const std::string& text);
/// A text, another one and a diff, with zeros between them: both are compared, and the diff changes the
/// first.
bool changes_shaders(const std::string& texts);

}  // namespace ir::fuzz
