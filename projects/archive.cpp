#include "projects/archive.h"

#include <archive.h>
#include <archive_entry.h>

#include <fstream>
#include <limits>
#include <new>
#include <vector>

#include "projects/text.h"
#include "renderers/core/error.h"
#include "renderers/core/limits.h"

namespace ir::projects {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t block_size = 1u << 20;  // bytes that are read or written at once
constexpr int max_files = 1'000'000;

/// What failed in the archive itself.
void require(archive* archive, int status) {
    if (status != ARCHIVE_OK) throw Error("cannot be packed: " + std::string(archive_error_string(archive)));
}

la_ssize_t write_to_stream(archive*, void* out, const void* data, size_t size) {
    static_cast<std::ostream*>(out)->write(static_cast<const char*>(data),
                                           static_cast<std::streamsize>(size));
    return static_cast<la_ssize_t>(size);
}

std::string name_of(archive_entry* entry) {
    const char* name = archive_entry_pathname(entry);
    if (!name) name = archive_entry_pathname_utf8(entry);
    return name ? name : "";
}

bool stays_inside(const std::string& name) {
    const auto normal = fs::path(name).lexically_normal();
    return !name.empty() && normal.is_relative() && normal != "." && *normal.begin() != "..";
}

bool is_plain_file(archive_entry* entry) {
    return archive_entry_filetype(entry) == AE_IFREG && !archive_entry_hardlink(entry);
}

}  // namespace

ArchiveWriter::ArchiveWriter(std::ostream& out, const CancelToken* cancel)
    : out_(out), cancel_(cancel), archive_(archive_write_new(), archive_write_free) {
    if (!archive_) throw std::bad_alloc();
    // The names' bytes stay as they are, whatever their length and the language of the system.
    require(archive_.get(), archive_write_set_format_gnutar(archive_.get()));
    require(archive_.get(), archive_write_open(archive_.get(), &out_, nullptr, write_to_stream, nullptr));
}

void ArchiveWriter::header(const std::string& name, std::uint64_t size) {
    const std::unique_ptr<archive_entry, void (*)(archive_entry*)> entry(archive_entry_new(),
                                                                         archive_entry_free);
    archive_entry_set_pathname(entry.get(), name.c_str());
    archive_entry_set_filetype(entry.get(), AE_IFREG);
    archive_entry_set_perm(entry.get(), 0644);
    archive_entry_set_size(entry.get(), static_cast<la_int64_t>(size));
    require(archive_.get(), archive_write_header(archive_.get(), entry.get()));
}

void ArchiveWriter::put(const char* data, std::size_t size) {
    if (archive_write_data(archive_.get(), data, size) < 0) require(archive_.get(), ARCHIVE_FATAL);
}

void ArchiveWriter::add_text(const std::string& name, const std::string& text) {
    header(name, text.size());
    put(text.data(), text.size());
}

void ArchiveWriter::add_file(const std::string& name, const fs::path& source) {
    std::error_code error;
    const auto size = fs::file_size(source, error);
    std::ifstream content(source, std::ios::binary);
    if (error || !content) throw Error(source.string() + ": cannot be read; check its permissions");
    header(name, size);
    std::vector<char> buffer(block_size);
    std::uint64_t read = 0;
    while (out_ && (content.read(buffer.data(), static_cast<std::streamsize>(buffer.size())) ||
                    content.gcount() > 0)) {
        if (cancel_) cancel_->check();
        put(buffer.data(), static_cast<std::size_t>(content.gcount()));
        read += static_cast<std::uint64_t>(content.gcount());
    }
    if (out_ && read != size) throw Error(source.string() + ": changed while it was packed; try again");
}

void ArchiveWriter::finish() {
    require(archive_.get(), archive_write_close(archive_.get()));
}

void read_archive(const fs::path& file,
                  const std::function<bool(const std::string&, const CopyContent&)>& read,
                  const CancelToken* cancel) {
    if (!std::ifstream(file))
        throw InputError(file.string(), "", "cannot be opened; check name and permissions");
    const std::unique_ptr<archive, int (*)(archive*)> opened(archive_read_new(), archive_read_free);
    if (!opened) throw std::bad_alloc();
    auto* const archive = opened.get();
    const auto refuse_if = [&](bool is_damaged) {
        if (is_damaged)
            throw InputError(file.string(), "byte " + std::to_string(archive_filter_bytes(archive, -1)),
                             "damaged or no packed project (" +
                                 printable(archive_error_string(archive), 200) + "); ask for another copy");
    };
    archive_read_support_format_tar(archive);
    archive_read_support_filter_gzip(archive);
    archive_read_support_filter_xz(archive);
    archive_read_support_filter_zstd(archive);
    refuse_if(archive_read_open_filename(archive, file.c_str(), block_size) != ARCHIVE_OK);
    std::vector<char> buffer(block_size);
    std::error_code error;
    const auto length = fs::file_size(file, error);  // none of a pipe
    auto left = error ? std::numeric_limits<std::uint64_t>::max() : max_expanded(length);
    const auto require_left = [&](la_int64_t bytes) {
        if (bytes > 0 && static_cast<std::uint64_t>(bytes) > left)
            throw InputError(file.string(), "", "unpacks to far more than it has bytes; it is no project");
    };
    const CopyContent copy = [&](std::ostream& out) {
        la_ssize_t count = 0;
        while (out && (count = archive_read_data(archive, buffer.data(), buffer.size())) > 0) {
            if (cancel) cancel->check();
            require_left(count);
            left -= static_cast<std::uint64_t>(count);
            out.write(buffer.data(), count);
        }
        refuse_if(count < 0);
    };
    archive_entry* entry = nullptr;
    for (int number = 0;; ++number) {
        const int status = archive_read_next_header(archive, &entry);
        if (status == ARCHIVE_EOF) return;
        refuse_if(status < ARCHIVE_WARN);
        if (number == max_files)
            throw InputError(file.string(), "", "holds more than a million files; it is no project");
        const auto name = name_of(entry);
        if (archive_entry_filetype(entry) == AE_IFDIR) continue;  // files make their folders
        if (!is_plain_file(entry) || !stays_inside(name))
            throw InputError(file.string(), printable(name),
                             "is no plain file inside the archive; a packed project holds nothing else");
        require_left(archive_entry_size(entry));
        if (!read(name, copy)) return;
    }
}

}  // namespace ir::projects
