#include "tests/fuzz/targets/target.h"
#include "tests/fuzz/understands.h"

/// A word on each line.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::vector<std::string> words(1);
    for (const char c : ir::fuzz::text_of(data, size))
        if (c == '\n')
            words.emplace_back();
        else
            words.back() += c;
    ir::fuzz::understands(words);
    return 0;
}
