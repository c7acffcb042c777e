#include "projects/archive.h"

#include <archive.h>
#include <archive_entry.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <memory>
#include <new>

#include "projects/text.h"
#include "renderers/core/error.h"
#include "renderers/core/file_system.h"
#include "renderers/core/limits.h"

namespace ir::projects {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t block_size = 1u << 16;  // bytes at once; more slows small files down

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

/// The file of an archive, and how much may come out of it: as bytes of the archive, headers included, and as
/// bytes of the files in it, which may have holes.
class UnpackedFile {
  public:
    UnpackedFile(fs::path file, const CancelToken* cancel)
        : file_(std::move(file)),
          cancel_(cancel),
          stream_(file_, std::ios::binary),
          most_(max_expanded(fs::file_size(file_))) {
        if (!stream_) throw InputError(file_.string(), "", "cannot be opened; check name and permissions");
    }

    /// A few bytes at once: a header without end is noticed between two calls. They may become 32768 times as
    /// many.
    static la_ssize_t read(archive* archive, void* self, const void** data) {
        auto& file = *static_cast<UnpackedFile*>(self);
        const bool is_cancelled = file.cancel_ && file.cancel_->is_cancelled();
        if (is_cancelled || file.has_too_much(archive)) return ARCHIVE_FATAL;  // see check()
        *data = file.block_.data();
        file.stream_.read(file.block_.data(), std::streamsize(file.block_.size()));
        if (!file.stream_.bad()) return static_cast<la_ssize_t>(file.stream_.gcount());
        archive_set_error(archive, EIO, "the disk does not give it");
        return ARCHIVE_FATAL;
    }

    /// Throws Cancelled, and InputError where the archive itself has become too long.
    void check(archive* archive) const {
        if (cancel_) cancel_->check();
        if (has_too_much(archive)) refuse();
    }
    void require_room(la_int64_t bytes) const {
        if (bytes > 0 && static_cast<std::uint64_t>(bytes) > most_ - taken_) refuse();
    }
    /// Of a file in it.
    void take(archive* archive, la_ssize_t bytes) {
        check(archive);
        require_room(bytes);
        taken_ += static_cast<std::uint64_t>(bytes);
    }

  private:
    bool has_too_much(archive* archive) const {
        const auto bytes = archive_filter_bytes(archive, 0);
        return bytes > 0 && static_cast<std::uint64_t>(bytes) > most_;
    }
    [[noreturn]] void refuse() const {
        throw InputError(file_.string(), "", "unpacks to far more than it has bytes; it is no project");
    }

    const fs::path file_;
    const CancelToken* const cancel_;
    std::ifstream stream_;
    const std::uint64_t most_;
    std::uint64_t taken_ = 0;
    std::array<char, 1u << 14> block_;
};

}  // namespace

ArchiveWriter::ArchiveWriter(std::ostream& out, const CancelToken* cancel)
    : out_(out), cancel_(cancel), archive_(archive_write_new(), archive_write_free) {
    if (!archive_) throw std::bad_alloc();
    // The names' bytes stay as they are, whatever their length and the language of the system.
    require(archive_.get(), archive_write_set_format_gnutar(archive_.get()));
    require(archive_.get(), archive_write_open(archive_.get(), &out_, nullptr, write_to_stream, nullptr));
}

void ArchiveWriter::header(const std::string& name, std::uint64_t size) {
    if (++files_ > max_packed_files)
        throw Error("cannot be packed: a packed project holds at most " + std::to_string(max_packed_files) +
                    " files; remove old results by project --prune");
    if (std::ranges::count(name, '/') > max_packed_depth + 1)  // the first ends the project's own
        throw Error(printable(name) + ": cannot be packed: a packed project is at most " +
                    std::to_string(max_packed_depth) + " folders deep; move the file");
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
    const auto buffer = std::make_unique_for_overwrite<char[]>(block_size);
    std::uint64_t read = 0;
    while (out_ && (content.read(buffer.get(), std::streamsize{block_size}) || content.gcount() > 0)) {
        if (cancel_) cancel_->check();
        put(buffer.get(), static_cast<std::size_t>(content.gcount()));
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
    require_regular_file(file);
    UnpackedFile unpacked(file, cancel);
    const std::unique_ptr<archive, int (*)(archive*)> opened(archive_read_new(), archive_read_free);
    if (!opened) throw std::bad_alloc();
    auto* const archive = opened.get();
    const auto refuse_if = [&](bool is_damaged) {
        unpacked.check(archive);
        if (is_damaged)
            throw InputError(file.string(), "byte " + std::to_string(archive_filter_bytes(archive, -1)),
                             "damaged or no packed project (" +
                                 printable(archive_error_string(archive), 200) + "); ask for another copy");
    };
    archive_read_support_format_tar(archive);
    archive_read_support_filter_gzip(archive);
    archive_read_support_filter_xz(archive);
    archive_read_support_filter_zstd(archive);
    refuse_if(archive_read_open(archive, &unpacked, nullptr, UnpackedFile::read, nullptr) != ARCHIVE_OK);
    if (archive_filter_count(archive) > 2)  // the file itself counts
        throw InputError(file.string(), "", "is compressed more than once; it is no project");
    const auto buffer = std::make_unique_for_overwrite<char[]>(block_size);
    const CopyContent copy = [&](std::ostream& out) {
        la_ssize_t count = 0;
        while (out && (count = archive_read_data(archive, buffer.get(), block_size)) > 0) {
            unpacked.take(archive, count);
            out.write(buffer.get(), count);
        }
        refuse_if(count < 0);
    };
    archive_entry* entry = nullptr;
    for (int number = 0;; ++number) {
        const int status = archive_read_next_header(archive, &entry);
        if (status == ARCHIVE_EOF) return;
        refuse_if(status < ARCHIVE_WARN);
        if (number == max_packed_files)
            throw InputError(
                file.string(), "",
                "holds more than " + std::to_string(max_packed_files) + " files; it is no project");
        const auto name = name_of(entry);
        if (archive_entry_filetype(entry) == AE_IFDIR) continue;  // files make their folders
        if (!is_plain_file(entry) || !stays_inside(name))
            throw InputError(file.string(), printable(name),
                             "is no plain file inside the archive; a packed project holds nothing else");
        unpacked.require_room(archive_entry_size(entry));
        if (!read(name, copy)) return;
    }
}

}  // namespace ir::projects
