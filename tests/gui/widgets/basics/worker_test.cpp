#include "widgets/models/worker.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <semaphore>
#include <thread>
#include <vector>

namespace ir::widgets {
namespace {

TEST(WorkerTest, JobsComeOneAfterTheOtherInAThreadOfTheirOwn) {
    std::vector<int> order;
    std::vector<std::thread::id> threads;
    std::binary_semaphore done(0);
    Worker worker;
    for (int i = 0; i < 100; ++i)
        worker.start([&, i] {
            order.push_back(i);
            threads.push_back(std::this_thread::get_id());
            if (i == 99) done.release();
        });
    done.acquire();
    ASSERT_EQ(order.size(), 100u);
    for (int i = 0; i < 100; ++i) EXPECT_EQ(order[i], i);
    for (const auto& thread : threads) {
        EXPECT_EQ(thread, threads.front());
        EXPECT_NE(thread, std::this_thread::get_id());
    }
}

TEST(WorkerTest, WhatWaitsIsForgottenAtTheEndAndWhatRunsIsWaitedFor) {
    std::binary_semaphore begun(0), may_end(0);
    std::atomic<bool> ended = false, second = false;
    Worker worker;
    worker.start([&] {
        begun.release();
        may_end.acquire();
        ended = true;
    });
    auto held = std::make_shared<int>();
    const std::weak_ptr<int> waiting = held;
    worker.start([&second, held = std::move(held)] { second = true; });
    begun.acquire();
    std::thread releases([&] {
        while (!waiting.expired()) std::this_thread::yield();
        may_end.release();
    });
    worker.finish();
    EXPECT_TRUE(ended);
    EXPECT_FALSE(second);
    releases.join();
}

TEST(WorkerTest, WorksOnAfterItWasFinished) {
    Worker worker;
    worker.finish();
    std::binary_semaphore done(0);
    worker.start([&] { done.release(); });
    EXPECT_TRUE(done.try_acquire_for(std::chrono::minutes(1)));
}

}  // namespace
}  // namespace ir::widgets
