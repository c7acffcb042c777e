#include "projects/tar.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <optional>
#include <vector>

#include "projects/text.h"
#include "renderers/core/error.h"

namespace ir::projects {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t block_size = 512;
constexpr std::uint64_t largest_file = 077777777777;  // eleven octal digits

/// [POSIX.1-2017 pax, "ustar Interchange Format"]
struct Header {
    char name[100], mode[8], uid[8], gid[8], size[12], mtime[12], checksum[8], type, link[100], magic[6],
        version[2], user[32], group[32], major[8], minor[8], prefix[155], unused[12];
};
static_assert(sizeof(Header) == block_size);

void put_octal(char* field, std::size_t digits, std::uint64_t value) {
    for (std::size_t i = digits; i-- > 0; value /= 8) field[i] = static_cast<char>('0' + value % 8);
}

/// The sum of all bytes with the checksum's own field taken as blanks.
unsigned checksum_of(Header header) {
    std::fill_n(header.checksum, sizeof header.checksum, ' ');
    unsigned sum = 0;
    for (std::size_t i = 0; i < block_size; ++i) sum += reinterpret_cast<const unsigned char*>(&header)[i];
    return sum;
}

std::optional<std::uint64_t> octal(const char* field, std::size_t length) {
    std::uint64_t value = 0;
    std::size_t i = 0;
    while (i < length && field[i] == ' ') ++i;
    for (; i < length && field[i] != '\0' && field[i] != ' '; ++i) {
        if (field[i] < '0' || field[i] > '7') return std::nullopt;
        value = value * 8 + static_cast<std::uint64_t>(field[i] - '0');
    }
    return value;
}

std::string text_of(const char* field, std::size_t length) {
    return {field, std::find(field, field + length, '\0')};
}

/// Long names are divided at a slash into prefix and name.
bool put_name(Header& header, const std::string& name) {
    if (name.size() <= sizeof header.name) {
        std::memcpy(header.name, name.data(), name.size());
        return true;
    }
    const auto slash = name.find('/', name.size() - sizeof header.name - 1);
    if (slash == std::string::npos || slash > sizeof header.prefix) return false;
    std::memcpy(header.prefix, name.data(), slash);
    std::memcpy(header.name, name.data() + slash + 1, name.size() - slash - 1);
    return true;
}

bool stays_inside(const std::string& name) {
    const auto normal = fs::path(name).lexically_normal();
    return !name.empty() && normal.is_relative() && normal != "." && *normal.begin() != "..";
}

}  // namespace

void TarWriter::header(const std::string& name, std::uint64_t size) {
    Header header{};
    if (!put_name(header, name)) throw Error(printable(name, 300) + ": this name is too long to be packed");
    if (size > largest_file)
        throw Error(printable(name, 300) + ": is larger than 8 GiB and cannot be packed");
    put_octal(header.mode, 7, 0644);
    put_octal(header.uid, 7, 0);
    put_octal(header.gid, 7, 0);
    put_octal(header.size, 11, size);
    put_octal(header.mtime, 11, 0);
    header.type = '0';
    std::memcpy(header.magic, "ustar", 6);
    std::memcpy(header.version, "00", 2);
    put_octal(header.checksum, 6, checksum_of(header));
    header.checksum[7] = ' ';
    out_.write(reinterpret_cast<const char*>(&header), sizeof header);
}

void TarWriter::pad(std::uint64_t size) {
    static constexpr std::array<char, block_size> zeros{};
    const auto rest = size % block_size;
    if (rest != 0) out_.write(zeros.data(), static_cast<std::streamsize>(block_size - rest));
}

void TarWriter::add_text(const std::string& name, const std::string& text) {
    header(name, text.size());
    out_.write(text.data(), static_cast<std::streamsize>(text.size()));
    pad(text.size());
}

void TarWriter::add_file(const std::string& name, const fs::path& source) {
    std::error_code error;
    const auto size = fs::file_size(source, error);
    std::ifstream content(source, std::ios::binary);
    if (error || !content) throw Error(source.string() + ": cannot be read; check its permissions");
    header(name, size);
    std::vector<char> buffer(1u << 20);
    std::uint64_t written = 0;
    while (out_ && (content.read(buffer.data(), static_cast<std::streamsize>(buffer.size())) ||
                    content.gcount() > 0)) {
        if (cancel_) cancel_->check();
        out_.write(buffer.data(), content.gcount());
        written += static_cast<std::uint64_t>(content.gcount());
    }
    if (out_ && written != size) throw Error(source.string() + ": changed while it was packed; try again");
    pad(size);
}

void TarWriter::finish() {
    static constexpr std::array<char, 2 * block_size> end{};
    out_.write(end.data(), end.size());
}

void read_tar(const fs::path& file,
              const std::function<void(const std::string&, std::istream&, std::uint64_t)>& read) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw InputError(file.string(), "", "cannot be opened; check name and permissions");
    std::error_code ignored;
    const std::uint64_t total = fs::file_size(file, ignored);
    Header header{};
    while (stream.read(reinterpret_cast<char*>(&header), sizeof header)) {
        if (header.name[0] == '\0') return;  // the end is marked by blocks of zeros
        const auto size = octal(header.size, sizeof header.size);
        const auto start = static_cast<std::uint64_t>(stream.tellg());
        const auto prefix = text_of(header.prefix, sizeof header.prefix);
        const auto own = text_of(header.name, sizeof header.name);
        const auto name = prefix.empty() ? own : prefix + "/" + own;
        if (octal(header.checksum, sizeof header.checksum) != checksum_of(header) || !size ||
            *size > total - start)
            throw InputError(file.string(), "byte " + std::to_string(start - block_size),
                             "damaged or no packed project; ask for another copy");
        if (header.type != '0' || !stays_inside(name))
            throw InputError(file.string(), printable(name),
                             "is no plain file inside the archive; a packed project holds nothing else");
        read(name, stream, *size);
        stream.clear();
        stream.seekg(static_cast<std::streamoff>(start + (*size + block_size - 1) / block_size * block_size));
    }
    throw InputError(file.string(), "", "ends early or is no packed project; ask for another copy");
}

}  // namespace ir::projects
