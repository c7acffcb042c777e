#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <streambuf>
#include <string_view>

namespace ir {

/// Throws Error: "FILE: cannot ACTION: why; the mend". `error` is an errno.
[[noreturn]] void fail(const std::filesystem::path& file, const char* action, int error);

/// 0, or the errno for which not all was written.
int write_all(int descriptor, std::string_view bytes);

/// What a stream writes goes into a new file. The first failure is remembered, whoever asks for it and
/// whatever libraries do about it; nothing is written after it.
class OutputBuffer final : public std::streambuf {
  public:
    /// Takes the descriptor of an empty file.
    explicit OutputBuffer(int descriptor);
    ~OutputBuffer() override;
    OutputBuffer(const OutputBuffer&) = delete;
    OutputBuffer& operator=(const OutputBuffer&) = delete;

    int error() const { return error_; }              ///< errno of the first failure, or 0
    std::uint64_t length() const { return length_; }  ///< of all that was written so far
    /// Everything is on the disk afterwards, or there is an error(); if not `is_synced`, some is on its way.
    void close(bool is_synced = true);

  protected:
    int_type overflow(int_type character) override;
    std::streamsize xsputn(const char* bytes, std::streamsize count) override;
    int sync() override;
    pos_type seekoff(off_type offset, std::ios_base::seekdir from, std::ios_base::openmode which) override;
    pos_type seekpos(pos_type place, std::ios_base::openmode which) override;

  private:
    void write(std::string_view bytes);
    std::array<char, 1 << 16> waiting_;
    int descriptor_, error_ = 0;
    std::uint64_t place_ = 0, length_ = 0;  ///< without what waits
};

}  // namespace ir
