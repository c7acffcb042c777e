// The context is lost at a call of OpenGL, as by a reset of the device: another one is made, and the picture
// comes all the same.
#include <algorithm>
#include <cstdlib>
#include <thread>

#include "tests/unit/engine/render_thread_fixture.h"
#include "tests/watched_gl.h"

namespace ir::engine {
namespace {

class LostContext : public RenderThreadTest {
  protected:
    LostContext() { processor = Processor::gl; }
    void TearDown() override {
        test::lose_context_at(0);
        test::refuse_storage_at(0);
        RenderThreadTest::TearDown();
    }

    static LiveRequest picture(const std::string& method, std::int64_t seed) {
        auto request = request_of("a", method);
        request.experiment.seed = std::uint64_t(seed);
        if (method == "ldm-ao")
            request.experiment.settings = {{"directions", std::int64_t{16}},
                                           {"resolution", std::int64_t{32}}};
        if (method == "photon-mapping") request.experiment.settings = {{"photons", std::int64_t{2000}}};
        return request;
    }
    /// Waits until there is none, and says why.
    std::string no_device() {
        const auto deadline = Clock::now() + std::chrono::minutes(1);
        while (answers().no_device.empty() && Clock::now() < deadline)
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        return answers().no_device;
    }
    /// What the newest request shows, whatever failed before.
    Image picture_after_all(std::uint64_t serial) {
        Image found;
        EXPECT_TRUE(wait([&](const Answers& a) {
            for (const auto& result : a.results)
                if (result.serial == serial && result.finished && result.images.contains(Part{}))
                    return found = result.images.at(Part{}), true;
            return false;
        }));
        return found;
    }
};

TEST_F(LostContext, ThePictureComesWhereverItHappens) {
    for (const char* method : {"ldm-ao", "photon-mapping"}) {
        render(picture(method, 1));  // programs are there
        const long before = test::gl_calls();
        const auto expected = render(picture(method, 2)).images.at(Part{}).pixels;
        const long calls = test::gl_calls() - before;
        ASSERT_GT(calls, 100);
        const long most = std::getenv("INTERREFLECT_ALL_LOSSES") ? calls : 5;
        for (long i = 0; i < most; ++i) {
            render(picture(method, 1));
            forget();
            const long call = 1 + i * calls / most;
            test::lose_context_at(call);
            const auto serial = thread->request(picture(method, 2));
            EXPECT_EQ(picture_after_all(serial).pixels, expected);
            EXPECT_TRUE(test::was_context_lost());
            test::lose_context_at(0);
            if (HasFailure()) FAIL() << method << ": lost at call " << call << " of " << calls;
        }
        RecordProperty(std::string("calls of ") + method, int(calls));
    }
}

TEST_F(LostContext, APictureThatAlwaysTakesTheContextWithItEnds) {
    const auto wanted = picture("view-normals", 1);
    render(wanted);
    forget();
    test::lose_context_at(1);
    picture_after_all(thread->request(picture("view-normals", 2)));
    const long calls = test::gl_calls();  // of a context and the picture
    test::lose_context_at(1, calls * 9 / 10);
    thread->request(wanted);
    EXPECT_NE(no_device().find("again and again"), std::string::npos);
}

TEST_F(LostContext, NothingOfOpenGlIsLeftWhenTheThreadEnds) {
    for (const char* method : {"ldm-ao", "photon-mapping"}) {
        auto request = picture(method, 1);
        request.tag = method;
        render(request);
    }
    EXPECT_FALSE(test::living_gl_objects().empty());
    thread->release("ldm-ao");
    thread.reset();
    for (const auto& [kind, count] : test::living_gl_objects()) ADD_FAILURE() << count << " " << kind;
}

TEST_F(LostContext, NoMemoryOfTheDeviceIsALineAndTheNextPictureIsWhole) {
    for (const char* method : {"ldm-ao", "photon-mapping"}) {
        const auto afresh = [&] {
            thread->release("a");
            forget();
            return thread->request(picture(method, 1));
        };
        const auto expected = finished(afresh()).images.at(Part{}).pixels;
        const long before = test::gl_storages();
        EXPECT_EQ(finished(afresh()).images.at(Part{}).pixels, expected);
        const long storages = test::gl_storages() - before;
        ASSERT_GT(storages, 3);
        for (long i = 1; i <= storages; ++i) {
            test::refuse_storage_at(i);
            afresh();
            ASSERT_TRUE(wait([](const Answers& a) { return !a.failures.empty() || !a.results.empty(); }));
            EXPECT_TRUE(test::was_storage_refused());
            const auto failures = answers().failures;
            ASSERT_EQ(failures.size(), 1u) << method << ": " << i << " of " << storages;
            const auto& line = failures.front().error;
            EXPECT_NE(line.find("MiB, which the device does not have; lower --memory"), std::string::npos)
                << line;
            EXPECT_EQ(line.find('\n'), std::string::npos) << line;
            test::refuse_storage_at(0);
            forget();
            EXPECT_EQ(finished(thread->request(picture(method, 1))).images.at(Part{}).pixels, expected);
            if (HasFailure()) FAIL() << method << ": refused at " << i << " of " << storages;
        }
        RecordProperty(std::string("storages of ") + method, int(storages));
    }
}

}  // namespace
}  // namespace ir::engine
