// SPDX-FileCopyrightText: 2026 The Regolith authors
// SPDX-License-Identifier: BSD-3-Clause
#include "regolith/core/serial_worker.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <thread>
#include <vector>

namespace regolith {
namespace {

TEST(SerialWorker, WorksOffTasksInTheirOrder) {
  for (const size_t capacity : {size_t{0}, size_t{1}, size_t{50}}) {
    std::vector<int> order;
    SerialWorker worker(capacity);
    for (int i = 0; i < 100; ++i) worker.Post([&order, i] { order.push_back(i); });
    worker.WaitFor(100);
    EXPECT_EQ(worker.posted(), 100U);
    EXPECT_EQ(worker.done(), 100U);
    ASSERT_EQ(order.size(), 100U);
    for (int i = 0; i < 100; ++i) EXPECT_EQ(order[static_cast<size_t>(i)], i);
  }
}

TEST(SerialWorker, OnlyAThreadOfItsOwnWorksBesideTheCaller) {
  std::thread::id worked_by;
  SerialWorker inline_worker(0);
  inline_worker.Post([&] { worked_by = std::this_thread::get_id(); });
  EXPECT_EQ(worked_by, std::this_thread::get_id());
  SerialWorker worker(4);
  worker.Post([&] { worked_by = std::this_thread::get_id(); });
  worker.WaitFor(1);
  EXPECT_NE(worked_by, std::this_thread::get_id());
}

TEST(SerialWorker, TwoThatWaitForEachOther) {
  for (const size_t capacity : {size_t{0}, size_t{3}}) {
    SerialWorker first(capacity);
    SerialWorker second(capacity);
    std::vector<int> order;
    for (size_t i = 0; i < 20; ++i) {
      first.Post([&, i] {
        second.WaitFor(i);
        order.push_back(1);
      });
      second.Post([&, i] {
        first.WaitFor(i + 1);
        order.push_back(2);
      });
    }
    second.WaitFor(20);
    for (size_t i = 0; i < order.size(); ++i) EXPECT_EQ(order[i], i % 2 == 0 ? 1 : 2);
  }
}

TEST(SerialWorker, AFailureReachesTheCallerAndNobodyWaitsForEver) {
  for (const size_t capacity : {size_t{0}, size_t{8}}) {
    SerialWorker worker(capacity);
    bool later_one_worked = false;
    EXPECT_THROW(
        {
          worker.Post([] { throw std::runtime_error("no"); });
          worker.WaitFor(1);
          worker.Post([&] { later_one_worked = true; });
        },
        std::runtime_error);
    worker.WaitFor(1);
    EXPECT_THROW(worker.RethrowFailure(), std::runtime_error);
    EXPECT_FALSE(later_one_worked);
  }
}

TEST(SerialWorker, StopFreesThoseWhoWait) {
  SerialWorker first(1);
  SerialWorker second(1);
  // Neither is ever done: each waits for the other's second task.
  first.Post([&] { second.WaitFor(2); });
  second.Post([&] { first.WaitFor(2); });
  first.Stop();
  second.Stop();
  first.WaitFor(2);
  SUCCEED();
}

}  // namespace
}  // namespace regolith
