#pragma once

#include <ImfHeader.h>
#include <ImfIO.h>

#include <ostream>
#include <stdexcept>

#include "renderers/image/exr.h"

/// For what reads and writes EXR files of its own layout.
namespace ir {

/// OpenEXR takes memory for the length that an attribute claims before it reads it. Throws InputError where
/// one is longer than the file, or not as long as its type, of which OpenEXR reads so many bytes in any case.
void require_whole_header(const std::filesystem::path& file);

/// Threads with which a file is read: few, because each holds blocks of lines.
int threads_of_reading();

/// Takes from what is `left` the bytes that reading a part takes: its values, and the blocks of lines or rows
/// of tiles that OpenEXR holds, each packed as one, for all threads. Throws InputError where they are more.
void take_bytes_of_part(const Imf::Header& header, const std::string& file, std::uint64_t& left);

/// What a message takes from a file, such as OpenEXR's with names in it: no control characters, 400 bytes at
/// most.
std::string in_one_line(std::string text);

/// The texts of a file's header, but for those that are OpenEXR's own.
ImageAttributes attributes_of(const Imf::Header& header);

/// OpenEXR writes into a stream of ours, which remembers the failures that OpenEXR swallows when it closes.
class ExrStream final : public Imf::OStream {
  public:
    explicit ExrStream(std::ostream& out) : Imf::OStream("the file"), out_(out) {}
    void write(const char* bytes, int count) override {
        if (!out_.write(bytes, count)) throw std::runtime_error("it takes no more bytes");
    }
    std::uint64_t tellp() override { return static_cast<std::uint64_t>(out_.tellp()); }
    void seekp(std::uint64_t place) override { out_.seekp(static_cast<std::streamoff>(place)); }

  private:
    std::ostream& out_;
};

}  // namespace ir
