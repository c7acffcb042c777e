#include "renderers/image/tev.h"

#include <netdb.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "renderers/core/error.h"

namespace ir {
namespace {

static_assert(std::endian::native == std::endian::little, "tev reads numbers with their low bytes first");

constexpr char create_image = 4, update_image = 6;  ///< kinds of messages; 6: with strides
constexpr int max_seconds = 5;                      ///< to connect, and for each part that is sent
constexpr std::size_t max_pixels_bytes = 16 << 20;  ///< of a message

/// Its length, itself included, then what it is, then the values. Texts end with a zero.
class Message {
  public:
    explicit Message(char kind) {
        add(std::uint32_t(0));
        add(kind);
        add(true);  // in front of the other pictures
    }
    template <typename T>
    void add(T value) {
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    void add(const std::string& text) { bytes_.append(text.c_str(), std::strlen(text.c_str()) + 1); }
    void add(const float* values, std::size_t count) {
        bytes_.append(reinterpret_cast<const char*>(values), count * sizeof *values);
    }
    const std::string& bytes() {
        const auto length = static_cast<std::uint32_t>(bytes_.size());
        std::memcpy(bytes_.data(), &length, sizeof length);
        return bytes_;
    }

  private:
    std::string bytes_;
};

class Connection {
  public:
    explicit Connection(const std::string& address) : address_(address) {
        const auto colon = address.rfind(':');
        if (colon == std::string::npos || colon == 0 || colon + 1 == address.size())
            throw UsageError("'" + address + "' is no address of tev; give HOST:PORT, such as " +
                             tev_address);
        const auto port = std::strtol(address.c_str() + colon + 1, nullptr, 10);
        if (address.find_first_not_of("0123456789", colon + 1) != std::string::npos || port < 1 ||
            port > 65535)
            throw UsageError("'" + address + "' has no port from 1 to 65535; tev listens at " + tev_address);
        addrinfo wanted{};
        wanted.ai_socktype = SOCK_STREAM;
        wanted.ai_flags = AI_NUMERICSERV;
        addrinfo* list = nullptr;
        auto host = address.substr(0, colon);
        if (host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);  // as of IPv6
        const int status = getaddrinfo(host.c_str(), address.c_str() + colon + 1, &wanted, &list);
        if (status != 0) fail(gai_strerror(status));
        const std::unique_ptr<addrinfo, void (*)(addrinfo*)> found(list, freeaddrinfo);
        int why = 0;
        for (const auto* each = list; each && socket_ < 0; each = each->ai_next) why = connect_to(*each);
        if (socket_ < 0) fail(why == EINPROGRESS ? "no answer" : std::strerror(why));
    }
    ~Connection() { ::close(socket_); }
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;

    void send(const std::string& bytes) {
        for (std::size_t sent = 0; sent < bytes.size();) {
            const auto count = ::send(socket_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
            if (count < 0 && errno == EINTR) continue;
            if (count < 0) fail(errno == EAGAIN ? "it takes nothing more" : std::strerror(errno));
            sent += static_cast<std::size_t>(count);
        }
    }

  private:
    /// Why it did not work.
    int connect_to(const addrinfo& place) {
        const int made = ::socket(place.ai_family, place.ai_socktype | SOCK_CLOEXEC, place.ai_protocol);
        if (made < 0) return errno;
        const timeval patience{max_seconds, 0};
        ::setsockopt(made, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
        if (::connect(made, place.ai_addr, place.ai_addrlen) == 0) {
            socket_ = made;
            return 0;
        }
        const int why = errno;
        ::close(made);
        return why;
    }
    [[noreturn]] void fail(const std::string& why) const {
        throw Error("tev at " + address_ + ": " + why + "; start it, or name where it runs");
    }

    std::string address_;
    int socket_ = -1;
};

/// All layers side by side in one picture, pixel by pixel.
struct Channels {
    std::vector<std::string> names;
    std::vector<std::pair<const Image*, int>> of;
    int width = 0, height = 0;

    explicit Channels(const std::vector<ImageLayer>& layers) {
        for (const auto& layer : layers) {
            if (layer.image.empty()) continue;
            if (names.empty()) width = layer.image.width, height = layer.image.height;
            if (layer.image.width != width || layer.image.height != height)
                throw Error("layers of different sizes cannot be one picture in tev");
            for (int c = 0; c < layer.image.channels; ++c) {
                const auto& channel = layer.channels.at(static_cast<std::size_t>(c));
                names.push_back(layer.name.empty() ? channel : layer.name + "." + channel);
                of.emplace_back(&layer.image, c);
            }
        }
        if (names.empty()) throw Error("there is no picture to show in tev");
    }
    std::vector<float> rows(int first, int count) const {
        std::vector<float> values;
        values.reserve(static_cast<std::size_t>(count) * width * of.size());
        for (int y = first; y < first + count; ++y)
            for (int x = 0; x < width; ++x)
                for (const auto& [image, c] : of) values.push_back(image->at(x, y, c));
        return values;
    }
};

}  // namespace

void send_to_tev(const std::string& name, const std::vector<ImageLayer>& layers, const std::string& address) {
    const Channels channels(layers);
    const auto count = static_cast<std::int32_t>(channels.names.size());
    Connection tev(address);
    Message made(create_image);
    made.add(name);
    for (const std::int32_t number : {channels.width, channels.height, count}) made.add(number);
    for (const auto& channel : channels.names) made.add(channel);
    tev.send(made.bytes());
    const auto row_bytes = static_cast<std::size_t>(channels.width) * channels.names.size() * sizeof(float);
    const int rows = std::max(1, static_cast<int>(max_pixels_bytes / row_bytes));
    for (std::int32_t y = 0; y < channels.height; y += rows) {
        const std::int32_t height = std::min(rows, channels.height - y);
        Message part(update_image);
        part.add(name);
        part.add(count);
        for (const auto& channel : channels.names) part.add(channel);
        for (const std::int32_t number : {0, y, channels.width, height}) part.add(number);
        for (std::int64_t c = 0; c < count; ++c) part.add(c);           // where a channel begins
        for (int c = 0; c < count; ++c) part.add(std::int64_t(count));  // and how far apart its values are
        const auto values = channels.rows(y, height);
        part.add(values.data(), values.size());
        tev.send(part.bytes());
    }
}

}  // namespace ir
