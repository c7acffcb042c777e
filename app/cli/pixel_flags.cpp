#include "app/cli/pixel_flags.h"

#include <cmath>
#include <sstream>

#include "projects/light_spec.h"
#include "renderers/core/error.h"

namespace ir::cli {

std::vector<std::string> split_at_commas(const std::string& text) {
    std::vector<std::string> words;
    std::stringstream stream(text);
    for (std::string word; std::getline(stream, word, ',');) words.push_back(word);
    return words;
}

std::vector<double> numbers_of(const std::string& text, std::size_t count, const std::string& option,
                               const std::string& form) {
    const auto words = split_at_commas(text);
    if (words.size() != count) throw UsageError(option + " '" + text + "' is not of the form " + form);
    std::vector<double> result;
    for (const auto& word : words) result.push_back(projects::parse_number(word, option));
    return result;
}

std::vector<int> pixels_of(const std::string& text, std::size_t count, const std::string& option,
                           const std::string& form) {
    std::vector<int> result;
    for (const double value : numbers_of(text, count, option, form)) {
        if (value != std::floor(value) || std::abs(value) > 1e6)
            throw UsageError(option + " '" + text + "' must hold whole numbers of pixels");
        result.push_back(int(value));
    }
    return result;
}

}  // namespace ir::cli
