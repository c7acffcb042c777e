#include "projects/pack.h"

#include <gtest/gtest.h>

#include <sys/stat.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "projects/archive.h"
#include "projects/hash.h"
#include "projects/results.h"
#include "projects/scene_files.h"
#include "projects/store.h"
#include "renderers/core/error.h"
#include "tests/unit/projects/sample.h"

namespace ir::projects {
namespace {

namespace fs = std::filesystem;
using testing::registry;
using testing::sample_project;
using testing::TemporaryFolder;

/// A project whose scene is a glTF file beside the project, with a texture in a third folder.
fs::path make_project(const fs::path& parent) {
    const auto folder = parent / "a.interreflect";
    testing::write_text(
        parent / "scenes/church.gltf",
        R"({"buffers": [{"uri": "church.bin"}], "images": [{"uri": "../textures/stone.png"}]})");
    testing::write_text(parent / "scenes/church.bin", std::string(1000, 'b'));
    testing::write_text(parent / "textures/stone.png", std::string(512, 't'));
    testing::write_text(folder / "sky.exr", "sky");
    auto project = sample_project();
    project.scenes[0].parts = {{"../scenes/church.gltf", "", {}}};
    project.scenes[0] = with_current_hashes(project.scenes[0], folder);
    save_project(project, folder, "");
    testing::write_text(folder / "results/k/main.exr", "pixels");
    ResultIndex index;
    KeptResult kept;
    kept.key = "k";
    kept.files = {{"main", "k/main.exr", hash_bytes("pixels")}};
    index.put(kept);
    index.save(folder);
    return folder;
}

TEST(Pack, RoundTripsToAnotherPlace) {
    TemporaryFolder here, there;
    const auto folder = make_project(here.path());
    const auto messages = pack_project(folder, here.path() / "a.tar", registry());
    ASSERT_EQ(messages.size(), 2u);
    EXPECT_NE(messages[0].text.find("from outside of the project's folder are packed: "), std::string::npos);
    for (const char* name : {"church.gltf", "church.bin", "stone.png"})
        EXPECT_NE(messages[0].text.find(name), std::string::npos) << messages[0].text;
    EXPECT_NE(messages[1].text.find("photo.exr"), std::string::npos) << "it does not exist";

    const auto unpacked = unpack_project(here.path() / "a.tar", there.path());
    EXPECT_EQ(unpacked, there.path() / "a.interreflect");
    const auto loaded = load_project(unpacked, registry());
    EXPECT_EQ(loaded.project.experiments, sample_project().experiments);
    const auto& part = loaded.project.scenes[0].parts[0];
    EXPECT_EQ(status(part, unpacked).state, FileState::ok);  // the very same scene, textures included
    EXPECT_EQ(part.source, "files/1/scenes/church.gltf");
    EXPECT_TRUE(check_results(ResultIndex::load(unpacked), unpacked).empty());
    EXPECT_THROW(unpack_project(here.path() / "a.tar", there.path()), Error);  // exists already
    EXPECT_EQ(load_project(unpacked, registry()).project, loaded.project);

    pack_project(folder, here.path() / "b.tar", registry());
    EXPECT_EQ(hash_file(here.path() / "a.tar"), hash_file(here.path() / "b.tar"));
}

TEST(Pack, WhatAGltfMayNotReadIsNotPackedAndSaid) {
    TemporaryFolder here;
    const auto folder = make_project(here.path());
    const auto scene = here.path() / "scenes" / "church.gltf";
    auto text = testing::read_text(scene);
    const auto at = text.find("church.bin");
    ASSERT_NE(at, std::string::npos) << text;
    text.insert(at, "../../");
    std::ofstream(scene) << text;
    std::string told;
    for (const auto& message : pack_project(folder, here.path() / "a.tar", registry()))
        if (message.severity == Severity::warning) told += message.text + "\n";
    EXPECT_NE(told.find("'../../church.bin' lies outside of the folder of '"), std::string::npos) << told;
}

TEST(Pack, OrdinaryTarReadsIt) {
    if (std::system("tar --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "needs the tar program";
    TemporaryFolder here;
    const std::string long_name = "d/" + std::string(90, 'x') + "/" + std::string(90, 'y') + ".bin";
    std::ofstream stream(here.path() / "a.tar", std::ios::binary);
    ArchiveWriter writer(stream);
    writer.add_text(long_name, std::string(700, 'z'));
    writer.add_text("d/empty", "");
    writer.finish();
    stream.close();
    const std::string in = "cd " + here.path().string() + " && ";
    ASSERT_EQ(std::system((in + "tar xf a.tar").c_str()), 0);
    EXPECT_EQ(testing::read_text(here.path() / long_name), std::string(700, 'z'));
    EXPECT_TRUE(fs::exists(here.path() / "d/empty"));
}

TEST(Pack, ReadsWhatOtherProgramsPacked) {
    if (std::system("tar --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "needs the tar program";
    TemporaryFolder origin, here, there;
    pack_project(make_project(origin.path()), origin.path() / "a.tar", registry());
    const auto folder = unpack_project(origin.path() / "a.tar", here.path());
    const auto packed = (here.path() / "a.tar.gz").string();
    const std::string in = "cd " + here.path().string() + " && tar czf a.tar.gz ";
    ASSERT_EQ(std::system((in + "a.interreflect").c_str()), 0);
    const auto unpacked = unpack_project(packed, there.path());
    EXPECT_EQ(load_project(unpacked, registry()).project, load_project(folder, registry()).project);
    EXPECT_EQ(testing::read_text(unpacked / "results/k/main.exr"), "pixels");

    fs::remove_all(unpacked);
    fs::create_symlink("/etc/hostname", folder / "results/link");
    ASSERT_EQ(std::system((in + "a.interreflect").c_str()), 0);
    EXPECT_THROW(unpack_project(packed, there.path()), InputError);
    EXPECT_TRUE(fs::is_empty(there.path()));
}

/// What `archive` of these files says when it is unpacked; empty where it is.
std::string refusal_of(const std::vector<std::pair<std::string, std::string>>& files) {
    TemporaryFolder here, there;
    const auto archive = here.path() / "bad.tar";
    std::ofstream stream(archive, std::ios::binary);
    ArchiveWriter writer(stream);
    for (const auto& [name, text] : files) writer.add_text("a.interreflect/" + name, text);
    writer.finish();
    stream.close();
    try {
        unpack_project(archive, there.path());
        EXPECT_FALSE(fs::exists(there.path() / "a.interreflect/project.json.autosave"));
        return "";
    } catch (const InputError& error) {
        EXPECT_TRUE(fs::is_empty(there.path()));
        const std::string line = error.what();
        EXPECT_EQ(line.rfind(archive.string() + ": ", 0), 0u) << line;
        EXPECT_EQ(line.find('\n'), std::string::npos) << line;
        return line;
    }
}

std::string document_with(const std::string& source) {
    auto project = sample_project();
    project.scenes[0].parts = {{source, "", {}}};
    project.images.clear();
    return write_project(project);
}

TEST(Pack, WhatItNamesIsInIt) {
    const std::string lies_outside = "lies outside of its folder; if you trust who packed it";
    for (const char* source : {"/etc/passwd", "../scenes/church.gltf", "files/../../x.glb", "/dev/zero"}) {
        const auto refusal = refusal_of({{"project.json", document_with(source)}});
        EXPECT_NE(refusal.find(lies_outside), std::string::npos) << source << ": " << refusal;
    }
    EXPECT_EQ(refusal_of({{"project.json", document_with("files/1/gone.gltf")}}), "");
    EXPECT_EQ(refusal_of({{"project.json", document_with("~root/a.gltf")}}), "") << "a name like any other";
    // Neither does a scene in it, whatever its name.
    const std::string scene = R"({"images": [{"uri": "../../stone.png"}]})";
    for (const char* name : {"files/a.gltf", "files/a.txt"}) {
        const auto refusal = refusal_of({{"project.json", document_with(name)}, {name, scene}});
        EXPECT_EQ(refusal, "") << "the loader refuses it: two folders above";
    }
    const std::string beside = R"({"images": [{"uri": "../stone.png"}]})";
    for (const char* name : {"a.gltf", "a.txt"}) {
        const auto refusal = refusal_of({{"project.json", document_with(name)}, {name, beside}});
        EXPECT_NE(refusal.find(lies_outside), std::string::npos) << name << ": " << refusal;
    }
    EXPECT_EQ(refusal_of({{"project.json", document_with("files/a.gltf")}, {"files/a.gltf", beside}}), "");
}

TEST(Pack, UnsavedChangesOfOthersStayOut) {
    EXPECT_EQ(refusal_of({{"project.json", document_with("files/a.gltf")},
                          {"project.json.autosave", "evil"},
                          {".lock", "evil"}}),
              "");
}

TEST(Pack, LinksInResultsAreNotFollowed) {
    TemporaryFolder here;
    const auto folder = make_project(here.path());
    testing::write_text(here.path() / "secret", "secret");
    fs::remove(folder / "results/k/main.exr");
    fs::create_symlink(here.path() / "secret", folder / "results/k/main.exr");
    EXPECT_THROW(pack_project(folder, here.path() / "a.tar", registry()), Error);
    EXPECT_FALSE(fs::exists(here.path() / "a.tar"));
}

TEST(Pack, BombsAreRefused) {
    if (std::system("tar --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "needs the tar program";
    TemporaryFolder here, there;
    testing::write_text(here.path() / "a.interreflect/project.json", document_with("files/a.gltf"));
    testing::write_text(here.path() / "a.interreflect/hole", "");
    fs::resize_file(here.path() / "a.interreflect/hole", std::uintmax_t{8} << 30);
    const auto pack = "cd " + here.path().string() + " && tar cSf a.tar a.interreflect";
    ASSERT_EQ(std::system(pack.c_str()), 0);
    ASSERT_LT(fs::file_size(here.path() / "a.tar"), 100'000u);
    try {
        unpack_project(here.path() / "a.tar", there.path());
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("unpacks to far more than it has bytes"), std::string::npos);
    }
    EXPECT_TRUE(fs::is_empty(there.path()));
}

TEST(Pack, DamagedArchivesLeaveNothingBehind) {
    TemporaryFolder here, there;
    const auto folder = make_project(here.path());
    pack_project(folder, here.path() / "a.tar", registry());
    const auto good = testing::read_text(here.path() / "a.tar");
    const auto refused = [&](const std::string& bytes) {
        testing::write_text(here.path() / "bad.tar", bytes);
        EXPECT_THROW(unpack_project(here.path() / "bad.tar", there.path()), Error);
        EXPECT_TRUE(fs::is_empty(there.path()));
        EXPECT_THROW(unpack_project(here.path() / "bad.tar", there.path() / "new" / "newer"), Error);
        EXPECT_TRUE(fs::is_empty(there.path()));
    };
    refused("");
    refused("not a tar");
    refused(good.substr(0, good.size() / 2));
    auto flipped = good;
    flipped[3] ^= 1;
    refused(flipped);
    EXPECT_THROW(unpack_project(here.path() / "none.tar", there.path()), InputError);
}

TEST(Pack, NamesCannotLeaveTheProject) {
    TemporaryFolder here, there;
    fs::create_directories(there.path() / "inside");
    for (const char* name : {"../evil", "/evil", "a.interreflect/../../evil", "a.interreflect",
                             "b/project.json", "c.interreflect/project.json"}) {
        std::ofstream stream(here.path() / "bad.tar", std::ios::binary);
        ArchiveWriter writer(stream);
        writer.add_text("a.interreflect/project.json", "{}");
        writer.add_text(name, "x");
        writer.finish();
        stream.close();
        EXPECT_THROW(unpack_project(here.path() / "bad.tar", there.path() / "inside"), InputError) << name;
        EXPECT_TRUE(fs::is_empty(there.path() / "inside")) << name;
        EXPECT_FALSE(fs::exists(there.path() / "evil"));
    }
}

/// A header as tar archives have it: its name, the length of what follows, and its type.
std::string tar_header(const std::string& name, std::size_t size, char type) {
    std::string block(512, '\0');
    const auto put = [&](std::size_t at, const std::string& text) { block.replace(at, text.size(), text); };
    put(0, name);
    put(100, "0000644");
    char octal[12];
    std::snprintf(octal, sizeof octal, "%011zo", size);
    put(124, octal);
    put(136, "00000000000");
    put(148, "        ");
    block[156] = type;
    put(257, type == 'S' ? "ustar  " : std::string("ustar\00000", 8));
    if (type == 'S') block[482] = 1;  // more of the header follows
    unsigned sum = 0;
    for (const char c : block) sum += static_cast<unsigned char>(c);
    std::snprintf(octal, sizeof octal, "%06o", sum);
    put(148, octal);
    block[154] = '\0';
    return block;
}

std::string in_blocks(std::string text) {
    text.resize((text.size() + 511) / 512 * 512);
    return text;
}

/// What unpacking an archive of a small project says, then `count` times `more`; by another program, if one
/// is given. Empty: nothing.
std::string refusal_of_more(const std::string& more, int count, const std::string& program = "cat") {
    TemporaryFolder here, there;
    const auto archive = (here.path() / "bad.tar").string();
    auto* out = ::popen((program + " > " + archive).c_str(), "w");
    EXPECT_TRUE(out);
    const auto document = document_with("files/a.gltf");
    const auto first = tar_header("a.interreflect/project.json", document.size(), '0') + in_blocks(document);
    std::fwrite(first.data(), 1, first.size(), out);
    for (int i = 0; i < count; ++i) std::fwrite(more.data(), 1, more.size(), out);
    EXPECT_EQ(::pclose(out), 0);
    try {
        unpack_project(archive, there.path());
        return "";
    } catch (const InputError& error) {
        EXPECT_TRUE(fs::is_empty(there.path()));
        return error.what();
    }
}

TEST(Pack, HeadersCountInTheLimit) {
    // An attribute that means nothing.
    std::string record = "1000000 comment=";
    record.resize(999'999, 'x');
    record += '\n';
    const auto folder = tar_header("a.interreflect/d/", 0, '5');
    const auto bulky = tar_header("x", record.size(), 'x') + in_blocks(record) + folder;
    EXPECT_EQ(refusal_of_more(bulky, 2), "");
    const std::string too_much = "unpacks to far more than it has bytes";
    EXPECT_NE(refusal_of_more(bulky, 560, "gzip").find(too_much), std::string::npos);
}

TEST(Pack, ArchivesInArchivesAreRefused) {
    EXPECT_EQ(refusal_of_more("", 0, "gzip"), "");
    EXPECT_NE(refusal_of_more("", 0, "gzip | gzip").find("is compressed more than once"), std::string::npos);
}

TEST(Pack, MoreFilesAndFoldersThanAProjectHasAreRefused) {
    const auto folder = tar_header("a.interreflect/d/", 0, '5');
    EXPECT_EQ(refusal_of_more(folder, 1000), "");
    EXPECT_NE(refusal_of_more(folder, max_packed_files).find("holds more than 100000 files"),
              std::string::npos);
    std::string deep = "a.interreflect/";
    for (int i = 0; i < 40; ++i) deep += "d/";
    EXPECT_EQ(refusal_of_more(tar_header(deep + "f", 0, '0'), 1), "");
    std::string record = " path=a.interreflect/";
    for (int i = 0; i < 100; ++i) record += "d/";
    record += "f\n";
    record = std::to_string(record.size() + 3) + record;
    const auto deeper = tar_header("x", record.size(), 'x') + in_blocks(record) + tar_header("f", 0, '0');
    EXPECT_NE(refusal_of_more(deeper, 1).find("has more folders than a project"), std::string::npos);
    std::ostringstream out;
    ArchiveWriter writer(out);
    for (int i = 0; i < max_packed_files; ++i) writer.add_text("a", "");
    EXPECT_THROW(writer.add_text("a", ""), Error) << "nobody could unpack it";
    ArchiveWriter deepest(out);
    std::string place = "a.interreflect/";
    for (int i = 0; i < max_packed_depth; ++i) place += "d/";
    EXPECT_NO_THROW(deepest.add_text(place + "f", ""));
    EXPECT_THROW(deepest.add_text(place + "d/f", ""), Error);
}

TEST(Pack, PipesAreNotWaitedFor) {
    TemporaryFolder here, there;
    const auto pipe = here.path() / "a.tar";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_THROW(unpack_project(pipe, there.path()), InputError);
}

TEST(Pack, UnpackingOfFilesWithoutContentIsCancelled) {
    TemporaryFolder here, there;
    std::ofstream stream(here.path() / "a.tar", std::ios::binary);
    ArchiveWriter writer(stream);
    for (int i = 0; i < 10; ++i) writer.add_text("a.interreflect/" + std::to_string(i), "");
    writer.finish();
    stream.close();
    CancelToken cancel;
    cancel.cancel();
    EXPECT_THROW(unpack_project(here.path() / "a.tar", there.path(), &cancel), Cancelled);
    EXPECT_TRUE(fs::is_empty(there.path()));
}

}  // namespace
}  // namespace ir::projects
