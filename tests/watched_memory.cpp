#include "tests/watched_memory.hpp"

#include <cstdlib>
#include <new>

namespace {

bool isWatching = false;
std::size_t largest = 0;

void* takeOrNull(std::size_t bytes) noexcept {
  if (isWatching && bytes > largest) largest = bytes;
  return std::malloc(bytes > 0 ? bytes : 1);
}

void* take(std::size_t bytes) {
  if (void* const memory = takeOrNull(bytes)) return memory;
  throw std::bad_alloc();
}

}  // namespace

// What new and delete do in this program.
void* operator new(std::size_t bytes) {
  return take(bytes);
}
void* operator new[](std::size_t bytes) {
  return take(bytes);
}
// What algorithms sort and merge with.
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  return takeOrNull(bytes);
}
void* operator new[](std::size_t bytes, const std::nothrow_t&) noexcept {
  return takeOrNull(bytes);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace lampblack::test {

std::size_t largestTaken(const std::function<void()>& work) {
  largest = 0;
  isWatching = true;
  work();
  isWatching = false;
  return largest;
}

}  // namespace lampblack::test
