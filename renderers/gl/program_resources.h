#pragma once

#include <map>
#include <string>
#include <vector>

#include "renderers/gl/context.h"

namespace ir::gl {

/// What a linked program reads or writes through a name of its source: a storage block, a sampler or an
/// image.
struct ProgramResource {
    enum class Kind { buffer, texture, image };
    std::string name;  ///< the block's, the sampler's or the image's; of an array without [0]
    Kind kind = Kind::buffer;
    GLenum type = GL_NONE;  ///< of samplers and images
    GLuint unit = 0;        ///< the first of `count`
    int count = 1;          ///< elements of an array of samplers
    bool written = false;   ///< not declared readonly
    std::string format;     ///< of images: the layout's, such as "r32f"; empty where it has none
    /// Of a block with an array of structs: its records, as linked.
    struct Member {
        std::string name;
        int offset = 0;          ///< bytes from the record's begin
        GLenum type = GL_FLOAT;  ///< of an array: of its elements
        int count = 1;           ///< elements of an array
        bool is_array = false;
    };
    std::vector<Member> members = {};  ///< those that the program uses; empty: the array is of plain values
    int stride = 0;                    ///< bytes from record to record

    /// "levels[2]", or the name where it is no array.
    std::string element(int index) const;
    bool is_array_texture() const;  ///< or array image
    bool is_integer() const;
};

/// The declarations of blocks, samplers and images in a program's sources. OpenGL reflects neither formats
/// nor `readonly`. Directives are not followed: of several declarations of a name, one that writes counts,
/// and formats count where they agree.
class ResourceDeclarations {
  public:
    /// Adds the source of a stage.
    void add(const std::string& text);
    bool names(const std::string& resource) const { return declared_.contains(resource); }

  private:
    friend std::vector<ProgramResource> assign_units(const Api&, GLuint, const ResourceDeclarations&);
    struct Declaration {
        bool written = false;
        std::string format = {};
    };
    std::map<std::string, Declaration> declared_;
};

struct PlainUniform {
    GLenum type = GL_NONE;
    GLint location = -1;
};

/// The active uniforms of a linked program that are no samplers and no images, by name; of arrays without
/// [0].
std::map<std::string, PlainUniform> plain_uniforms(const Api& api, GLuint program);

/// The active resources of a linked program, in the order of their names. Each gets a unit of its kind.
std::vector<ProgramResource> assign_units(const Api& api, GLuint program,
                                          const ResourceDeclarations& declarations);

}  // namespace ir::gl
