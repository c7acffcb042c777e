#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "renderers/image/image.h"

namespace ir {

/// Listens as tev does, and reads what one connection sends.
class FakeTev {
  public:
    struct Shown {
        std::vector<std::string> channels;
        Image image;
        std::vector<bool> is_set;  ///< a pixel
    };

    FakeTev() : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
        sockaddr_in place{};
        place.sin_family = AF_INET;
        place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t length = sizeof place;
        const timeval patience{20, 0};  // where nobody comes
        ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
        if (::bind(socket_, reinterpret_cast<const sockaddr*>(&place), length) != 0 ||
            ::listen(socket_, 8) != 0 ||
            ::getsockname(socket_, reinterpret_cast<sockaddr*>(&place), &length) != 0)
            throw std::runtime_error("no socket");
        address_ = "127.0.0.1:" + std::to_string(ntohs(place.sin_port));
    }
    ~FakeTev() { ::close(socket_); }

    const std::string& address() const { return address_; }

    /// What the next connection sends until it ends; by the pictures' names.
    std::map<std::string, Shown> receive() {
        const int connection = ::accept(socket_, nullptr, nullptr);
        if (connection < 0) throw std::runtime_error("nobody sends");
        std::string bytes;
        char part[1 << 16];
        for (ssize_t count; (count = ::read(connection, part, sizeof part)) > 0;)
            bytes.append(part, static_cast<std::size_t>(count));
        ::close(connection);
        std::map<std::string, Shown> shown;
        for (std::size_t at = 0; at < bytes.size();) {
            std::uint32_t length = 0;
            std::memcpy(&length, bytes.data() + at, sizeof length);
            if (length < sizeof length || at + length > bytes.size())
                throw std::runtime_error("a message's length is wrong");
            take(bytes.substr(at + sizeof length, length - sizeof length), shown);
            at += length;
        }
        return shown;
    }

  private:
    struct Reader {
        const std::string& bytes;
        std::size_t at = 0;
        template <typename T>
        T take() {
            T value;
            if (at + sizeof value > bytes.size()) throw std::runtime_error("a message is too short");
            std::memcpy(&value, bytes.data() + at, sizeof value);
            at += sizeof value;
            return value;
        }
        std::string text() {
            const std::string result = bytes.c_str() + at;
            at += result.size() + 1;
            return result;
        }
        std::vector<std::string> texts(int count) {
            std::vector<std::string> result;
            for (int i = 0; i < count; ++i) result.push_back(text());
            return result;
        }
    };

    static void take(const std::string& message, std::map<std::string, Shown>& shown) {
        Reader reader{message};
        const auto kind = reader.take<char>();
        reader.take<bool>();
        const auto name = reader.text();
        if (kind == 4) {
            const int width = reader.take<std::int32_t>(), height = reader.take<std::int32_t>();
            const int count = reader.take<std::int32_t>();
            shown[name] = {reader.texts(count), Image(width, height, count, -1),
                           std::vector<bool>(static_cast<std::size_t>(width) * height)};
        } else if (kind == 6) {
            fill(reader, shown.at(name));
        } else {
            throw std::runtime_error("a message of kind " + std::to_string(int(kind)));
        }
        if (reader.at != message.size()) throw std::runtime_error("a message is too long");
    }

    static void fill(Reader& reader, Shown& shown) {
        const int count = reader.take<std::int32_t>();
        if (reader.texts(count) != shown.channels) throw std::runtime_error("other channels");
        const int x0 = reader.take<std::int32_t>(), y0 = reader.take<std::int32_t>();
        const int width = reader.take<std::int32_t>(), height = reader.take<std::int32_t>();
        std::vector<std::int64_t> begins, strides;
        for (int c = 0; c < count; ++c) begins.push_back(reader.take<std::int64_t>());
        for (int c = 0; c < count; ++c) strides.push_back(reader.take<std::int64_t>());
        std::vector<float> values((reader.bytes.size() - reader.at) / sizeof(float));
        for (auto& value : values) value = reader.take<float>();
        for (int i = 0; i < width * height; ++i) {
            const int x = x0 + i % width, y = y0 + i / width;
            shown.is_set.at(std::size_t(y) * shown.image.width + x) = true;
            for (int c = 0; c < count; ++c)
                shown.image.at(x, y, c) = values.at(std::size_t(begins[c] + i * strides[c]));
        }
    }

    int socket_;
    std::string address_;
};

}  // namespace ir
