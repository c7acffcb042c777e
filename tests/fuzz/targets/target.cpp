#include "tests/fuzz/targets/target.h"

#include <unistd.h>

#include <fstream>

namespace ir::fuzz {
namespace {

namespace fs = std::filesystem;

class Folder {
  public:
    Folder() {
        std::string pattern = "/dev/shm/interreflect-fuzz-XXXXXX";
        path = mkdtemp(pattern.data());
    }
    ~Folder() {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }
    fs::path path;
};

}  // namespace

const fs::path& folder() {
    static const Folder all;
    return all.path;
}

std::string write_input(const std::string& name, const std::uint8_t* data, std::size_t size) {
    const auto file = folder() / name;
    fs::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
    return file.string();
}

}  // namespace ir::fuzz
