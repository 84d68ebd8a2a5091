/// What is expected of every rival: that threads with a session each get the bits of one thread.
#pragma once

#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "tests/baselines/meshes.h"

namespace touchmark::baselines {

template <class D>
void expect_threads_to_get_the_same_bits(const D& detector, int probes = 200) {
  const auto distances = [&] {
    typename D::Session session;
    Random random(10);
    std::vector<double> all;
    for (int i = 0; i < probes; ++i) {
      const auto contact = detector.nearest({random.point(), 0}, 0.3, session);
      all.push_back(contact ? contact->distance : -1);
    }
    return all;
  };
  const std::vector<double> expected = distances();
  std::vector<std::vector<double>> got(4);
  std::vector<std::thread> threads;
  for (auto& mine : got) threads.emplace_back([&mine, &distances] { mine = distances(); });
  for (std::thread& thread : threads) thread.join();
  for (const auto& mine : got) EXPECT_EQ(mine, expected);
}

}  // namespace touchmark::baselines
