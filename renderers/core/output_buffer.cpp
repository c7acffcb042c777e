#include "renderers/core/output_buffer.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "renderers/core/error.h"

namespace ir {
namespace {

std::string mend_for(int error) {
    if (error == ENOSPC || error == EDQUOT || error == EFBIG) return "; free some space and try again";
    if (error == EACCES || error == EPERM || error == EROFS) return "; choose a place that you may write to";
    if (error == ENOENT || error == ENOTDIR) return "; choose a folder that exists and is writable";
    if (error == EIO) return "; check the disk";
    return "";
}

}  // namespace

void fail(const std::filesystem::path& file, const char* action, int error) {
    throw Error(file.string() + ": cannot " + action + ": " + std::strerror(error) + mend_for(error));
}

int write_all(int descriptor, std::string_view bytes) {
    while (!bytes.empty()) {
        const auto count = ::write(descriptor, bytes.data(), bytes.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return errno;
        if (count == 0) return EIO;
        bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return 0;
}

OutputBuffer::OutputBuffer(int descriptor) : descriptor_(descriptor) {
    setp(waiting_.data(), waiting_.data() + waiting_.size());
}

OutputBuffer::~OutputBuffer() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

void OutputBuffer::close(bool is_synced) {
    sync();
    if (is_synced && error_ == 0 && ::fsync(descriptor_) != 0) error_ = errno;
    // Interrupted, it is closed all the same.
    if (::close(std::exchange(descriptor_, -1)) != 0 && errno != EINTR && error_ == 0) error_ = errno;
}

void OutputBuffer::write(std::string_view bytes) {
    if (error_ == 0) error_ = write_all(descriptor_, bytes);
    place_ += bytes.size();
    length_ = std::max(length_, place_);
}

int OutputBuffer::sync() {
    write({pbase(), static_cast<std::size_t>(pptr() - pbase())});
    setp(waiting_.data(), waiting_.data() + waiting_.size());
    return error_ == 0 ? 0 : -1;
}

OutputBuffer::int_type OutputBuffer::overflow(int_type character) {
    if (sync() != 0) return traits_type::eof();
    return traits_type::eq_int_type(character, traits_type::eof())
               ? traits_type::not_eof(character)
               : sputc(traits_type::to_char_type(character));
}

std::streamsize OutputBuffer::xsputn(const char* bytes, std::streamsize count) {
    if (count > epptr() - pptr()) sync();
    if (count <= epptr() - pptr()) {
        std::memcpy(pptr(), bytes, static_cast<std::size_t>(count));
        pbump(static_cast<int>(count));
    } else {
        write({bytes, static_cast<std::size_t>(count)});
    }
    return error_ == 0 ? count : 0;
}

OutputBuffer::pos_type OutputBuffer::seekoff(off_type offset, std::ios_base::seekdir from,
                                             std::ios_base::openmode) {
    if (from == std::ios_base::cur && offset == 0) return static_cast<off_type>(place_) + (pptr() - pbase());
    if (sync() != 0) return off_type(-1);
    const auto base = from == std::ios_base::beg ? 0 : from == std::ios_base::cur ? place_ : length_;
    const auto place = ::lseek(descriptor_, static_cast<off_t>(base) + static_cast<off_t>(offset), SEEK_SET);
    if (place < 0) return off_type(-1);
    place_ = static_cast<std::uint64_t>(place);
    return place;
}

OutputBuffer::pos_type OutputBuffer::seekpos(pos_type place, std::ios_base::openmode which) {
    return seekoff(off_type(place), std::ios_base::beg, which);
}

}  // namespace ir
