// Counts what a program takes from memory: watched_memory.cpp replaces its new and delete.
#pragma once

#include <cstddef>
#include <functional>

namespace lampblack::test {

// Bytes: the most that `work` took at once.
std::size_t largestTaken(const std::function<void()>& work);

}  // namespace lampblack::test
