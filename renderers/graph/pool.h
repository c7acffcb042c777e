#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "renderers/gl/device.h"
#include "renderers/graph/resource.h"

namespace ir::graph {

/// One copy of an image's or buffer's contents, on the device, on the host, or on both.
struct Copy {
    gl::Name name = 0;
    std::vector<std::byte> host;
    bool on_device = false, on_host = false;  ///< where the contents are up to date
    bool committed = false;
};

/// The memory behind one resource key. With history there are two copies: the one being written and the
/// committed one.
struct Physical {
    bool is_image = true;
    std::string label;
    gl::ImageShape shape;                                         // images
    std::uint64_t element_bytes = 0, capacity = 0, estimate = 0;  // buffers
    bool history = false;
    /// Graphs that share contents hold the same copy; own() is before writing.
    std::shared_ptr<Copy> copies[2] = {std::make_shared<Copy>(), std::make_shared<Copy>()};
    int current = 0;
    std::string fingerprint;    ///< of the contents; empty: valid within the frame only
    bool produced = false;      ///< written in this frame
    bool had_previous = false;  ///< the last committed frame found a history

    Copy& now() { return *copies[current]; }
    bool has_contents() const { return copies[current]->on_device || copies[current]->on_host; }
    Copy& before() { return *copies[1 - current]; }
    std::uint64_t copy_bytes() const { return is_image ? shape.bytes() : element_bytes * capacity; }
    std::uint64_t host_bytes() const;  ///< of level 0 with all layers, or of the whole buffer
};

/// Creates, keeps and frees what a graph's resources are stored in. Contents move between host and device on
/// demand.
class Pool {
  public:
    explicit Pool(gl::Device& device) : device_(device) {}
    ~Pool();
    Pool(const Pool&) = delete;

    /// Makes the resource as described; memory of the same shape is kept, else it is freed and the history
    /// with it.
    Physical& image(const std::string& key, const std::string& label, const gl::ImageShape& shape,
                    bool history);
    /// When only the capacity grows, the history is kept, with zeros in the new elements.
    Physical& buffer(const std::string& key, const std::string& label, std::uint64_t element_bytes,
                     std::uint64_t capacity, std::uint64_t estimate, bool history);
    Physical* find(const std::string& key);
    const Physical* find(const std::string& key) const;
    void free(const std::string& key);
    void free_except(const std::vector<std::string>& keys);

    /// The name on the device with contents up to date.
    gl::Name on_device(Physical& physical, Copy& copy);
    /// Host bytes with contents up to date.
    std::vector<std::byte>& on_host(Physical& physical, Copy& copy);

    /// The bytes that on_host() would give, without keeping them there.
    std::vector<std::byte> read(const Physical& physical, const Copy& copy) const;
    std::vector<std::string> keys() const;

    /// The copy that is written, which no other graph has: a new one in place of one that is shared.
    Copy& own(Physical& physical);
    /// Takes the contents of another graph's resource of the same shape in place of its own.
    void adopt(Physical& physical, std::shared_ptr<Copy> copy, const std::string& fingerprint);

    /// Zeros (depth images on the device: 1) on the device or on the host.
    void zero(Physical& physical, Copy& copy, bool device);

    void begin_frame();    ///< turns committed contents into "previous" ones
    void begin_attempt();  ///< of the same frame: nothing is written yet
    void commit();
    /// After a commit: what was "previous" in that frame is it again, until hide_previous().
    void show_previous();
    void hide_previous();
    void abandon();  ///< a frame that failed: the committed contents are the current ones again
    void forget_history();
    /// Device and host memory of one resource, of all.
    std::uint64_t bytes(const Physical& physical) const;
    std::uint64_t bytes() const;

  private:
    void release(Physical& physical);
    void release(const Physical& physical, std::shared_ptr<Copy>& copy);
    void grow_with_history(Physical& physical, std::uint64_t capacity);
    gl::Device& device_;
    std::map<std::string, Physical> resources_;
};

}  // namespace ir::graph
