#include "app/engine/version.h"

#include <fstream>

namespace ir::engine {

std::string version() {
    return INTERREFLECT_VERSION;
}

std::string version_and_commit() {
    return version() + ", commit " + commit();
}

std::string build() {
    return INTERREFLECT_BUILD;
}

std::string shell_word(const std::string& word) {
    constexpr const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=.,:/@%";
    if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
    std::string text = "'";
    for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
}

std::string command_line() {
    std::ifstream words("/proc/self/cmdline", std::ios::binary);
    std::string line;
    for (std::string word; std::getline(words, word, '\0');)
        line += (line.empty() ? "" : " ") + shell_word(word);
    return line;
}

}  // namespace ir::engine
